"""A display's own hand, driven as a person drives it: a real window on a screen without glass, a pointer, pixels."""

import contextlib
import itertools
import math
import signal
import subprocess
import sys
import time
import unittest

from cursor import Cursor
from glass import Glass, NoGlass
from harness import ROOT, EndToEnd, marked, repeat_until, wait_until
from touch import TouchVisitor, dot, numbers, placed, sub, turned_by

SIZE = (480, 270)


# Every activity whose visit takes something; the village's signs are clicked on, see visit_e2e.py.
TOUR = ("archimedes-screw/assemble archimedes-screw/use ktesibios-pump/assemble ktesibios-pump/use pulley-crane/use "
        "compound-pulley-crane/use catapult/use crossbow/use aiolos-sphere/use odometer/construct odometer/use").split()


def scenario_of(name):
    return ROOT / f"scenarios/{name}/{name}.x3d"


@marked("alone")
class Touch(EndToEnd):
    @contextlib.contextmanager
    def visitor_at(self, scenario):
        """A server, a window with the exhibit, and who touches it."""
        server = self.server(scenario=scenario_of(scenario), records=False)
        size = "x".join(map(str, SIZE))
        with self.screen(size) as environment:
            window = self.start("window", "display", "--kiosk", "wall", "--size", size, "--mute", "--still-view", "--ask", "none",
                                "--out", self.folder / "pictures", environment=environment)
            visitor = TouchVisitor(scenario_of(scenario), "wall", SIZE, environment)
            visitor.server, visitor.window = server, window
            try:
                self.assertNotIn("wall (user 3", server.text(), "a hand that nobody touches with")
                yield visitor
                self.assertIn("wall (user 3, mechane-display", server.text())
            finally:
                visitor.stop()
                self.assertEqual(window.stop(), 0, window.text())

    def begin(self, visitor, scenario, activity):
        """Lets another program begin it, as a museum's own may; it is gone before it has reached out."""
        if visitor.status.now()["activity"] == activity:
            return
        other = self.start("other", "visitor", "--kiosk", "wall", "--scenario", scenario_of(scenario), "--activity", activity)
        wait_until(lambda: visitor.status.now()["activity"] == activity, 20, f"{activity} has begun")
        other.kill()

    def test_the_screw_is_put_together_and_turned_by_touch_alone(self):
        with self.visitor_at("archimedes-screw") as visitor:
            self.assertTrue(visitor.play("assemble"), visitor.story)
            go_on = (410, 238)  # the button, left of the language's
            repeat_until(lambda: visitor.point(go_on, "click", 1), lambda: visitor.status.now()["activity"] == "use", 30, "the next activity")
            self.assertTrue(visitor.play("use"), visitor.story)

    def test_a_load_is_lifted_and_guided_by_touch_alone(self):
        with self.visitor_at("pulley-crane") as visitor:
            self.assertTrue(visitor.play("use"), visitor.story)

    def test_a_load_is_lifted_by_keys_alone(self):
        with self.visitor_at("pulley-crane") as visitor:
            def take():
                if not visitor.holding():  # the key that takes lets go, too
                    visitor.xdo("key", "Tab", "key", "space")
            repeat_until(take, visitor.holding, 60, "Tab and Space take the crank")
            visitor.xdo("key", "space")
            wait_until(lambda: not visitor.holding(), 10, "Space lets go")
            repeat_until(take, visitor.holding, 60, "and takes again")
            step = lambda: visitor.status.now()["step"]
            wait_until(lambda: step() == "lift", 10, "the crank is taken")
            # The load goes up with positive turns of the drum; Right turns as a clock goes, for who sees it.
            (axle,) = [j for j in visitor.x3d.iter("SingleAxisHingeJoint") if j.get("DEF") == "AXLE"]
            axis, middle = numbers(axle.get("axis")), numbers(axle.get("anchorPoint"))
            key = "Left" if dot(axis, sub(visitor.screen.eye, middle)) > 0 else "Right"
            m = visitor.screen.pixel(middle)

            def seen_angle():
                x, y = visitor.screen.pixel(visitor.hand()["X_WS"][0]["p"])
                return math.atan2(y - m[1], x - m[0])
            still = seen_angle()
            turned = lambda: math.remainder(seen_angle() - still, 2 * math.pi)
            visitor.xdo("keydown", key)
            way = wait_until(lambda: abs(turned()) > 0.4 and turned(), 20, "the hand goes round")
            self.assertEqual(way > 0, key == "Right", "as a clock goes")
            wait_until(lambda: step() == "guide", 60, f"{key}, held, turns the crank until the load is up")
            visitor.xdo("keyup", key)
            self.keys_that_change_the_picture(visitor)

    def keys_that_change_the_picture(self, visitor):
        """In a world that stands still, only a key changes a picture."""
        visitor.server.process.send_signal(signal.SIGSTOP)
        wait_until(lambda: {d["link"] for d in self.displays().values()} == {"lost"}, 30, "the window knows of no server")
        shown = [self.still_picture(visitor.window, 9)]  # some words are said for 8 s
        for key in ("l", "plus", "c"):
            visitor.xdo("key", key)
            wait_until(lambda: self.picture(visitor.window) not in shown, 10, f"the key {key} changes the picture")
            shown.append(self.still_picture(visitor.window, 2))
        self.assertEqual(len(set(shown)), 4, "each key does something else")
        visitor.server.process.send_signal(signal.SIGCONT)

    def test_what_is_under_the_pointer_is_named_or_lit(self):
        server = self.server(scenario=scenario_of("village"), records=False)
        size = "x".join(map(str, SIZE))
        with self.screen(size) as environment:
            # In `high` the same scene is the same picture, to the bit.
            window = self.start("window", "display", "--kiosk", "wall", "--size", size, "--quality", "high", "--mute",
                                "--out", self.folder / "pictures", environment=environment)
            visitor = TouchVisitor(scenario_of("village"), "wall", SIZE, environment)
            self.addCleanup(visitor.stop)
            wait_until(lambda: {d["link"] for d in self.displays().values()} == {"joined"}, 30, "the window shows the village")
            # In a world that stands still, only the pointer changes a picture.
            server.process.send_signal(signal.SIGSTOP)
            wait_until(lambda: {d["link"] for d in self.displays().values()} == {"lost"}, 30, "the window knows of no server")

            def seen(body, p):
                visitor.point(visitor.screen.pixel(placed(visitor.pose(body), p)))
            wall, board = [0, 0.6, 0.5], [0, -0.106, 0.01]
            seen("STAND", wall)
            shown = [self.still_picture(window, 9)]  # the goal is said for 8 s to who comes
            for body, p in (("SIGN_SCREW", board), ("SIGN_PUMP", board), ("STAND", wall), ("SIGN_SCREW", board)):
                seen(body, p)
                wait_until(lambda: self.picture(window) != shown[-1], 10, f"another picture over {body}")
                shown.append(self.still_picture(window))
            self.assertEqual(len(set(shown)), 3, "each name is another")
            self.assertEqual(shown[3], shown[0], "what has no name shows none")
            self.assertEqual(shown[4], shown[1])
            visitor.point((round(0.945 * SIZE[0]), round(0.906 * SIZE[1])))  # the button of the other language
            wait_until(lambda: self.picture(window) not in shown, 10, "the button under the pointer is lit")
            self.assertNotIn(self.still_picture(window), shown)
            server.process.send_signal(signal.SIGCONT)
            self.assertEqual(window.stop(), 0, window.text())

    def test_a_mouse_that_rests_is_not_seen_full_screen(self):
        with self.screen("320x240") as environment:
            window = self.start("window", "display", "--kiosk", "wall", "--full-screen", "--size", "320x240", "--mute", environment=environment)
            cursor = Cursor(environment)
            xdo = lambda *words: subprocess.run(["xdotool", *words], env=environment, stderr=subprocess.DEVNULL, check=True)
            wait_until(lambda: not cursor.seen(), 30, "the mouse rests")
            # As long as it moves it is seen; and in a window that leaves some of the screen free.
            xdo("mousemove", "100", "90")
            wait_until(cursor.seen, 10, "the mouse moves")
            wait_until(lambda: not cursor.seen(), 10, "the mouse rests again")
            xdo("key", "F11")
            wait_until(cursor.seen, 10, "the window does not fill the screen")
            xdo("key", "F11")
            wait_until(lambda: not cursor.seen(), 10, "the window fills the screen again")
            cursor.close()
            self.assertEqual(window.stop(), 0, window.text())

    def test_after_a_finger_no_mouse_is_seen_until_it_moves(self):
        try:
            glass = Glass(self.folder, self.environment)
        except NoGlass as reason:
            self.skipTest(str(reason))
        self.addCleanup(glass.stop)
        # In a window, for full screen a mouse that rests goes by itself.
        window = self.start("window", "display", "--kiosk", "wall", "--size", "640x360", "--mute", environment=glass.environment)
        cursor = Cursor(glass.environment)
        wander = itertools.cycle((200, 240))

        def move():
            subprocess.run(["xdotool", "mousemove", str(next(wander)), "150"], env=glass.environment, stderr=subprocess.DEVNULL, check=True)

        def touch():
            glass.press(1, (300, 200))
            glass.lift(1)
        repeat_until(touch, lambda: not cursor.seen(), 30, "a finger came", again_s=2)
        repeat_until(move, cursor.seen, 30, "the mouse moves", again_s=2)
        repeat_until(touch, lambda: not cursor.seen(), 10, "another finger came", again_s=2)
        cursor.close()
        self.assertEqual(window.stop(), 0, window.text())

    def test_two_fingers_on_glass_carry_turn_and_bring_nearer(self):
        self.server(scenario=scenario_of("aiolos-sphere"), records=False)
        try:
            glass = Glass(self.folder, self.environment)
        except NoGlass as reason:
            self.skipTest(str(reason))
        self.addCleanup(glass.stop)
        window = self.start("window", "display", "--kiosk", "wall", "--full-screen", "--size", "320x240", "--mute", "--still-view",
                            "--ask", "none", environment=glass.environment)
        visitor = TouchVisitor(scenario_of("aiolos-sphere"), "wall", glass.SIZE, glass.environment)
        self.addCleanup(visitor.stop)
        x, y = visitor.screen.pixel(placed(visitor.pose("TORCH"), [0, 0, 0.06]))

        def take():
            glass.lift(1)
            glass.press(1, (x, y))
        repeat_until(take, visitor.holding, 60, "one finger takes the torch")

        def seen_turned():
            """How far the torch has turned about the line of sight, as the hands of a clock go."""
            level = turned_by(visitor.pose("TORCH")["q"], visitor.screen.right)
            return math.degrees(math.atan2(-dot(level, visitor.screen.up), dot(level, visitor.screen.right)))

        def depth():
            return dot(sub(visitor.hand()["X_WS"][0]["p"], visitor.screen.eye), visitor.screen.ahead)

        def seen_at():
            return visitor.screen.pixel(visitor.hand()["X_WS"][0]["p"])
        # Up into free air, and a second finger beside the first.
        y -= 100
        for k in range(21):
            glass.move(1, (x, y + 100 - 5 * k))
        wait_until(lambda: math.dist(seen_at(), (x, y)) < 15, 10, "it has come up")
        self.assertLess(abs(seen_turned()), 8)
        glass.press(2, (x + 80, y))
        for k in range(1, 31):
            angle = math.radians(2 * k)
            for finger, side in ((1, -40), (2, 40)):
                glass.move(finger, (x + 40 + side * math.cos(angle), y + side * math.sin(angle)))
        wait_until(lambda: 45 < seen_turned() < 75, 10, "it turns as the fingers do")
        before = depth()
        for k in range(1, 31):
            for finger, side in ((1, -40 - k / 3), (2, 40 + k / 3)):
                glass.move(finger, (x + 40 + side * 0.5, y + side * 0.866))
        wait_until(lambda: abs(depth() / before - 40 / 50) < 0.06, 10, "it comes as they spread")
        # The first finger leaves: the other holds on, and nothing jumps.
        there = seen_at()
        glass.lift(1)
        glass.move(2, (x + 40 + 25, y + 43 + 10))
        wait_until(lambda: math.dist(seen_at(), (there[0], there[1] + 10)) < 6, 10, "the other finger goes on with it")
        self.assertTrue(visitor.holding())
        glass.lift(2)
        wait_until(lambda: not visitor.holding(), 10, "no finger holds it")
        self.assertEqual(window.stop(), 0, window.text())


