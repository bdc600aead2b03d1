"""Records of visits, from a scripted visitor's hand to `mechane visits`: what was done, what a kill and a full disk cost."""

import csv
import io
import itertools
import json
import math
import re
import sqlite3
import struct
import subprocess
import unittest

from browser import Frame, Page
from harness import PATIENCE, ROOT, SCENARIO, EndToEnd, marked, repeat_until, wait_until

VILLAGE = ROOT / "scenarios/village/village.x3d"


class Visits(EndToEnd):
    def visits(self, *arguments):
        result = self.run_command("visits", "--records", self.folder / "records", *arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def records(self):
        return self.visits("list", "--last", "0")

    def steps_of(self, record):
        return [(step["step"], step["ending"]) for step in record["steps"]]

    def test_what_a_visitor_does_is_in_the_records_while_the_server_runs_and_after(self):
        server = self.server()
        visitor = self.visitor("kiosk-1")
        self.assertEqual(visitor.wait(150), 0, visitor.text())
        done = lambda: [s for s in self.records() if s["ending"] == "done"]
        wait_until(lambda: len(done()) == 2, 10, "both activities are in their records")
        self.assertEqual(server.stop(), 0, server.text())
        records = {record["activity"]: record for record in self.records()}
        self.assertEqual(set(records), {"assemble", "use"})
        self.assertEqual(self.steps_of(records["assemble"]), [("take", "done"), ("seat", "done")])
        self.assertEqual(self.steps_of(records["use"]), [("grasp", "done"), ("turn", "done"), ("fill", "done")])
        # The visitor timed each step with its own clock, from news to news; news are late where a sanitizer makes all slow.
        for activity in self.report_of(visitor)["activities"]:
            record = records[activity["name"]]
            self.assertEqual([s["step"] for s in record["steps"]], [s["name"] for s in activity["steps"]])
            for step, seen in zip(record["steps"], activity["steps"]):
                self.assertAlmostEqual(step["duration_s"], seen["seconds"], delta=PATIENCE, msg=step["step"])
            self.assertAlmostEqual(sum(step["duration_s"] for step in record["steps"]), record["duration_s"], delta=0.01)
            self.assertEqual((record["kiosk"], record["scenario"], record["hands"]), ("kiosk-1", "archimedes-screw", 1))
            # On a slow machine a step takes longer than its hint waits (20 s); the record then says that the visitor had help.
            alone = all(step["duration_s"] < 20 for step in record["steps"])
            self.assertEqual((record["mistakes"], record["done_alone"], record["notes_lost"]), ([], alone, 0))
        report = self.visits()
        self.assertEqual([(a["activity"], a["visits"], a["done"]) for a in report["activities"]], [("assemble", 1, 1), ("use", 1, 1)])
        self.assert_nobody_is_in_the_file()

    def assert_nobody_is_in_the_file(self):
        """No table has more than the record, and no session, host or pose got in by another name."""
        with sqlite3.connect(self.folder / "records/visits.db") as file:
            columns = {table: [c[1] for c in file.execute(f"PRAGMA table_info({table})")]
                       for (table,) in file.execute("SELECT name FROM sqlite_schema WHERE type = 'table'")}
            self.assertEqual(set(columns), {"visit", "step", "mistake", "answer", "remark"})
            (minute,) = file.execute("SELECT max(minute) FROM visit").fetchone()
        self.assertLess(minute, 10_000_000_000 // 60, "the minute, not the second")

    @marked("address")
    def test_an_observer_remarks_and_forgets_while_the_server_runs(self):
        self.server()
        visitor = self.visitor("kiosk-1", "--activity", "assemble")
        self.assertEqual(visitor.wait(120), 0, visitor.text())
        wait_until(lambda: [s["ending"] for s in self.records()] == ["done"], 10, "the record is there")
        records = ("--records", self.folder / "records")
        number = self.records()[0]["visit"]
        result = self.run_command("visits", "remark", number[:6], "went straight for it", *records)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.records()[0]["remarks"][0]["text"], "went straight for it")
        self.the_console_shows_it_and_remarks(number)
        result = self.run_command("visits", "forget", number, *records)
        self.assertEqual((result.returncode, result.stdout), (0, "1 visit forgotten\n"), result.stderr)
        self.assertEqual(self.records(), [])

    def the_console_shows_it_and_remarks(self, number):
        records, state = self.folder / "records", self.folder / "gateway"
        gateway = self.start("gateway", "gateway", "--listen", "127.0.0.1:0", "--state", state, "--records", records,
                             "--scenarios", ROOT / "scenarios")
        wait_until(lambda: "\nready" in gateway.text() or not gateway.running(), 60, "the gateway is ready")
        page = Page(int(re.search(r"console: http://[^:]+:(\d+)/", gateway.text()).group(1)))
        self.assertEqual(page.get("/api/visits")[0], 401)
        self.assertEqual(page.sign_in("operator", re.search(r"operator (\S+)", gateway.text()).group(1))[0], 200)
        figures = json.loads(page.get("/api/visits?days=1&exhibit=archimedes-screw")[2])
        (activity,) = figures["activities"]
        self.assertEqual((activity["activity"], activity["done"], activity["doneAlone"]), ("assemble", 1, 1))
        self.assertEqual([(s["step"], s["visits"], s["left"], s["time"]["count"]) for s in activity["steps"]],
                         [("take", 1, 0, 1), ("seat", 1, 0, 1)])
        self.assertEqual(sum(day["visits"] for day in figures["perDay"]), 1)
        self.assertEqual(json.loads(page.get("/api/visits?exhibit=pump")[2])["visits"], 0)

        # An author remarks; a visitor may not; what is no visit, or no remark, is refused.
        other, remarks = Page(page.port), f"/api/visits/{number}/remarks"
        for role, kept in (("visitor", 403), ("author", 200)):
            self.assertEqual(page.post("/api/accounts", {"user": "eva", "role": role, "password": "a long password"})[0], 200)
            self.assertEqual(other.sign_in("eva", "a long password")[0], 200)
            self.assertEqual(other.post(remarks, {"text": "=asked, \"why?\"", "at": 12.5})[0], kept)
            self.assertEqual(other.get("/api/visits.csv")[0], kept)
        for path, body, status in (("/api/visits/0000-0000-0000/remarks", {"text": "x"}, 404), (remarks, {"text": ""}, 400),
                                   ("/api/visits/..%2f..%2fetc%2fx/remarks", {"text": "x"}, 404), (remarks, {"text": "x" * 2001}, 413),
                                   ("/api/visits/remarks", {"text": "x"}, 404), (remarks, {"text": "x", "at": -1}, 400)):
            self.assertEqual(page.post(path, body)[0], status, (path, body))
        told = json.loads(page.get("/api/visits")[2])["recent"][0]["remarks"]
        self.assertEqual([(r["author"], r["text"], r.get("at")) for r in told],
                         [("", "went straight for it", None), ("eva", "=asked, \"why?\"", 12.5)])
        status, headers, text = page.get("/api/visits.csv?days=1")
        self.assertEqual((status, headers["content-disposition"]), (200, 'attachment; filename="visits.csv"'))
        head, line = csv.reader(io.StringIO(text.decode(), newline=""))
        self.assertEqual(dict(zip(head, line))["remarks"], "went straight for it\neva, at 12 s: =asked, \"why?\"")
        shown = self.visits("show", number, "--remarks", state / "remarks.json")
        self.assertEqual(shown[0]["remarks"][1]["author"], "eva")
        self.assertNotIn("asked", (state / "audit.log").read_text(), "the audit log keeps no words about a visit")
        for wrong in ("days=0", "days=x", "days=99999", "exhibit=" + "x" * 200):
            self.assertEqual(page.get("/api/visits?" + wrong)[0], 400, wrong)
        self.a_page_plays_it_back(page, number)
        self.assertEqual(gateway.stop(), 0, gateway.text())

    def a_page_plays_it_back(self, page, number):
        self.assertEqual(page.get(f"/api/visits/{number}/tape")[0], 404, "nobody has asked for it")
        for wrong in ("0000-0000-0000", "..%2f..%2fetc%2fx", number[:4], "-" * 14):
            self.assertEqual(page.post(f"/api/visits/{wrong}/playback", {})[0], 404, wrong)
        self.assertEqual(page.post(f"/api/visits/{number}/playback", {})[0], 200)
        state = lambda: json.loads(page.get(f"/api/visits/{number}/playback")[2])
        wait_until(lambda: state()["state"] != "preparing", 60, "the visit was shown again")
        self.assertEqual((state()["state"], state()["trouble"], state()["visit"]["visit"]), ("ready", "", number))
        tape, at, texts, frames = page.get(f"/api/visits/{number}/tape")[2], 0, [], []
        while at < len(tape):
            kind, size = struct.unpack_from("<II", tape, at)
            part = tape[at + 8:at + 8 + size]
            texts += [json.loads(part)] if kind == 1 else []
            frames += [Frame(part)] if kind == 2 else []
            at += 8 + (size + 3) // 4 * 4
        self.assertEqual([step for step, _ in itertools.groupby(t["step"] for t in texts if t["type"] == "world")][:2], ["take", "seat"])
        self.assertEqual({t["type"] for t in texts}, {"world", "scene", "presentation"})
        record = self.visits("show", number)[0]
        self.assertAlmostEqual((frames[-1].tick - frames[0].tick) / 1000, record["duration_s"] + 1.5, delta=1)
        self.assertGreater(len(frames), 5 * record["duration_s"], "frames a second")
        moved = [b for b, (_, pose) in frames[0].bodies.items() if math.dist(pose[:3], frames[-1].bodies[b][1][:3]) > 0.05]
        self.assertTrue(moved, "a part was carried to its place")
        self.assertTrue(any(hand["holding"] for frame in frames for hand in frame.hands), "by the visitor's hand")

    @marked("address")
    def test_a_killed_server_loses_the_step_at_hand_at_most_and_the_visit_goes_on(self):
        server = self.server()
        visitor = self.visitor("kiosk-1", "--activity", "use", "--endless", "--patience", "30")
        filling = lambda: any(self.steps_of(s)[-1:] == [("fill", "unfinished")] for s in self.records()) if self.database() else False
        wait_until(filling, 60, "the visit has come to its last step")
        # The snapshot from which the world goes on must be of that step too.
        taken = {f: f.stat().st_mtime_ns for f in (self.folder / "records").glob("*.snapshot")}
        wait_until(lambda: any(f.stat().st_mtime_ns != taken.get(f) for f in (self.folder / "records").glob("*.snapshot")), 10,
                   "a snapshot was taken since")
        server.kill()
        (cut,) = self.records()
        self.assertEqual(self.steps_of(cut), [("grasp", "done"), ("turn", "done"), ("fill", "unfinished")])
        self.assertEqual(cut["ending"], "running")
        again = self.server()
        wait_until(lambda: "resumed kiosk-1" in again.text(), 30, "the world is resumed")
        wait_until(lambda: self.records()[0]["ending"] == "running", 10, "the record is taken up")
        (record,) = self.records()
        self.assertEqual(record["visit"], cut["visit"])
        self.assertEqual(self.steps_of(record)[:2], self.steps_of(cut)[:2])
        visitor.kill()
        self.assertEqual(again.stop(), 0, again.text())
        self.assertEqual([s["visit"] for s in self.records()], [cut["visit"]])
        self.assertEqual(self.records()[0]["ending"], "cut", "the server stopped; that says nothing about the visitor")

    def database(self):
        return (self.folder / "records/visits.db").exists()

    # In a user namespace the server's loop may have no real-time rights: what runs beside it would spoil the visits.
    @marked("alone", "address")
    def test_a_full_disk_costs_records_and_not_the_visit(self):
        server = self.server(prefix=self.full_disk(self.folder / "records"))
        visitors = [self.visitor("kiosk-1", "--activity", "assemble"), self.visitor("kiosk-2", "--activity", "assemble")]
        for visitor in visitors:
            self.assertEqual(visitor.wait(150), 0, visitor.text())
        text = server.text()
        self.assertRegex(text, r"visits are not being recorded: .*visits\.db.*(disk|room)")
        # A world that ends gives back the room of its snapshot: then the trouble may be over.
        troubles, ends = (text.count(f"visits are {what}") for what in ("not being recorded", "being recorded again"))
        self.assertIn(troubles - ends, (0, 1), "once when it begins, once when it is over")
        self.assertEqual(server.stop(), 0, server.text())

    @marked("address")
    def test_a_damaged_file_is_set_aside_and_a_new_one_begun(self):
        (self.folder / "records").mkdir()
        (self.folder / "records/visits.db").write_bytes(b"no database " * 1000)
        server = self.server()
        self.assertIn("a new one was begun", server.text())
        self.assertEqual(self.records(), [])
        self.assertEqual(len(list((self.folder / "records").glob("visits.db.damaged-*"))), 1)
        self.assertEqual(server.stop(), 0, server.text())

    def test_a_sign_that_leads_on_is_a_visit_done(self):
        server = self.server(scenario=[VILLAGE, SCENARIO])
        visit = self.run_command("visitor", "--kiosk", "kiosk-1", "--scenario", VILLAGE, "--activity", "choose")
        self.assertEqual(visit.returncode, 0, visit.stdout + visit.stderr)
        wait_until(lambda: [(s["scenario"], s["ending"], s["went_on_to"]) for s in self.records()]
                   == [("village", "done", "archimedes-screw")], 10, "the record says where the sign led")
        self.assertEqual(server.stop(), 0, server.text())

    def test_none_are_kept_where_none_are_wanted(self):
        server = self.server("--visits", "none")
        visitor = self.visitor("kiosk-1", "--activity", "assemble")
        self.assertEqual(visitor.wait(120), 0, visitor.text())
        self.assertEqual(server.stop(), 0, server.text())
        self.assertFalse(self.database())
        result = self.run_command("visits", "--records", self.folder / "records")
        self.assertEqual(result.returncode, 1)
        self.assertIn("there is no file of visits", result.stderr)

    @marked("draws")
    def test_an_answer_given_by_a_click_is_in_the_record(self):
        self.server(scenario=VILLAGE)
        with self.screen("640x360") as environment:
            window = self.start("window", "display", "--kiosk", "wall", "--size", "640x360", "--ask", "both", "--language", "en",
                                environment=environment)
            answers = lambda: {a["question"]: a for record in self.records() for a in record["answers"]}
            places = itertools.cycle(range(330, 20, -15))

            def click():
                # The first click tells that somebody is there; then answers lie in the picture's middle column, and nothing else does.
                for _ in range(2):
                    subprocess.run(["xdotool", "mousemove", "320", str(next(places)), "click", "1"], env=environment, stderr=subprocess.DEVNULL)

            repeat_until(click, lambda: len(answers()) == 2, 120, "clicks answer both questions", again_s=0.6)
            self.assertEqual(window.stop(), 0, window.text())
        given = answers()
        self.assertEqual({a["asked"] for a in given.values()}, {"before"})
        self.assertIn(given["water"]["answer"], ("screw", "crane", "odometer"))
        self.assertEqual(given["clear"]["mark"], 3, "of five, the one in the middle")


if __name__ == "__main__":
    unittest.main(verbosity=2)
