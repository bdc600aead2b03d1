"""The gateway: a kiosk in browsers, the operator's API, and what is refused."""

import json
import math
import re
import socket
import struct
import subprocess
import time
import unittest

from browser import Browser, Page, Refused
from harness import ROOT, SCENARIO, EndToEnd, marked, repeat_until, wait_until
from touch import TouchVisitor, add, cross, placed, scaled, sub, turned, unit

SIZE = (480, 270)


class WebVisitor(TouchVisitor):
    """The visitor's finger, on a browser's picture: the browser casts the ray, the gateway moves the hand."""

    def __init__(self, browser, scenario, kiosk, environment):
        super().__init__(scenario, kiosk, SIZE, environment)
        self.browser, self.pick = browser, None
        self.screen.see_room = lambda p, at: None  # this picture makes no room

    def camera(self):
        screen = self.screen
        rows = [screen.right, screen.up, [-x for x in screen.ahead]]
        m = [[rows[column][row] for column in range(3)] for row in range(3)]  # columns are the camera's axes
        w = math.sqrt(max(0, 1 + m[0][0] + m[1][1] + m[2][2])) / 2
        q = [(m[2][1] - m[1][2]) / (4 * w), (m[0][2] - m[2][0]) / (4 * w), (m[1][0] - m[0][1]) / (4 * w), w]
        return {"pose": [*screen.eye, *q], "fov": 2 * math.atan(screen.half), "aspect": SIZE[0] / SIZE[1]}

    def take(self, body, grip):
        self.pick = {"object": self.objects[body], "p": placed(self.pose(body), grip), "n": [0, 0, 1]}
        return super().take(body, grip)

    def xdo(self, *words):
        kinds = {"mousedown": "press", "mouseup": "release"}
        events = [{"kind": "move", "x": float(words[1]), "y": float(words[2])}] if words[0] == "mousemove" else []
        events += [{"kind": kinds[word], "x": float(self.at[0]), "y": float(self.at[1])} for word in words if word in kinds]
        for event in events:
            if event["kind"] == "press":
                event["pick"] = self.pick
        self.browser.say(type="pointer", events=events, picture=SIZE, camera=self.camera())


def tracked_hand(wrist, closed):
    """The message of a headset that sees a right hand: its wrist in W, palm down, fingers along x, each bent by this share of a fist."""
    joints = [[0, 0, 0], *(add([0.02, -0.01, -0.025], scaled(unit([0.62, -0.30, -0.72]), s)) for s in (0, 0.045, 0.08, 0.105))]
    for z in (-0.03, -0.01, 0.01, 0.03):
        joints += [[0.045, 0, z / 2], [0.09, 0, z]]
        down = 0
        for bone, bend in ((0.045, 1.2), (0.026, 1.4), (0.02, 0.8)):
            down += closed * bend
            joints.append(add(joints[-1], [bone * math.cos(down), -bone * math.sin(down), 0]))
    numbers = [x for joint in joints for x in add(wrist, joint)]
    return struct.pack("<8Bf75f", 2, 1, 1, 0, 0, 1, 1, 0, -1, *numbers)