def tour(wanted):
    """Plays activities by touch alone; a line for each at the end. True when each was done."""
    table = []

    def one(stop):
        scenario, activity = stop.split("/")

        class Stop(Touch):
            def runTest(self):
                began, done, story = time.monotonic(), False, []
                try:
                    with self.visitor_at(scenario) as visitor:
                        story = visitor.story
                        self.begin(visitor, scenario, activity)
                        began = time.monotonic()
                        # What was put down beside its place is taken up again.
                        done = visitor.play(activity, patience=15) or visitor.play(activity)
                        self.assertTrue(done, f"{stop}: {'; '.join(story)}")
                finally:
                    table.append(f"{stop:32} {'done' if done else 'NOT DONE':8} {time.monotonic() - began:5.0f} s  {'; '.join(story)}")
        return Stop()
    result = unittest.TextTestRunner(verbosity=0).run(unittest.TestSuite(map(one, wanted or TOUR)))
    print("\n".join(table), flush=True)
    return result.wasSuccessful()


if __name__ == "__main__":
    # Not in the suite, for it takes a quarter of an hour: touch_e2e.py tour [SCENARIO/ACTIVITY ...]
    if sys.argv[1:2] == ["tour"]:
        sys.exit(0 if tour(sys.argv[2:]) else 1)
    else:
        unittest.main(verbosity=2)
