"""What operators order at a gateway: restarts, changes that end, messages, maintenance, opening hours; and the console's page."""

import json
import re
import socket
import subprocess
import unittest

from browser import Browser, Page, WithGateway
from harness import DRIVERS, PATIENCE, ROOT, SCENARIO, marked, wait_until

VILLAGE = ROOT / "scenarios/village/village.x3d"
CLOSED = {"week": {}}


class Console(WithGateway):
    def gateway(self, *arguments):
        process, page = super().gateway(*arguments)
        self.token = re.search(r"kiosk kiosk-1: \S+\?token=(\S+)", process.text()).group(1)
        return process, page

    def browser(self, page):
        browser = Browser(Page(page.port), f"/ws/kiosk/kiosk-1?token={self.token}")
        self.addCleanup(browser.close)
        browser.wait("world")
        return browser

    def ordered(self, page):
        return self.got(page, "/api/operations")

    def setting(self, display, name):
        return self.displays().get(display, {}).get("settings", {}).get(name)

    @marked("address")
    def test_a_message_and_a_change_end_by_themselves(self):
        self.server(scenario=[VILLAGE, SCENARIO], records=False)
        process, page = self.gateway()
        browser = self.browser(page)
        said = self.posted(page, "/api/messages", {"texts": {"el": "Κλείνουμε στις έξι.", "en": "<b>We close at six."}, "minutes": 0.1})
        overlay = browser.wait("overlay", lambda overlay: overlay["message"])
        self.assertEqual(overlay["message"], "Κλείνουμε στις έξι." if overlay["language"] == "el" else "<b>We close at six.")
        self.assertEqual([m["id"] for m in self.ordered(page)["messages"]], [said["id"]])

        # The volume and the exhibit return.
        changed = {"display": "", "settings": {"volume": "0.30"}, "minutes": 0.1}
        self.posted(page, "/api/kiosks/kiosk-1/settings", changed)
        browser.wait("settings", lambda settings: settings["volume"] == 0.3)
        self.posted(page, "/api/kiosks/kiosk-1/open", {"scenario": "archimedes-screw", "minutes": 0.05})
        browser.wait("settings", lambda settings: settings["volume"] == 0.8)
        browser.wait("world", lambda world: world["scenario"] == "village")
        browser.wait("overlay", lambda overlay: not overlay["message"])
        wait_until(lambda: not self.ordered(page)["messages"] and not self.ordered(page)["changes"], 20, "all has ended")

        for path, body, field in (("/api/messages", {"texts": {"en": "x" * 300}, "minutes": 1}, "texts"),
                                  ("/api/messages", {"texts": {"en": "x"}}, "minutes"),
                                  ("/api/hours", {"museum": {"week": {"monday": ["18:00-10:00"]}}}, "museum.week.monday"),
                                  ("/api/kiosks/kiosk-1/settings", {**changed, "minutes": -1}, "minutes")):
            refused = self.posted(page, path, body, 400)
            self.assertTrue(refused["error"].startswith(field) and refused["remedy"], refused)
        actions = {e["action"] for e in json.loads(page.get("/api/audit")[2])["entries"]}
        self.assertLessEqual({"/api/messages", "ended"}, actions)
        self.assertEqual(process.stop(), 0, process.text())

    @marked("address")
    def test_maintenance_and_hours_outlast_a_killed_gateway(self):
        self.server(scenario=[VILLAGE, SCENARIO], records=False)
        process, page = self.gateway()
        browser = self.browser(page)
        self.posted(page, "/api/kiosks/kiosk-1/open", {"scenario": "archimedes-screw"})
        browser.wait("world", lambda world: world["scenario"] == "archimedes-screw")
        self.posted(page, "/api/kiosks/kiosk-1/maintenance", {"on": True})
        panel = browser.wait("overlay", lambda overlay: overlay["panel"])["panel"]
        self.assertEqual((panel["answers"], panel["leave"]), ([], None), "there is nothing to press")
        browser.wait("world", lambda world: world["scenario"] == "village")
        browser.wait("settings", lambda settings: settings["mute"])
        status, _, text = Page(page.port).get(f"/kiosk/kiosk-1?token={self.token}")
        self.assertEqual(status, 503)
        self.assertIn("Under maintenance", text.decode())
        process.kill()

        listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        listener.bind(("127.0.0.1", 0))
        listener.settimeout(20 * PATIENCE)
        self.addCleanup(listener.close)
        process, page = self.gateway("--wake-to", f"127.0.0.1:{listener.getsockname()[1]}")
        self.assertEqual(self.ordered(page)["maintenance"], {"kiosk-1": None})
        status, text = page.post("/api/kiosks/kiosk-1/maintenance", {"on": False})
        self.assertEqual(status, 200, text)
        browser = self.browser(page)

        # Closed all week; then open, which wakes the kiosk.
        mac = "02:00:5e:10:00:01"
        self.posted(page, "/api/hours", {"museum": CLOSED, "wake": {"kiosk-1": mac}})
        browser.wait("overlay", lambda overlay: overlay["panel"])
        process.kill()
        process, page = self.gateway("--wake-to", f"127.0.0.1:{listener.getsockname()[1]}")
        self.assertEqual(self.ordered(page)["hours"]["wake"], {"kiosk-1": mac})
        browser = self.browser(page)
        browser.wait("overlay", lambda overlay: overlay["panel"])
        self.posted(page, "/api/hours", {"museum": None, "wake": {"kiosk-1": mac}})
        browser.wait("overlay", lambda overlay: not overlay["panel"])
        packet = listener.recv(200)
        self.assertEqual(packet, b"\xff" * 6 + bytes.fromhex(mac.replace(":", "")) * 16)
        self.assertEqual(process.stop(), 0, process.text())

    @marked("draws")
    def test_a_native_display_shows_the_orders_and_starts_again(self):
        self.server(scenario=VILLAGE, records=False)
        display = self.start("display", "display", "--kiosk", "kiosk-1", "--name", "wall", "--offscreen", "--size", "320x180")
        process, page = self.gateway()
        wait_until(lambda: self.displays().get("wall", {}).get("link") == "joined", 60, "the display is there")
        self.posted(page, "/api/messages", {"texts": {"en": "We close at six."}, "kiosks": ["kiosk-1"], "minutes": 5})
        wait_until(lambda: self.setting("wall", "message-en") == "We close at six.", 20, "the display has the message")
        self.posted(page, "/api/kiosks/kiosk-1/maintenance", {"on": True, "minutes": 0.05})
        wait_until(lambda: self.setting("wall", "sign") == "maintenance", 20, "the display has the sign")
        wait_until(lambda: self.setting("wall", "sign") == "none", 20, "and takes it away in time")
        self.posted(page, "/api/kiosks/kiosk-1/restart", {"display": "nothing"}, 404)
        self.assertEqual(self.posted(page, "/api/kiosks/kiosk-1/restart", {"display": "wall"}), {"restarts": True})
        wait_until(lambda: not display.running(), 20, "the display ends; its service starts it again")
        self.assertEqual(process.stop(), 0, process.text())

    @marked("draws")
    def test_an_operator_with_a_phone(self):
        self.server(scenario=[VILLAGE, SCENARIO], records=False)
        process, page = self.gateway()
        browser = self.browser(page)
        self.environment["MECHANE_DRIVERS"] = str(DRIVERS)
        self.start("haptic", "haptic", "--device", "fake", "--kiosk", "kiosk-1", "--fifo-priority", "0")
        (device,) = wait_until(lambda: self.got(page, "/api/kiosks/kiosk-1/devices")["devices"], 30, "the kiosk's device is there")
        self.assertEqual((device["user"], device["request"]), (0, "none"))
        for order, status in (({"user": 0, "action": "dance"}, 400), ({"user": 3, "action": "test"}, 409)):
            self.assertTrue(self.posted(page, "/api/kiosks/kiosk-1/device", order, status)["remedy"])
        self.posted(page, "/api/kiosks/nowhere/device", {"user": 0, "action": "test"}, 404)
        result = subprocess.run(["node", ROOT / "client-sdk/web/tests/browser/console.mjs", f"http://127.0.0.1:{page.port}", self.password,
                                 "archimedes-screw"], capture_output=True, text=True, timeout=300 * PATIENCE)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        browser.wait("world", lambda world: world["scenario"] == "archimedes-screw")
        browser.wait("overlay", lambda overlay: overlay["message"] == "The museum closes at six.")
        # Neither this server nor this gateway has a key: the page told so.
        self.assertIn("--exhibit-key", self.posted(page, "/api/exhibits/village/replace", {}, 404)["remedy"])
        self.assertEqual(process.stop(), 0, process.text())


if __name__ == "__main__":
    unittest.main()
