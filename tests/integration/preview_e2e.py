"""Drafts are tried in the studio: on a server of their own, whose time stands still, runs slowly and goes on by steps."""

import math
import os
import pathlib
import re
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

from browser import Browser, Page, Refused, WithGateway
from gateway_e2e import SIZE, WebVisitor
from harness import DRIVERS, SCENARIO, EndToEnd, marked, wait_until
from touch import Screen

NAME = "windlass"
DRAFT = f"/api/studio/drafts/{NAME}"
PREVIEW = f"{DRAFT}/preview"


class Seen:
    """What a Watch tells, from a function."""

    def __init__(self, now):
        self.now = now

    def stop(self):
        pass


class PreviewVisitor(WebVisitor):
    """A finger at a preview's kiosk, which sees no more of the world than its page does."""

    def __init__(self, browser, text):
        self.x3d = xml.etree.ElementTree.fromstring(text)
        self.screen = Screen(self.x3d, *SIZE)
        self.screen.see_room = lambda p, at: None
        self.kiosk, self.browser, self.pick, self.story = "", browser, None, []
        self.objects = {one["name"]: one["index"] for one in browser.wait("scene")["objects"]}
        self.frames, self.status = Seen(self.seen), Seen(lambda: browser.texts["world"])

    def seen(self):
        pose = lambda numbers: {"p": list(numbers[:3]), "q": [numbers[6], *numbers[3:6]]}
        frame = self.browser.frame
        hands = [{"kiosk": self.kiosk, "user": hand["user"], "holding": hand["holding"], "X_WS": [pose(hand["poses"][0])]}
                 for hand in frame.hands]
        return {"bodies": [{"object": index, "X_WB": pose(numbers)} for index, (_, numbers) in frame.bodies.items()], "hands": hands}


def servers_of(process):
    """The processes that run servers for this one, by number."""
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            name, rest = stat.read_text().rsplit(")", 1)
        except OSError:
            continue
        if name.split("(", 1)[1].startswith("mechane-server") and int(rest.split()[1]) == process.process.pid and rest.split()[0] != "Z":
            found.append(int(stat.parent.name))
    return found


