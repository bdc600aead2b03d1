"""A real device's path: a driver (tests/support/fake_driver.c) in a process of its own, and the programs that use it. The driver
writes each force that it is given into a file, so that what the device felt is known whatever died."""

import json
import os
import signal
import struct
import time
import unittest
import zlib

from harness import DRIVERS, PATIENCE, EndToEnd, marked, wait_until

SILENT_S = 0.02  # without a word from the loop, the driver's process writes zero
LATE_S = 0.03 * PATIENCE  # what a busy machine may add between the look at the clock and the write
GOLD = (237, 196, 117)  # of a notice's tile


def pixels(png):
    """The colours of a picture that a display wrote: 8 bits each of red, green and blue (and of opacity, which is left out)."""
    width, height, depth, kind = struct.unpack(">IIBB", png[16:26])
    assert (depth, kind) == (8, 6), (depth, kind)
    at, packed = 8, b""
    while at < len(png):
        size, name = struct.unpack(">I4s", png[at:at + 8])
        packed += png[at + 8:at + 8 + size] if name == b"IDAT" else b""
        at += size + 12
    data, stride = zlib.decompress(packed), 4 * width
    above = bytearray(stride)
    for row in range(height):
        way, line = data[row * (stride + 1)], bytearray(data[row * (stride + 1) + 1:(row + 1) * (stride + 1)])
        for i in range(stride if way else 0):
            left, up, corner = (line[i - 4], above[i], above[i - 4]) if i >= 4 else (0, above[i], 0)
            nearest = min((abs(up - corner), 0, left), (abs(left - corner), 1, up), (abs(left + up - 2 * corner), 2, corner))[2]
            line[i] = (line[i] + (0, left, up, (left + up) // 2, nearest)[way]) & 255
        yield from zip(line[0::4], line[1::4], line[2::4])
        above = line


class Devices(EndToEnd):
    def setUp(self):
        super().setUp()
        self.environment["MECHANE_DRIVERS"] = str(DRIVERS)
        self.trace_file = self.folder / "trace"

    def device(self, options=""):
        return f"fake:trace={self.trace_file},{options}"

    def trace(self):
        """What the device was given: (time, force upwards), and how often it was closed."""
        data = self.trace_file.read_bytes() if self.trace_file.exists() else b""
        written = list(struct.iter_unpack("=qd", data[:len(data) // 16 * 16]))
        return [(at / 1e9, force) for at, force in written if at > 0], sum(at < 0 for at, _ in written)

    def written(self, text):
        file = self.folder / "text"
        file.write_text(f"# a hand\n{text}\n")
        return file

    def refused(self, *arguments):
        """What a program says that ends with status 2."""
        process = self.start("refused", *arguments)
        self.assertEqual(process.wait(20), 2, process.text())
        return process.text()

    def pressing(self, process, least_n=0.3):
        wait_until(lambda: self.trace()[0][-1:] and self.trace()[0][-1][1] > least_n, 20, f"{process.name} presses: {process.text()}")

    def expect_zero_soon_after(self, moment):
        """The device has been given no force from 20 ms after this moment on."""
        wait_until(lambda: self.trace()[0][-1][1] == 0, 10, "zero is written")
        last = max(at for at, force in self.trace()[0] if force > 0)
        self.assertLess(last, moment + SILENT_S + LATE_S)

    def test_a_killed_loop_leaves_no_force_on_the_device(self):
        wall = self.start("wall", "devices", "--test", self.device())
        self.pressing(wall)
        killed = time.monotonic()
        wall.kill()
        self.expect_zero_soon_after(killed)
        wait_until(lambda: self.trace()[1] == 1, 10, "the device is closed")

    def test_a_terminals_signals_do_not_reach_the_driver(self):
        """Ctrl-\\ goes to all processes of the terminal's group."""
        wall = self.start("wall", "devices", "--test", self.device(), prefix=["setsid"])
        self.pressing(wall)
        quitted = time.monotonic()
        os.killpg(wall.process.pid, signal.SIGQUIT)
        self.expect_zero_soon_after(quitted)
        wait_until(lambda: self.trace()[1] == 1, 10, "the device is closed")

    def test_a_device_that_failed_is_told_by_the_tests_status(self):
        wall = self.start("wall", "devices", "--test", self.device("fault=gone,after=300"), "--seconds", "2")
        self.assertEqual(wall.wait(20), 1, wall.text())
        self.assertIn("the fake cable was pulled", wall.text())
        self.assertIn("the device is back", wall.text())

    def test_a_driver_that_waits_too_long_is_told_with_its_time(self):
        wall = self.start("wall", "devices", "--test", self.device("fault=slow,after=300"), "--seconds", "1.5")
        self.assertEqual(wall.wait(20), 1, wall.text())
        self.assertRegex(wall.text(), r"read\(\) took [3-9]\d\d ms at most; a driver may wait 100 ms")
        last = [line for line in wall.text().splitlines() if " /s, late by up to " in line][-1]
        self.assertLess(float(last.split(" /s")[0].split()[-1]), 400, "it is not its loop's time-outs that are counted")

    def test_a_stopped_loop_leaves_no_force_and_begins_again_from_zero(self):
        wall = self.start("wall", "devices", "--test", self.device())
        self.pressing(wall)
        stopped = time.monotonic()
        wall.process.send_signal(signal.SIGSTOP)
        self.expect_zero_soon_after(stopped)
        self.assertEqual(self.trace()[1], 0, "it waits for its loop")
        wall.process.send_signal(signal.SIGCONT)
        self.assertEqual(wall.stop(), 0, wall.text())
        forces, closed = self.trace()
        self.assertEqual((forces[-1][1], closed), (0, 1))

    @marked("address")
    def test_a_hand_on_a_real_device_feels_the_exhibit_and_is_let_go(self):
        self.server(records=False)
        report = self.folder / "haptic.json"
        center = ["--center", "0", "0.72", "0.19"]
        haptic = self.start("haptic", "haptic", "--kiosk", "kiosk-1", "--device", self.device(), *center, "--report", report)
        wait_until(lambda: "device: Fake stylus" in haptic.text(), 20, haptic.text())
        wait_until(lambda: len(self.trace()[0]) > 2000, 30, "two seconds of forces were written")
        self.assertEqual(haptic.stop(), 0, haptic.text())
        told = json.loads(report.read_text())
        self.assertGreater(told["answers"], 100, told)
        self.assertEqual(told["device"], "Fake stylus")
        forces, closed = self.trace()
        self.assertEqual((forces[-1][1], closed), (0, 1))
        self.assertLessEqual(max(force for _, force in forces), 2 * (1 + 1e-9), "the device's limit")

    def kiosk_status(self, **wanted):
        """Whether `mechane echo` shows a program of a kiosk like this."""
        told = self.run_command("echo", "KioskStatus", "--json", "--seconds", "2").stdout
        return any(wanted.items() <= json.loads(line).items() for line in told.splitlines() if line.startswith("{"))

    @marked("draws", "address")
    def test_the_display_shows_that_the_handle_was_let_go(self):
        self.server(records=False)
        display = self.start("display", "display", "--offscreen", "--kiosk", "kiosk-1", "--size", "640x360",
                             "--language", "en", "--fps", "10",
                             "--out", self.folder / "pictures")

        def sign():
            """Whether a notice's golden tile is in the picture; titles and dots have some gold, too."""
            return sum(1 for pixel in pixels(self.picture(display)) if pixel == GOLD) > 700
        haptic = self.start("ready", "haptic", "--kiosk", "kiosk-1", "--device", self.device())
        wait_until(lambda: self.kiosk_status(program="mechane-haptic", device="ready", device_name="Fake stylus"), 30, haptic.text())
        self.assertFalse(sign(), "all is well")
        self.assertEqual(haptic.stop(), 0, haptic.text())
        haptic = self.start("let-go", "haptic", "--kiosk", "kiosk-1", "--device", self.device("fault=let_go,after=1"))
        wait_until(sign, 40, "the display shows a notice")
        self.assertTrue(self.kiosk_status(program="mechane-haptic", device="let go"))
        haptic.kill()
        wait_until(lambda: not sign(), 40, "the notice of a program that died is gone")

    def statuses(self, echo, user=0):
        """What the haptic program of a hand told, in order."""
        told = [json.loads(line) for line in echo.text().split("\n")[:-1] if line.startswith("{")]  # the last line may be half one
        return [status for status in told if (status["program"], status["user"]) == ("mechane-haptic", user)]

    def calibrations(self, echo, user=0):
        """The steps, each once."""
        steps = [status["calibration"] for status in self.statuses(echo, user)]
        return [step for step, before in zip(steps, [None, *steps]) if step != before]

    @marked("draws")
    def test_the_display_leads_a_visitor_through_a_gloves_calibration(self):
        self.server(records=False)
        display = self.start("display", "display", "--offscreen", "--kiosk", "kiosk-1", "--size", "640x360", "--language", "en",
                             "--fps", "10", "--out", self.folder / "pictures")

        def disc():
            """Gold that no sign has: a quarter of it lies behind the drawn hand."""
            return sum(1 for pixel in pixels(self.picture(display)) if pixel == GOLD) > 4000
        echo = self.start("echo", "echo", "KioskStatus", "--json")
        wait_until(lambda: any(shown["pictures"] > 0 for shown in self.displays().values()), 60, "the display draws")
        self.assertFalse(disc())
        haptic = self.start("haptic", "haptic", "--kiosk", "kiosk-1", "--device", "virtual:kind=glove", "--calibrate")
        wait_until(disc, 30, "a pose is shown")
        wait_until(lambda: self.statuses(echo)[-1]["device"] == "ready", 60, haptic.text())
        self.assertEqual(self.calibrations(echo), ["none", "flat", "fist", "pinch", "done"])
        first, done = ([s["sent_ns"] for s in self.statuses(echo) if s["calibration"] == step][0] for step in ("flat", "done"))
        self.assertLess((done - first) / 1e9, 30 * PATIENCE)
        asked = [s for s in self.statuses(echo) if s["calibration"] in ("flat", "fist", "pinch")]
        self.assertLessEqual(len(asked), 5 * (done - first) / 1e9, "a few messages a second")
        wait_until(lambda: not disc(), 30, "the thanks are over")

    @marked("address")
    def test_a_glove_is_fitted_to_the_next_visitor_without_a_restart(self):
        """Staff ask for it by a signal. The stand-in of a glove shows what it is asked for."""
        flat, fist, pinch = [0] * 20, [-20, 25, 40, 60] + 4 * [0, 90, 100, 90], [-8, 18, 40, 30, 0, 62, 42, 24] + 3 * [0, 10, 10, 10]
        file, moves = self.folder / "pose", 0

        def shows(degrees):
            file.write_bytes(struct.pack("20d", *(angle / 57.2957795 for angle in degrees)))

        def is_ready():
            nonlocal moves
            told = self.statuses(echo)[-1] if self.statuses(echo) else {"calibration": "none", "device": "none"}
            moves += 1
            shows({"flat": flat, "fist": fist, "pinch": pinch}.get(told["calibration"], fist if moves // 20 % 2 else flat))
            return (told["device"], told["calibration"]) == ("ready", "done")
        shows(flat)
        echo = self.start("echo", "echo", "KioskStatus", "--json")
        report = self.folder / "haptic.json"
        haptic = self.start("haptic", "haptic", "--wait", "--calibrate", "--kiosk", "kiosk-1", "--device", self.device(f"pose={file}"),
                            "--report", report)
        for step in "none", "flat":
            wait_until(lambda: is_ready() or self.calibrations(echo)[-1:] == [step], 60, haptic.text())
            haptic.process.send_signal(signal.SIGUSR1)
        wait_until(is_ready, 60, haptic.text())
        written = len(self.trace()[0])
        wait_until(lambda: len(self.trace()[0]) > written + 1000, 20, "a second of forces was written")
        self.assertEqual(self.trace()[1], 1, "who asks while it calibrates, or before, asks for no second time")
        haptic.process.send_signal(signal.SIGUSR1)
        wait_until(lambda: self.statuses(echo)[-1]["device"] == "let go", 10, "it waits for a hand")
        wait_until(lambda: not is_ready() and self.calibrations(echo)[-1] == "flat", 10, haptic.text())
        self.assertEqual(self.calibrations(echo)[-6:], ["flat", "fist", "pinch", "done", "none", "flat"])
        self.assertEqual(self.trace()[1], 2, "closed after the calibration, and before the next")
        self.assertEqual(haptic.stop(), 0, haptic.text())
        forces, closed = self.trace()
        self.assertEqual((forces[-1][1], closed), (0, 3))
        told = json.loads(report.read_text())
        self.assertGreater(told["ticks"], 500, "what came before the calibration that was stopped")

    def test_a_glove_that_nobody_wears_is_waited_for_as_long_as_was_told(self):
        (self.folder / "pose").write_bytes(bytes(160))
        haptic = self.start("haptic", "haptic", "--wait", "--calibrate", "--seconds", "1", "--kiosk", "kiosk-1", "--device",
                            self.device(f"pose={self.folder / 'pose'}"))
        self.assertEqual(haptic.wait(20), 0, haptic.text())
        self.assertIn("put the glove on", haptic.text())

    def test_a_device_that_is_not_there_at_the_start_is_waited_for(self):
        there = self.folder / "there"
        haptic = self.start("haptic", "haptic", "--wait", "--kiosk", "kiosk-1", "--device", self.device(f"until={there}"))
        wait_until(lambda: self.kiosk_status(device="lost", device_name="fake"), 30, haptic.text())
        self.assertTrue(self.kiosk_status(device="lost"), "two seconds later, too")
        there.touch()
        wait_until(lambda: self.kiosk_status(device="ready", device_name="Fake stylus"), 30, haptic.text())
        self.assertEqual(haptic.text().count("plug it in"), 1, "told once, though it is tried each second")
        self.assertEqual(haptic.stop(), 0, haptic.text())

    def test_one_that_is_waited_for_can_be_stopped(self):
        haptic = self.start("haptic", "haptic", "--wait", "--kiosk", "kiosk-1", "--device", self.device("fault=absent"))
        wait_until(lambda: "trying again" in haptic.text(), 20, haptic.text())
        self.assertEqual(haptic.stop(), 0, haptic.text())

    @marked("address")
    def test_two_devices_of_a_kiosk_work_and_fail_each_on_its_own(self):
        server = self.server(records=False)
        at_kiosk = ["haptic", "--kiosk", "kiosk-1", "--center", "0", "0.72", "0.19", "--device"]
        echo = self.start("echo", "echo", "KioskStatus", "--json")
        first = self.start("first", *at_kiosk, self.device())
        second = self.start("second", *at_kiosk, "fake:fault=let_go,after=1", "--user", "1")

        def told(user):
            return self.statuses(echo, user)[-1]["device"] if self.statuses(echo, user) else ""
        wait_until(lambda: (told(0), told(1)) == ("ready", "let go"), 30, first.text() + second.text())
        third = self.start("third", *at_kiosk, "virtual", "--user", "1")
        wait_until(lambda: "hand 1 of kiosk-1 belongs to mechane-haptic" in third.text(), 20, third.text())
        second.kill()
        wait_until(lambda: sum("user 1" in line and "is in world" in line for line in server.text().splitlines()) == 2, 20,
                   "the third program takes the hand that became free")
        written = len(self.trace()[0])
        wait_until(lambda: len(self.trace()[0]) > written + 500, 20, "the first device goes on")
        self.assertEqual(told(0), "ready")
        self.assertEqual(first.stop(), 0, first.text())

    def test_two_gloves_of_a_kiosk_are_fitted_one_after_the_other(self):
        echo = self.start("echo", "echo", "KioskStatus", "--json")
        glove = ["haptic", "--kiosk", "kiosk-1", "--device", "virtual:kind=glove", "--calibrate"]
        first = self.start("first", *glove)
        wait_until(lambda: self.calibrations(echo)[-1:] == ["flat"], 20, first.text())
        second = self.start("second", *glove, "--user", "1")
        wait_until(lambda: self.calibrations(echo)[-1] == "fist", 30, first.text())
        self.assertEqual(self.calibrations(echo, 1)[-1:], ["none"], "it waits for its turn")
        first.kill()
        wait_until(lambda: self.calibrations(echo, 1)[-1] == "flat", 20, second.text())

    @marked("address")
    def test_a_driver_that_dies_ends_the_haptic_program(self):
        """systemd starts it again."""
        haptic = self.start("haptic", "haptic", "--kiosk", "kiosk-1", "--device", self.device("fault=crash,after=300"))
        self.assertEqual(haptic.wait(20), 1, haptic.text())
        self.assertIn("by signal 6", haptic.text())

    def test_what_cannot_be_used_says_why(self):
        for device, words in (("nothing-has-this-name", "no driver of this name"), (self.device("fault=absent"), "plug it in"),
                              ("later", "another version"), (self.device("fault=limits"), "peak_force_n is 1000")):
            for command in (["devices", "--test"], ["haptic", "--device"]):
                self.assertIn(words, self.refused(*command, device))

    def test_a_virtual_device_has_options(self):
        for device, words in (("virtual:mass=1", "no option 'mass'"), ("virtual:kind=glove,delay=1", "no option 'delay'"),
                              ("virtual:delay=21", "0 to 20")):
            for command in (["haptic", "--device"], ["visitor", "--device"]):
                self.assertIn(words, self.refused(*command, device))
        self.assertIn("nothing to test", self.refused("devices", "--test", "virtual"))
        self.assertIn("no real device", self.refused("visitor", "--device", "fake"))
        self.assertIn("cannot move the stylus", self.refused("visitor", "--device", "virtual:hand=off"))

    @marked("address")
    def test_a_recorded_hand_is_played_again(self):
        files = [self.folder / "first", self.folder / "again"]
        devices = ["virtual", f"playback:file={files[0]},speed=4"]
        for device, file in zip(devices, files):
            haptic = self.start("haptic", "haptic", "--kiosk", "kiosk-1", "--device", device, "--center", "0", "0", "0", "--record", file,
                                "--seconds", "1")
            self.assertEqual(haptic.wait(30), 0, haptic.text())
        first, again = ([line.split() for line in file.read_text().splitlines() if line[0] != "#"] for file in files)
        self.assertGreater(len(first), 100)
        self.assertEqual(again[-1][1:], first[-1][1:], "it has come to the end, and stands there")
        self.assertIn("line 2", self.refused("haptic", "--device", f"playback:file={self.written('0 0')}"))

    def test_drivers_are_listed(self):
        listed = self.start("list", "devices", "--json")
        self.assertEqual(listed.wait(20), 0)
        drivers = {entry["name"]: entry for entry in json.loads(listed.text())}
        self.assertIn("kind=phantom|glove|tracked", drivers["virtual"]["options"])
        self.assertEqual(drivers["fake"]["fault"], "")
        self.assertIn("another version", drivers["later"]["fault"])


if __name__ == "__main__":
    unittest.main()
