# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""A viscous drop hits a floor (cases C9d and C9d 3D), computed independently of Treacle.

Problem. A disc (or, axisymmetric, a sphere) of diameter 1, density 1, viscosity 0.2 falls at speed 1 from height 2
(its centre), gravity 0.19578667, onto a floor that holds it (or lets it slip); no surface tension, no air. Wanted: its
width.

Method. Lagrangian finite elements: P1 velocity and stabilised P1 pressure on triangles that move with it, the
midpoint rule (or backward Euler) on the mesh at mid step, which keeps the volume, x >= 0 only. A node that would fall
through the floor is put on it, and stays. Poor triangles: the outline is resampled by cubic splines, finer by
`--refinement` near the contact line, the interior anew from a hexagonal lattice. The fall (until
t = 1.328) is exact.

usage: /usr/bin/python3 doc/verification/drop_impact.py [--slip] [--axisymmetric] [--spacing h] [--step dt] [--decay]

Widths at t = 1.5, 1.8, 2, 2.5, 3; mass error; energy (kinetic, potential, dissipated) lost, of the kinetic at landing:

| floor | spacing, step | widths | mass | energy |
|---|---|---|---|---|
| holds | 1/20, 1/160 | 1.173, 1.516, 1.602, 1.680, 1.712 | 9e-4 | -4.1 % |
| | 1/20, 1/320 | 1.174, 1.516, 1.603, 1.680, 1.713 | 9e-4 | -3.3 % |
| | 1/40, 1/320 | 1.174, 1.516, 1.603, 1.681, 1.714 | 4e-4 | -2.1 % |
| | 1/80, 1/320 | 1.174, 1.516, 1.603, 1.681, 1.714 | 2e-4 | -1.4 % |
| | published | 1.185, 1.598, 1.721, 1.844, 1.892 | | |
| slips | 1/20, 1/160 | 1.183, 1.669, 1.862, 2.142, 2.288 | 3e-4 | -2.3 % |
| | 1/40, 1/320 | 1.183, 1.671, 1.865, 2.144, 2.292 | 1e-4 | -1.3 % |
| | 1/60, 1/200 | 1.183, 1.671, 1.866, 2.145, 2.293 | 6e-5 | -1.2 % |
| holds, axisymmetric | 1/20, 1/160 | 1.069, 1.302, 1.345, 1.372, 1.387 | 9e-4 | -2.8 % |
| | 1/40, 1/320 | 1.069, 1.302, 1.345, 1.372, 1.388 | 4e-4 | -1.4 % |
| | 1/60, 1/200 | 1.069, 1.302, 1.345, 1.373, 1.388 | 2e-4 | -1.4 % |
| | published | 1.072, 1.334, 1.395, 1.437, 1.455 | | |