def runs(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def still_tick(browser):
    """The tick at which time stands still: frames come and have the same."""
    def stands():
        tick, frames = browser.frame.tick, browser.frames
        wait_until(lambda: browser.frames >= frames + 10, 20, "frames go on")
        return browser.frame.tick == tick and tick
    return wait_until(stands, 20, "time stands still")


class Preview(WithGateway):
    def setUp(self):
        super().setUp()
        self.scenarios = self.folder / "scenarios"
        self.scenarios.mkdir()
        (self.folder / "app").mkdir()
        (self.folder / "app/index.html").write_text("<!doctype html><title>Mechane</title>")
        self.file = self.scenarios / NAME / ".preview.x3d"

    def preview(self, page):
        return self.got(page, PREVIEW)

    def gateway(self):
        return super().gateway("--app", self.folder / "app", "--scenarios", self.scenarios)

    def tried(self, page, revision, **more):
        """The preview, once it runs."""
        self.assertEqual(self.posted(page, PREVIEW, {"revision": revision, **more})["state"], "starting")
        wait_until(lambda: self.preview(page)["state"] != "starting", 120, "the draft runs")
        preview = self.preview(page)
        self.assertEqual(preview["state"], "running", preview)
        self.assertEqual(preview["revision"], revision)
        return preview

    def browser(self, page, preview):
        browser = Browser(page, preview["socket"])
        self.addCleanup(browser.close)
        browser.wait("link", lambda link: link["state"] == "joined")
        wait_until(lambda: browser.frame, 20, "frames come")
        return browser

    def look_at_the_page(self, page, preview):
        """Only the studio's own page may show it in a frame."""
        def framing(path):
            headers = page.get(path)[1]
            return headers["x-frame-options"], "frame-ancestors 'self'" in headers["content-security-policy"]
        self.assertEqual(framing(preview["address"]), ("SAMEORIGIN", True))
        for path in (preview["address"][:-1] + "-", f"/kiosk/{preview['kiosk']}", "/kiosk/kiosk-1", "/studio"):
            self.assertEqual(framing(path), ("DENY", False), path)
        self.assertEqual(Page(page.port).get(PREVIEW)[0], 401)

    def turn_the_crank(self, browser, text):
        visitor = PreviewVisitor(browser, text)
        rotation = lambda: browser.frame.bodies[visitor.objects["DRUM"]][1][3:]
        before = rotation()
        self.assertTrue(visitor.take("DRUM", [0, 0.25, 0.3]), browser.texts.get("pointer"))
        way, _ = visitor.circle("AXLE")
        visitor.drag(lambda share: way(2 * share), 3)
        wait_until(lambda: abs(sum(a * b for a, b in zip(before, rotation()))) < math.cos(0.4), 20, "the crank has turned")
        return visitor

    @marked("alone")
    def test_a_draft_is_tried_by_a_finger_paused_stepped_and_begun_anew(self):
        process, page = self.gateway()
        self.posted(page, "/api/studio/drafts", {"name": NAME, "from": "template:crank-and-rope"})
        self.assertEqual(self.preview(page), {"state": "none"})
        self.posted(page, f"{PREVIEW}/pace", {"pace": 0}, 409)
        preview = self.tried(page, 0)
        self.assertEqual((preview["kiosk"], preview["pace"], preview["step"], preview["activity"]), (f"studio-{NAME}", 1, "wind", "lift"))
        self.assertTrue(self.file.exists())
        self.look_at_the_page(page, preview)
        self.assertEqual(len(servers_of(process)), 1)
        self.assertEqual(os.getpriority(os.PRIO_PROCESS, servers_of(process)[0]), 5)

        browser = self.browser(page, preview)
        shapes = {one["hash"] for one in browser.wait("scene")["objects"] if one["hash"]}
        for hash_ in shapes:
            status, _, mesh = page.get(f"/content/{hash_}")
            self.assertEqual((status, mesh[:4]), (200, b"glTF"))
        text = page.get(f"{DRAFT}/text")[2].decode()
        visitor = self.turn_the_crank(browser, text)

        # Paused: the hand lets go, time stands still, pictures go on; then ten ticks, and no more.
        self.posted(page, f"{PREVIEW}/pace", {"ticks": 10}, 409)
        self.assertEqual(self.posted(page, f"{PREVIEW}/pace", {"pace": 0})["pace"], 0)
        tick = still_tick(browser)
        self.assertFalse(any(hand["holding"] for hand in browser.frame.hands))
        self.assertAlmostEqual(self.preview(page)["time_s"], tick / 1000)
        self.posted(page, f"{PREVIEW}/pace", {"ticks": 10})
        wait_until(lambda: browser.frame.tick != tick, 20, "time goes on")
        self.assertEqual(still_tick(browser), tick + 10)
        visitor.xdo("mouseup", 1)

        # A tenth of real time, in which a finger works on.
        self.posted(page, f"{PREVIEW}/pace", {"pace": 0.1})
        wait_until(lambda: browser.frame.tick > tick + 20, 20, "time goes on")
        began, before = time.monotonic(), browser.frame.tick
        self.turn_slowly(browser, text)
        share = (browser.frame.tick - before) / 1000 / (time.monotonic() - began)
        self.assertLess(share, 0.3, "a tenth, and what frames tell late")
        self.posted(page, f"{PREVIEW}/pace", {"pace": 1})

        # As the draft is now.
        change = [{"op": "set", "path": "activities/lift/steps/wind/disable", "value": "HOLD"}]
        self.posted(page, f"{DRAFT}/commands", {"revision": 0, "commands": change})
        self.assertEqual(self.preview(page)["revision"], 0)
        self.posted(page, PREVIEW, {"revision": 0}, 409)
        second = self.tried(page, 1)
        wait_until(lambda: not browser.open, 20, "who saw the first one is told and goes")
        self.assertEqual(browser.texts["bye"]["reason"], "this draft is tried anew")
        self.assertNotEqual(second["address"], preview["address"])
        with self.assertRaises(Refused):
            Browser(Page(page.port), preview["socket"])
        wait_until(lambda: self.reasons(page, "DRUM") == ["off"], 20, "it is told why the crank stands still")

        # From a step: what the steps before it say holds there.
        later = [{"op": "set", "path": "activities/lift/steps/after/timeoutSeconds", "value": 600},
                 {"op": "set", "path": "activities/lift/steps/wind/trigger:1/next", "value": "after"}]
        self.posted(page, f"{DRAFT}/commands", {"revision": 1, "commands": later})
        self.posted(page, PREVIEW, {"revision": 2, "step": "lift/never"}, 404)
        self.assertEqual(self.preview(page)["revision"], 1)
        self.tried(page, 2, step="lift/after")
        wait_until(lambda: self.preview(page)["step"] == "after", 20, "it is at the step")
        self.assertEqual(self.preview(page)["begins"], "lift/after")
        wait_until(lambda: self.reasons(page, "DRUM") == ["off"], 20, "the crank is off, as the step before says")

        self.assertEqual(self.posted(page, f"{PREVIEW}/stop", {}), {"state": "none"})
        wait_until(lambda: not servers_of(process) and not self.file.parent.exists(), 20, "nothing is left of it")
        self.assertEqual(process.stop(), 0, process.text())

    def reasons(self, page, body):
        still = {one["def"]: one["reasons"] for one in self.preview(page).get("still", [])}
        return [reason["kind"] for reason in still.get(body, [])]

    def turn_slowly(self, browser, text):
        visitor = PreviewVisitor(browser, text)
        self.assertTrue(visitor.take("DRUM", [0, 0.25, 0.3]), browser.texts.get("pointer"))
        visitor.xdo("mouseup", 1)

    def edited(self, page, revision, *commands):
        """Changes the draft, and asks for it where it runs; the preview, once its server has answered."""
        self.posted(page, f"{DRAFT}/commands", {"revision": revision, "commands": list(commands)})
        self.posted(page, f"{PREVIEW}/edit", {"revision": revision}, 409)
        self.posted(page, f"{PREVIEW}/edit", {"revision": revision + 1})
        answered = lambda: revision + 1 in (self.preview(page)["revision"], self.preview(page).get("kept", {}).get("revision"))
        wait_until(answered, 60, "the server has answered")
        return self.preview(page)

    def test_what_is_edited_goes_into_what_runs_or_it_is_told_what_keeps_it(self):
        process, page = self.gateway()
        self.posted(page, "/api/studio/drafts", {"name": NAME, "from": "template:crank-and-rope"})
        self.posted(page, f"{PREVIEW}/edit", {"revision": 0}, 409)
        preview = self.tried(page, 0)
        browser = self.browser(page, preview)
        # A device is there, too, and stays.
        where = ("--kiosk", preview["kiosk"], "--domain", str(preview["domain"]))
        haptic = self.start("haptic", "haptic", "--device", "virtual", *where, "--fifo-priority", "0")
        device = lambda: [(one["user"], one["state"], one["kind"]) for one in self.preview(page)["devices"]]
        wait_until(lambda: device() == [(0, "ready", "one-point")], 30, "its author sees a device")
        caption = lambda: browser.texts["world"]["caption"]["en"]
        said = lambda words: {"op": "set", "path": "activities/lift/steps/wind/text/caption.en", "value": words}
        wait_until(lambda: browser.frame.tick > 500, 20, "time goes on")
        self.assertEqual(self.edited(page, 0, said("Wind it up."))["revision"], 1)
        wait_until(lambda: caption() == "Wind it up.", 20, "visitors read the new words")
        self.assertGreater(browser.frame.tick, 500, "it goes on from where it was")

        # While time stands still, too.
        self.posted(page, f"{PREVIEW}/pace", {"pace": 0})
        tick = still_tick(browser)
        heavier = {"op": "field", "node": "DRUM", "field": "mass", "value": "20"}
        self.assertEqual(self.edited(page, 1, said("Turn."), heavier)["revision"], 2)
        wait_until(lambda: caption() == "Turn.", 20, "visitors read the new words")
        self.assertEqual(still_tick(browser), tick)
        self.posted(page, f"{PREVIEW}/pace", {"pace": 1})
        wait_until(lambda: browser.frame.tick > tick, 20, "time goes on")

        # What needs a start anew.
        elsewhere = {"op": "field", "node": "LOAD", "field": "position", "value": "0 0.5 0"}
        kept = self.edited(page, 2, elsewhere)
        self.assertEqual((kept["revision"], kept["kept"]), (2, {"revision": 3, "by": "body LOAD"}))
        kept = self.edited(page, 3, {"op": "set", "path": "activities/lift/steps/wind/disable", "value": "HOLD"})
        self.assertEqual((kept["revision"], kept["kept"]), (2, {"revision": 4, "by": "steps wind"}))
        self.assertEqual(browser.frame.tick > tick, browser.open, "nobody has noticed")
        self.assertEqual((len(browser.frame.hands), haptic.running()), (1, True), haptic.text())
        self.assertNotIn("kept", self.tried(page, 4))
        self.assertFalse([line for line in self.preview(page)["said"] if line.startswith("edit ")])
        self.assertEqual(process.stop(), 0, process.text())

    def test_an_author_tests_a_device_and_puts_its_hand_elsewhere(self):
        self.environment["MECHANE_DRIVERS"] = str(DRIVERS)
        process, page = self.gateway()
        self.posted(page, "/api/studio/drafts", {"name": NAME, "from": "template:crank-and-rope"})
        preview = self.tried(page, 0)
        ask = lambda order, status=200: self.posted(page, f"{PREVIEW}/device", {"user": 0, **order}, status)
        ask({"action": "test"}, 409)  # there is none yet
        sinks = self.folder / "sinks"
        where = ("--kiosk", preview["kiosk"], "--domain", str(preview["domain"]), "--center", "0", "1", "0.5")
        self.start("haptic", "haptic", "--device", f"fake:sinks={sinks}", *where, "--fifo-priority", "0")
        device = lambda: (self.preview(page).get("devices") or [{}])[0]
        told = lambda key: device().get("details", {}).get(key)
        wait_until(lambda: told("wanted_hz") == 1000 and told("rate_hz") > 100, 30, "its author reads how it fares")
        self.assertEqual((told("peak_force_n"), told("place"), device()["request"]),
                         (2, {"center_m": [0, 1, 0.5], "turn_rad": 0, "scale": 1}, "none"))

        place = {"center_m": [0.25, 1.5, 0.75], "turn_rad": 0.5, "scale": 2}
        ask({"action": "place", "place": place})
        wait_until(lambda: device()["request"] == "done" and told("place") == place, 20, "it is put there")
        wait_until(lambda: abs(told("hand_m")[1] - 1.5) < 0.01, 20, "and so is its hand")
        ask({"action": "place", "place": {**place, "scale": 0.5}}, 400)
        ask({"action": "calibrate"})
        wait_until(lambda: device()["request"] == "refused", 20, "it is no glove")
        self.assertIn("glove", device()["refusal"])

        ask({"action": "test"})
        wait_until(lambda: told("testing"), 20, "it is tested")
        sinks.write_text("now")
        wait_until(lambda: told("test_force_n") > 0.1, 20, "the hand is on the floor")
        self.assertLessEqual(told("test_force_n"), 1)
        ask({"action": "end-test"})
        wait_until(lambda: not told("testing"), 20, "the world comes back")
        self.assertEqual(process.stop(), 0, process.text())

    @marked("address")
    def test_what_cannot_be_tried_is_told_and_nothing_outlives_its_gateway(self):
        process, page = self.gateway()
        self.posted(page, "/api/studio/drafts", {"name": NAME, "from": "template:crank-and-rope"})
        self.posted(page, f"{DRAFT}/commands", {"revision": 0, "commands": [{"op": "delete", "node": "LOAD"}]})
        refused = self.posted(page, PREVIEW, {"revision": 1}, 422)
        self.assertTrue(refused["problems"])
        self.assertEqual(self.preview(page), {"state": "none"})
        self.assertFalse(self.file.parent.exists())
        self.posted(page, f"{DRAFT}/undo", {"revision": 1})
        self.posted(page, PREVIEW, {}, 400)
        self.posted(page, f"{PREVIEW}/else", {}, 404)

        # A server that is killed.
        browser = self.browser(page, self.tried(page, 2))
        (server,) = servers_of(process)
        os.kill(server, signal.SIGKILL)
        wait_until(lambda: self.preview(page)["state"] == "failed", 20, "it has failed")
        failed = self.preview(page)
        self.assertIn("Killed", failed["said"][-1])
        self.assertTrue(any("ready" in line for line in failed["said"]), failed["said"])
        self.assertNotIn("address", failed)
        wait_until(lambda: not browser.open and not self.file.exists(), 20, "what was seen of it ends, and its file is gone")

        # The draft's end is its preview's.
        self.tried(page, 2)
        self.posted(page, f"{DRAFT}/discard", {"revision": 2})
        self.assertEqual(self.preview(page), {"state": "none"})
        wait_until(lambda: not servers_of(process) and not self.file.parent.exists(), 20, "nothing is left of it")

        # The gateway's end, in both ways.
        self.posted(page, "/api/studio/drafts", {"name": NAME, "from": "template:crank-and-rope"})
        self.tried(page, 0)
        (server,) = servers_of(process)
        self.assertEqual(process.stop(), 0, process.text())
        self.assertFalse(runs(server))
        self.assertFalse(self.file.parent.exists())
        process, page = self.gateway()
        self.tried(page, 0)
        (server,) = servers_of(process)
        process.kill()
        wait_until(lambda: not runs(server), 30, "the server ends with its input")
        self.assertTrue(self.file.exists(), "nobody was there to remove it")
        process, page = self.gateway()
        self.assertFalse(self.file.parent.exists())
        self.assertEqual(process.stop(), 0, process.text())


class Paced(EndToEnd):
    def test_a_server_takes_orders_about_its_time_and_ends_with_them(self):
        server = self.start("server", "server", "--scenario", SCENARIO, "--records", "", "--paced", stdin=subprocess.PIPE)
        wait_until(lambda: " ready: " in server.text() or not server.running(), 600, "the server is ready")
        self.assertTrue(server.running(), server.text())
        order = lambda line: (server.process.stdin.write(f"{line}\n".encode()), server.process.stdin.flush())
        self.addCleanup(server.process.stdin.close)
        gateway = self.start("gateway", "gateway", "--listen", "127.0.0.1:0", "--state", self.folder / "state")
        wait_until(lambda: "\nready" in gateway.text() or not gateway.running(), 60, "the gateway is ready")
        port, path = re.search(r"kiosk kiosk-1: http://[^:]+:(\d+)(/\S+)", gateway.text()).groups()
        browser = Browser(Page(int(port)), f"/ws{path}")
        self.addCleanup(browser.close)
        wait_until(lambda: browser.frame, 30, "frames come")
        order("pace 2")
        wait_until(lambda: "'pace 2' is not an order" in server.text(), 20, "a bad line is told")
        order("step 5")
        wait_until(lambda: "'step 5' has no effect while time runs" in server.text(), 20, "a step that has no effect is told")

        order("pace 0")
        tick = still_tick(browser)
        order("step 10")
        wait_until(lambda: browser.frame.tick > tick, 20, "time goes on")
        self.assertEqual(still_tick(browser), tick + 10)
        order("pace 1")
        wait_until(lambda: browser.frame.tick > tick + 1000, 20, "time runs")
        server.process.stdin.close()
        self.assertEqual(server.wait(20), 0, server.text())
        self.assertIn("standard input has ended", server.text())


if __name__ == "__main__":
    unittest.main()
