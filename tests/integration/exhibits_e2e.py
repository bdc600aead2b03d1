"""Every visit of every exhibit over the network, against one server: the good visits and those with a visitor's typical mistakes."""

import json
import unittest
from concurrent.futures import ThreadPoolExecutor

from harness import ROOT, EndToEnd, marked


@marked("alone", "not-address")
class Exhibits(EndToEnd):
    def test_every_visit_is_completed_and_replays(self):
        scenarios = sorted((ROOT / "scenarios").glob("*/*.x3d"))
        server = self.server("--worlds", len(scenarios), scenario=scenarios)
        report = self.folder / "tour.json"
        tour = self.run_command("visitor", "--all", "--at-once", 4, "--scenario", ROOT / "scenarios",
                                "--report", report, limit_s=900)
        self.assertEqual(tour.returncode, 0, tour.stdout + tour.stderr)
        stops = json.loads(report.read_text())
        self.assertEqual(len(stops), len(scenarios))
        for stop in stops:
            self.assertTrue(stop["activities"], stop["scenario"])
            for activity in stop["activities"]:
                self.assertTrue(activity["steps"], activity["visit"])
                self.assertTrue(all(step["done"] for step in activity["steps"]), activity["visit"])
        chosen = [activity["gone_on_to"] for stop in stops for activity in stop["activities"] if activity["gone_on_to"]]
        self.assertEqual(len(chosen), len(set(chosen)), "each visit of the village chooses another sign")
        self.assertGreater(len(chosen), 1)
        self.assertEqual(server.stop(), 0, server.text())
        journals = self.journals()
        # Who is sent on gets a world there, and one more at home where the next visit begins.
        self.assertEqual(len(journals), len(scenarios) + len(chosen) + len(chosen) - 1)
        with ThreadPoolExecutor(max_workers=2) as pool:  # a replay compares each of its states with the live one
            for status, text in pool.map(lambda journal: self.replay(journal, scenario=scenarios), journals):
                self.assertEqual(status, 0, text)


if __name__ == "__main__":
    unittest.main(verbosity=2)
