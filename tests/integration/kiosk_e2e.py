"""A kiosk's life: displays tell how they are and take requests from afar, several show one world, links delay and lose."""

import contextlib
import json
import pathlib
import re
import signal
import subprocess
import sys
import time
import unittest

from harness import BIN, PATIENCE, ROOT, SCENARIO, EndToEnd, marked, wait_until

LINK = pathlib.Path(__file__).with_name("impaired_link.py")


class Link:
    """A router between two networks; see impaired_link.py."""

    def __init__(self, **settings):
        self.process = subprocess.Popen(["unshare", "--map-root-user", "--net", sys.executable, "-B", str(LINK)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)
        ends = self.process.stdout.readline()
        if not ends:
            self.close()
            raise unittest.SkipTest("no networks of one's own can be made here (unshare)")
        ends = json.loads(ends)
        self.server, self.client = (["nsenter", "--user", "--net", "--preserve-credentials", "--target", str(ends[end])]
                                    for end in ("server", "client"))
        self.set(**settings)

    def set(self, **settings):
        for name, value in settings.items():
            self.process.stdin.write(f"{name} {value}\n")
        self.process.stdin.flush()

    def close(self):
        with contextlib.suppress(OSError):
            self.process.stdin.close()
        self.process.wait(timeout=20)
        self.process.stdout.close()


@marked("draws")
class Kiosk(EndToEnd):
    def display(self, *arguments, name="wall", prefix=(), environment=None):
        return self.start(name, "display", "--offscreen", "--kiosk", "kiosk-1", "--name", name, "--size", "160x90", "--fps", "10",
                          *arguments, prefix=prefix, environment=environment)

    def wait_for_displays(self, wanted, limit_s, what):
        told = {}

        def look():
            told.clear()
            told.update(self.displays())
            return wanted(told)

        try:
            wait_until(look, limit_s, what)
        except AssertionError as error:
            raise AssertionError(f"{error}; told was {json.dumps(told, indent=1)}") from None
        return told

    def test_two_displays_of_a_kiosk_show_one_world_and_do_as_they_are_told(self):
        displays = [self.display("--out", self.folder / "wall"), self.display(name="bystanders")]
        # Before any server: a calm picture, and no end.
        told = self.wait_for_displays(lambda told: len(told) == 2 and all(d["pictures"] > 1 for d in told.values()), 30, "both draw")
        self.assertEqual({d["link"] for d in told.values()}, {"searching"})
        self.assertIn("it is looking for a server", told["wall"]["remarks"][0])
        server = self.server(records=False)
        joined = lambda told: len(told) == 2 and all(d["link"] == "joined" and d["frames_per_s"] > 10 for d in told.values())
        told = self.wait_for_displays(joined, 30, "both have joined")
        self.assertEqual({d["world"] for d in told.values()}, {"world-1"})
        self.assertEqual({d["scenario"] for d in told.values()}, {"archimedes-screw"})
        self.assertEqual({d["missing_total"] for d in told.values()}, {0})

        def command(*words, status=0):
            result = self.run_command("displays", *words)
            self.assertEqual(result.returncode, status, result.stdout + result.stderr)
            return result.stdout + result.stderr

        self.assertEqual(command("set", "--kiosk", "kiosk-1", "--display", "wall", "volume=0.25", "language=en", "large-text=on"),
                         "kiosk-1/wall: done\n")
        self.assertRegex(command("set", "--kiosk", "kiosk-1", "ask=none"), "bystanders: done\nkiosk-1/wall: done")
        settings = {name: display["settings"] for name, display in self.displays().items()}
        self.assertEqual([settings["wall"][s] for s in ("volume", "language", "large-text", "ask")], ["0.25", "en", "on", "none"])
        self.assertEqual([settings["bystanders"][s] for s in ("volume", "language", "large-text", "ask")], ["0.8", "el", "off", "none"])
        self.assertIn("volume=... with 0 to 1", command("set", "--kiosk", "kiosk-1", "volume=7", status=2))
        self.assertIn("name one of: kiosk-1/bystanders, kiosk-1/wall", command("set", "--kiosk", "kiosk-2", "mute=on", status=1))
        pictures = command("picture", "--kiosk", "kiosk-1", status=1)
        self.assertIn("bystanders: refused: this display has no folder for pictures: start it with --out", pictures)
        (file,) = (line.split(":")[-1] for line in pictures.splitlines() if line.startswith("kiosk-1/wall"))
        before = pathlib.Path(file).read_bytes()
        self.assertEqual(before[:4], b"\x89PNG")
        # A picture of a display before stays.
        taken_for = pathlib.Path(file.replace("-001-", "-002-"))
        taken_for.write_text("of another display")
        self.assertIn("-003-", command("picture", "--kiosk", "kiosk-1", "--display", "wall"))
        self.assertEqual((taken_for.read_text(), pathlib.Path(file).read_bytes()), ("of another display", before))
        table = command()
        self.assertRegex(table, r"kiosk-1/wall +joined +archimedes-screw +160x90 ")
        self.assertIn("kiosk-1/wall: it draws on the processor (llvmpipe", table)

        # The server goes and comes: the picture stays, and both are back by themselves.
        server.kill()
        told = self.wait_for_displays(lambda told: {d["link"] for d in told.values()} == {"lost"}, 20, "the loss is told")
        drawn = {name: display["pictures"] for name, display in told.items()}
        self.server(records=False)
        self.wait_for_displays(lambda told: joined(told) and all(told[n]["pictures"] > drawn[n] for n in drawn), 30, "both are back")
        self.assertNotIn("error", displays[0].text() + displays[1].text())
        displays[1].kill()
        self.wait_for_displays(lambda told: set(told) == {"wall"}, 20, "one that was killed is not listed any more")
        self.assertEqual(command("restart", "--kiosk", "kiosk-1"), "kiosk-1/wall: done\n")
        self.assertEqual(displays[0].wait(20), 0, "it ends without an error, for its service to start it again")

    def test_what_is_set_from_afar_is_seen(self):
        server = self.server(records=False)
        self.display("--out", self.folder / "out", "--quality", "high")
        self.wait_for_displays(lambda told: told and told["wall"]["link"] == "joined" and told["wall"]["missing_total"] == 0, 30, "it has joined")
        # In a world that stands still, only a setting changes a picture.
        server.process.send_signal(signal.SIGSTOP)
        self.wait_for_displays(lambda told: told and told["wall"]["link"] == "lost", 30, "the display knows of no server")

        def command(*words):
            result = self.run_command("displays", *words, "--kiosk", "kiosk-1")
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            return result.stdout

        def picture():
            return pathlib.Path(command("picture").strip().split(":")[-1].strip()).read_bytes()

        def still():
            """Larger words make room for themselves, and then it stands still."""
            last, since = picture(), time.monotonic()
            while time.monotonic() - since < 2:
                newer = picture()
                if newer != last:
                    last, since = newer, time.monotonic()
            return last
        seen = [still()]
        for setting in ("language=en", "large-text=on", "high-contrast=on"):
            self.assertEqual(command("set", setting), "kiosk-1/wall: done\n")
            seen.append(still())
            self.assertFalse(seen[-1] == seen[-2], f"{setting} is not seen")
        server.process.send_signal(signal.SIGCONT)

    def test_a_kiosk_that_nobody_touches_goes_home(self):
        scenarios = [ROOT / "scenarios/village/village.x3d", SCENARIO]
        server = self.server("--worlds", "2", scenario=scenarios, records=False)
        left = self.display("--home-after", "6")
        kept = self.start("kept", "display", "--offscreen", "--kiosk", "kiosk-2", "--name", "kept", "--size", "160x90", "--fps", "10")
        opened = lambda kiosk: re.findall(rf"opened for {kiosk}: (\S+)", server.text())
        for kiosk in ("kiosk-2", "kiosk-1"):
            wait_until(lambda: opened(kiosk) == ["village"], 30, f"{kiosk} has a world")
            began = time.monotonic()
            result = self.run_command("open", "archimedes-screw", "--kiosk", kiosk)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        wait_until(lambda: opened("kiosk-1") == ["village", "archimedes-screw", "village"], 40, "nobody is there: it is at home")
        self.assertGreater(time.monotonic() - began, 5.5, "who looks for a moment is not sent home")
        self.wait_for_displays(lambda told: told["wall"]["scenario"] == "village", 20, "and so is its picture")
        self.assertEqual(opened("kiosk-2"), ["village", "archimedes-screw"], "without the option it stays")
        for display in (left, kept):
            self.assertEqual(display.stop(), 0, display.text())

    def test_without_a_picture_for_each_eye_it_shows_one_for_both_and_says_so(self):
        with self.screen("320x240") as environment:
            for place, arguments in (("offscreen", ("--offscreen",)), ("window", ())):
                out = self.folder / place
                display = self.start(place, "display", *arguments, "--stereo", "quad", "--frames", "1", "--size", "160x90", "--mute", "--out", out,
                                     environment=environment)
                self.assertEqual(display.wait(60), 0, display.text())
                self.assertIn("a picture for each eye (quad-buffered stereo), so it shows a mono picture: try --stereo sbs", display.text())
                self.assertEqual([file.name for file in out.iterdir()], ["frame-mono.png"])

    def test_what_a_display_lacks_is_told_and_it_goes_on(self):
        self.server(records=False)
        out = self.folder / "out"
        display = self.display("--assets", self.folder, "--out", out)
        told = self.wait_for_displays(lambda told: told and told["wall"]["missing_total"] > 0, 40, "the missing model is told")["wall"]
        self.assertIn("archimedes-screw.glb", told["missing"][0])
        self.assertTrue(any("1 file is missing, a plain box stands in its place" in remark for remark in told["remarks"]), told["remarks"])
        self.assertRegex(told["last_warning"], "archimedes-screw.glb.*a plain box is shown")
        # A folder that is gone costs the picture alone.
        out.rmdir()
        result = self.run_command("displays", "picture", "--kiosk", "kiosk-1")
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn("wall: refused: ", result.stderr)
        self.assertGreater(self.displays()["wall"]["pictures"], told["pictures"])
        self.assertTrue(display.running(), display.text())

    def test_while_nobody_is_there_a_recorded_visit_invites_until_a_hand_moves(self):
        self.server(records=False)
        film = self.folder / "visit.seen"
        recorder = self.display("--record", film, name="recorder")
        visit = ("visitor", "--kiosk", "kiosk-1", "--scenario", SCENARIO, "--activity", "use", "--endless")
        first = self.start("first", *visit)
        wait_until(lambda: "use: turn" in first.text(), 60, "somebody turns the crank")
        wait_until(lambda: film.exists() and film.stat().st_size > 8_000, 60, "and is recorded")
        self.assertEqual(recorder.stop(), 0, recorder.text())
        first.stop()
        wall = self.display("--attract", film, "--attract-after", "5", "--out", self.folder / "out")
        showing = lambda what: lambda told: told and told["wall"]["showing"] == what
        told = self.wait_for_displays(showing("attract"), 40, "nobody is there")["wall"]
        self.assertEqual((told["link"], told["missing_total"]), ("joined", 0))
        result = self.run_command("displays", "picture", "--kiosk", "kiosk-1")
        self.assertEqual(result.returncode, 0, result.stderr)
        # The world behind it has felt nothing: the recorded hand is only seen.
        frame = json.loads(self.run_command("echo", "SceneFrame", "--kiosk", "kiosk-1", "--count", "1", "--json").stdout)
        self.assertEqual([hand["holding"] for hand in frame["hands"]], [])
        second = self.start("second", *visit)
        self.wait_for_displays(showing("world"), 30, "somebody came")
        second.stop()
        self.wait_for_displays(showing("attract"), 40, "and went")
        self.run_command("displays", "set", "--kiosk", "kiosk-1", "attract=off")
        self.wait_for_displays(showing("world"), 10, "it is switched off from afar")
        self.assertEqual(wall.stop(), 0, wall.text())

    def test_who_comes_to_the_window_ends_the_invitation(self):
        self.server(records=False)
        film = ROOT / "tests/golden/scenes/archimedes-screw.frames"
        showing = lambda what: lambda told: told and told["wall"]["showing"] == what
        with self.screen("160x120") as environment:
            for arguments, ways in (((), (("mousemove", "40", "30"), ("key", "space"), ("key", "c"))),
                                    (("--no-touch",), (("mousemove", "50", "40", "click", "1"), ("key", "c")))):
                wall = self.start("wall", "display", "--kiosk", "kiosk-1", "--name", "wall", "--size", "160x120", "--mute", "--attract", film,
                                  "--attract-after", "8", *arguments, environment=environment)
                for way in ways:
                    self.wait_for_displays(showing("attract"), 40, f"nobody is there, before {way}")
                    subprocess.run(["xdotool", *way], env=environment, stderr=subprocess.DEVNULL, check=True)
                    self.wait_for_displays(showing("world"), 7, f"{way} means that somebody came")
                self.assertEqual(wall.stop(), 0, wall.text())

    def test_wrong_arguments_of_a_display_say_what_is_right(self):
        film = self.folder / "visit.seen"
        film.write_text("a recorded visit")
        other_name = self.folder / "other.seen"
        other_name.symlink_to(film)
        for arguments, said in (
                (("--play", film, "--record", film), "this is the file of --play"),
                (("--attract", film, "--record", other_name), "this is the file of --attract"),
                (("--stereo", "side-by-side"), "side-by-side not in {mono,sbs,top-bottom,sbs-squeezed,top-bottom-squeezed,anaglyph,rows,quad,left,right}"),
                (("--ask", "wrong"), "wrong not in {none,after,both}"),
                (("--screen-width", "1.2"), "--screen-width requires --viewer-distance"),
                (("--viewer-distance", "2"), "--viewer-distance requires --screen-width"),
                (("--right-eye-first",), "--right-eye-first requires --stereo rows"),
                (("--right-eye-first", "--stereo", "sbs"), "--right-eye-first requires --stereo rows"),
                (("--screen-width", "1200", "--viewer-distance", "2"), "1200 is not a length of 0.05 to 50 metres; 65 mm is 0.065"),
                (("--screen-width", "1.2", "--viewer-distance", "2m"), "2m is not a length of 0.1 to 50 metres"),
                (("--eye-separation", "65"), "65 is not a length of 0.01 to 0.2 metres; 65 mm is 0.065")):
            result = self.run_command("display", "--offscreen", "--frames", "1", *arguments)
            self.assertEqual(result.returncode, 2, (arguments, result.stdout + result.stderr))
            self.assertIn(said, result.stderr, arguments)
            self.assertNotRegex(result.stdout + result.stderr, r"[\x00-\x09\x0b-\x1f]", arguments)
        self.assertEqual(film.read_text(), "a recorded visit")

    def test_an_unknown_command_is_reported_with_the_nearest(self):
        for words, said in ((["displya"], "there is no command 'displya': did you mean 'display'? (mechane --help"),
                            (["xyzzy", "--kiosk", "wall"], "there is no command 'xyzzy' (mechane --help"),
                            ([], "A subcommand is required"), (["--no-such"], "A subcommand is required")):
            result = self.run_command(*words)
            self.assertEqual(result.returncode, 2, (words, result.stdout + result.stderr))
            self.assertIn(said, result.stderr, words)

    def test_the_help_of_a_display_tells_what_is_usual(self):
        told = " ".join(self.run_command("display", "--help").stdout.split())
        self.assertRegex(told, r"--ask TEXT:\{none,after,both\}=after ")
        self.assertRegex(told, r"--stereo TEXT:\{mono,\S+\}=mono ")
        self.assertRegex(told, r"--mute play no sound")
        self.assertRegex(told, r"--no-touch mouse, finger")

    def test_a_head_without_a_kiosk_and_malformed_lines(self):
        for at in (("0", "0", "-1"), ("0", "0", "0"), ("0", "0", "600")):
            result = self.run_command("head", "--at", *at)
            self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
            self.assertIn("--at: the head is not in front of the screen and within 20 m", result.stderr)
        result = self.run_command("head", "--kiosk", "kiosk-7", "--at", "0", "0", "1", "--seconds", "4")
        self.assertEqual((result.returncode, result.stderr.count("no display answered")), (0, 1), result.stderr)
        self.display()
        self.wait_for_displays(lambda told: told and told["wall"]["pictures"] > 0, 30, "a display draws")
        result = self.run_command("head", "--kiosk", "kiosk-7", "--at", "0", "0", "1", "--seconds", "4")
        self.assertIn("kiosk-7/*: there is no such display; name one of: kiosk-1/wall", result.stderr)
        result = self.run_command("head", "--kiosk", "kiosk-1", "--at", "0", "0", "1", "--seconds", "4")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_a_file_that_is_no_recorded_visit_is_told_at_the_start(self):
        result = self.run_command("display", "--offscreen", "--attract", SCENARIO, "--frames", "1")
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn("archimedes-screw.x3d", result.stderr)

    def test_without_a_driver_for_graphics_the_remedy_is_told(self):
        result = subprocess.run([str(BIN / "mechane"), "display", "--offscreen", "--frames", "1"], capture_output=True, text=True,
                                timeout=60 * PATIENCE, env={**self.environment, "LIBGL_DRIVERS_PATH": str(self.folder), "MESA_LOADER_DRIVER_OVERRIDE": "none"})
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn("install libegl-mesa0 and libgl1-mesa-dri", result.stderr)

    @marked("alone")
    def test_a_display_behind_a_router_with_delay_and_loss_follows_a_whole_visit(self):
        link = Link(delay=40, jitter=2, loss=0.01)
        self.addCleanup(link.close)
        museum = {**self.environment, "CYCLONEDDS_URI": "file://" + str(ROOT / "deploy/cyclonedds/museum.xml"),
                  "MECHANE_SERVER": "10.77.1.2", "MECHANE_MUSEUM": self.environment["CYCLONEDDS_TEST_TAG"], "MECHANE_INTERFACE": "end-1"}
        self.environment = museum
        self.server(records=False, prefix=link.server)
        self.display(prefix=link.client, environment={**museum, "MECHANE_INTERFACE": "end-2"})
        self.command_prefix = link.server
        joined = lambda told: told and told["wall"]["link"] == "joined" and told["wall"]["frames_per_s"] > 20
        told = self.wait_for_displays(joined, 60, "the display has its scene")["wall"]
        self.assertEqual((told["scenario"], told["missing_total"]), ("archimedes-screw", 0))
        visitor = self.start("visitor", "visitor", "--kiosk", "kiosk-1", "--scenario", SCENARIO,
                             "--activity", "use", prefix=link.server)
        self.wait_for_displays(lambda told: 0.002 < told["wall"]["frames_lost"] < 0.05, 40, "a loss of one in a hundred is told")
        link.set(loss=0.1)
        told = self.wait_for_displays(lambda told: 0.05 < told["wall"]["frames_lost"] < 0.3, 40, "a loss of one in ten is told")["wall"]
        self.assertTrue(any("frames are lost on the network" in remark for remark in told["remarks"]), told["remarks"])
        self.assertEqual(visitor.wait(120), 0, visitor.text())
        self.wait_for_displays(joined, 20, "it has stayed")


if __name__ == "__main__":
    unittest.main(verbosity=2)
