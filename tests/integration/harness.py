"""Starts Mechane's programs for end-to-end tests: own DDS domain tag, loopback only, own folder, everything stopped at the end."""

import contextlib
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy/common_lib"))
from running import network  # noqa: E402

BIN = pathlib.Path(os.environ.get("MECHANE_BIN", ROOT / "build/release/bin"))
DRIVERS = BIN.parent / "test-drivers"  # of devices that are not there: tests/support/fake_driver.c
SCENARIO = ROOT / "scenarios/archimedes-screw/archimedes-screw.x3d"
# A sanitizer makes everything some times slower.
PATIENCE = float(os.environ.get("MECHANE_PATIENCE", "1"))


def marked(*_):
    """Labels for a test, or for all of a class; CMakeLists.txt says which there are, and reads them here as text."""
    return lambda test: test


def wait_until(condition, limit_s, what):
    """Polls a condition; fails loudly. Not a sleep: the condition says when it is enough."""
    end = time.monotonic() + limit_s * PATIENCE
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.02)
    raise AssertionError(f"not within {limit_s * PATIENCE:.0f} s: {what}")


def repeat_until(action, condition, limit_s, what, again_s=5):
    """For what a program may not have been ready to hear: acts, looks for a while, and acts again."""
    end = time.monotonic() + limit_s * PATIENCE
    while time.monotonic() < end:
        action()
        try:
            return wait_until(condition, again_s, what)
        except AssertionError:
            continue
    raise AssertionError(f"not within {limit_s * PATIENCE:.0f} s: {what}")


class Process:
    def __init__(self, name, command, folder, environment, stdin=subprocess.DEVNULL):
        self.name, self.log = name, folder / f"{name}.log"
        self._file = open(self.log, "w")
        self.process = subprocess.Popen(command, stdout=self._file, stderr=subprocess.STDOUT, stdin=stdin,
                                        env=environment)

    def text(self):
        return self.log.read_text(errors="replace")

    def wait(self, limit_s):
        return self.process.wait(timeout=limit_s * PATIENCE)

    def running(self):
        return self.process.poll() is None

    def kill(self):
        """kill -9."""
        self.process.kill()
        self.process.wait()

    def stop(self, limit_s=15):
        """A polite stop; returns the exit status."""
        if self.running():
            self.process.send_signal(signal.SIGTERM)
        return self.wait(limit_s)


