"""That `deploy/bench worlds` measures what it says, with one exhibit and for a moment: no figure is judged. Its tables and plots are
made of what the program printed, and its aims are held against planted figures."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy/bench_lib"))

import aims  # noqa: E402
import worlds  # noqa: E402
from peers import Measured  # noqa: E402

PROGRAM = Path(os.environ["MECHANE_BIN"]) / "bench_worlds"
SCENARIO = ROOT / "scenarios/village/village.x3d"  # the quickest to load


class Worlds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([PROGRAM, SCENARIO, "--seconds", "0.3", "--most", "3", "--priority", "0"],
                              capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        said = json.loads(done.stdout)
        cls.result = Measured(said["metrics"], said["curves"], said["notes"])
        worlds.add_models(cls.result, [SCENARIO])

    def test_every_metric_that_others_read_is_there(self):
        metrics = self.result.metrics
        for name in ("tick_us.village.median", "tick_us.village.p999", "load_s.village", "model_mb.village", "models_mb", "worlds_per_core.computed"):
            self.assertGreater(metrics[name], 0, name)
        self.assertLessEqual(metrics["tick_us.village.median"], metrics["tick_us.village.p99"])
        self.assertLessEqual(metrics["tick_us.village.p99"], metrics["tick_us.village.p999"])
        self.assertLessEqual(metrics["tick_floor_us.village.p999"], metrics["tick_us.village.p999"])
        self.assertIn(metrics["worlds_per_core"], (0, 1, 2, 3))
        if "worlds_over_pct.3" in metrics:
            self.assertGreater(metrics["force_later_us.third.p99"], 0)
        self.assertEqual(metrics["models_mb"] * 1e6, (ROOT / "scenarios/models/village.glb").stat().st_size)

    def test_a_visit_goes_well_and_ends_in_the_same_state_when_it_is_played_again(self):
        self.assertEqual(self.result.metrics["state_hash.stable"], 1)
        self.assertFalse([note for note in self.result.notes if "did not go well" in note or "another state" in note])

    def test_the_table_and_the_plots_show_it(self):
        shown = worlds.table("worlds", self.result.metrics)
        self.assertIn("village", shown)
        self.assertIn("one core holds", shown)
        with tempfile.TemporaryDirectory() as folder:
            made = worlds.plot(self.result, Path(folder), "a machine")
            self.assertIn("worlds-tick.svg", [path.name for path in made])
            for path in made:
                ElementTree.parse(path)

    def test_an_unreadable_scenario_ends_it_with_a_reason(self):
        done = subprocess.run([PROGRAM, ROOT / "README.md"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("README.md", done.stderr)


class Aims(unittest.TestCase):
    def test_what_is_missed_is_said_with_its_exhibit_and_nothing_else(self):
        metrics = {"tick_us.screw.median": 149.0, "tick_us.screw.p999": 501.0, "load_s.screw": 0.9, "model_mb.screw": 8.5, "models_mb": 59.0,
                   "tick_us.pump.median": 150.0, "tick_us.pump.p999": 200.0, "load_s.pump": 1.5, "worlds_per_core": 6, "state_hash.stable": 1}
        self.assertEqual(self.missed(metrics), ["tick_us.pump.median", "tick_us.screw.p999", "load_s.pump", "model_mb.screw"])
        self.assertEqual(len(self.missed({"worlds_per_core": 5, "state_hash.stable": 0, "models_mb": 61})), 3)
        self.assertEqual(len(aims.judge({**metrics, "tick_us.pump.p99": 1e9}, worlds.AIMS)), len(metrics))

    @staticmethod
    def missed(metrics):
        return [name for name, one in aims.judge(metrics, worlds.AIMS).items() if not one.met]


if __name__ == "__main__":
    unittest.main()
