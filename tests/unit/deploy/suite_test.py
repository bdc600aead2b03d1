"""What deploy/test makes of the results of others: counts, times, and a report."""

import contextlib
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "deploy/test_lib"))
import suite  # noqa: E402
from programs import chosen, from_ctest, run_program  # noqa: E402
from repeat import rounds_of, run_rounds, seeds, worst  # noqa: E402
from report import Ran, long_cases, write_report  # noqa: E402
from results import LEFT_OUT, Case, Tally, read_junit, write_junit  # noqa: E402

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
    <testcase name="Lasts" status="run" result="skipped" time="0" classname="Mailbox">
      <skipped message="a.cpp:9&#x0A;left to other builds: thousands of ticks"><![CDATA[...]]></skipped>
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
                         [("Mailbox.Keeps", "passed", 1.25), ("Mailbox.Drops", "failed", 0.35), ("Mailbox.Waits", "skipped", 0), ("Mailbox.Lasts", "left out", 0)])
        self.assertIn("a.cpp:7", cases[1].detail)
        self.assertIn("Expected equality of these values", cases[1].detail)

    def test_the_mark_of_the_tests_is_the_one_that_is_known_here(self):
        marks = (ROOT / "tests/support/sanitizers.hpp").read_text()
        self.assertEqual(marks.count(f'GTEST_SKIP() << "{LEFT_OUT}: "'), marks.count("#define MECHANE_NOT_"))

    def test_ctest_repeats_the_name_and_keeps_the_output(self):
        cases = self.read(CTEST)
        self.assertEqual([(c.name, c.outcome, c.seconds) for c in cases],
                         [("fuzz.x3d.corpus", "passed", 2.5), ("integration.Fit.test_a", "failed", 7), ("architecture.format", "skipped", 0.1)])
        self.assertEqual(cases[1].detail, "not within 30 s")

    def test_what_is_written_is_read_again(self):
        cases = [Case("a.One", "passed", seconds=0.125), Case("a.Two", "failed", "why\nso", 3), Case("a.Three", "skipped"),
                 Case("a.Four", "left out"), Case("a.Five", "too late")]
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
        report = self.written({"build-release": Ran(Tally([Case("build", "passed")]), 61.04, 243.26),
                               "fuzz": Ran(Tally([Case("x", "failed", seconds=2), Case("y", "skipped"), Case("z", "passed")]), 9.5)})
        self.assertEqual(report["metrics"], {"seconds": 70.5, "passed": 2, "failed": 1, "skipped": 1, "left_out": 0, "too_late": 0,
                                             "phase_s.build-release": 61.0, "phase_s.fuzz": 9.5,
                                             "cpu_s.build-release": 243.3, "cpu_s.fuzz": 0})
        self.assertEqual((report["name"], report["seconds"], report["notes"]), ("test", 70.5, ["2.0 s  x  (fuzz)"]))
        for key in ("commit", "cpu", "cores", "simd"):
            self.assertTrue(report[key], key)

    def test_the_twenty_longest_are_named_the_longest_first(self):
        early = Tally([Case(f"early.{i:02}", "passed", seconds=i) for i in range(30)])
        late = Tally([Case("late", "failed", seconds=28.5)])
        notes = long_cases({"one": Ran(early, 1), "two": Ran(late, 1)})
        self.assertEqual(len(notes), 20)
        self.assertEqual(notes[:3], ["29.0 s  early.29  (one)", "28.5 s  late  (two)", "28.0 s  early.28  (one)"])


def listed(*tests):
    """What CTest lists: (program, test, labels) each."""
    return {"tests": [{"name": f"{program}.{test}", "command": [f"/bin/test_{program}", f"--gtest_filter={test}"],
                       "properties": [{"name": "LABELS", "value": [labels]}, {"name": "ENVIRONMENT", "value": ["RC_PARAMS=seed=1"]}]}
                      for program, test, labels in tests] + [{"name": "architecture.format", "command": ["format.sh"], "properties": []},
                                                             {"name": "test_b_NOT_BUILT"}]}


# In place of a GoogleTest program.
FAKE = """#!/bin/sh
for word; do case "$word" in --gtest_output=xml:*) out="${word#--gtest_output=xml:}" ;; esac; done
echo "[ RUN      ] Mailbox.Drops"
%s
"""


