"""The browser display at a real gateway: Chromium, a finger on its glass, the built app."""

import contextlib
import json
import re
import subprocess
import sys
import time
import unittest

from harness import PATIENCE, ROOT, EndToEnd, marked, wait_until
from page_visitor import PageVisitor

CRANE = ROOT / "scenarios/pulley-crane/pulley-crane.x3d"
SIZE = (480, 360)  # the processor draws
HAND_PROGRAM = 41021  # the test has a network of its own
# By touch, one activity of each exhibit whose good visit takes something (not the village's signs); by a camera's hand, a crank.
TOUR = ("archimedes-screw/use ktesibios-pump/use pulley-crane/use compound-pulley-crane/use catapult/use crossbow/use aiolos-sphere/use "
        "odometer/use camera").split()


def scenario_of(name):
    return ROOT / f"scenarios/{name}/{name}.x3d"


@marked("draws")
class Web(EndToEnd):
    def address(self, *options):
        """Of a kiosk's page, at a gateway of its own."""
        gateway = self.start("gateway", "gateway", "--listen", "127.0.0.1:0", "--kiosk", "kiosk-1", "--state", self.folder / "state",
                             *options)
        wait_until(lambda: "\nready" in gateway.text() or not gateway.running(), 60, "the gateway is ready")
        self.assertTrue(gateway.running(), gateway.text())
        return re.search(r"kiosk kiosk-1: (\S+)", gateway.text()).group(1)

    def in_browser(self, script, *arguments):
        result = subprocess.run(["node", ROOT / f"client-sdk/web/tests/browser/{script}.mjs", *arguments], capture_output=True, text=True,
                                timeout=300 * PATIENCE)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def test_a_crank_is_taken_again_after_a_reload_and_turned_by_touch(self):
        server = self.server(scenario=CRANE, records=False)
        told = json.loads(self.in_browser("turn", self.address()))
        self.assertEqual((told["first"], told["step"]), ("grasp", "lift"))
        self.assertIn("kiosk-1", server.text())

    def turn_by_camera(self):
        """A hand before a camera takes a crank, turns it by a quarter and lets go. Returns the radians."""
        self.server(scenario=CRANE, records=False)
        address = self.address("--hand-program", str(HAND_PROGRAM))
        return json.loads(self.in_browser("camera_turn", address, str(HAND_PROGRAM), "DRUM", "0.3,0,0.65"))["turned"]

    @contextlib.contextmanager
    def visitor_at(self, scenario, activity):
        """A server, a gateway, a page with the exhibit in an activity, and who touches it."""
        self.server(scenario=scenario_of(scenario), records=False)
        visitor = PageVisitor(self.address(), scenario_of(scenario), "kiosk-1", SIZE, self.environment)
        try:
            if visitor.status.now()["activity"] != activity:
                # Another program begins it, as a museum's own may, and is gone before it takes anything.
                other = self.start("other", "visitor", "--kiosk", "kiosk-1", "--scenario", scenario_of(scenario), "--activity", activity)
                wait_until(lambda: visitor.status.now()["activity"] == activity, 20, f"{activity} has begun")
                other.kill()
            yield visitor
            self.assertEqual(visitor.ask("look")["errors"], [])
        finally:
            visitor.stop()


def tour(wanted):
    """Plays good visits through the page by touch or a camera's hand; a line for each at the end. True when each was done."""
    table = []

    def one(stop):
        class Stop(Web):
            def runTest(self):
                began, done, story = time.monotonic(), False, []
                try:
                    if stop == "camera":
                        story = [f"turned by {self.turn_by_camera():.2f} rad"]
                        done = True
                        return
                    scenario, activity = stop.split("/")
                    with self.visitor_at(scenario, activity) as visitor:
                        story, began = visitor.story, time.monotonic()
                        # What was put down beside its place is taken up again.
                        done = visitor.play(activity, patience=15) or visitor.play(activity)
                        self.assertTrue(done, f"{stop}: {'; '.join(story)}")
                finally:
                    table.append(f"{stop:32} {'done' if done else 'NOT DONE':8} {time.monotonic() - began:5.0f} s  {'; '.join(story)}")
                    print(table[-1], file=sys.stderr, flush=True)
        return Stop()
    result = unittest.TextTestRunner(verbosity=0).run(unittest.TestSuite(map(one, wanted or TOUR)))
    print("\n".join(table), flush=True)
    return result.wasSuccessful()


if __name__ == "__main__":
    # Not in the suite, for it takes long where the processor draws: web_e2e.py tour [SCENARIO/ACTIVITY | camera ...]
    if sys.argv[1:2] == ["tour"]:
        sys.exit(0 if tour(sys.argv[2:]) else 1)
    else:
        unittest.main()
