"""Killed processes, full disks, second sessions: what goes on, what comes back, and that no force is left."""

import json
import os
import signal
import socket
import time
import unittest

from harness import SCENARIO, EndToEnd, marked, wait_until


class Faults(EndToEnd):
    def test_the_second_session_on_a_hand_is_told_so(self):
        self.server()
        first = self.visitor("kiosk-1", "--endless")
        wait_until(lambda: "assemble" in first.text(), 30, "the first visitor has begun")
        second = self.visitor("kiosk-1")
        self.assertEqual(second.wait(60), 2)
        self.assertIn("kiosk-1", second.text())
        self.assertTrue(first.running())

    def test_a_killed_visitor_lets_go_and_its_successor_is_back_in_the_world(self):
        server = self.server()
        visitor = self.visitor("kiosk-1", "--activity", "use")
        wait_until(lambda: "use: turn" in visitor.text(), 60, "the visitor holds the handle")
        bystander = self.visitor("kiosk-2", "--activity", "assemble")
        visitor.kill()
        successor = self.visitor("kiosk-1", "--activity", "use")
        self.assertEqual(successor.wait(120), 0, successor.text())
        self.assertEqual(bystander.wait(120), 0, bystander.text())
        self.assertEqual(server.stop(), 0)
        log = server.text()
        self.assertEqual(log.count("world world-1 opened"), 1, log)

    def test_a_hand_that_was_stopped_for_4_s_feels_again_at_once(self):
        server = self.server()
        file = self.folder / "haptic.json"
        hand = self.start("haptic", "haptic", "--kiosk", "kiosk-1", "--report", file)
        wait_until(lambda: "in world world-1" in server.text(), 30, "the hand is in its world")
        time.sleep(6)  # sleeps: the answers of this time of use must not be waited for again
        hand.process.send_signal(signal.SIGSTOP)
        stopped = time.monotonic()
        wait_until(lambda: "hand of kiosk-1" in server.text() and " left" in server.text(), 10, "the server gives the hand up")
        time.sleep(max(0, stopped + 4 - time.monotonic()))  # sleeps: how long it was stopped is the subject
        hand.process.send_signal(signal.SIGCONT)
        wait_until(lambda: server.text().count("in world world-1") == 2, 10, "the hand is in its world again")
        time.sleep(3)  # sleeps: so long would be silent, were it wrong
        self.assertEqual(hand.stop(), 0, hand.text())
        report = json.loads(file.read_text())
        self.assertLess(report["silent_ticks"], 1000, f"it felt nothing for too long: {report}")
        self.assertEqual(server.stop(), 0)

    @marked("address")
    def test_a_killed_server_puts_the_kiosk_back_at_its_step(self):
        server = self.server()
        visitor = self.visitor("kiosk-1", "--activity", "use", "--endless", "--patience", "30")
        wait_until(lambda: "use: turn" in visitor.text(), 60, "the visitor turns")
        turning_since = time.time()
        newer = lambda: [f for f in (self.folder / "records").glob("*.snapshot") if f.stat().st_mtime > turning_since]
        wait_until(newer, 10, "a snapshot was taken since")
        server.kill()
        again = self.server()
        wait_until(lambda: "resumed" in again.text(), 30, "the world is resumed")
        self.assertRegex(again.text(), r"resumed .*kiosk-1.* step (turn|fill)")
        again.kill()  # before the resumed world took a snapshot in its course
        third = self.server()
        wait_until(lambda: "resumed" in third.text(), 30, "the world is resumed once more")
        self.assertRegex(third.text(), r"resumed .*kiosk-1.* step (turn|fill)")
        self.assertTrue(visitor.running())
        self.assertEqual(third.stop(), 0)

    @marked("address")
    def test_kiosks_that_wait_get_a_world_when_one_is_free(self):
        server = self.server("--worlds", "1", "--world-idle", "1")
        first = self.start("haptic-1", "haptic", "--kiosk", "kiosk-1")
        wait_until(lambda: "in world world-1" in server.text(), 30, "the first hand is in its world")
        reports = [self.folder / "second.json", self.folder / "third.json"]
        third = self.start("haptic-3", "haptic", "--kiosk", "kiosk-3", "--join", "kiosk-2", "--report", reports[1])
        wait_until(lambda: "waiting for kiosk kiosk-2" in third.text(), 10, "the third is told why it waits")
        second = self.start("haptic-2", "haptic", "--kiosk", "kiosk-2", "--report", reports[0])
        wait_until(lambda: "all 1 worlds" in second.text(), 10, "the second is told why it waits")
        self.assertEqual(first.stop(), 0)
        wait_until(lambda: server.text().count("is in world world-2") == 2, 20, "both are in the next world")
        for kiosk in ("kiosk-2", "kiosk-3"):
            self.run_command("echo", "HapticOutput", "--kiosk", kiosk, "--count", "200", "--seconds", "20")
        for hand, report in zip((second, third), reports):
            self.assertEqual(hand.stop(), 0)
            self.assertGreater(json.loads(report.read_text())["answers"], 50)
        self.assertEqual(server.stop(), 0)

    def test_a_server_that_is_kept_from_its_processor_says_so(self):
        server = self.server()
        self.start("haptic", "haptic", "--kiosk", "kiosk-1")
        wait_until(lambda: "in world world-1" in server.text(), 30, "a hand is in its world")

        def hold_up():
            for _ in range(20):
                server.process.send_signal(signal.SIGSTOP)
                time.sleep(0.02)  # sleeps: what it is kept from is time
                server.process.send_signal(signal.SIGCONT)
                time.sleep(0.02)  # sleeps: what it is kept from is time
            return "had to wait for a processor" in server.text()
        wait_until(hold_up, 30, "the server's log tells it")

        def doctor_warns():
            told = json.loads(self.run_command("doctor", "--json", "--probe-seconds", "0").stdout)
            return next((check for check in told if check["name"] == "server server-1" and check["status"] == "warning"), None)
        # Its status goes out just after the line in its log.
        self.assertIn("mechane doctor", wait_until(doctor_warns, 5, "mechane doctor tells it too")["remedy"])

    def test_a_full_disk_under_the_journal_is_survived(self):
        server = self.server(prefix=self.full_disk(self.folder / "records"))
        visitor = self.visitor("kiosk-1", "--activity", "use")
        self.assertEqual(visitor.wait(120), 0, visitor.text())
        self.assertTrue(server.running(), "the server must go on")
        self.assertRegex(server.text(), r"records are being lost: .*(No space left on device|File too large)")
        self.assertEqual(server.stop(), 0)

    def test_two_servers_warn_of_each_other(self):
        first = self.server()
        second = self.server("--name", "forgotten")
        wait_until(lambda: "another server, forgotten on" in first.text(), 10, "the first warns")
        wait_until(lambda: "another server, server-1 on" in second.text(), 10, "the second warns")

    def test_a_stop_while_parts_are_built_ends_the_server(self):
        server = self.start("server", "server", "--scenario", SCENARIO, "--cache", self.folder / "empty", "--records", "")
        wait_until(lambda: "building" in server.text(), 60, "parts are being built")
        self.assertEqual(server.stop(), -signal.SIGTERM, server.text())
        self.assertNotIn("ready:", server.text())

    def test_a_visitor_without_a_server_says_what_it_waits_for_and_stops_when_told(self):
        visitor = self.visitor("kiosk-1")
        wait_until(lambda: "looking for a server" in visitor.text(), 10, "the visitor says what it waits for")
        self.assertEqual(visitor.stop(5), 2, visitor.text())

    @marked("address")
    def test_a_clean_stop_and_systemd_are_told(self):
        path = str(self.folder / "notify")
        listener = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        listener.bind(path)
        listener.settimeout(60)
        self.environment["NOTIFY_SOCKET"] = path
        server = self.server()
        self.assertIn(b"READY=1", listener.recv(4096))
        # At once: ready is said only where every loop ticks, so the report has ticks however soon the stop comes.
        self.assertEqual(server.stop(), 0)
        messages = b""
        listener.settimeout(1)
        while b"STOPPING=1" not in messages:
            messages += listener.recv(4096)
        report = json.loads((self.folder / "server.json").read_text())
        self.assertGreater(report["ticks"], 0)

    @marked("address")
    def test_two_users_share_a_world(self):
        server = self.server()
        first = self.visitor("kiosk-1", "--activity", "use", "--endless")
        wait_until(lambda: "use: " in first.text(), 60, "the first visitor has begun")
        second = self.start("haptic", "haptic", "--kiosk", "kiosk-2", "--join", "kiosk-1", "--seconds", "3", "--report",
                            self.folder / "haptic.json")
        self.assertEqual(second.wait(30), 0, second.text())
        report = json.loads((self.folder / "haptic.json").read_text())
        self.assertGreater(report["answers"], 1000)
        self.assertEqual(first.stop(), 1)
        self.assertEqual(server.stop(), 0)
        self.assertNotIn("world world-2 opened", server.text())


