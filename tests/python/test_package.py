# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""What the package treacle reads of a run, and what it says where that cannot be read."""

import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy
from synthetic_run import write_run

from treacle import DataError, Run, read_parameters, read_statistics, read_surface, read_timing
from treacle.bodies import distance
from treacle.formula import formula
from treacle.layers import problems
from treacle.mesh import Mesh
from treacle.motion import Motion
from treacle.run import Solid
from treacle.stream import area_of_cut, centre_of_cut, coiling, folding
from treacle.sweep import Scene, Verdict


class InDirectory(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.path = Path(place.name)
        self.run_path = self.path / "run"
        write_run(self.run_path)

    def fails(self, text, function, *arguments):
        """With a DataError of one line that holds the text."""
        with self.assertRaises(DataError) as caught:
            function(*arguments)
        self.assertIn(text, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))


class StatisticsTest(InDirectory):
    def test_columns(self):
        for path in self.run_path, self.run_path / "statistics", str(self.run_path):
            table = read_statistics(path)
            self.assertEqual(list(table), ["Time step number", "Time (s)", "Liquid maximum y (m)"])
            numpy.testing.assert_array_equal(table["Time (s)"], [0, 0.25, 0.5])
            numpy.testing.assert_array_equal(table["Liquid maximum y (m)"], [0.75, 0.5, numpy.nan])

    def test_row_being_written(self):
        file = self.run_path / "statistics"
        text = file.read_text()
        for more in "3", "3 0.75", "3 0.75 0.12":
            file.write_text(text + more)
            self.assertEqual(read_statistics(file)["Time (s)"][-1], 0.5)
        file.write_text(text + "3 0.75 0.125\n")
        self.assertEqual(read_statistics(file)["Time (s)"][-1], 0.75)

    def test_no_rows(self):
        (self.path / "statistics").write_text("# 1: Time (s)\n")
        self.assertEqual(read_statistics(self.path)["Time (s)"].shape, (0,))

    def test_errors(self):
        self.fails(f"there is no '{self.path}/statistics'", read_statistics, self.path)
        table = read_statistics(self.run_path)
        self.fails("statistics' has no column 'Time'", table.__getitem__, "Time")
        self.fails("is not a table", read_statistics, self.run_path / "parameters.prm")
        (self.path / "statistics").write_bytes(b"\xff\x00\n")
        self.fails("cannot be read", read_statistics, self.path)


class TimingTest(InDirectory):
    def test_read(self):
        (self.path / "timing.txt").write_text(
            "Section                calls    wall time   share\n"
            "liquid domain              3       1.50 s  75.0 %\n"
            "Total                      1       2.00 s 100.0 %\n"
            "Peak memory: 853 MiB in all, 430 MiB on the largest of 2 ranks\n"
            "Work                              2\n"
            "products with matrices           12\n")
        timing = read_timing(self.path)
        self.assertEqual(timing.seconds, {"liquid domain": 1.5, "Total": 2})
        self.assertEqual(timing.memory, 853)
        self.assertEqual(timing.work, {"products with matrices": 12})

    def test_errors(self):
        self.fails("timing.txt'", read_timing, self.path)
        (self.path / "timing.txt").write_text("nothing\n")
        self.fails("is not the timing of a run", read_timing, self.path)


