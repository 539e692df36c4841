# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Meshes of triangles for symmetric containers in two dimensions."""


def half_width(profile, y):
    """At a height."""
    for (y0, w0), (y1, w1) in zip(profile, profile[1:]):
        if y <= y1:
            return w0 + (w1 - w0) * (y - y0) / (y1 - y0)
    return profile[-1][1]


def heights(profile, size):
    """Of the rows of points: about equilateral triangles, a row at each corner."""
    result = [profile[0][0]]
    for (y0, _), (y1, _) in zip(profile, profile[1:]):
        n = max(1, round((y1 - y0) / (0.866 * size)))
        result += [y0 + (y1 - y0) * k / n for k in range(1, n + 1)]
    return result


def row(width, size, is_odd):
    """Points from wall to wall; odd rows begin and end with half an edge."""
    n = max(1, round(2 * width / size))
    edge = 2 * width / n
    if is_odd:
        return [-width] + [-width + (k + 0.5) * edge for k in range(n)] + [width]
    return [-width + k * edge for k in range(n + 1)]


def zip_rows(points, low, high):
    """Triangles between two rows of point numbers, by the shorter diagonal."""
    def length2(a, b):
        return sum((s - t) ** 2 for s, t in zip(points[a], points[b]))

    i = j = 0
    while i + 1 < len(low) or j + 1 < len(high):
        if j + 1 == len(high) or (i + 1 < len(low) and
                                  length2(low[i + 1], high[j]) <= length2(low[i], high[j + 1])):
            yield low[i], low[i + 1], high[j]
            i += 1
        else:
            yield low[i], high[j + 1], high[j]
            j += 1


def mesh_of(profile, size):
    """Points (x, y) and triangles (numbers of points) of the container with this profile, pairs
    of height and half width in m from the bottom up; size (m): of the triangles' edges."""
    points, cells, last = [], [], None
    for k, y in enumerate(heights(profile, size)):
        xs = row(half_width(profile, y), size, k % 2)
        this = range(len(points), len(points) + len(xs))
        points += [(x, y) for x in xs]
        if last is not None:
            cells += zip_rows(points, last, this)
        last = this
    return points, cells


def write(path, points, cells):
    """A file in Gmsh's format .msh, version 2.2."""
    with open(path, "w") as out:
        out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(points)}\n")
        for k, (x, y) in enumerate(points, 1):
            out.write(f"{k} {x:.7g} {y:.7g} 0\n")
        out.write(f"$EndNodes\n$Elements\n{len(cells)}\n")
        for k, cell in enumerate(cells, 1):
            out.write(f"{k} 2 2 0 1 {' '.join(str(v + 1) for v in cell)}\n")
        out.write("$EndElements\n")
