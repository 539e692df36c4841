# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Exact small waves and threads against what is known of them."""

import unittest
from math import pi, sqrt, tanh

import numpy

from treacle.verification.measures import decay_and_frequency, decay_rate
from treacle.verification.small_waves import wave_from_rest
from treacle.verification.thread import thread_speed


class SmallWaveTest(unittest.TestCase):
    def test_begins_at_rest(self):
        dt = 1e-3
        a = wave_from_rest(pi, 1, 0.05, numpy.array([0, dt]))
        self.assertAlmostEqual(a[0], 1, places=7)
        self.assertAlmostEqual(a[1], 1 - pi * tanh(pi) * dt ** 2 / 2, places=7)

    def test_slowest_mode_is_left(self):
        """Eigenvalues found independently (Orr-Sommerfeld)."""
        for k, depth, nu, rate in ((pi, 1, 1, 0.145546628), (pi, 0.5, 1, 0.076507535), (2 * pi, 0.5, 0.1, 0.828245658)):
            times = numpy.linspace(4, 8, 9)
            self.assertAlmostEqual(decay_rate(times, wave_from_rest(k, depth, nu, times)) / rate, 1, places=6)
        times = numpy.arange(10, 20, 0.1)
        rate, frequency = decay_and_frequency(times, wave_from_rest(pi, 1, 0.05, times))
        self.assertAlmostEqual(rate / 0.575442182, 1, places=4)
        self.assertAlmostEqual(frequency / 1.47245435, 1, places=4)

    def test_without_viscosity(self):
        times = numpy.linspace(0, 2, 21)
        exact = numpy.cos(sqrt(9.81 * 3 * tanh(3 * 0.7)) * times)
        self.assertLess(abs(wave_from_rest(3, 0.7, 1e-5, times, gravity=9.81) - exact).max(), 2e-3)


class ThreadTest(unittest.TestCase):
    def test_falls_freely_without_viscosity(self):
        z = numpy.array([0.1, 0.5])
        numpy.testing.assert_allclose(thread_speed(z, 1, 0.9, 1e-7), numpy.sqrt(1 + 2 * 9.81 * z), rtol=1e-4)

    def test_force_and_momentum(self):
        """U - 3 nu U'/U changes by g times the time that passes."""
        nu, z = 0.05, numpy.linspace(0.1, 0.3, 401)
        u = thread_speed(z, 1, 0.9, nu)
        momentum = u - 3 * nu * numpy.gradient(u, z) / u
        time = numpy.concatenate([[0], numpy.cumsum(numpy.diff(z) * (1 / u[1:] + 1 / u[:-1]) / 2)])
        numpy.testing.assert_allclose((momentum - momentum[0])[5:-5], 9.81 * time[5:-5], rtol=2e-2, atol=2e-3)


if __name__ == "__main__":
    unittest.main()
