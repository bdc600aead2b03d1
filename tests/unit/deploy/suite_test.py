"""What deploy/test makes of the results of others: counts, times, and a report."""

import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "deploy/test_lib"))
import suite  # noqa: E402
from report import Ran, long_cases, write_report  # noqa: E402
from results import Case, Tally, read_junit, write_junit  # noqa: E402

GTEST = """<?xml version="1.0" encoding="UTF-8"?>
<testsuites tests="3" failures="1" disabled="0" errors="0" time="1.6" name="AllTests">
  <testsuite name="Mailbox" tests="3" failures="1" disabled="0" skipped="1" errors="0" time="1.6">
    <testcase name="Keeps" file="a.cpp" line="1" status="run" result="completed" time="1.25" classname="Mailbox" />
    <testcase name="Drops" status="run" result="completed" time="0.35" classname="Mailbox">
      <failure message="a.cpp:7&#x0A;Expected equality" type=""><![CDATA[a.cpp:7
Expected equality of these values]]></failure>
    </testcase>
    <testcase name="Waits" status="run" result="skipped" time="0" classname="Mailbox">
      <skipped message="no clock here"><![CDATA[no clock here]]></skipped>
    </testcase>
  </testsuite>
</testsuites>
"""
CTEST = """<testsuite name="Linux" tests="3">
  <testcase name="fuzz.x3d.corpus" classname="fuzz.x3d.corpus" time="2.5" status="run"><system-out>ok</system-out></testcase>
  <testcase name="integration.Fit.test_a" classname="integration.Fit.test_a" time="7" status="fail">
    <failure message=""/><system-out>not within 30 s</system-out></testcase>
  <testcase name="architecture.format" classname="architecture.format" time="0.1" status="notrun"><skipped message="77"/></testcase>
</testsuite>
"""


class Results(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.file = self.folder / "results.xml"

    def read(self, text):
        self.file.write_text(text)
        return read_junit(self.file).cases

    def test_a_case_has_its_suite_its_time_and_what_failed(self):
        cases = self.read(GTEST)
        self.assertEqual([(c.name, c.outcome, c.seconds) for c in cases],
                         [("Mailbox.Keeps", "passed", 1.25), ("Mailbox.Drops", "failed", 0.35), ("Mailbox.Waits", "skipped", 0)])
        self.assertIn("a.cpp:7", cases[1].detail)
        self.assertIn("Expected equality of these values", cases[1].detail)

    def test_ctest_repeats_the_name_and_keeps_the_output(self):
        cases = self.read(CTEST)
        self.assertEqual([(c.name, c.outcome, c.seconds) for c in cases],
                         [("fuzz.x3d.corpus", "passed", 2.5), ("integration.Fit.test_a", "failed", 7), ("architecture.format", "skipped", 0.1)])
        self.assertEqual(cases[1].detail, "not within 30 s")

    def test_what_is_written_is_read_again(self):
        cases = [Case("a.One", "passed", seconds=0.125), Case("a.Two", "failed", "why\nso", 3), Case("a.Three", "skipped")]
        write_junit(self.file, "a", Tally(list(cases)))
        self.assertEqual([(c.name, c.outcome, c.seconds) for c in read_junit(self.file).cases], [(c.name, c.outcome, c.seconds) for c in cases])

    def test_a_file_that_is_missing_or_broken_is_a_failure(self):
        self.assertEqual([c.outcome for c in read_junit(self.folder / "none.xml").cases], ["failed"])
        self.assertEqual([c.outcome for c in self.read(GTEST[:200])], ["failed"])
        self.assertEqual([c.outcome for c in self.read(CTEST.replace('"2.5"', '"long"'))], ["failed"])


class Report(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def written(self, phases):
        write_report(self.folder / "report.json", ROOT, phases)
        return json.loads((self.folder / "report.json").read_text())

    def test_counts_and_the_time_of_each_phase(self):
        report = self.written({"build-release": Ran(Tally([Case("build", "passed")]), 61.04),
                               "fuzz": Ran(Tally([Case("x", "failed", seconds=2), Case("y", "skipped"), Case("z", "passed")]), 9.5)})
        self.assertEqual(report["metrics"], {"seconds": 70.5, "passed": 2, "failed": 1, "skipped": 1, "phase_s.build-release": 61.0, "phase_s.fuzz": 9.5})
        self.assertEqual((report["name"], report["seconds"], report["notes"]), ("test", 70.5, ["2.0 s  x  (fuzz)"]))
        for key in ("commit", "cpu", "cores", "simd"):
            self.assertTrue(report[key], key)

    def test_the_twenty_longest_are_named_the_longest_first(self):
        early = Tally([Case(f"early.{i:02}", "passed", seconds=i) for i in range(30)])
        late = Tally([Case("late", "failed", seconds=28.5)])
        notes = long_cases({"one": Ran(early, 1), "two": Ran(late, 1)})
        self.assertEqual(len(notes), 20)
        self.assertEqual(notes[:3], ["29.0 s  early.29  (one)", "28.5 s  late  (two)", "28.0 s  early.28  (one)"])


class Phases(unittest.TestCase):
    def setUp(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.enterContext(mock.patch.object(suite, "OUT", folder))
        self.enterContext(mock.patch.object(suite, "ROOT", folder))

    def run_phases(self, *phases):
        done = {}
        with contextlib.redirect_stdout(io.StringIO()) as said:
            suite.run_phases(list(phases), done)
        return done, said.getvalue()

    def test_after_a_failed_build_its_tests_are_not_run_and_the_others_are(self):
        def gives(outcome):
            return lambda log: Tally([Case("case", outcome, "the reason")])
        done, said = self.run_phases(suite.Phase("build one", gives("failed"), "one"), suite.Phase("test one", gives("passed"), "one"),
                                     suite.Phase("test two, 10 s each", gives("passed"), "two"))
        self.assertEqual(list(done), ["build-one", "test-two"])
        self.assertIn("the reason", said)
        self.assertIn("not run: its build failed", said)

    def test_no_two_phases_share_a_name(self):
        for quick in (False, True):
            names = [phase.name for phase in suite.phases(quick)]
            self.assertEqual(len(names), len(set(names)), names)


if __name__ == "__main__":
    unittest.main(verbosity=2)