class Programs(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_a_program_is_chosen_by_whole_labels(self):
        programs = from_ctest(listed(("a", "A.One", "program.in-process"), ("a", "A.Two", "program.in-process"), ("b", "B.One", "program.in-process.slow"),
                                     ("c", "C.One", "program.alone"), ("d", "D.One", "program.in-process-not")))
        self.assertEqual([(p.name, p.tests) for p in chosen(programs, only="in-process")], [("b", 1), ("a", 2)])
        self.assertEqual([p.name for p in chosen(programs, leave_out="slow")], ["a", "c", "d"])
        self.assertEqual(dict(programs[0].environment), {"RC_PARAMS": "seed=1"})

    def run_fake(self, does, tests=4):
        fake = self.folder / "test_fake"
        fake.write_text(FAKE % does)
        fake.chmod(0o755)
        (self.folder / "junit.xml").write_text(GTEST)
        listing = listed(*[("fake", f"Mailbox.{i}", "program") for i in range(tests)])
        for test in listing["tests"][:tests]:
            test["command"][0] = str(fake)
        (program,) = from_ctest(listing)
        return run_program(program, self.folder / "2-test.log", {}).cases

    def test_its_cases_carry_its_name(self):
        cases = self.run_fake(f'cp {self.folder}/junit.xml "$out"; exit 1')
        self.assertEqual([c.name for c in cases], [f"fake.Mailbox.{name}" for name in ("Keeps", "Drops", "Waits", "Lasts")])

    def test_a_program_that_dies_is_a_failure_with_its_last_words(self):
        (case,) = self.run_fake("kill -SEGV $$")
        self.assertEqual(case.outcome, "failed")
        self.assertIn("Mailbox.Drops", case.detail)

    def test_a_test_that_was_not_run_is_a_failure(self):
        self.assertIn("it ran 4 tests; CTest knows 5", self.run_fake(f'cp {self.folder}/junit.xml "$out"; exit 1', tests=5)[-1].detail)


class Repeated(unittest.TestCase):
    def test_slow_tests_run_a_twentieth_of_the_rounds_but_once_at_least(self):
        self.assertEqual([rounds_of(frozenset({"in-process"}), n) for n in (1, 200)], [1, 200])
        self.assertEqual([rounds_of(frozenset({"in-process", "slow"}), n) for n in (1, 20, 21, 200)], [1, 1, 2, 10])

    def test_the_seeds_come_again_and_differ(self):
        self.assertEqual(seeds(7, 50), seeds(7, 50))
        self.assertNotEqual(seeds(7, 50), seeds(8, 50))
        self.assertGreater(len(set(seeds(7, 50))), 45)

    def test_one_failure_among_many_is_a_failure(self):
        good, bad, late = (Tally([Case("a", outcome, outcome, seconds)]) for outcome, seconds in (("passed", 3), ("failed", 1), ("passed", 2)))
        (case,) = worst([good, bad, late]).cases
        self.assertEqual((case.outcome, case.detail, case.seconds), ("failed", "failed", 3))

    def test_a_failure_says_how_it_is_seen_again_and_the_logs_of_good_rounds_go(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        fake = folder / "test_fake"
        fake.write_text(FAKE % f"""case "$*" in *--gtest_shuffle*random_seed={seeds(7, 3)[1]}) exit 1 ;; esac
            [ "$RC_PARAMS" != seed=1 ] && echo '<testsuites><testcase name="One" classname="A"/></testsuites>' > "$out" """)
        fake.chmod(0o755)
        listing = listed(("fake", "A.One", "program.in-process"))
        listing["tests"][0]["command"][0] = str(fake)
        tally = run_rounds(from_ctest(listing), 3, 7, folder / "2-test.log", {}, at_once=2)
        self.assertEqual(sorted((c.name, c.outcome) for c in tally.cases), [("fake", "failed"), ("fake.A.One", "passed")])
        self.assertIn(f"RC_PARAMS=seed={seeds(7, 3)[1]} {fake} --gtest_shuffle --gtest_random_seed={seeds(7, 3)[1]}", tally.failed[0].detail)
        self.assertEqual([file.name for file in folder.glob("2-test*")], [f"2-test-seed-{seeds(7, 3)[1]}-fake.log"])


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
        self.assertIn("not run: its build is not there", said)

    def test_when_the_time_is_up_a_build_ends_and_what_follows_is_named(self):
        soon = time.monotonic() + 0.5
        with mock.patch.object(suite, "_build_commands", lambda *_: (["true"], ["sleep", "60"])):
            build = suite.build("slow", until=soon)
            done, said = self.run_phases(build, suite.Phase("test slow", lambda log: Tally([Case("a", "failed")]), "slow", until=soon),
                                         suite.Phase("test release", lambda log: Tally([Case("b", "passed")]), "release"))
        self.assertEqual({name: [c.outcome for c in ran.tally.cases] for name, ran in done.items()},
                         {"build-slow": ["too late"], "test-slow": ["too late"], "test-release": ["passed"]})
        with mock.patch.object(suite, "_build_commands", lambda *_: (["true"], ["false"])):  # no time is an excuse for a build that fails
            self.assertEqual([c.outcome for c in suite.build("bad", until=time.monotonic()).run(suite.OUT / "log").cases], ["failed"])
        self.assertIn("1 too late", said)
        self.assertIn("not run: the time is up", said)
        ends = {phase.title for phase in suite.phases(False, until=soon) if phase.until == soon}
        self.assertEqual({phase.title for phase in suite.phases(False)} - ends,
                         {"build release", "test release in-process", "test release end-to-end"})

    def test_tests_are_filled_with_what_comes_later_from_one_to_the_next(self):
        order = []
        beside = mock.Mock(end=lambda: order.append("end"), pid=0)
        planned = [suite.Phase(title, lambda log, title=title: order.append(title) or Tally(), "one")
                   for title in ("build one", "test one", "fuzz", "build two", "test two", "clang-tidy")]
        with mock.patch.object(suite.processes, "Beside", lambda command, log: order.append(command[-1]) or beside):
            self.run_phases(*planned)
            self.assertEqual(order, [phase.title for phase in planned])
            order.clear()
            planned[0].ahead, planned[3].ahead, planned[5].ahead = "earlier", "one", "another"
            self.run_phases(*planned)
            self.assertEqual(order, ["build one", "one && another", "test one", "fuzz", "end", "build two", "another", "test two", "end", "clang-tidy"])

    def test_what_runs_beside_a_test_is_spared_when_the_test_ends(self):
        suite.processes.adopt_orphans()
        beside = suite.processes.Beside(["sleep", "60"], suite.OUT / "log")
        left = subprocess.Popen(["sleep", "61"])
        self.assertEqual(suite.processes.end_leftovers(0, beside.pid), ["sleep"])
        self.assertRaises(ProcessLookupError, os.kill, left.pid, 0)
        os.kill(beside.pid, 0)  # raises if it is gone
        beside.end()
        ahead = [[phase.title for phase in suite.phases(quick) if phase.ahead] for quick in (True, False)]
        self.assertEqual(ahead, [["build quick"], ["build release", "build asan-ubsan", "build tsan", "clang-tidy"]])

    def test_a_phase_has_the_processor_time_of_its_processes_and_of_no_other(self):
        def works(log):
            subprocess.run([sys.executable, "-c", "import time\nwhile time.process_time() < 0.3: pass"], check=True)
            return Tally()
        done, _ = self.run_phases(suite.Phase("test one", works, "one"), suite.Phase("test two", lambda log: Tally(), "one"))
        self.assertGreaterEqual(done["test-one"].cpu_s, 0.25)
        self.assertLess(done["test-two"].cpu_s, 0.2)

    def test_no_two_phases_share_a_name(self):
        for quick in (False, True):
            names = [phase.name for phase in suite.phases(quick)]
            self.assertEqual(len(names), len(set(names)), names)

    def test_programs_with_a_lock_run_one_after_another_and_those_alone_at_the_end(self):
        listing = listed(*[(name, "A.One", labels) for name, labels in
                           (("free", "program"), ("parts1", "program.slow"), ("parts2", "program"), ("timed", "program.alone"), ("left", "program.not-address"))])
        for test in listing["tests"]:
            if test["name"].startswith("parts"):
                test["properties"].append({"name": "RESOURCE_LOCK", "value": ["parts"]})
        order, lock, held = [], threading.Lock(), []

        def runs(program, log, environment):
            if program.locks:
                self.assertEqual(held, [])
                held.append(program.name)
                time.sleep(0.05)  # a second one would be seen
                held.clear()
            with lock:
                order.append(program.name)
            return Tally([Case(program.name, "passed")])

        def ctest(*_, **__):
            with lock:
                order.append("others")
            return Tally([Case("others", "passed")])

        with mock.patch.multiple(suite, known_to_ctest=lambda _: from_ctest(listing), run_program=runs, _run_ctest=ctest):
            tally = suite.programs("release", leave_out="not-address", others=True).run(suite.OUT / "log")
        self.assertEqual(sorted(c.name for c in tally.cases), ["free", "others", "parts1", "parts2", "timed"])
        self.assertEqual([name for name in order if name not in ("free", "others")], ["parts1", "parts2", "timed"])
        self.assertEqual(order[-1], "timed")

    def test_what_is_repeated(self):
        titles = lambda *options: [phase.title for phase in suite.repeat_phases(*options)]
        self.assertEqual(titles(30, 5, ""), ["build release", "test release in-process, 30 times from seed 5", "test release end-to-end, 2 times"])
        self.assertEqual(titles(30, 5, "unit_record"), ["build release", "test release in-process, 30 times from seed 5"])
        self.assertEqual(titles(30, 5, "integration.Fit"), ["build release", "test release end-to-end, 2 times"])

    def test_what_runs_beside_is_ended_with_all_that_it_started(self):
        suite.processes.adopt_orphans()  # as a run does: else whoever adopts them may leave them unreaped, and the wait has no end
        with tempfile.TemporaryDirectory() as folder:
            ended = pathlib.Path(folder) / "ended"
            beside = suite.processes.Beside(["sh", "-c", f"(trap '' TERM; echo > {ended}.begun; sleep 0.5; touch {ended}) & sleep 60"],
                                            pathlib.Path(folder) / "log")
            while not pathlib.Path(f"{ended}.begun").exists():
                time.sleep(0.01)  # sleeps: the poll of a condition
            beside.end()
            self.assertTrue(ended.exists(), "end() waits for those that take their time")


class WithoutRealTime(unittest.TestCase):
    def test_a_sanitized_program_gets_no_real_time_priority_and_runs(self):
        self.assertEqual(subprocess.run([*suite.without_real_time(), "true"]).returncode, 0)
        asked = subprocess.run([*suite.without_real_time(), "chrt", "-f", "1", "true"], capture_output=True, text=True)
        self.assertNotEqual(asked.returncode, 0)
        self.assertIn("not permitted", asked.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