class Gateway(EndToEnd):
    maxDiff = 4000
    def gateway(self, *arguments):
        """A gateway at a port of its own, with an app of three files, and a page of it."""
        (self.folder / "app/assets").mkdir(parents=True, exist_ok=True)
        (self.folder / "app/index.html").write_text("<!doctype html><title>Mechane</title>")
        (self.folder / "app/assets/main-1.js").write_text("'use strict'")
        (self.folder / "app/sw.js").write_text("'use strict'")
        self.state = self.folder / "state"
        listen = [] if "--listen" in arguments else ["--listen", "127.0.0.1:0"]
        process = self.start("gateway", "gateway", *listen, "--state", self.state, "--app", self.folder / "app", *arguments)
        wait_until(lambda: "\nready" in process.text() or not process.running(), 60, "the gateway is ready")
        self.assertTrue(process.running(), process.text())
        address = re.search(r"console: (https?)://[^:]+:(\d+)/console", process.text())
        page = Page(int(address.group(2)), tls=address.group(1) == "https")
        if found := re.search(r"operator (\S+)", process.text()):
            self.password = found.group(1)
        return process, page

    def token(self, process, kiosk="kiosk-1"):
        return re.search(rf"kiosk {kiosk}: \S+\?token=(\S+)", process.text()).group(1)

    def path(self, process, kiosk="kiosk-1"):
        return f"/ws/kiosk/{kiosk}?token={self.token(process, kiosk)}"

    def refused(self, page, path, status, **how):
        with self.assertRaises(Refused) as refusal:
            Browser(page, path, **how)
        self.assertEqual(refusal.exception.status, status, refusal.exception.body)
        self.assertTrue(json.loads(refusal.exception.body)["remedy"])

    @marked("alone")
    def test_a_browser_sees_the_screw_and_turns_its_crank(self):
        self.server()
        process, page = self.gateway()
        browser = Browser(page, self.path(process))
        self.addCleanup(browser.close)
        self.assertEqual(browser.wait("hello")["protocol"], 1)
        browser.wait("link", lambda link: link["state"] == "joined")
        scene, world = browser.wait("scene"), browser.wait("world")
        self.assertEqual(world["scenario"], "archimedes-screw")
        self.assertIn("title", browser.wait("overlay"))
        wait_until(lambda: browser.frames > 30, 20, "frames come")
        wait_until(lambda: browser.frame.age_s < 0.05, 20, "a frame is fresh")
        self.assertEqual(set(browser.frame.bodies), {o["index"] for o in scene["objects"] if o["movable"]})

        # The mesh, whole, by a part, and not again.
        (hash_,) = {o["hash"] for o in scene["objects"] if o["hash"]}
        mesh = (SCENARIO.parent / next(o["uri"] for o in scene["objects"] if o["hash"])).read_bytes()
        address = f"/content/{hash_}?token={self.token(process)}"
        status, headers, body = page.get(address)
        self.assertEqual(status, 200, body[:200])
        self.assertTrue(body == mesh, "the file, byte by byte")
        self.assertIn("immutable", headers["cache-control"])
        self.assertEqual(page.get(address, **{"If-None-Match": headers["etag"]})[0], 304)
        status, headers, body = page.get(address, Range="bytes=4-11")
        self.assertEqual((status, body, headers["content-range"]), (206, mesh[4:12], f"bytes 4-11/{len(mesh)}"))

        # The app's service worker may serve all pages, and no other file may.
        allowed = {path: page.get(path)[1].get("service-worker-allowed") for path in ("/app/sw.js", "/app/assets/main-1.js")}
        self.assertEqual(allowed, {"/app/sw.js": "/", "/app/assets/main-1.js": None})

        # The crank.
        browser.say(type="press", action="activity:use")
        browser.wait("world", lambda world: world["activity"] == "use")
        visitor = WebVisitor(browser, SCENARIO, "kiosk-1", self.environment)
        self.addCleanup(visitor.stop)
        grasp = next(move for move in visitor.visit("use") if move["kind"] == "reach")
        rotation = lambda: browser.frame.bodies[visitor.objects[grasp["body"]]][1][3:]
        before = rotation()
        self.assertTrue(visitor.take(grasp["body"], [float(x) for x in grasp["grip"].split()]), browser.texts.get("pointer"))
        self.assertEqual(browser.wait("pointer", lambda hand: hand["phase"] == "holding")["drag"], "turn")
        turn = next(move for move in visitor.visit("use") if move["kind"] == "turn")

        def go_round():  # from where the hand is now: it comes after the finger as fast as a hand may
            way, _ = visitor.circle(turn["joint"])
            visitor.drag(lambda share: way(math.copysign(3 * share, float(turn["turns"]))), 3)
        turned = lambda: abs(sum(a * b for a, b in zip(before, rotation()))) < 0.9
        repeat_until(go_round, turned, 60, "the crank has turned by a radian or more")
        visitor.xdo("mouseup", 1)
        browser.wait("pointer", lambda hand: hand["phase"] in ("leaving", "resting"))

        # It is one of the kiosk's displays.
        browser.say(type="status", picturesPerS=30, pictureMsMedian=8, pictureMsP99=20, width=480, height=270, renderer="a test")
        wait_until(lambda: self.displays().get("web-1", {}).get("renderer") == "a test", 20, "technicians see the browser")
        changed = self.run_command("displays", "set", "--kiosk", "kiosk-1", "--display", "web-1", "large-text=on")
        self.assertEqual(changed.returncode, 0, changed.stderr)
        browser.wait("overlay", lambda overlay: overlay["largeText"])
        self.assertEqual(process.stop(), 0, process.text())

    @marked("alone")
    def test_two_fingers_take_two_things_at_once(self):
        """As two visitors do at one tablet."""
        scenario = ROOT / "scenarios/odometer/odometer.x3d"
        server = self.server(scenario=scenario, records=False)
        process, page = self.gateway()
        browser = Browser(page, self.path(process))
        self.addCleanup(browser.close)
        browser.say(type="press", action="activity:construct")
        browser.wait("world", lambda world: world["activity"] == "construct")
        visitor = WebVisitor(browser, scenario, "kiosk-1", self.environment)
        self.addCleanup(visitor.stop)
        grips = {move["body"]: [float(x) for x in move["grip"].split()] for move in visitor.visit("construct") if "grip" in move}
        held_by = lambda hands: {hand["object"] for hand in hands if hand["phase"] == "holding"}
        held = lambda: held_by([browser.texts.get("pointer", {"phase": ""}), *browser.texts.get("pointer", {}).get("others", [])])

        def say(kind, finger, at, body=None):
            pick = {"object": visitor.objects[body], "p": placed(visitor.pose(body), grips[body])} if body else None
            event = {"kind": kind, "x": at[0], "y": at[1], "finger": finger, "pick": pick}
            browser.say(type="pointer", events=[event], picture=SIZE, camera=visitor.camera())
        seen = lambda body: visitor.screen.pixel(placed(visitor.pose(body), grips[body]), 1)

        def take(finger, body):
            say("release", finger, (0, 0))
            say("press", finger, seen(body), body)
        objects = {visitor.objects[body] for body in ("TOOTH", "DRUM")}
        repeat_until(lambda: take(1, "TOOTH"), lambda: visitor.objects["TOOTH"] in held(), 60, "one finger takes a wheel")
        def take_what_is_not_held():  # on a busy machine the first may have slipped meanwhile
            for finger, body in ((1, "TOOTH"), (2, "DRUM")):
                if visitor.objects[body] not in held():
                    take(finger, body)
        repeat_until(take_what_is_not_held, lambda: held() == objects, 60, "another takes a drum meanwhile")
        users = lambda: {hand["user"] for hand in browser.frame.hands if hand["holding"]}
        wait_until(lambda: users() == {2, 3}, 20, "two of the kiosk's hands hold something")

        # Two fingers on one thing are one hand, which they bring nearer as they spread.
        x, y = seen("TOOTH")
        before = visitor.pose("TOOTH")["p"]
        nearer = lambda: math.dist(before, visitor.screen.eye) - math.dist(visitor.pose("TOOTH")["p"], visitor.screen.eye)
        say("press", 3, (x + 40, y), "TOOTH")
        for k in range(1, 21):
            say("move", 3, (x + 40 + k, y))
        wait_until(lambda: nearer() > 0.1, 20, "the wheel comes nearer")
        self.assertEqual(users(), {2, 3})
        self.assertNotIn("user 1", server.text())

        # A third thing takes the last hand; for a fourth none is left.
        repeat_until(lambda: take(4, "FLAT"), lambda: len(held()) == 3, 60, "a third hand")
        say("press", 5, seen("VESSEL"), "VESSEL")
        browser.wait("pointer", lambda hand: hand["link"] == "refused")
        browser.wait("overlay", lambda overlay: "hands are busy" in overlay["note"] or "απασχολημένα" in overlay["note"])
        for finger in (5, 4, 3, 1):
            say("release", finger, (0, 0))
        browser.wait("pointer", lambda hand: visitor.objects["DRUM"] in held_by([hand]) and not hand.get("others"))
        self.assertEqual(process.stop(), 0, process.text())

    @marked("alone")
    def test_a_tracked_hand_closes_around_a_crank_and_turns_it(self):
        self.server(scenario=ROOT / "scenarios/pulley-crane/pulley-crane.x3d", records=False)
        process, page = self.gateway()
        browser = Browser(page, self.path(process))
        self.addCleanup(browser.close)
        (drum,) = [o["index"] for o in browser.wait("scene")["objects"] if o["name"] == "DRUM"]
        wait_until(lambda: browser.frame, 20, "a frame comes")
        axle = [0.30, 0.80, 0.65]  # along z; the crank's grip is beside it

        def angle():
            z, w = browser.frame.bodies[drum][1][5:]
            return 2 * math.atan2(z, w)

        def around(turn):
            return add(axle, turned([0, 0, 1, turn], [0.30, 0, 0]))

        def show(grip, closed):
            """For one picture of the headset: the grip is in the hollow of the hand."""
            browser.say_bytes(tracked_hand(sub(grip, [0.085, -0.03, 0]), closed))
            time.sleep(1 / 60)  # sleeps: the pace

        def holds():
            return browser.texts.get("tracked", {"hands": [{"holding": False}]})["hands"][0]["holding"]

        def close():
            for k in range(60):  # from above, open
                show(add(around(angle()), [0, 0.2 * (1 - k / 59), 0]), 0)
            for k in range(30):
                show(around(angle()), k / 29)
        repeat_until(close, lambda: show(around(angle()), 1) or holds(), 60, "the hand holds the crank")
        before = angle()
        for k in range(180):
            show(around(before + 1.2 * k / 179), 1)
        wait_until(lambda: show(around(before + 1.2), 1) or angle() - before > 1, 20, "the crank has turned by a radian")
        (hand,) = browser.frame.hands
        self.assertEqual((holds(), hand["holding"], len(hand["poses"])), (True, 1, 16), "a whole hand holds it still")
        wait_until(lambda: show(around(angle()), 0) or not holds(), 20, "an open hand lets go")
        browser.say_bytes(struct.pack("<4B", 2, 1, 0, 0))
        browser.wait("tracked", lambda tracked: all(hand["link"] == "none" for hand in tracked["hands"]))
        self.assertEqual(process.stop(), 0, process.text())

    def test_a_model_of_hands_is_given_to_whom_the_kiosk_is_open(self):
        model = self.folder / "hand_landmarker.task"
        model.write_bytes(b"no model")
        refused = self.start("refused", "gateway", "--listen", "127.0.0.1:0", "--state", self.folder / "other", "--hand-model", model)
        wait_until(lambda: not refused.running(), 20, "a file of another kind is refused")
        self.assertIn("--hand-model", refused.text())
        model.write_bytes(b"PK\3\4 a bundle")
        process, page = self.gateway("--hand-model", model, "--hand-program", "8765")
        browser = Browser(page, self.path(process))
        self.addCleanup(browser.close)
        self.assertEqual(browser.wait("hello")["cameraHand"], {"model": True, "program": 8765})
        status, headers, body = page.get(f"/hand-model?token={self.token(process)}")
        self.assertEqual((status, body), (200, model.read_bytes()))
        self.assertIn(" ws://127.0.0.1:8765;", headers["content-security-policy"])
        self.assertEqual(page.get("/hand-model")[0], 403)
        self.assertEqual(process.stop(), 0, process.text())

    @marked("draws")
    def test_a_display_shows_a_code_that_leads_a_phone_to_its_kiosk(self):
        """Read by a program that knows nothing of how it was made."""
        self.server(records=False)
        display = self.start("display", "display", "--kiosk", "kiosk-1", "--name", "wall", "--language", "en", "--offscreen",
                             "--size", "960x540", "--mute", "--out", self.folder / "pictures")
        process, page = self.gateway("--phones", "https://museum.example:8480")

        def read():
            self.picture(display)
            newest = self.folder / f"pictures/request-{self.pictures:03}-mono.png"
            return subprocess.run(["zbarimg", "--quiet", "--raw", newest], capture_output=True, text=True).stdout.strip()
        code = wait_until(read, 60, "a code is read in a picture of the display")
        self.assertRegex(code, r"^https://museum\.example:8480/kiosk/kiosk-1\?token=[\w-]{20,}$")
        token = code.partition("token=")[2]
        browser = Browser(page, f"/ws/kiosk/kiosk-1?token={token}")
        self.addCleanup(browser.close)
        self.assertEqual(browser.wait("hello")["kiosk"], "kiosk-1")
        self.refused(page, f"/ws/kiosk/kiosk-2?token={token}", 403)

        # The token is a secret: no log has it, nor what the display tells of itself. Only the address that the gateway prints first does.
        settings = self.displays()["wall"]["settings"]
        self.assertEqual((settings["phone-address"], settings["phone-code"]), ("https://museum.example:8480", "set"))
        self.assertNotIn(token, display.text() + process.text().partition("\nready")[2])
        self.assertEqual(process.stop(), 0, process.text())

    @marked("address")
    def test_who_has_no_right_is_told_why(self):
        process, page = self.gateway("--kiosk", "kiosk-1", "kiosk-2")
        path = self.path(process)
        self.refused(page, "/ws/kiosk/kiosk-1", 403)
        self.refused(page, "/ws/kiosk/kiosk-1?token=wrong", 403)
        self.refused(page, path.replace("kiosk-1", "kiosk-2"), 403)  # only its own kiosk
        self.refused(page, path, 403, origin="http://elsewhere.example")
        self.refused(page, path, 403, origin="")
        self.refused(page, path, 400, protocol="")
        for address, status in {"/api/kiosks": 401, "/api/me": 401, "/content/00": 403, "/exhibit/x/y.png": 403, "/nowhere": 404,
                                "/app/../state/accounts.json": 404, "/app/%2e%2e/state/accounts.json": 404, "/app/.hidden.js": 404,
                                "/app/index.htm": 403, "/%zz": 400, "/%00": 400, "/app/assets/main-1.js": 200, "/console": 200}.items():
            answer, headers, text = page.get(address)
            self.assertEqual(answer, status, f"{address}: {text}")
            self.assertIn("default-src 'self'", headers["content-security-policy"])
            self.assertEqual(headers["x-content-type-options"], "nosniff")
        link = self.folder / "app/assets/away.js"
        link.symlink_to(self.state / "accounts.json")
        self.assertEqual(page.get("/app/assets/away.js")[0], 404, "no link out of the folder")
        self.assertEqual(page.get("/app/" + "a" * 20000)[0], 431)
        self.assertEqual(page.ask("POST", "/api/sign-in", "x" * 100_000)[0], 413)
        self.assertEqual(page.ask("DELETE", "/console")[0], 405)

        # What a socket must not say.
        for message, kind in ((b"{", 1), (b'{"type":"nothing"}', 1), (b'{"type":"pointer","events":[{"kind":"press","x":1e999}]}', 1), (b"\x02\x01", 2)):
            browser = Browser(page, path)
            browser.say_bytes(message, kind)
            self.assertTrue(browser.wait("bye")["remedy"])
            wait_until(lambda: not browser.open, 10, "the socket is closed")
        browser = Browser(page, path)
        browser.say_bytes(b" " * 70_000, 1)
        wait_until(lambda: not browser.open, 10, "a message over the limit ends the socket")
        self.assertEqual(process.stop(), 0, process.text())

    @marked("address")
    def test_operators_sign_in_and_steer_a_kiosk(self):
        self.server(scenario=[ROOT / "scenarios/village/village.x3d", SCENARIO])
        process, page = self.gateway("--records", self.folder / "records")
        self.assertEqual(page.sign_in("operator", "a wrong password")[0], 401)
        status, headers, _ = page.sign_in("operator", self.password)
        self.assertEqual(status, 200)
        for word in ("HttpOnly", "SameSite=Strict", "Path=/"):
            self.assertIn(word, headers["set-cookie"])
        self.assertEqual(self.state.stat().st_mode & 0o77, 0, "nobody else reads the state")
        self.assertNotIn(self.password, (self.state / "accounts.json").read_text())

        # A cookie alone does nothing.
        opened = {"scenario": "archimedes-screw"}
        self.assertEqual(page.post("/api/kiosks/kiosk-1/open", opened, **{"X-Mechane-CSRF": "wrong"})[0], 403)
        self.assertEqual(page.post("/api/kiosks/kiosk-1/open", opened, Origin="http://elsewhere.example")[0], 403)
        self.assertEqual(page.post("/api/kiosks/kiosk-1/open", opened, **{"Content-Type": "text/plain"})[0], 415)
        self.assertEqual(page.post("/api/kiosks/nowhere/open", opened)[0], 404)

        status, text = page.post("/api/kiosks/kiosk-1/open", opened)
        self.assertEqual((status, json.loads(text)["scenario"]), (200, "archimedes-screw"), text)
        self.assertEqual(page.post("/api/kiosks/kiosk-1/open", {"scenario": "no-such"})[0], 404)
        (kiosk,) = json.loads(page.get("/api/kiosks")[2])["kiosks"]
        self.assertEqual(kiosk["scenario"], "archimedes-screw")

        # Its address lets a browser in, and so does the cookie.
        token = kiosk["address"].split("token=")[1]
        browser = Browser(Page(page.port), f"/ws/kiosk/kiosk-1?token={token}")
        browser.wait("world", lambda world: world["scenario"] == "archimedes-screw")
        signed_in = Browser(page, "/ws/kiosk/kiosk-1")
        signed_in.wait("hello")
        names = lambda: {d["display"] for kiosk in json.loads(page.get("/api/kiosks")[2])["kiosks"] for d in kiosk["displays"]}
        wait_until(lambda: names() == {"web-1", "web-2"}, 20, "both browsers are displays of the kiosk")
        status, text = page.post("/api/kiosks/kiosk-1/settings", {"display": "web-1", "settings": {"volume": "0.25"}})
        self.assertEqual((status, json.loads(text)), (200, {"answers": [{"display": "web-1", "refusal": ""}]}))
        browser.wait("settings", lambda settings: settings["volume"] == 0.25)
        self.assertEqual(page.post("/api/kiosks/kiosk-1/settings", {"display": "", "settings": {"volume": "7"}})[0], 400)
        self.assertEqual(json.loads(page.get("/api/server")[2])["server"]["scenarios"], ["village", "archimedes-screw"])
        exhibits = json.loads(page.get("/api/exhibits")[2])
        self.assertEqual([e["id"] for e in exhibits["exhibits"]], ["village", "archimedes-screw"])
        self.assertEqual((exhibits["changeable"], exhibits["remedy"]), (True, ""))
        self.assertEqual(json.loads(page.get("/api/visits?days=1")[2])["days"], 1)

        # Visitors and authors may not do this.
        other = Page(page.port)
        for role, seen in (("visitor", 403), ("author", 200)):
            self.assertEqual(page.post("/api/accounts", {"user": "eva", "role": role, "password": "a long password"})[0], 200)
            self.assertEqual(other.sign_in("eva", "a long password")[0], 200)
            self.assertEqual(other.get("/api/kiosks")[0], seen)
            self.assertEqual(other.post("/api/kiosks/kiosk-1/open", opened)[0], 403)
            self.assertEqual(other.get("/api/audit")[0], 403)
        self.assertEqual(page.post("/api/accounts/remove", {"user": "operator"})[0], 409)
        self.assertEqual(page.post("/api/accounts/remove", {"user": "eva"})[0], 200)
        self.assertEqual(other.get("/api/me")[0], 401, "who was removed is signed out")

        entries = json.loads(page.get("/api/audit")[2])["entries"]
        self.assertIn(("operator", "/api/kiosks/kiosk-1/open"), {(e["user"], e["action"]) for e in entries})
        self.assertNotIn("a long password", (self.state / "audit.log").read_text())
        self.assertEqual(page.post("/api/sign-out", {})[0], 200)
        self.assertEqual(page.get("/api/me")[0], 401, "the old cookie opens nothing")
        for _ in range(5):
            page.sign_in("operator", "guess")
        status, headers, _ = page.sign_in("operator", self.password)
        self.assertEqual(status, 429)
        self.assertTrue(int(headers["retry-after"]) >= 1)
        self.assertEqual(process.stop(), 0, process.text())

    @marked("alone")
    def test_fifty_browsers_one_of_which_reads_nothing(self):
        self.server(records=False)
        process, page = self.gateway()
        path = self.path(process)
        browsers = [Browser(page, path) for _ in range(49)]
        slow = Browser(page, path, reads=False, receive_buffer=4096)
        for browser in browsers:
            browser.wait("scene")
        before = [browser.frames for browser in browsers]
        wait_until(lambda: all(b.frames - n > 60 for b, n in zip(browsers, before)), 30, "all who read get frames")
        # Its own buffer and the gateway's hold some seconds of frames.
        first = browsers[0].frame.sequence
        wait_until(lambda: browsers[0].frame.sequence > first + 600, 60, "time passes")
        slow.read()
        wait_until(lambda: slow.frame and slow.frame.skipped > 100, 20, "it gets the newest frame, and how many it missed")
        wait_until(lambda: slow.frame.sequence + 5 >= browsers[0].frame.sequence, 20, "and keeps up from then on")
        page.sign_in("operator", self.password)
        self.assertGreater(json.loads(page.get("/api/server")[2])["gateway"]["framesSkipped"], 100)
        for browser in [*browsers, slow]:
            browser.close()
        self.assertEqual(process.stop(), 0, process.text())

    @marked("address")
    def test_a_thousand_connections_are_refused_politely(self):
        process, page = self.gateway("--most-connections", "60", "--most-of-address", "50")
        held, told = [], 0
        for _ in range(1000):
            one = socket.create_connection(("127.0.0.1", page.port), timeout=20)
            if len(held) < 50:
                held.append(one)  # says nothing
                continue
            with one:
                answer = b""
                while more := one.recv(4096):
                    answer += more
            told += answer.startswith(b"HTTP/1.1 503")
        self.assertEqual(told, 950, "are told why")
        # All at once: more than may linger.
        many = [socket.create_connection(("127.0.0.1", page.port), timeout=20) for _ in range(300)]
        for one in many:
            self.assertTrue(one.recv(4096).startswith(b"HTTP/1.1 503"), "is told why")
            one.close()
        self.assertLess(process.text().count("are refused"), 100, "and the log is not full of it")
        for one in held:
            one.close()
        wait_until(lambda: page.get("/console")[0] == 200, 20, "there is room again")
        self.assertEqual(process.stop(), 0, process.text())

    @marked("address")
    def test_beyond_this_machine_only_with_tls(self):
        process, page = self.gateway("--listen", "0.0.0.0:0")
        self.assertTrue(page.tls, process.text())
        self.assertEqual((self.state / "tls-key.pem").stat().st_mode & 0o777, 0o600)
        certificate = (self.state / "tls-cert.pem").read_bytes()
        self.assertEqual(page.get("/console")[0], 200)
        self.assertIn("Secure", page.sign_in("operator", self.password)[1]["set-cookie"])
        self.assertEqual(process.stop(), 0, process.text())
        process, page = self.gateway("--listen", "0.0.0.0:0", "--plain")
        self.assertFalse(page.tls)
        self.assertNotIn("operator's password", process.text(), "it is told once")
        self.assertEqual(process.stop(), 0, process.text())
        self.assertEqual((self.state / "tls-cert.pem").read_bytes(), certificate)

    @marked("address")
    def test_an_address_that_nobody_uses_ends(self):
        process, page = self.gateway("--token-idle", "0.05")
        browser = Browser(page, self.path(process))
        browser.wait("bye", limit_s=30)
        wait_until(lambda: not browser.open, 10, "the socket is closed")
        self.refused(page, self.path(process), 403)
        self.assertEqual(process.stop(), 0, process.text())


if __name__ == "__main__":
    unittest.main()