Energy goes where nodes land, nearly all before t = 1.4. Refinement 1 to 8, backward Euler, a quarter of the
stabilisation: the last width within 0.1 %. Validated: `--decay`, a free disc that strains (spacing 1/10, 1/20, 1/40:
+3.4, +0.75, +0.18 % off the exact rate); the slump C9c (spacing 1/20, corner rounded by 0.04): x = 1.0892, 1.2764,
1.429, 1.697, 1.877 at t = 1, 3, 5, 10, 15 (published 1.0887, 1.2761, 1.4354, 1.7327, 1.9406). The published widths of
the drop come out with viscosity 0.145 (axisymmetric: 0.156), or on a floor with a slip length of 0.18 (both).
"""
import argparse
import time

import numpy
from matplotlib.path import Path
from matplotlib.tri import CubicTriInterpolator, Triangulation
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu
from scipy.spatial import Delaunay, cKDTree
from scipy.special import jv, jvp

RADIUS, VISCOSITY, GRAVITY, HEIGHT = 0.5, 0.2, 0.19578667, 2  # the density is 1
TIMES = (1.5, 1.8, 2, 2.5, 3)
QUADRATURE = numpy.full((3, 3), 1 / 6) + numpy.eye(3) / 2  # exact for quadratic functions


class Drop:
    """Half of a drop. Its nodes: the outline counterclockwise from the lowest on the axis, then the interior.
    The first n_contact lie on the floor; those from n_surface to n_outline (and the first) lie on the axis.
    Velocity u moves the nodes through a step, v is the one at its end."""

    def __init__(self, outline, n_surface, h, n_contact=1, refinement=2, slip=False, axisymmetric=False,
                 gravity=GRAVITY, theta=0.5):
        self.h, self.h_contact, self.slip, self.axisymmetric = h, h / refinement, slip, axisymmetric
        self.gravity, self.theta = gravity, theta
        self.x, self.v, self.u = outline, numpy.zeros_like(outline), numpy.zeros_like(outline)
        self.n_contact, self.n_surface, self.n_outline = n_contact, n_surface, len(outline)
        self.triangles, self.dissipated, self.n_meshes, self.pocket = None, 0.0, 0, 0.0
        self.remesh()

    def size(self, points):
        """The wanted distance between nodes."""
        if self.n_contact == 0:
            return numpy.full(len(points), self.h)
        distance = numpy.linalg.norm(points - self.line, axis=1)
        return numpy.minimum(self.h, self.h_contact + numpy.maximum(distance - 8 * self.h_contact, 0) / 4)

    def resampled(self, nodes):
        """Positions and velocities on a part of the outline, as far apart as wanted."""
        data = numpy.hstack((self.x, self.v, self.u))[nodes]
        s = numpy.append(0, numpy.cumsum(numpy.linalg.norm(numpy.diff(data[:, :2], axis=0), axis=1)))
        curve = CubicSpline(s, data)
        fine = numpy.linspace(0, s[-1], 4000)
        density = 1 / self.size(curve(fine)[:, :2])
        count = numpy.append(0, numpy.cumsum((density[1:] + density[:-1]) / 2 * numpy.diff(fine)))
        n = max(int(numpy.ceil(count[-1])), 1)
        result = curve(numpy.interp(numpy.linspace(0, count[-1], n + 1), count, fine))
        result[0], result[-1] = data[0], data[-1]
        return result

    def remesh(self):
        c, f = self.n_contact, self.n_surface
        self.line = self.x[max(c - 1, 0)].copy()
        self.x[:c, 1] = 0  # closes pockets
        parts = [self.resampled(numpy.arange(c))] if c > 1 else []
        parts.append(self.resampled(numpy.arange(max(c - 1, 0), f + 1)))
        parts.append(self.resampled(numpy.append(numpy.arange(f, self.n_outline), 0)))
        outline = numpy.vstack([part[:-1] for part in parts])
        outline[:, 1] = numpy.maximum(outline[:, 1], 0)
        self.n_contact = len(parts[0]) if c > 1 else c
        self.n_surface, self.n_outline = len(outline) - len(parts[-1]) + 1, len(outline)
        outline[:self.n_contact, 1] = outline[self.n_surface:, 0] = 0
        points, triangles = mesh(outline[:, :2], self.size, self.h, self.h_contact)
        velocities = numpy.vstack((outline[:, 2:], self.interpolated(points[len(outline):])))
        self.v, self.u = velocities[:, :2].copy(), velocities[:, 2:].copy()
        self.x, self.triangles = points, triangles
        self.n_meshes += 1

    def interpolated(self, points):
        """Both velocities, by cubics."""
        if self.triangles is None:
            return numpy.zeros((len(points), 4))
        old, data = Triangulation(*self.x.T, self.triangles), numpy.hstack((self.v, self.u))
        finder = old.get_trifinder()
        cubics = [CubicTriInterpolator(old, column, kind="geom", trifinder=finder) for column in data.T]
        result = numpy.stack([cubic(*points.T).filled(numpy.nan) for cubic in cubics], axis=-1)
        lost = numpy.isnan(result[:, 0])
        result[lost] = data[cKDTree(self.x).query(points[lost])[1]]
        return result

    def must_remesh(self):
        way = numpy.linalg.norm(self.x[max(self.n_contact - 1, 0)] - self.line)
        return quality(self.x, self.triangles).min() < 0.3 or (self.n_contact and way > 4 * self.h_contact)

    def forms(self, x):
        """At each quadrature point of the triangles: weight, shape functions, their gradients, and the strains
        xx, yy, xy * sqrt(2), hoop as rows that act on the nine unknowns (u_x, u_y, p at the corners)."""
        gradient, area = gradients(x[self.triangles])
        zero = numpy.zeros((len(area), 3))
        for shape in QUADRATURE:
            r = x[self.triangles, 0] @ shape if self.axisymmetric else numpy.ones(len(area))
            hoop = shape / r[:, None] if self.axisymmetric else zero
            shear = numpy.hstack((gradient[:, 1], gradient[:, 0], zero)) / numpy.sqrt(2)
            xx, yy = numpy.hstack((gradient[:, 0], zero, zero)), numpy.hstack((zero, gradient[:, 1], zero))
            yield area / 3 * r, shape, gradient, [xx, yy, shear, numpy.hstack((hoop, zero, zero))]

    def system(self, x, dt):
        """Matrix and right-hand side of a step, on the mesh x; the pressure is stabilised by the residual (PSPG)."""
        n, inertia = len(self.triangles), 1 / (self.theta * dt)
        matrix, vector = numpy.zeros((n, 9, 9)), numpy.zeros((n, 9))
        old = inertia * self.v[self.triangles] + [0, -self.gravity]
        tau = 1 / (4 * inertia + 15 * VISCOSITY / gradients(x[self.triangles])[1])
        zero = numpy.zeros((n, 3))
        for weight, shape, gradient, strains in self.forms(x):
            value = numpy.broadcast_to(shape, (n, 3))
            divergence, pressure = strains[0] + strains[1] + strains[3], numpy.hstack((zero, zero, value))
            for strain in strains:
                matrix += outer(2 * VISCOSITY * weight, strain, strain)
            matrix -= outer(weight, divergence, pressure) + outer(weight, pressure, divergence)
            for k in range(2):
                velocity = numpy.hstack((value, zero, zero) if k == 0 else (zero, value, zero))
                slope = numpy.hstack((zero, zero, gradient[:, k]))
                force = weight * (old[:, :, k] @ shape)
                matrix += outer(weight * inertia, velocity, velocity)
                matrix -= outer(weight * tau, slope, slope + inertia * velocity)
                vector += force[:, None] * (velocity - tau[:, None] * slope)
        n = 3 * len(self.x)
        unknowns = (3 * self.triangles[:, None, :] + numpy.arange(3)[None, :, None]).reshape(-1, 9)
        rows, columns = numpy.repeat(unknowns, 9, axis=1), numpy.tile(unknowns, (1, 9))
        a = coo_matrix((matrix.ravel(), (rows.ravel(), columns.ravel())), shape=(n, n)).tocsc()
        return a, numpy.bincount(unknowns.ravel(), vector.ravel(), n)

    def solve(self, x, dt, landing):
        """The velocity u of a step, on the mesh x; the nodes that land reach the floor at its end."""
        a, b = self.system(x, dt)
        fixed, value = numpy.zeros((len(x), 3), bool), numpy.zeros((len(x), 3))
        fixed[self.n_surface:self.n_outline, 0] = fixed[0, 0] = True
        fixed[:self.n_contact, 1] = fixed[landing, 1] = True
        if not self.slip:
            fixed[:self.n_contact, 0] = True
        value[landing, 1] = -self.x[landing, 1] / dt
        free, result = ~fixed.ravel(), value.ravel()
        b = (b - a @ result)[free]
        lu = splu(a[free][:, free], permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01, options={"SymmetricMode": True})
        result[free] = lu.solve(b)
        return result.reshape(-1, 3)[:, :2]

    def step(self, dt):
        """Moves the nodes; False, and nothing done, if a triangle suffers too much."""
        u, landing = self.u, numpy.zeros(len(self.x), bool)
        for _ in range(12):
            new = self.solve(self.x + dt / 2 * u, dt, landing)
            change, u = abs(new - u).max(), new
            below = self.x[:, 1] + dt * u[:, 1] < -1e-12
            below[:self.n_contact] = below[self.n_outline:] = False
            if not (below & ~landing).any() and change < 1e-3:
                break
            landing |= below
        x = self.x + dt * u
        if (areas(x[self.triangles]) < 0.4 * areas(self.x[self.triangles])).any():
            return False
        self.dissipated += dt * self.dissipation(self.x + dt / 2 * u, u)
        self.v, self.u, self.x = self.v + (u - self.v) / self.theta, u, x
        if landing.any():
            self.n_contact = max(self.n_contact, numpy.flatnonzero(landing)[-1] + 1)
            self.pocket = max(self.pocket, x[:self.n_contact, 1].max())
        for velocity in (self.v, self.u):
            velocity[:self.n_contact, 1 if self.slip else slice(2)] = 0
        return True

    def integral(self, function):
        """Over the whole drop (in the axisymmetric case divided by pi)."""
        return 2 * sum((weight * function(shape)).sum() for weight, shape, *_ in self.forms(self.x))

    def dissipation(self, x, u):
        corners = u[self.triangles]
        values = numpy.hstack((corners[:, :, 0], corners[:, :, 1], numpy.zeros((len(corners), 3))))
        return 4 * VISCOSITY * sum((weight * (strain * values).sum(axis=1) ** 2).sum()
                                   for weight, *_, strains in self.forms(x) for strain in strains)

    def mass(self):
        return self.integral(lambda shape: 1)

    def kinetic(self):
        return self.integral(lambda shape: ((shape @ self.v[self.triangles]) ** 2).sum(axis=1) / 2)

    def energy(self):
        return self.kinetic() + self.dissipated + self.gravity * self.integral(
            lambda shape: self.x[self.triangles, 1] @ shape)

    def widths(self):
        """Of the drop and of its contact with the floor."""
        return 2 * self.x[:, 0].max(), 2 * self.x[max(self.n_contact - 1, 0), 0]


def outer(weight, a, b):
    return (weight[:, None] * a)[:, :, None] * b[:, None, :]


def areas(corners):
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    return (ax * by - ay * bx) / 2


def gradients(corners):
    """Of the shape functions (triangle, direction, corner), and the areas."""
    edge, area = numpy.roll(corners, -2, axis=1) - numpy.roll(corners, -1, axis=1), areas(corners)
    return numpy.stack((-edge[:, :, 1], edge[:, :, 0]), axis=1) / (2 * area)[:, None, None], area


def quality(x, triangles):
    """One for equilateral triangles, 0 for flat ones."""
    corners = x[triangles]
    return 4 * numpy.sqrt(3) * areas(corners) / ((corners - numpy.roll(corners, 1, axis=1)) ** 2).sum(axis=(1, 2))


def lattice(low, high, a):
    x, y = numpy.meshgrid(numpy.arange(low[0], high[0], a), numpy.arange(low[1], high[1], a * numpy.sqrt(3) / 2))
    x[1::2] += a / 2
    return numpy.stack((x.ravel(), y.ravel()), axis=-1)


def triangulated(points, path):
    triangles = Delaunay(points).simplices
    triangles = triangles[path.contains_points(points[triangles].mean(axis=1))]
    clockwise = areas(points[triangles]) < 0
    triangles[clockwise] = triangles[clockwise, ::-1]
    return triangles[quality(points, triangles) > 1e-3]


def mesh(outline, size, h, h_fine):
    """Points (those of the outline first) and triangles: hexagonal lattices of spacing h, h / 2, ..., smoothed."""
    path, parts, n = Path(outline), [], len(outline)
    for k in range(int(numpy.ceil(numpy.log2(h / h_fine) - 1e-9)) + 1):
        points = lattice(outline.min(axis=0), outline.max(axis=0), h / 2 ** k)
        parts.append(points[numpy.rint(numpy.log2(h / size(points))) == k])
    points = numpy.vstack(parts)
    points = points[path.contains_points(points)]
    points = points[cKDTree(outline).query(points)[0] > 0.7 * size(points)]
    points = numpy.vstack((outline, points))
    for _ in range(4):
        triangles = triangulated(points, path)
        edges = numpy.vstack([triangles[:, [i, j]] for i in range(3) for j in range(3) if i != j])
        degree = numpy.maximum(numpy.bincount(edges[:, 0], minlength=len(points)), 1)
        mean = [numpy.bincount(edges[:, 0], points[edges[:, 1], k], len(points)) / degree for k in range(2)]
        points[n:] = numpy.stack(mean, axis=-1)[n:]
    triangles = triangulated(points, path)
    x, y = outline.T
    area = (x * numpy.roll(y, -1) - y * numpy.roll(x, -1)).sum() / 2
    assert abs(areas(points[triangles]).sum() / area - 1) < 1e-6  # else the triangles do not fill the outline
    return points, triangles


def half_disc(h, bottom=0):
    """An outline, and the place of its topmost node."""
    angle = numpy.linspace(-numpy.pi / 2, numpy.pi / 2, int(numpy.pi * RADIUS / h) * 4)
    arc = RADIUS * numpy.stack((numpy.cos(angle), numpy.sin(angle)), axis=-1)
    arc[[0, -1], 0] = 0
    axis = numpy.linspace(arc[-1], arc[0], int(2 * RADIUS / h) + 1)[1:-1]
    return numpy.vstack((arc - arc[0], axis - arc[0])) + [0, bottom], len(arc) - 1


def impact(h, dt, **options):
    """Times, widths and widths of the contact; the errors of mass and energy; the drop."""
    drop = Drop(*half_disc(h), h, **options)
    speed = numpy.sqrt(1 + 2 * GRAVITY * (HEIGHT - RADIUS))
    t = landing = (speed - 1) / GRAVITY
    drop.v[1:] = drop.u[1:] = 0, -speed
    mass, energy, kinetic = drop.mass(), drop.energy(), drop.kinetic()
    history = [(t, *drop.widths())]
    while t < TIMES[-1] - 1e-9:
        part = min(dt, dt / 32 + (t - landing) / 10, TIMES[-1] - t)  # contact first spreads like a square root
        while not drop.step(part):
            part /= 2
        t += part
        history.append((t, *drop.widths()))
        if drop.must_remesh():
            drop.remesh()
    return numpy.array(history).T, drop.mass() / mass - 1, (drop.energy() - energy) / kinetic, drop


def decay(h, dt):
    """The rate at which the strain of a free disc decays, exact and computed: exp(-nu k^2 t),
    stream function (r^2 + b J_2(k r)) sin 2 theta, with neither shear nor normal stress at the surface."""
    def shear(z):
        return z * jvp(2, z) - z ** 2 * jvp(2, z, 2) - 4 * jv(2, z)

    z = brentq(lambda z: (4 - z ** 2) * shear(z) + 16 * (z * jvp(2, z) - jv(2, z)), 2, 2.5)
    k, b = z / RADIUS, 4 * RADIUS ** 2 / shear(z)
    drop = Drop(*half_disc(h, RADIUS), h, n_contact=0, gravity=0)
    x, y = (drop.x - [0, 2 * RADIUS]).T
    r, angle = numpy.maximum(numpy.hypot(x, y), 1e-9), numpy.arctan2(y, x)
    radial = 2 * (r + b * jv(2, k * r) / r) * numpy.cos(2 * angle)
    around = -(2 * r + b * k * jvp(2, k * r)) * numpy.sin(2 * angle)
    drop.v[:] = 1e-4 * numpy.stack((radial * x - around * y, radial * y + around * x), axis=-1) / r[:, None]
    energy = drop.kinetic()
    for _ in range(round(0.1 / dt)):
        drop.step(dt)
    return VISCOSITY * k ** 2, numpy.log(energy / drop.kinetic()) / 2 / 0.1


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--spacing", type=float, default=0.05)
    parser.add_argument("--step", type=float, help="spacing / 8 unless given")
    parser.add_argument("--refinement", type=float, default=2, help="spacing over that at the contact line")
    parser.add_argument("--theta", type=float, default=0.5, help="0.5: midpoint rule, 1: backward Euler")
    parser.add_argument("--slip", action="store_true")
    parser.add_argument("--axisymmetric", action="store_true")
    parser.add_argument("--decay", action="store_true", help="the validation")
    a = parser.parse_args()
    start, dt = time.time(), a.step or a.spacing / 8
    if a.decay:
        exact, rate = decay(a.spacing, dt)
        print(f"spacing {a.spacing:g}, step {dt:g}: rate {rate:.5f}, exact {exact:.5f}, {rate / exact - 1:+.1e}")
        return
    (t, width, contact), mass, energy, drop = impact(
        a.spacing, dt, refinement=a.refinement, slip=a.slip, axisymmetric=a.axisymmetric, theta=a.theta)
    print(f"spacing {a.spacing:g}, step {dt:g}, {len(drop.x)} nodes, {drop.n_meshes} meshes, "
          f"{time.time() - start:.0f} s; mass {mass:+.1e}, energy {energy:+.1e}, pockets {drop.pocket:.1e}")
    for name, values in (("width", width), ("contact", contact)):
        print(name, " ".join(f"{value:.4f}" for value in numpy.interp(TIMES, t, values)))


if __name__ == "__main__":
    main()
