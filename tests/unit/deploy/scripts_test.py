"""What deploy's scripts say when they are asked, or asked wrongly: at once, before anything is installed or built; and what the demo
starts."""

import contextlib
import io
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "deploy/demo_lib"))
import demo  # noqa: E402


def run(script, *arguments):
    return subprocess.run([str(ROOT / "deploy" / script), *arguments], capture_output=True, text=True, timeout=30, stdin=subprocess.DEVNULL)


class Scripts(unittest.TestCase):
    def test_help_is_for_people(self):
        for script in ("demo", "test", "bench", "narration", "soak", "film", "install-deps"):
            with self.subTest(script):
                result = run(script, "--help")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn(f"deploy/{script}", result.stdout)
                for line in result.stdout.splitlines():
                    self.assertFalse(line.startswith(("#", "set -")), line)

    def test_help_is_asked_for_anywhere(self):
        self.assertEqual(run("demo", "--all", "--help").stdout, run("demo", "--help").stdout)

    def test_every_argument_of_the_demo_stands_in_its_help(self):
        text = run("demo", "--help").stdout
        for line in (ROOT / "deploy/demo_lib/demo.py").read_text().splitlines():
            name = line.partition('parser.add_argument("')[2].partition('"')[0]
            if name and name not in ("--bin", "--out"):  # the script gives these itself
                self.assertIn(f"deploy/demo {name}", text)

    def test_every_argument_of_the_suite_stands_in_its_help(self):
        text = run("test", "--help").stdout
        for name in ("--quick", "--repeat N", "--seed S", "--only", "--no-install"):
            self.assertIn(name, text)
        for wrong in (["--repeat"], ["--often"]):
            self.assertEqual(run("test", *wrong).returncode, 2)

    def test_a_wrong_argument_ends_the_demo_before_it_begins(self):
        for wrong in (["--headles"], ["--domain"], ["--domain", "x"], ["--domain", "--all"], ["--all", "now"]):
            with self.subTest(wrong):
                result = run("demo", *wrong)
                self.assertEqual(result.returncode, 2)
                self.assertIn("demo: ", result.stderr)
                self.assertEqual(result.stdout, "")

    def test_the_demo_builds_every_program_that_the_command_starts(self):
        build = pathlib.Path(os.environ.get("MECHANE_BUILD", ROOT / "build/release"))
        if not (build / "build.ninja").exists() or shutil.which("ninja") is None:
            self.skipTest(f"{build} was not made by Ninja")
        built = subprocess.run(["ninja", "-C", str(build), "-t", "query", "mechane_programs"], capture_output=True, text=True, check=True).stdout
        programs = re.search(r"kPrograms\{\{(.*?)\}\};", (ROOT / "client-sdk/cli/main.cpp").read_text(), re.DOTALL).group(1)
        commands = re.findall(r'\{"(\w+)", ', programs)
        self.assertIn("fit", commands)
        for program in ("mechane", "mechane-mesh-import", *(f"mechane-{command}" for command in commands)):
            self.assertRegex(built, rf"(?m)/{program}$")

    def test_the_demo_tells_how_far_its_tour_is(self):
        log = ("2026-11-22 13:00:00.000 info visitor: odometer: looking for a server\n"
               "odometer  use: push\ncatapult  use: grasp\nodometer  use: done\nodometer  use: visit pushing: done, 31.2 s\n"
               "catapult  use: visit shooting: not done, 60.0 s\nvillage  choose: gone on to odometer\ncatapult  use: wind\n"
               "odometer                pushing                   3/3 steps    31.2 s  done\n")
        self.assertEqual(demo.tour_progress(log, 22), "2 of 22 visits, 1 not done | catapult use: wind")
        self.assertEqual(demo.tour_progress("", 22), "0 of 22 visits")

    def test_the_demo_reports_what_was_measured_and_nothing_in_its_place(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            metrics, _, _, simd = demo.gather(out, [], (0, 0))
            self.assertIsNone(simd)
            for name in ("overruns", "water_l", "force_n.max"):
                self.assertNotIn(name, metrics)
            (out / "server.json").write_text('{"simd": "avx2", "overruns": 3, "tick_us": {"p99": 71}}')
            metrics, _, _, simd = demo.gather(out, [], (0, 0))
            self.assertEqual((simd, metrics["overruns"], metrics["tick_us.p99"]), ("avx2", 3, 71))
            for name, report in (("dry", {"force_n": {"ticks": 0}, "rtt_us": {}}),
                                 ("wet", {"water_l": 2.5, "force_n": {"max": 1.5}, "rtt_us": {"p99": 900}})):
                (out / f"{name}.json").write_text(json.dumps(report))
            metrics = demo.gather(out, ["dry", "wet"], (0, 0))[0]
            self.assertEqual((metrics["water_l"], metrics["force_n.max"], metrics["rtt_us.p99"]), (2.5, 1.5, 900))

    def test_the_demo_counts_a_step_without_its_picture_as_missed(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            (out / "pictures/kiosk-1").mkdir(parents=True)
            (out / "pictures/kiosk-1/use-turn-mono.png").touch()
            (out / "visitor.json").write_text(json.dumps({"activities": [
                {"kiosk": "kiosk-1", "name": "use", "done": True, "steps": [{"name": "turn", "done": True}]}]}))
            metrics, _, missed, _ = demo.gather(out, ["visitor"], (0, 0))
            self.assertEqual((metrics["pictures.wanted"], metrics["pictures.missed"], missed), (2, 1, [("kiosk-1", "use-done")]))

    def test_the_demo_counts_the_visits_of_its_tour(self):
        screw = ROOT / "scenarios/archimedes-screw/archimedes-screw.x3d"
        self.assertEqual(demo.count_visits([screw, screw]), 4)


# In the place of the command `mechane`: notes how it was started; what it records is whole only once it was told to end.
STAND_IN = f"""#!{sys.executable} -IS
import json, os, pathlib, signal, sys
with open(os.environ["STARTED"], "a") as started:
    started.write(json.dumps(sys.argv[1:]) + "\\n")
options = dict(zip(sys.argv[2:], sys.argv[3:]))
if "--play" in options:
    whole = pathlib.Path(options["--play"]).is_file()
    sys.exit(0 if whole and not options["--out"].endswith(os.environ["UNDRAWN"]) else 1)
if sys.argv[1] == os.environ["FAILING"]:
    sys.exit(3)
if sys.argv[1] in ("server", "gateway", "display", "haptic", "record"):
    if sys.argv[1] == "gateway":
        print("operator's password, shown only now: operator secret\\nkiosk kiosk-1: http://there/kiosk/kiosk-1?token=t\\n"
              "console: http://there/console\\nready", flush=True)
    print(" ready: ", flush=True)
    signal.sigwait([signal.SIGTERM])
    if sys.argv[1] == "record":
        pathlib.Path(sys.argv[2]).touch()
"""


def value(command, option):
    """What follows an option."""
    return command[command.index(option) + 1]


class WhatTheDemoStarts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()
        self.out = self.folder / "out"
        (self.folder / "mechane").write_text(STAND_IN)
        (self.folder / "mechane").chmod(0o755)
        # Programs inherit the mask: one that is told to end before it waits for that is not killed.
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])
        self.addCleanup(signal.pthread_sigmask, signal.SIG_SETMASK, mask)

    def demo(self, *arguments, screen, undrawn="none", failing="none"):
        """Runs the demo with stand-ins: the displays and recorders that it started, in order, each a list of arguments;
        and what it complained of. What it told is in self.told."""
        started = self.folder / "started"
        started.unlink(missing_ok=True)
        environment = {"STARTED": str(started), "UNDRAWN": undrawn, "FAILING": failing, "DISPLAY": screen, "WAYLAND_DISPLAY": ""}
        with mock.patch.dict(os.environ, environment), contextlib.redirect_stdout(io.StringIO()) as told, \
                contextlib.redirect_stderr(io.StringIO()) as complaints, \
                mock.patch.object(sys, "argv", ["demo", "--bin", str(self.folder), "--out", str(self.out), "--domain", "7", *arguments]):
            demo.main()
        commands, self.told = [json.loads(line) for line in started.read_text().splitlines()], told.getvalue()
        return [command for command in commands if command[0] in ("display", "record")], complaints.getvalue()

    def test_without_a_window_it_records_and_draws_every_step_once_all_is_recorded(self):
        for arguments, screen in (((), ""), (("--headless",), ":0")):
            with self.subTest(arguments):
                started, complaints = self.demo(*arguments, screen=screen)
                recorded, drawn = started[:3], started[3:]
                self.assertEqual({(*each[:2], value(each, "--kiosk"), value(each, "--domain")) for each in recorded},
                                 {("record", str(self.out / f"{kiosk}.frames"), kiosk, "7") for kiosk in demo.KIOSKS})
                self.assertEqual([(value(each, "--play"), value(each, "--out")) for each in drawn],
                                 [(str(self.out / f"{kiosk}.frames"), str(self.out / "pictures" / kiosk)) for kiosk in demo.KIOSKS])
                for each in drawn:
                    self.assertIn("--offscreen", each)
                    self.assertIn("--every-step", each)
                for wrong in ("could not be drawn", "ended badly"):
                    self.assertNotIn(wrong, complaints)

    def test_a_kiosk_whose_recording_cannot_be_drawn_is_named_and_the_others_are_drawn(self):
        displays, complaints = self.demo(screen="", undrawn="kiosk-1")
        self.assertEqual(sum("--play" in each for each in displays), 3)
        self.assertEqual(re.findall(r"the steps at (\S+) could not be drawn", complaints), ["kiosk-1"])

    def test_with_a_screen_it_opens_windows_and_records_nothing(self):
        displays, complaints = self.demo(screen=":0")
        self.assertEqual(sorted(displays), [["display", "--kiosk", kiosk, "--domain", "7"] for kiosk in ("kiosk-1", "village")])
        self.assertNotIn("picture", complaints)

    def test_it_tells_the_addresses_for_browsers_and_ends_the_gateway(self):
        _, complaints = self.demo(screen=":0")
        for line in ("kiosk kiosk-1: http://there/kiosk/kiosk-1?token=t", "console: http://there/console", "operator secret"):
            self.assertIn(line, self.told)
        self.assertNotIn("gateway", complaints)
        _, complaints = self.demo(screen=":0", failing="gateway")
        self.assertIn("the gateway did not start", complaints)
        self.assertNotIn("console", self.told)


if __name__ == "__main__":
    unittest.main(verbosity=2)