class RunTest(InDirectory):
    def test_parameters(self):
        run = Run(str(self.run_path))
        self.assertEqual(run.dim, 2)
        self.assertEqual(run.parameters["Domain/Upper corner"], "2, 2")
        self.assertEqual(run.parameters["Material/Viscosity"].split(), ["1", "+", "x"])
        numpy.testing.assert_array_equal([run.lower, run.upper], [[0, 0], [2, 2]])
        self.assertFalse(run.has_mesh_file)
        solid, = run.solids()
        self.assertEqual((solid.shape, solid.is_inverted), ("box", True))
        numpy.testing.assert_array_equal(solid.numbers("Lower corner"), [0.5, 1.5])

    def test_statistics(self):
        run = Run(self.run_path)
        self.assertEqual(run.statistics["Time (s)"].shape, (3,))
        self.assertIs(run.statistics, run.statistics)

    def test_frames(self):
        run = Run(self.run_path)
        self.assertEqual(run.frames, [0, 1, 3])
        self.assertEqual([run.time(frame) for frame in run.frames], [0, 0.125, 1.5])
        self.assertEqual([run.frame_at(time) for time in (-1, 0.1, 0.8, 0.9)], [0, 1, 1, 3])

    def test_surfaces(self):
        write_run(self.path / "3D", 3)
        for dim, directory in (2, self.run_path), (3, self.path / "3D"):
            surface = Run(directory).surface(1)
            numpy.testing.assert_array_equal(surface.points,
                                             [[0, 0.25, 0], [1, 0.25, 0], [0, 1.25, 0]])
            self.assertEqual(surface.facets.shape, (3, 2) if dim == 2 else (1, 3))
            self.assertEqual(surface.velocity.shape, (3, 3))
            numpy.testing.assert_array_equal(surface.speed, [5, 5, 5])

    def test_not_a_run(self):
        self.fails("there is no directory", Run, self.path / "nowhere")
        self.fails("there is no directory", Run, self.run_path / "statistics")
        self.fails("is not the output directory of a run", Run, self.path)
        parameters = self.run_path / "parameters.prm"
        text = parameters.read_text()
        for old, new, message in (
                ("set Dimension ", "set Size ", "does not set 'Dimension'"),
                ("= 2\n", "= two\n", "'Dimension' is neither 2 nor 3"),
                ("0, 0", "0, 0, 0", "does not have 2 components"),
                ("0, 0", "0, left", "'Domain/Lower corner' is not made of numbers: 0, left")):
            parameters.write_text(text.replace(old, new, 1))
            self.fails(message, Run, self.run_path)
        parameters.write_bytes(b"\xff\xfe")
        self.fails("cannot be read", Run, self.run_path)

    def test_missing_parts(self):
        run = Run(self.run_path)
        self.fails("there is no surface", run.surface, 2)
        self.fails("does not set 'End time'", run.get, "End time")
        for path in (self.run_path / "frames").glob("surface_*"):
            path.unlink()
        (self.run_path / "statistics").unlink()
        self.fails("there are no surfaces", getattr, run, "frames")
        self.fails("there is no '", getattr, run, "statistics")
        self.fails("there is no file", read_parameters, self.path / "nothing.prm")


