"""Every exhibit over the network, against one server. Beside its good visits, those with a visitor's typical mistakes are played without
a network (tests/exhibits)."""

import json
import unittest
import xml.etree.ElementTree as ElementTree
from concurrent.futures import ThreadPoolExecutor

from harness import ROOT, EndToEnd, marked

AT_ONCE = 5  # each needs part of a core, here and at the server


def good_visits(scenario):
    visits = ElementTree.parse(scenario).find(".//MetadataSet[@name='visits']")
    return [visit.get("name") for visit in visits if not visit.get("name").startswith("mistakes")]


@marked("alone")
class Exhibits(EndToEnd):
    def test_the_good_visits_of_every_exhibit_are_completed_and_replay(self):
        scenarios = sorted((ROOT / "scenarios").glob("*/*.x3d"))
        server = self.server("--worlds", len(scenarios), scenario=scenarios)

        def visitor(name, *arguments):
            report = self.folder / f"{name}.json"
            played = self.run_command("visitor", *arguments, "--report", report, limit_s=600)
            self.assertEqual(played.returncode, 0, played.stdout + played.stderr)
            return json.loads(report.read_text())

        def play(scenario):
            return visitor(scenario.stem, "--kiosk", scenario.stem, "--scenario", scenario, "--visit", *good_visits(scenario))

        toured = [scenario for scenario in scenarios if scenario.stem in ("archimedes-screw", "village")]
        others = [scenario for scenario in scenarios if scenario not in toured]
        with ThreadPoolExecutor(max_workers=AT_ONCE) as pool:
            tour = pool.submit(visitor, "tour", "--all", "--at-once", 1, "--scenario", *toured)
            played = dict(zip(others, pool.map(play, others)))
            played |= dict(zip(toured, tour.result(), strict=True))
        for scenario, stop in played.items():
            self.assertTrue(stop["activities"], scenario)
            for activity in stop["activities"]:
                self.assertTrue(activity["steps"], activity["visit"])
                self.assertTrue(all(step["done"] for step in activity["steps"]), activity["visit"])
        chosen = [activity["gone_on_to"] for stop in played.values() for activity in stop["activities"] if activity["gone_on_to"]]
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
