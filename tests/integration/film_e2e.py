"""What a display shows is what a server said: it stands still when the server does, and can be recorded and shown again."""

import json
import signal
import unittest

from harness import EndToEnd, marked, wait_until


@marked("draws")
class Film(EndToEnd):
    def display(self, *arguments, size="320x180"):
        return self.start("display", "display", "--kiosk", "wall", "--language", "en", "--offscreen", "--size", size, "--quality", "high",
                          *arguments)

    def test_a_server_that_is_stopped_in_mid_turn_stops_the_picture(self):
        server = self.server(records=False)
        display = self.display("--out", self.folder / "pictures", "--screen-width", 1.2, "--viewer-distance", 2)
        visitor = self.visitor("wall", "--activity", "use")
        wait_until(lambda: "use: turn" in visitor.text(), 60, "the visitor turns the crank")
        moving = [self.picture(display) for _ in range(3)]
        self.assertEqual(len(set(moving)), 3, "while the crank turns, no picture is like another")
        server.process.send_signal(signal.SIGSTOP)
        # The calm word about the link comes two seconds later; the bounded extrapolation was over long before it.
        wait_until(lambda: {d["link"] for d in self.displays().values()} == {"lost"}, 30, "the display knows of no server")
        still = self.still_picture(display)
        self.assertEqual({self.picture(display) for _ in range(8)}, {still}, "and nothing in it moves any more")
        # A head that moves looks at the same moment from elsewhere, and back.
        head = self.start("head", "head", "--kiosk", "wall", "--at", 0.4, 0.1, 2)
        wait_until(lambda: self.picture(display) != still, 30, "the picture follows the head")
        self.assertEqual(head.stop(), 0, head.text())
        wait_until(lambda: self.picture(display) == still, 60, "without a tracker it is as before")
        server.process.send_signal(signal.SIGCONT)
        visitor.stop()  # its moves may be over by now; the next one's hand is seen to come
        self.visitor("wall", "--activity", "use")
        wait_until(lambda: self.picture(display) != still, 30, "it goes on with the server")
        self.assertIsNone(server.process.poll(), "it lives through what it slept over: " + server.text())
        self.assertEqual(display.stop(), 0, display.text())

    def test_a_visit_is_recorded_and_shown_again_without_a_server(self):
        server = self.server(records=False)
        file = self.folder / "visit.frames"
        recorder = self.start("recorder", "record", file, "--kiosk", "wall")
        wait_until(lambda: file.exists() and file.stat().st_size > 5000, 30, "the recorder hears of a world")
        visitor = self.visitor("wall", "--activity", "use")
        self.assertEqual(visitor.wait(120), 0, visitor.text())
        self.assertEqual(recorder.stop(), 0, recorder.text())
        server.kill()
        play = ("display", "--offscreen", "--size", "160x90", "--language", "en", "--play")
        steps = self.run_command(*play, file, "--every-step", "--out", self.folder / "steps")
        (visit,) = self.report_of(visitor)["activities"]
        wanted = {f"use-{step['name']}-mono.png" for step in visit["steps"]} | {"use-done-mono.png"}
        before = {"assemble-take-mono.png"}  # where the world stood until the visitor had come, if that took a while
        self.assertEqual({path.name for path in (self.folder / "steps").iterdir()} - before, wanted, steps.stdout + steps.stderr)
        shown = self.run_command(*play, file, "--film-fps", "5", "--play-from", "turn@0.4", "--seconds", "1", "--out", self.folder / "film")
        self.assertEqual(shown.returncode, 0, shown.stdout + shown.stderr)
        summary = json.loads(shown.stdout)
        self.assertEqual((len(summary["pictures"]), summary["missing_assets"]), (5, []))
        pictures = [(self.folder / f"film/film-{i:05}-mono.png").read_bytes() for i in range(1, 6)]
        self.assertEqual(len(set(pictures)), 5, "the crank turns")
        again = self.run_command(*play, file, "--film-fps", "5", "--play-from", "turn@0.4", "--frames", "1", "--out", self.folder / "again")
        self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
        self.assertEqual((self.folder / "again/film-00001-mono.png").read_bytes(), pictures[0], "to the same picture")
        last = self.run_command(*play, file, "--seconds", "1", "--out", self.folder / "last")
        self.assertEqual(json.loads(last.stdout)["pictures"], [str(self.folder / "last/last-mono.png")], last.stderr)
        # It ends by itself, and a killed display's recording is shown as far as it goes.
        (self.folder / "cut.frames").write_bytes(file.read_bytes()[:20_000])
        cut = self.run_command(*play, self.folder / "cut.frames", "--film-fps", "0.2")
        self.assertEqual(cut.returncode, 0, cut.stdout + cut.stderr)
        self.assertIn("is incomplete", cut.stderr)
        damaged = bytearray(file.read_bytes())
        damaged[3000] ^= 1
        (self.folder / "damaged.frames").write_bytes(damaged)
        for name, told in (("damaged.frames", "is damaged at byte"), ("visitor.frames", "does not exist"), ("recorder-2.log", "--record")):
            refused = self.run_command(*play, self.folder / name)
            self.assertEqual(refused.returncode, 1, refused.stdout)
            self.assertIn(told, refused.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
