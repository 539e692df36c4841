# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Random small scenes, and what to make of a run of one: did it crash, gain energy, change its
volume, move faster than its energy allows?"""

import math
import random

BODIES = {"sphere": "Centre", "cylinder": "Centre", "capsule": "Start", "torus": "Centre", "box": "Lower corner"}
WALLS = ("no slip", "free slip", "default: free slip; bottom: no slip", "default: no slip; left, right: free slip")


class Scene:
    """A scene from a seed: `settings` by section; `describe()` says in a few words what it is."""

    def __init__(self, seed):
        self.draw = random.Random(seed)
        self.dim = self.draw.choice((2, 2, 3))
        self.level = self.draw.choice((4, 5, 6) if self.dim == 2 else (3, 4))
        self.viscosity = 0 if self.draw.random() < 0.1 else 10 ** self.draw.uniform(-1, 8)
        self.density = 10 ** self.draw.uniform(0, 4)
        self.speed, self.words = 0.0, []
        self.settings = {}
        self.add("", {"Dimension": self.dim, "End time": 0.5, "Frame interval": 0.05,
                      "Maximum time step": self.draw.choice((0.0125, 0.05)),
                      "Maximum CFL number": self.draw.choice((0.5, 1, 3, 3, 10))})
        self.add("Domain", {"Lower corner": self.point([0] * self.dim), "Upper corner": self.point([1] * self.dim),
                            "Wall condition": self.draw.choice(WALLS)})
        self.add("Mesh", {"Surface level": self.level, "Interior level": self.level - self.draw.choice((0, 1)),
                          "Air level": 2})
        self.add("Gravity", {"Acceleration": self.components([0] * (self.dim - 1) + [-9.81])})
        self.add("Output", {"Surface format": "none", "Mesh format": "none"})
        self.add("Checkpoint", {"Interval": 0})
        self.add_liquids()
        for kind, chance in (("Solid 1", 0.4), ("Emitter 1", 0.2)):
            if self.draw.random() < chance:
                self.words.append(getattr(self, "add_" + kind.split()[0].lower())(kind))

    def add(self, section, values):
        self.settings.setdefault(section, {}).update(values)

    def point(self, x):
        return ", ".join(f"{v:.4g}" for v in x)

    def components(self, x):
        return "; ".join(f"{v:.4g}" for v in x)

    def body(self, section, height, size):
        """A body of any shape at about a height of the box; its name."""
        shape = self.draw.choice(list(BODIES))
        centre = [self.draw.uniform(0.35, 0.65) for _ in range(self.dim - 1)] + [height]
        shift = [self.draw.uniform(0.3, 1) * size for _ in range(self.dim)]
        values = {"Shape": shape, "Radius": size, "Minor radius": 0.4 * size, "Length": 1.5 * size,
                  "Centre": self.point(centre), "Axis": "0, 0, 1" if self.dim == 3 else None,
                  "Lower corner": self.point([c - s for c, s in zip(centre, shift)]),
                  "Upper corner": self.point([c + s for c, s in zip(centre, shift)]),
                  "Start": self.point([c - s for c, s in zip(centre, shift)]),
                  "End": self.point([c + s for c, s in zip(centre, shift)])}
        keep = {"sphere": ("Centre", "Radius"), "cylinder": ("Centre", "Radius", "Length", "Axis"),
                "capsule": ("Start", "End", "Radius"), "box": ("Lower corner", "Upper corner"),
                "torus": ("Centre", "Radius", "Minor radius", "Axis")}[shape]
        if shape == "capsule":
            values["Radius"] = 0.5 * size
        self.add(section, {"Shape": shape, **{name: values[name] for name in keep if values[name] is not None}})
        return shape

    def velocity(self, section, largest):
        v = [self.draw.uniform(-largest, largest) for _ in range(self.dim)]
        self.add(section, {"Velocity": self.components(v)})
        self.speed = max(self.speed, math.hypot(*v))

    def add_liquids(self):
        material = {"Density": f"{self.density:.4g}", "Viscosity": f"{self.viscosity:.4g}"}
        self.words.append(self.body("Liquid 1", self.draw.uniform(0.45, 0.65), self.draw.uniform(0.1, 0.25)))
        if self.draw.random() < 0.4:
            self.velocity("Liquid 1", 2)
        if self.draw.random() < 0.4:
            depth = self.draw.uniform(0.12, 0.3)
            self.add("Liquid 2", {"Shape": "half space", "Centre": self.point([0] * (self.dim - 1) + [depth]),
                                  "Normal": self.point([0] * (self.dim - 1) + [1])})
            self.words.append("pool")
            if self.draw.random() < 0.5:
                contrast = 10 ** self.draw.uniform(-4, 4)
                material["Transport"] = "advected"
                self.add("Liquid 2", {"Viscosity": f"{max(self.viscosity, 1e-3) * contrast:.4g}"})
                self.words.append(f"contrast {contrast:.0e}")
        self.add("Material", material)

    def add_solid(self, section):
        name = self.body(section, self.draw.uniform(0.1, 0.3), self.draw.uniform(0.08, 0.15))
        if self.draw.random() < 0.5:
            self.velocity(section, 0.5)
            return "moving " + name
        return "solid " + name

    def add_emitter(self, section):
        down = self.draw.uniform(0.3, 2)
        self.add(section, {"Shape": "sphere", "Radius": 0.08,
                           "Centre": self.point([0.25] * (self.dim - 1) + [0.85]),
                           "Velocity": self.components([0] * (self.dim - 1) + [-down])})
        self.speed = max(self.speed, down)
        return "emitter"

    def is_closed(self):
        """Does nothing put energy in?"""
        return not any(word == "emitter" or word.startswith("moving") for word in self.words)

    def text(self):
        """The parameter file."""
        lines = []
        for section, values in self.settings.items():
            lines += [f"subsection {section}"] if section else []
            lines += [f"  set {name} = {value}" for name, value in values.items()]
            lines += ["end"] if section else []
        return "\n".join(lines) + "\n"

    def describe(self):
        return (f"{self.dim}D level {self.level}, mu {self.viscosity:.0e}, CFL "
                f"{self.settings['']['Maximum CFL number']}, {', '.join(self.words)}")


class Verdict:
    """What a run of a scene did, from its statistics: all relative."""

    def __init__(self, scene, table):
        # by the velocity that moves the liquid
        energy = [p + k for p, k in zip(table["Potential energy (J)"], table["Nodal kinetic energy (J)"])]
        self.n_steps = len(energy) - 1
        scale = max(energy[0], 1e-30)
        least = energy[0]
        self.energy_gained = 0.0
        for value in energy:
            least = min(least, value)
            self.energy_gained = max(self.energy_gained, (value - least) / scale)
        if not scene.is_closed():
            self.energy_gained = 0.0
        self.drift = max(map(abs, table["Volume drift"]))
        self.largest_step_drift = max(map(abs, table.get("Drift before correction", [0])))
        self.repetitions = int(sum(table.get("Repetitions", [0])))
        self.fallbacks = int(sum(table["Fallbacks"]))
        fastest = max(table["Maximum speed (m/s)"])
        # all of the box's height fallen through, and squeezed out between bodies at twice that
        allowed = 2 * math.sqrt(scene.speed ** 2 + 2 * 9.81 * 1)
        self.speed = fastest / allowed
