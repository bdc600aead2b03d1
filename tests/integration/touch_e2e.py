"""A display's own hand, driven as a person drives it: a real window on a screen without glass, a pointer, pixels."""

import contextlib
import sys
import time
import unittest

from harness import ROOT, EndToEnd, repeat_until, wait_until
from touch import TouchVisitor

SIZE = (480, 270)


# Every activity whose visit takes something; the village's signs are clicked on, see visit_e2e.py.
TOUR = ("archimedes-screw/assemble archimedes-screw/use ktesibios-pump/assemble ktesibios-pump/use pulley-crane/use "
        "compound-pulley-crane/use catapult/use crossbow/use aiolos-sphere/use odometer/construct odometer/use").split()


def scenario_of(name):
    return ROOT / f"scenarios/{name}/{name}.x3d"


class Touch(EndToEnd):
    @contextlib.contextmanager
    def visitor_at(self, scenario):
        """A server, a window with the exhibit, and who touches it."""
        server = self.server(scenario=scenario_of(scenario), records=False)
        size = "x".join(map(str, SIZE))
        with self.screen(size) as environment:
            window = self.start("window", "display", "--kiosk", "wall", "--size", size, "--mute", "--ask", "none", environment=environment)
            visitor = TouchVisitor(scenario_of(scenario), "wall", SIZE, environment)
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


def tour(wanted):
    """Plays activities by touch alone and prints a line for each."""
    def one(stop):
        scenario, activity = stop.split("/")

        class Stop(Touch):
            def runTest(self):
                with self.visitor_at(scenario) as visitor:
                    self.begin(visitor, scenario, activity)
                    began = time.monotonic()
                    done = visitor.play(activity)
                    print(f"{stop:32} {'done' if done else 'NOT DONE'}  {time.monotonic() - began:5.0f} s  {'; '.join(visitor.story)}", flush=True)
        return Stop()
    unittest.TextTestRunner(verbosity=0).run(unittest.TestSuite(map(one, wanted or TOUR)))


if __name__ == "__main__":
    # Not in the suite, for it takes a quarter of an hour: touch_e2e.py tour [SCENARIO/ACTIVITY ...]
    if sys.argv[1:2] == ["tour"]:
        tour(sys.argv[2:])
    else:
        unittest.main(verbosity=2)
