"""The soak's judge: a leak is found among noise and peaks, and what only breathes is not one."""

import pathlib
import random
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "deploy/soak_lib"))
from growth import LIMIT_MIB_PER_H, growth_of  # noqa: E402


def night(slope_mib_per_h, hours=1.0, every_s=2.0, seed=1):
    """Loading in the first minutes, then a slope, noise, and peaks while an exhibit is loaded."""
    draw = random.Random(seed)
    samples = []
    for i in range(int(hours * 3600 / every_s)):
        t = i * every_s
        loading = 100 * min(1.0, t / (0.2 * hours * 3600))
        peak = 80 if draw.random() < 0.1 else 0
        samples.append((t, 50 + loading + slope_mib_per_h * t / 3600 + draw.gauss(0, 1) + peak))
    return samples


class GrowthTest(unittest.TestCase):
    def test_what_is_loaded_once_is_no_leak(self):
        growth = growth_of(night(0))
        self.assertAlmostEqual(growth.slope_mib_per_h, 0, delta=0.5)
        self.assertTrue(growth.good)

    def test_a_leak_is_found_with_its_size(self):
        growth = growth_of(night(2 * LIMIT_MIB_PER_H))
        self.assertAlmostEqual(growth.slope_mib_per_h, 2 * LIMIT_MIB_PER_H, delta=1.5)
        self.assertFalse(growth.good)
        self.assertTrue(growth_of(night(0.8 * LIMIT_MIB_PER_H)).good)

    def test_of_minutes_only_what_is_plain_is_a_leak(self):
        self.assertTrue(growth_of(night(30, hours=0.05)).good)  # 1 MiB in two minutes: how allocators breathe
        self.assertFalse(growth_of(night(300, hours=0.05)).good)

    def test_a_handful_of_samples_is_not_judged(self):
        with self.assertRaises(ValueError):
            growth_of(night(0)[:9])


if __name__ == "__main__":
    unittest.main(verbosity=2)
