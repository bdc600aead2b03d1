"""A visitor with one finger on a real page: plays a scenario's scripted visits in Chromium, by the rules of touch.py."""

import json
import math
import subprocess

from harness import ROOT, wait_until
from touch import TouchVisitor, dot, sub, turned_by


class PageScreen:
    """Where a point of the world is seen in the page's picture, as the page drew it last."""

    room = 1

    def __init__(self, view, width, height):
        *self.eye, x, y, z, w = view["pose"]
        self.right, self.up, back = (turned_by([w, x, y, z], axis) for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1]))
        self.ahead = [-c for c in back]
        self.across, self.high = math.tan(view["fov"] / 2) * view["aspect"], math.tan(view["fov"] / 2)
        self.offset, self.width, self.height = view["offset"], width, height

    def see_room(self, p, at):
        """The page tells its view."""

    def pixel(self, p, room=None):
        d = sub(p, self.eye)
        depth = dot(d, self.ahead)
        x = dot(d, self.right) / (depth * self.across) - self.offset[0]
        y = dot(d, self.up) / (depth * self.high) - self.offset[1]
        return (1 + x) / 2 * self.width, (1 - y) / 2 * self.height


class PageVisitor(TouchVisitor):
    def __init__(self, address, scenario, kiosk, size, environment):
        self.page = subprocess.Popen(["node", ROOT / "client-sdk/web/tests/browser/finger.mjs", address, "{}x{}".format(*size)],
                                     stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.size, self.down = size, False
        if not self.page.stdout.readline():
            raise AssertionError("the page did not open")
        super().__init__(scenario, kiosk, size, environment)
        self.see()

    def stop(self):
        super().stop()
        self.page.stdin.close()
        self.page.wait(60)
        self.page.stdout.close()

    def ask(self, do, **more):
        self.page.stdin.write(json.dumps({"do": do, **more}) + "\n")
        self.page.stdin.flush()
        answer = self.page.stdout.readline()
        if not answer:
            raise AssertionError(f"the page ended at '{do}'")
        return json.loads(answer)

    def see(self):
        """Takes the view as it is drawn now; closes a question that covers the machine."""
        seen = self.ask("look")
        if seen["panel"] and seen["panel"].get("leave"):
            self.ask("button", text=seen["panel"]["leave"]["text"])
            seen = wait_until(lambda: (s := self.ask("look")) and not s["panel"] and s, 20, "the question is gone")
        self.screen = PageScreen(seen["view"], *self.size)
        return seen

    def still(self):
        """Until the view follows the place of work no more."""
        before = self.see()["view"]

        def stands():
            nonlocal before
            last, before = before, self.see()["view"]
            return all(abs(a - b) < 1e-4 for a, b in zip([*last["pose"], last["fov"]], [*before["pose"], before["fov"]]))
        wait_until(stands, 30, "the view stands still")

    def xdo(self, *words):
        """As of a mouse: what the words of xdotool mean for a finger."""
        words = list(map(str, words))
        if words[:1] == ["mousemove"] and self.down:
            self.ask("move", at=self.glass())
        if "mousedown" in words:
            self.ask("press", at=self.glass())
            self.down = True
        if "mouseup" in words and self.down:
            self.ask("lift")
            self.down = False

    def glass(self):
        return {"x": min(max(self.at[0], 0), self.size[0] - 1), "y": min(max(self.at[1], 0), self.size[1] - 1)}

    def take(self, body, grip):
        self.still()
        return super().take(body, grip)
