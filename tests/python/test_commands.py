# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Commands say what they do, also where the libraries that draw are missing, and end with one
line where these are needed or a run is not there."""

import os
import subprocess
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from synthetic_run import write_run

ROOT = Path(__file__).resolve().parents[2]
LIBRARIES = ("vtk", "matplotlib", "scipy", "PIL")


def python_commands():
    return [path for path in sorted((ROOT / "scripts").iterdir())
            if path.is_file() and b"python3" in path.read_bytes().partition(b"\n")[0]]


class CommandsTest(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.path = Path(place.name)
        for name in LIBRARIES:
            (self.path / f"{name}.py").write_text("raise ImportError(f'no module {__name__}')\n")
        self.environment = {**os.environ, "PYTHONPATH": str(self.path)}

    def run_command(self, name, *arguments):
        return subprocess.run([ROOT / "scripts" / name, *map(str, arguments)], cwd=self.path,
                              env=self.environment, capture_output=True, text=True)

    def test_help(self):
        commands = python_commands()
        self.assertGreaterEqual(len(commands), 8)
        with ThreadPoolExecutor(2) as pool:
            for path, done in zip(commands, pool.map(lambda c: self.run_command(c, "--help"), commands)):
                with self.subTest(path.name):
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertTrue(done.stdout.startswith(f"usage: {path.name}"), done.stdout)
                    self.assertGreater(len(done.stdout.splitlines()), 5)

    def test_help_of_run(self):
        self.assertEqual(self.run_command("run", "--help").returncode, 0)

    def fails(self, text, *command):
        """With exit code 1 and one line that holds the text."""
        done = self.run_command(*command)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertIn(text, done.stderr)

    def test_one_line(self):
        write_run(self.path / "run")
        self.fails("render: there is no directory 'nowhere'", "render.py", "nowhere")
        self.fails("render: '.' is not the output directory of a run", "render.py", ".")
        self.fails("swing: the run is not in three dimensions", "swing.py", "run", 1)
        self.fails("see scripts/install_packages", "render.py", "run")
        self.fails("see scripts/install_packages", "compare.py", "a.png", "a=run")

    def test_list_of_cases(self):
        done = self.run_command("verify", "--list")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("prm/verification/couette.prm", done.stdout)


if __name__ == "__main__":
    unittest.main()
