"""`bench_haptics` runs on a simulated clock, so its figures are the same everywhere: what theory says of them is tested. So is how smooth
facets feel, which `bench_touch` measures; what it says of time is not."""

import json
import os
import subprocess
import unittest
from pathlib import Path

PROGRAM = [Path(os.environ["MECHANE_BIN"]) / "bench_haptics", "--fault-ticks", "20000"]  # more of them: faults_test.cpp


class Haptics(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = subprocess.run(PROGRAM, capture_output=True, text=True, check=True).stdout
        cls.metrics = json.loads(cls.text)["metrics"]

    def test_a_wall_is_stable_up_to_the_stiffness_of_theory(self):
        for name in ("wall.k_ratio", *(f"wall.delay{ms}.k_ratio" for ms in (1, 2, 5, 10, 20))):
            self.assertAlmostEqual(self.metrics[name], 1, delta=0.1, msg=name)

    def test_a_press_is_still(self):
        self.assertLessEqual(self.metrics["wall.limit_cycle_ratio"], 1)
        self.assertLessEqual(self.metrics["resume.swing_n"], 0.3)
        self.assertLessEqual(self.metrics["resume.again_swing_n"], 0.3)

    def test_a_delay_of_20_ms_gives_the_hand_no_energy_and_still_pushes(self):
        for mode in ("direct", "local"):
            self.assertLessEqual(self.metrics[f"delay20.{mode}.energy_mj.max"], 1, mode)
        self.assertLessEqual(self.metrics["delay20.local.peak_ratio"], 1.1)
        self.assertGreaterEqual(self.metrics["delay20.local.force_share.min"], 0.8)

    def test_what_holds_a_hand_on_its_path_does_not_wait_for_the_server(self):
        for ms in (20, 50):
            self.assertLessEqual(self.metrics[f"delay{ms}.local.held.energy_mj.max"], 1, ms)
            self.assertGreaterEqual(self.metrics[f"delay{ms}.local.held.force_share.min"], 0.8, ms)
            self.assertAlmostEqual(self.metrics[f"delay{ms}.local.carried.force_share"], 1, delta=0.05)
            self.assertLessEqual(self.metrics[f"delay{ms}.direct.held.force_share.min"], 0.5, "there is something to gain")

    def test_grooves_feel_as_they_are_set(self):
        for distance in ("groove4", "groove10"):
            for delay in ("delay0", "delay20"):
                for mode in ("direct", "local"):
                    name = f"{distance}.{delay}.{mode}"
                    self.assertAlmostEqual(self.metrics[f"{name}.distance_ratio"], 1, delta=0.02, msg=name)
                    self.assertAlmostEqual(self.metrics[f"{name}.flank_ratio"], 1, delta=0.1, msg=name)

    def test_a_click_is_as_short_and_nearly_as_strong_as_asked(self):
        for name in (f"click.{delay}.{mode}" for delay in ("delay0", "delay20") for mode in ("direct", "local")):
            self.assertAlmostEqual(self.metrics[f"{name}.length_ratio"], 1, delta=0.1, msg=name)
            self.assertLessEqual(self.metrics[f"{name}.rise_late_ms"], 1, name)
            self.assertGreaterEqual(self.metrics[f"{name}.peak_ratio"], 0.85, name)

    def test_a_deadband_saves_most_messages_and_is_hardly_felt(self):
        for mode in ("direct", "local"):
            for play in ("stroke", "press", "slide"):
                name = f"deadband10.{mode}.{play}"
                self.assertGreaterEqual(self.metrics[f"{name}.saved_up"], 0.5, name)
                self.assertGreaterEqual(self.metrics[f"{name}.saved_down"], 0.5, name)
                self.assertLessEqual(self.metrics[f"{name}.force_error_ratio.p99"], 0.15, name)
        self.assertLessEqual(self.metrics["deadband.energy_mj.max"], 1)

    def test_facets_are_not_felt(self):
        program = Path(os.environ["MECHANE_BIN"]) / "bench_touch"
        metrics = json.loads(subprocess.run(program, capture_output=True, text=True, check=True).stdout)["metrics"]
        for sphere in ("fig16", "fig16.shipped"):
            self.assertLessEqual(metrics[f"{sphere}.jump_ratio"], 0.1, sphere)
            self.assertLessEqual(metrics[f"{sphere}.deviation_ratio"], 0.5, sphere)
        self.assertGreater(metrics["force_us.grasp.median"], 0)

    def test_it_says_the_same_each_time(self):
        self.assertEqual(subprocess.run(PROGRAM, capture_output=True, text=True, check=True).stdout, self.text)


if __name__ == "__main__":
    unittest.main()