class SurfaceTest(InDirectory):
    def test_damaged(self):
        file = self.run_path / "frames/surface_00000.ply"
        data = file.read_bytes()
        for damaged, message in ((b"", "not a complete PLY"), (data[:90], "not a complete PLY"),
                                 (data[:-4], "is damaged"), (b"solid" + data, "not a complete PLY"),
                                 (data[:-4] + b"\x09\0\0\0", "names a vertex that is not there"),
                                 (data.replace(b"property float x", b"property short x"), "is damaged")):
            file.write_bytes(damaged)
            self.fails(message, read_surface, file)

    def test_ascii(self):
        file = self.path / "a.ply"
        file.write_text("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                        "end_header\n0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n")
        surface = read_surface(file)
        self.assertEqual(surface.points[2].tolist(), [0, 1, 0.5])
        self.assertEqual(surface.facets.tolist(), [[0, 1, 2]])
        self.assertFalse(surface.velocity.any())


class MotionTest(unittest.TestCase):
    def test_position(self):
        motion = Motion({"Displacement": "0; 0.15*sin(5*t)", "Rotation": "if(t < 1, t^2, 1)",
                         "Centre of rotation": "1, 2"}, 2)
        matrix, shift = motion.pose(0.5)
        numpy.testing.assert_allclose(matrix @ [1, 2] + shift, [1, 2 + 0.15 * math.sin(2.5)])
        numpy.testing.assert_allclose(matrix @ [2, 2] + shift,
                                      [1 + math.cos(0.25), 2 + 0.15 * math.sin(2.5) + math.sin(0.25)])

    def test_velocity(self):
        motion = Motion({"Velocity": "t; 0; 0", "Angular velocity": "0; 0; 3*t^2", "Centre of rotation": "0, 0, 5"}, 3)
        matrix, shift = motion.pose(2)
        numpy.testing.assert_allclose(matrix @ [1, 0, 5] + shift, [2 + math.cos(8), math.sin(8), 5], atol=1e-4)

    def test_rest_and_others(self):
        self.assertFalse(Motion({"Velocity": "0; 0", "Rotation": "0"}, 2).is_moving)
        with self.assertRaises(DataError):
            Motion({"Displacement": "if(t > 0, sin(t)/t, 1); 0"}, 2).pose(0)
        for text in "log(t)", "__import__('os')", "t; t", "f(t)":
            with self.assertRaises(DataError):
                formula(text, "t")


class BodiesTest(unittest.TestCase):
    """Distances of points that are known by looking."""

    def check(self, shape, distances, **parameters):
        dim = len(next(iter(distances)))
        parameters = {"Scale": [1], "Rotation axis": [0] * (dim - 1) + [1], "Rotation angle": [0], "Translation": [0] * dim,
                      **parameters}
        solid = Solid(shape, parameters.get, lambda name: numpy.array(parameters[name], dtype=float), False, None)
        points, expected = zip(*distances.items())
        numpy.testing.assert_allclose(distance(solid, numpy.array(points, dtype=float)), expected, atol=1e-12)

    def test_3d(self):
        centre = {"Centre": [1, 0, 0]}
        self.check("sphere", {(1, 0, 0): -2, (1, 0, 5): 3}, Radius=[2], **centre)
        self.check("box", {(3, 4, 0.5): 5, (-1, -1, 0.5): -0.5, (0, 0, 3): 2},
                   **{"Lower corner": [-4, -4, 0], "Upper corner": [0, 0, 1]})
        self.check("cylinder", {(1, 0, 0): -1, (1, 5, 0): 4, (5, 0, 6): math.hypot(3, 2)},
                   Radius=[1], Length=[8], Axis=[0, 0, 2], **centre)
        self.check("capsule", {(0, 0, 2): -1, (0, 3, 4): 2, (0, 0, -2): 1}, Start=[0, 0, 0], End=[0, 0, 4], Radius=[1])
        self.check("capsule", {(3, 0, 0): 1}, Start=[1, 0, 0], End=[1, 0, 0], Radius=[1])
        self.check("torus", {(1, 0, 0): 2, (4, 0, 0): -1, (4, 0, 4): 3},
                   Radius=[3], Axis=[0, 0, 1], **{"Minor radius": [1], **centre})
        self.check("half space", {(7, 3, 0): 3, (7, -3, 0): -3}, Normal=[0, 2, 0], **centre)
        self.check("expression", {(1, 2, 0): 2, (1, 0, 0): math.inf}, Expression="x^2/y + if(z < 0, 1, 1.5)")

    def test_2d(self):
        self.check("cylinder", {(0, 0): -1, (0, 3): 2, (6, 4): 3}, Radius=[1], Length=[12], Axis=[1, 0], Centre=[0, 0])
        self.check("torus", {(0, 0): 2, (0, 4): 0, (3, 0): -1}, Radius=[3], Centre=[0, 0], **{"Minor radius": [1]})

    def test_placed(self):
        corners = {"Lower corner": [0, 0], "Upper corner": [2, 1]}
        self.check("box", {(3, 4): -2, (5, 11): 3, (8, 6): 3}, Scale=[4], Translation=[5, 0], **{"Rotation angle": [90], **corners})
        self.check("capsule", {(1, 2, 3): -2, (1, 7, 3): 3, (1, 2, 8): 1}, Scale=[2], Translation=[1, 2, 3], Radius=[1], Start=[0, 0, 0],
                   End=[0, 1, 0], **{"Rotation axis": [2, 0, 0], "Rotation angle": [90]})


class StreamTest(InDirectory):
    def test_cut(self):
        surface = read_surface(self.run_path / "frames/surface_00000.ply")
        surface.points = numpy.array([[0, 0, 0], [2, 0, 0], [0, 2, 2.]])
        surface.facets = numpy.array([[0, 1, 2]])
        numpy.testing.assert_allclose(centre_of_cut(surface, 1), [0.5, 1])
        self.assertIsNone(centre_of_cut(surface, 3))
        self.assertEqual(area_of_cut(surface, 3), 0)

    def test_area(self):
        """Of a tube, an octagon with corners at distance 1 from (3, 4)."""
        angles = numpy.arange(8) * math.pi / 4
        ring = numpy.stack([3 + numpy.cos(angles), 4 + numpy.sin(angles), numpy.zeros(8)], axis=1)
        surface = read_surface(self.run_path / "frames/surface_00000.ply")
        surface.points = numpy.concatenate([ring, ring + [0, 0, 1]])
        surface.facets = numpy.array([[k, (k + 1) % 8, k + 8] for k in range(8)] +
                                     [[(k + 1) % 8, (k + 1) % 8 + 8, k + 8] for k in range(8)])
        self.assertAlmostEqual(area_of_cut(surface, 0.3), 2 * math.sqrt(2))

    def test_coiling_and_folding(self):
        times = numpy.linspace(0, 1, 101)
        angles = 6 * numpy.pi * times + 0.1
        found = coiling(times, 0.5 * numpy.stack([numpy.cos(angles), numpy.sin(angles)], axis=1))
        numpy.testing.assert_allclose(found, [3, 3, 0.5], rtol=0.02)
        found = folding(times, numpy.stack([0.25 * numpy.sin(angles), 0 * times], axis=1))
        numpy.testing.assert_allclose(found, [6, 3, 0.25], rtol=0.02)
        self.assertIsNone(folding(times, numpy.stack([times, times], axis=1)))


class SweepTest(unittest.TestCase):
    def test_scenes(self):
        texts = [Scene(seed).text() for seed in range(50)]
        self.assertEqual(texts, [Scene(seed).text() for seed in range(50)])
        self.assertEqual(len(set(texts)), 50)
        for words in "contrast", "emitter", "moving", "pool", "3D", "2D":
            self.assertTrue(any(words in Scene(seed).describe() for seed in range(50)), words)

    def test_verdict(self):
        scene = next(s for s in map(Scene, range(50)) if s.is_closed() and s.speed == 0)
        table = {"Potential energy (J)": [10, 4, 3], "Nodal kinetic energy (J)": [0, 4, 6], "Volume drift": [0, 0, -0.25],
                 "Drift before correction": [0, -0.5, 0], "Repetitions": [0, 1, 2], "Fallbacks": [0, 0, 1],
                 "Maximum speed (m/s)": [0, 2 * math.sqrt(2 * 9.81), 1]}
        found = Verdict(scene, table)
        self.assertEqual((found.n_steps, found.repetitions, found.fallbacks), (2, 3, 1))
        self.assertAlmostEqual(found.energy_gained, 0.1)
        self.assertEqual((found.drift, found.largest_step_drift), (0.25, 0.5))
        self.assertAlmostEqual(found.speed, 1)


class MeshTest(unittest.TestCase):
    def test_levels(self):
        # whole cells of leaves of edge 1 and 1/4, and a half of one of edge 1; in 3D also a quarter
        for dim, whole, parts in ((2, 1 / 4, (1, 1 / 16, 1 / 2)), (3, 1 / 12, (1, 1 / 64, 1 / 2, 1 / 4))):
            points = numpy.concatenate([[numpy.zeros(3), *numpy.eye(3)[:dim] @ numpy.diag([s, 1, 1])]
                                        for s in (part * whole * math.factorial(dim) for part in parts)])
            mesh = Mesh(points, numpy.arange(len(points)).reshape(-1, dim + 1), {}, {})
            self.assertAlmostEqual(mesh.leaf_edges()[0], 1)
            self.assertEqual(list(mesh.levels(1)), [0, 2, 0, 0][:len(parts)])


class LayersTest(InDirectory):
    def test_order(self):
        for name, text in (("include/treacle/base/a.h", "#include <treacle/mesh/b.h>\n"),
                           ("include/treacle/mesh/b.h", "#include <treacle/base/a.h>\n"),
                           ("source/attic/c.cc", "#include <treacle/base/a.h>\n")):
            (self.path / name).parent.mkdir(parents=True, exist_ok=True)
            (self.path / name).write_text(text)
        found = list(problems(self.path))
        self.assertEqual(len(found), 3)
        self.assertIn("base must not know mesh", found[0])
        self.assertIn("in no room of GROUPS", found[1])
        self.assertEqual(found[2], "cycle: base/a -> mesh/b -> base/a")


class ImportTest(unittest.TestCase):
    def test_light(self):
        code = ("import sys, treacle; "
                "sys.exit(not {'vtk', 'matplotlib', 'scipy', 'PIL'}.isdisjoint(sys.modules))")
        subprocess.run([sys.executable, "-c", code], check=True)


if __name__ == "__main__":
    unittest.main()