@marked("address")
class BadInput(EndToEnd):
    def refuse(self, text, expected):
        path = self.folder / "bad.x3d"
        path.write_text(text)
        result = self.run_command("server", "--scenario", path, "--records", "")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("bad.x3d", result.stderr)
        self.assertRegex(result.stderr, expected)

    def test_a_scenario_that_is_not_xml(self):
        self.refuse("<X3D><Scene>", r"bad\.x3d:\d+")

    def test_a_scenario_with_nan(self):
        text = SCENARIO.read_text().replace("mass='", "mass='nan", 1)
        self.assertNotEqual(text, SCENARIO.read_text())
        # The file lies elsewhere; its mesh must still be found, so that the number is the only fault.
        (self.folder / "models").symlink_to(SCENARIO.parents[1] / "models")
        self.refuse(text.replace("../models/", "models/"), r"bad\.x3d:\d+.*mass")

    def test_a_deep_scenario(self):
        self.refuse("<X3D version='4.0'><Scene>" + "<Group>" * 100_000 + "</Group>" * 100_000 + "</Scene></X3D>", "deep|depth|nest")

    def test_a_missing_file_and_a_wrong_setting(self):
        result = self.run_command("server", "--scenario", self.folder / "nowhere.x3d")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("nowhere.x3d", result.stderr)
        settings = self.folder / "server.toml"
        settings.write_text("worlds = 2\nwurlds = 3\n")
        result = self.run_command("server", "--settings", settings, "--scenario", SCENARIO)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("wurlds", result.stderr)
        self.assertIn("server.toml:2", result.stderr)

    def test_check_tells_good_from_bad(self):
        self.assertEqual(self.run_command("check", SCENARIO).returncode, 0)
        bad = self.folder / "bad.x3d"
        bad.write_text(SCENARIO.read_text().replace("USE='", "USE='NO_", 1))
        result = self.run_command("check", bad)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stdout, r"bad\.x3d:\d+: error")

    def test_check_looks_into_the_mesh_file(self):
        bad = self.folder / "bad.x3d"
        bad.write_text(SCENARIO.read_text().replace("name='node' value='\"INNER\"'", "name='node' value='\"INER\"'"))
        (self.folder / "models").symlink_to(SCENARIO.parents[1] / "models")
        bad.write_text(bad.read_text().replace("../models/", "models/"))
        result = self.run_command("check", bad)
        self.assertEqual(result.returncode, 1)
        self.assertIn("did you mean 'INNER'?", result.stdout)

    def test_two_scenarios_become_one(self):
        both = self.folder / "two-screws.x3d"
        result = self.run_command("merge", SCENARIO, SCENARIO, "-o", both)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("0 errors, 0 warnings", result.stdout)
        self.assertEqual(self.run_command("check", both).returncode, 0)

    def test_the_reference_is_printed(self):
        result = self.run_command("reference")
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stdout, (SCENARIO.parents[1] / "REFERENCE.md").read_text())


if __name__ == "__main__":
    os.chdir(SCENARIO.parents[2])
    unittest.main(verbosity=2)
