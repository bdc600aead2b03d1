"""Whole visits over the network: what must turn the crank, what must not, and that a journal replays to the live hash."""

import json
import os
import subprocess
import time
import unittest

from harness import BIN, PATIENCE, ROOT, SCENARIO, EndToEnd, marked, repeat_until, wait_until


class Visit(EndToEnd):
    def test_two_kiosks_complete_both_activities_and_replay(self):
        server = self.server("--worlds", "2")
        visitors = [self.visitor("kiosk-1"), self.visitor("kiosk-2", "--direct")]
        for visitor in visitors:
            self.assertEqual(visitor.wait(150), 0, visitor.text())
            report = self.report_of(visitor)
            self.assertEqual([a["done"] for a in report["activities"]], [True, True])
            self.assertGreater(report["water_l"], 5)
            self.assertGreater(report["force_n"]["max"], 0.2)
            self.assertGreater(report["holding_ticks"], 1000)
        self.assertNotEqual(self.report_of(visitors[0])["world"], self.report_of(visitors[1])["world"])
        self.assertEqual(server.stop(), 0, server.text())
        journals = self.journals()
        self.assertEqual(len(journals), 2)
        for journal in journals:
            hashes = set()
            for _ in range(2):
                status, text = self.replay(journal)
                self.assertEqual(status, 0, text)
                hashes.add(self.hash_in(text))
            self.assertEqual(len(hashes), 1)

    def use_only(self, server_arguments=(), visitor_arguments=()):
        server = self.server(*server_arguments)
        visitor = self.visitor("kiosk-1", "--activity", "use", "--patience", "1", *visitor_arguments)
        visitor.wait(120)
        report = self.report_of(visitor)
        server.stop()
        return report

    def assert_nothing_turned(self, report):
        self.assertFalse(report["activities"][0]["done"])
        self.assertEqual(report["water_l"], 0)
        self.assertAlmostEqual(report["quantities"].get("turns", 0), 0, delta=0.01)

    def test_five_centimetres_beside_the_handle_nothing_turns(self):
        # Half the handle's length and 5 cm more along the axis: in the circle's plane the hand would meet the handle after a turn.
        report = self.use_only(visitor_arguments=("--offset", "0.0918", "0.0692", "0"))
        self.assert_nothing_turned(report)
        self.assertEqual(report["holding_ticks"], 0)

    def test_without_stiffness_nothing_turns(self):
        self.assert_nothing_turned(self.use_only(server_arguments=("--stiffness-scale", "0")))

    @marked("address")
    def test_the_examples_of_the_client_library_run(self):
        self.server("--worlds", "3")
        for example, expected in (("watch_quantities", "basin"), ("push_a_body", "forces"), ("turn_the_crank", "was held")):
            result = subprocess.run([str(BIN / example), "--kiosk", example.replace("_", "-"), "--seconds", "4"],
                                    capture_output=True, text=True, timeout=60 * PATIENCE, env=self.environment)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertIn(expected, result.stdout)

    @marked("address")
    def test_echo_prints_a_topic_as_json(self):
        self.server()
        result = self.run_command("echo", "ServerStatus", "--count", "1", "--seconds", "10", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(json.loads(result.stdout.splitlines()[0])["server"], "server-1")
        # Of a kiosk: that of its world, and nobody else's; where there is none, silence is told and is a failure.
        wall = self.start("wall", "haptic", "--device", "virtual", "--kiosk", "wall")
        result = self.run_command("echo", "WorldStatus", "--kiosk", "wall", "--count", "1", "--seconds", "10", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(json.loads(result.stdout)["scenario"], "archimedes-screw")
        wall.stop()
        result = self.run_command("echo", "WorldStatus", "--kiosk", "nobody", "--seconds", "4")
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn("nothing yet: no kiosk nobody", result.stderr)

    def scenario_of(self, kiosk):
        result = self.run_command("echo", "WorldStatus", "--kiosk", kiosk, "--count", "1", "--seconds", "10", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)["scenario"]

    @marked("address")
    def test_a_sign_opens_another_exhibit_and_home_brings_back(self):
        scenarios = [ROOT / "scenarios/village/village.x3d", SCENARIO]
        server = self.server(scenario=scenarios)
        # A second hand at the kiosk goes along with the one that touches the sign.
        beside = self.start("beside", "haptic", "--device", "virtual", "--kiosk", "kiosk-1", "--user", "1")
        wait_until(lambda: "world-1" in server.text(), 20, "the kiosk has a world")
        report = self.folder / "choose.json"
        visit = self.run_command("visitor", "--kiosk", "kiosk-1", "--scenario", scenarios[0], "--activity", "choose", "--report", report)
        self.assertEqual(visit.returncode, 0, visit.stdout + visit.stderr)
        (choice,) = json.loads(report.read_text())["activities"]
        self.assertEqual((choice["done"], choice["gone_on_to"]), (True, "archimedes-screw"))
        self.assertEqual(choice["steps"][-1]["name"], "to-archimedes-screw")
        self.assertEqual(self.scenario_of("kiosk-1"), "archimedes-screw")
        self.assertTrue(beside.running(), beside.text())
        # A server that starts anew puts the kiosk where it was, not where it began.
        wait_until(lambda: list((self.folder / "records").glob("world-2*.snapshot")), 10, "a snapshot of the new world was taken")
        server.kill()
        server = self.server(scenario=scenarios)
        wait_until(lambda: "resumed kiosk-1" in server.text(), 20, "the visit is taken up again")
        self.assertEqual(self.scenario_of("kiosk-1"), "archimedes-screw")
        for kiosk, request, status, answer in (("kiosk-1", (), 0, "kiosk-1 is at village"),
                                            ("kiosk-1", ("archimedes-screw",), 0, "kiosk-1 is at archimedes-screw"),
                                            ("kiosk-1", ("archimedes",), 1, "name one of: village, archimedes-screw"),
                                            ("kiosk-2", (), 1, "name one of: kiosk-1")):
            result = self.run_command("open", "--kiosk", kiosk, *request)
            self.assertEqual(result.returncode, status, result.stdout + result.stderr)
            self.assertIn(answer, result.stdout + result.stderr)
        # A server that no longer has the exhibit brings the kiosk home; what nobody has been in stays an error.
        server.kill()
        server = self.server(scenario=scenarios[0])
        wait_until(lambda: "kiosk-1 was in 'archimedes-screw', which this server does not have" in server.text(), 20, "the kiosk goes home")
        self.assertEqual(self.scenario_of("kiosk-1"), "village")
        lost = self.visitor("kiosk-3")
        wait_until(lambda: "this server has no scenario 'archimedes-screw'" in server.text(), 20, "a request for what is not there is refused")
        lost.stop()
        self.assertEqual(server.stop(), 0, server.text())

    def test_a_sign_that_leads_nowhere_is_named_at_once(self):
        village = ROOT / "scenarios/village/village.x3d"
        self.server(scenario=village)
        file = self.folder / "village.json"
        began = time.monotonic()
        result = self.run_command("visitor", "--scenario", village, "--kiosk", "kiosk-1", "--patience", "200", "--report", file, limit_s=190)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertLess(time.monotonic() - began, 150 * PATIENCE, "it waited for what cannot come")
        activity = json.loads(file.read_text())["activities"][0]
        self.assertEqual(activity["reason"], "visit pointing, step to-archimedes-screw: it opens 'archimedes-screw', which this "
                                             "server does not have")
        self.assertIn(activity["reason"], result.stdout)

    def test_a_visitor_says_what_it_waits_for_once_its_moves_are_over(self):
        self.server()
        file = self.folder / "missed.json"
        result = self.run_command("visitor", "--scenario", SCENARIO, "--kiosk", "kiosk-1", "--activity", "use", "--offset", "0", "0.5", "0",
                                  "--patience", "1", "--report", file, limit_s=120)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertRegex(result.stdout, r"use: visit turning, step \w+: all moves made; waiting up to 1 s for the step to be done")
        self.assertRegex(json.loads(file.read_text())["activities"][0]["reason"], r"visit turning, step \w+: it was not done in time")

    @marked("draws")
    def test_a_click_on_a_sign_opens_its_exhibit_and_the_key_home_leads_back(self):
        server = self.server(scenario=[ROOT / "scenarios/village/village.x3d", SCENARIO], records=False)
        with self.screen("640x360") as environment:
            window = self.start("window", "display", "--kiosk", "wall", "--size", "640x360", environment=environment)

            def opened(scenario, *action):
                """Clicks, or presses, until the last world that was opened is of this scenario."""
                last = lambda: [line for line in server.text().splitlines() if "opened for wall" in line][-1].endswith(scenario)
                repeat_until(lambda: subprocess.run(["xdotool", *action], env=environment, stderr=subprocess.DEVNULL), last, 60,
                             f"{action} opens {scenario}")

            wait_until(lambda: "opened for wall: village" in server.text(), 20, "the display has its world")
            sign = ("mousemove", "256", "168", "click", "1")  # the screw's, from where the display looks
            opened("archimedes-screw", *sign)
            opened("village", "key", "Home")
            opened("archimedes-screw", *sign)
            opened("village", "mousemove", "540", "325", "click", "1")  # the button with the house
            self.assertEqual(window.stop(), 0, window.text())

    def test_a_kiosk_without_a_name_is_refused_before_the_network_is_asked(self):
        result = self.run_command("open", "--kiosk", "", limit_s=5)
        self.assertEqual(result.returncode, 2)
        self.assertIn("the kiosk's name is empty", result.stderr)

    @marked("address")
    def test_who_opens_where_nobody_is_hears_whether_a_server_is_there(self):
        result = self.run_command("open", "archimedes-screw", "--kiosk", "kiosk-9")
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn("kiosk-9: no server answered; start one with 'mechane server'", result.stderr)
        self.server(records=False)
        result = self.run_command("open", "archimedes-screw", "--kiosk", "kiosk-9")
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn("no display and no device has joined any kiosk", result.stderr)
        self.assertIn("start 'mechane display --kiosk kiosk-9' first", result.stderr)

    @marked("address")
    def test_a_visit_that_is_not_there_is_answered_with_the_list_of_visits(self):
        result = self.run_command("visitor", "--scenario", SCENARIO, "--visit", "nobodys", limit_s=10)
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stdout + result.stderr, r"nobodys.*\bassembling\b.*\bturning\b")

    def test_wrong_arguments_end_with_one_status(self):
        for command in (("visitor", "--kios", "a"), ("fit",), ("echo", "--count", "x"), ("haptic", "--device"), ("replay", "--fast", "x"),
                        ("display", "--what"), ("server", "--what"), ("check",)):
            result = self.run_command(*command)
            self.assertEqual(result.returncode, 2, (command, result.stdout + result.stderr))
            self.assertNotEqual(result.stderr, "", command)

    def test_a_whole_hand_completes_the_use(self):
        report = self.use_only(visitor_arguments=("--glove",))
        self.assertTrue(report["activities"][0]["done"], report)

    def test_a_mouse_before_a_picture_assembles_the_screw(self):
        self.server()
        visitor = self.visitor("kiosk-1", "--activity", "assemble", "--device", "pointer")
        self.assertEqual(visitor.wait(120), 0, visitor.text())
        self.assertTrue(self.report_of(visitor)["activities"][0]["done"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