class EndToEnd(unittest.TestCase):
    command_prefix = ()  # of run_command(): where commands run

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(prefix="mechane-test-")
        self.folder = pathlib.Path(self._folder.name)
        self.environment = network(self.id().split(".")[-1])
        self.processes = []
        self._count = 0

    def tearDown(self):
        for process in self.processes:
            if process.running():
                process.kill()
        failed = any(error for _, error in getattr(self._outcome, "errors", [])) or (
            getattr(self._outcome, "result", None) is not None
            and any(test is self for test, _ in self._outcome.result.failures + self._outcome.result.errors))
        if failed:
            for process in self.processes:
                print(f"---- {process.name} ----\n{process.text()[-4000:]}")
        self._folder.cleanup()

    def start(self, name, *arguments, environment=None, prefix=(), stdin=subprocess.DEVNULL):
        """Runs `mechane` with these arguments. A display draws seldom, and without a window what costs least, unless they say otherwise: in
        `high` and 60 times a second, its defaults, two displays leave a processor no time for anything else. A test that compares pictures
        bit by bit must ask for it."""
        offscreen = "--offscreen" in arguments
        if offscreen and "--quality" not in arguments:
            arguments = (*arguments, "--quality", "cached")
        if "display" in arguments and not {"--fps", "--frames", "--play"} & set(arguments):
            arguments = (*arguments, "--fps", "10" if offscreen else "20")
        self._count += 1
        process = Process(f"{name}-{self._count}", [*prefix, str(BIN / "mechane"), *map(str, arguments)], self.folder,
                          environment or self.environment, stdin)
        self.processes.append(process)
        return process

    def server(self, *arguments, scenario=SCENARIO, records=True, prefix=()):
        record = ["--records", self.folder / "records"] if records else ["--records", ""]
        scenarios = scenario if isinstance(scenario, list) else [scenario]
        process = self.start("server", "server", "--scenario", *scenarios, *record, "--report",
                             self.folder / "server.json", *arguments, prefix=prefix)
        wait_until(lambda: " ready: " in process.text() or not process.running(), 600,
                   "the server is ready (the first time it fits the exhibit's parts)")
        self.assertTrue(process.running(), process.text())
        return process

    def visitor(self, kiosk, *arguments):
        report = self.folder / f"visitor-{kiosk}-{self._count}.json"
        process = self.start(f"visitor-{kiosk}", "visitor", "--kiosk", kiosk, "--scenario", SCENARIO, "--report", report,
                             *arguments)
        process.report_file = report
        return process

    @contextlib.contextmanager
    def screen(self, size):
        """The environment of a screen without glass, for windows; gone at the end."""
        read, write = os.pipe()
        server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", f"{size}x24"], pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        try:
            with os.fdopen(read) as said:
                yield {**self.environment, "DISPLAY": f":{said.readline().strip()}"}
        finally:
            server.kill()
            server.wait()

    def picture(self, display):
        """What a display that writes to the folder `pictures` shows at this moment, as bytes."""
        self.pictures = getattr(self, "pictures", 0) + 1
        file = self.folder / f"pictures/request-{self.pictures:03}-mono.png"
        display.process.send_signal(signal.SIGUSR1)
        wait_until(file.exists, 60, f"picture {self.pictures} was taken")
        return file.read_bytes()

    def still_picture(self, display, seconds=0):
        """Once it has stayed the same for so long, two pictures at least."""
        still, since = self.picture(display), time.monotonic()

        def stays():
            nonlocal still, since
            newer = self.picture(display)
            if newer != still:
                still, since = newer, time.monotonic()
                return False
            return time.monotonic() - since >= seconds
        wait_until(stays, 30 + seconds, "the picture stands still")
        return still

    def report_of(self, visitor):
        return json.loads(visitor.report_file.read_text())

    def journals(self):
        return sorted((self.folder / "records").glob("*.journal"))

    def replay(self, journal, *arguments, scenario=SCENARIO):
        scenarios = scenario if isinstance(scenario, list) else [scenario]
        result = subprocess.run([str(BIN / "mechane"), "replay", str(journal), "--scenario", *map(str, scenarios), *arguments],
                                capture_output=True, text=True, timeout=120 * PATIENCE, env=self.environment)
        return result.returncode, result.stdout + result.stderr

    def run_command(self, *arguments, limit_s=60):
        try:
            return subprocess.run([*self.command_prefix, str(BIN / "mechane"), *map(str, arguments)], capture_output=True, text=True,
                                  timeout=limit_s * PATIENCE, env=self.environment, stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired as late:
            told = "".join((text or b"").decode() for text in (late.stdout, late.stderr))
            raise AssertionError(f"mechane {arguments[0]} was not done in {late.timeout:.0f} s. It said:\n{told}") from None

    def displays(self, *arguments):
        """What `mechane displays` tells, by name."""
        result = self.run_command("displays", "--json", *arguments)
        told = [json.loads(line) for line in result.stdout.splitlines()]
        return {display["display"]: display for display in told}

    @staticmethod
    def full_disk(folder):
        """Runs a command with a disk of its own in `folder`, soon full; where that is not allowed, with a limit on each file."""
        mount = 'mkdir -p "$0" && mount -t tmpfs -o size=256k tmpfs "$0" && exec "$@"'
        # The root of a user namespace has no right to real-time priority: only where there is no other way.
        for unshare in (["unshare", "--mount"], ["unshare", "--map-root-user", "--mount"]):
            own_disk = [*unshare, "sh", "-c", mount, str(folder)]
            if subprocess.run([*own_disk, "true"], capture_output=True).returncode == 0:
                return own_disk
        print("no disk can be mounted here: a limit on the size of files stands for the full disk")
        return ["prlimit", "--fsize=65536", "env", "--ignore-signal=XFSZ"]

    def hash_in(self, text):
        return re.search(r"final hash\s+([0-9a-f]{16})", text).group(1)
