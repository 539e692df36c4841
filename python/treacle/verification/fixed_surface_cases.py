# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""The cases of the viscous step (section A) and of closed or fixed regions (section B),
for scripts/verify."""

import math

from treacle.verification.cases import EULER, Case, Program
from treacle.verification.measures import at, last, rate

U = "Probe 1 velocity x (m/s)"
V = "Probe 1 velocity y (m/s)"
STRESS = "Solid 1 force x (N)"

THIN_LAYER = {"Liquid 1/Viscosity": "0.01", "End time": "6", "Frame interval": "6"}
ARMADILLO = {"Liquid 1/Shape": "triangle mesh", "Liquid 1/File": "results/meshes/armadillo.off",
             "Liquid 1/Centre at origin": "true", "Liquid 1/Rotation axis": "1, 0, 0",
             "Liquid 1/Rotation angle": "-90", "Liquid 1/Scale": "0.0042",
             "Liquid 1/Translation": "0.5, 0.5, 0.4",
             "Pressure/Minimum theta": "0.01"}  # face coupled does not converge with less
EXPONENTIAL = {"Material/Viscosity": "100^y"}
CUT_FLOOR = {"Domain/Lower corner": "0, -0.1", "Domain/Upper corner": "8.1, 1.25",
             "Solid 1/Upper corner": "4.5175, 3", "Solid 3/Lower corner": "4.5175, 1",
             "Solid 4/Shape": "half space", "Solid 4/Centre": "0, 0", "Solid 4/Normal": "0, 1"}
CUT_WALL = {"Domain/Lower corner": "0, -0.1", "Domain/Upper corner": "5.4, 1.25",
            "Solid 2/Shape": "half space", "Solid 2/Centre": "0, 0", "Solid 2/Normal": "0, 1"}

VORTEX = {"rate": (rate("Kinetic energy (J)", 2), 2 * 0.1 * math.pi ** 2),
          "u, t = 0.2": (at(U, 0.2), math.sqrt(0.5) * math.exp(-0.04 * math.pi ** 2))}
COUETTE = {"u, t = 0.05": (at(U, 0.05), 0.113844197), "u, t = 0.1": (at(U, 0.1), 0.26275627),
           "u, t = 0.2": (at(U, 0.2), 0.41156643)}
POISEUILLE = {"u, t = 0.05": (at(U, 0.05), 0.370386318), "u, t = 0.1": (at(U, 0.1), 0.615352514),
              "u, t = 0.2": (at(U, 0.2), 0.856636891)}
PIPE = {"u, t = 0.0125": (at(U, 0.0125), 0.199616616), "u, t = 0.025": (at(U, 0.025), 0.385189504),
        "u, t = 0.05": (at(U, 0.05), 0.651795592)}
CYLINDERS = {"u": (at(V, 0.2), 0.0972222222),
             "u at 0.9 rad": (lambda table: table["Probe 2 velocity y (m/s)"][-1] * math.cos(0.9)
                              - table["Probe 2 velocity x (m/s)"][-1] * math.sin(0.9), 0.0972222222),
             "torque": (last("Solid 1 torque (N m)"), -1.047198)}
TWO_VISCOSITIES = {
    "u, left": (last(U), 0.00114834638), "v, left": (last(V), 0.00041332528),
    "p, left": (last("Probe 1 pressure (Pa)"), 0.168316173),
    "v, middle": (last("Probe 2 velocity y (m/s)"), 0.000584530216),
    "u, right": (last("Probe 3 velocity x (m/s)"), 2.32207206e-5),
    "v, right": (last("Probe 3 velocity y (m/s)"), 2.61923373e-5),
    "p, right": (last("Probe 3 pressure (Pa)"), -0.0287334587)}
BY_VELOCITY = {"Mesh/Size": "", "Mesh/Velocity error": "0.02", "Mesh/Interior level": 2, "Mesh/Air level": 2,
               "Steps/Surface": "true", "Steps/Advection": "true", "End time": "5e-3", "Frame interval": "5e-3"}
DRAG = {"force": (last("Solid 1 force z (N)"), -1.12636448 * 6 * math.pi / 4)}  # of a quarter
ONE_VISCOSITY = {"u": (last(U), 0.012665148),
                 "v": (last("Probe 2 velocity y (m/s)"), -0.017911224)}


def layered(stress, width=1):
    return {"stress": (last(STRESS), -stress * width), "u": (last(U), 0.909090909)}


def growth(exact, end):
    """Of the velocity, as its energy tells, from a tenth of the time on."""
    return {"growth": (rate("Nodal kinetic energy (J)", -2, 0.1 * end), exact)}


CONSERVED = {"angular momentum": 1e-10, "energy": 1e-10, "momentum": 1e-10}
FACES = {"mean": 0.01, "worst face": 0.05}
FACES_3D = {"mean": 0.05, "worst face": 0.2}  # 5 leaves in the radius, at most
MANUFACTURED = {"nodes, mean": 0.01, "nodes, worst": 0.02, "faces, mean": 0.01, "faces, worst": 0.02}
MANUFACTURED_3D = {quantity: 0.05 for quantity in MANUFACTURED}

VISCOUS_CASES = {
    "A1": Program("viscosity/rigid_rotation", ("2",), 4, CONSERVED, order=None, n_levels=2),
    "A1 3D": Program("viscosity/rigid_rotation", ("3",), 4, CONSERVED, order=None, n_levels=2),
    "A1 Armadillo": Program("viscosity/rigid_rotation", ("3",), 6, CONSERVED, ARMADILLO, None, 1),
    "A2": Program("viscosity/traction_free", ("2",), 4, FACES),
    "A3": Program("viscosity/traction_free", ("3",), 4, FACES_3D, n_levels=2),
    "A4": Program("viscosity/spin_down", (), 4, {"laplacian": 0.01, "full": 0.01}),
    "A6": Case("layered_couette", 4, 0.0005, layered(1.81818182)),
    "A6 exponential": Case("layered_couette", 4, 0.0005, layered(4.65168706), EXPONENTIAL),
    "A6 cut": Case("layered_couette", 4, 0.0005, layered(1.81818182, 1.0125), CUT_FLOOR),
    "A6 exponential, cut": Case("layered_couette", 4, 0.0005, layered(4.65168706, 1.0125),
                                {**EXPONENTIAL, **CUT_FLOOR}),
    "A7": Program("viscosity/manufactured", ("2",), 5, MANUFACTURED, order=1.5),
    "A7 3D": Program("viscosity/manufactured", ("3",), 4, MANUFACTURED_3D, order=1.5, n_levels=2),
}

CLOSED_CASES = {
    "B1": Case("taylor_green", 3, 0.02, VORTEX, in_time=({}, EULER)),
    "B1 MacCormack": Case("taylor_green", 3, 0.02, VORTEX, {"Advection/Scheme": "MacCormack"},
                          in_time=({},)),
    "B1 no advection": Case("taylor_green", 3, 0.02, VORTEX, {"Steps/Advection": "false"}),
    "B2": Case("couette", 3, 0.01, COUETTE, in_time=({}, EULER)),
    "B2 cut wall": Case("couette", 3, 0.01, COUETTE, CUT_WALL),
    "B3": Case("poiseuille", 3, 0.01, POISEUILLE, in_time=({},)),
    "B4": Case("pipe", 4, 0.0025, PIPE, n_levels=2),
    "B5": Case("rotating_cylinders", 4, 0.02, CYLINDERS),
    "B7": Case("two_viscosities", 4, 0.05, TWO_VISCOSITIES, in_time=({},)),
    "B7 viscosity 1": Case("two_viscosities", 4, 0.05, ONE_VISCOSITY, {"Material/Viscosity": 1},
                           in_time=({},)),
    "B8": Case("sphere_drag", 5, 1e-3, DRAG, {"Mesh/Interior level": 2, "Mesh/Air level": 2}, order=None),
    "B8 velocity error": Case("sphere_drag", 5, 1e-3, DRAG, BY_VELOCITY, order=None),
    "B9": Case("rayleigh_taylor", 1, 2, growth(0.0109031, 60), tolerance=0.03, order=None),
    "B9 viscosity 0.01": Case("rayleigh_taylor", 1, 0.2, growth(0.103834, 6), THIN_LAYER, 0.03, None),
    "B10": Case("square_decay", 4, 4e-3, {"rate": (rate("Kinetic energy (J)", 2, 0.08), 52.3446911)}, in_time=({},)),
    "B11": Case("spin_down", 4, 2e-3, {"rate": (rate("Kinetic energy (J)", 2, 0.03), (3.83170597 / 0.43) ** 2)},
                in_time=({},)),
    "B12": Case("added_mass", 5, 0.01, {"force": (last("Solid 2 force x (N)"), -1000 * math.pi * 0.2 ** 2 * 5 / 3)}),
}
