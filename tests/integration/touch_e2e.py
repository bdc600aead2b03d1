"""A display's own hand, driven as a person drives it: a real window on a screen without glass, a pointer, pixels."""

import subprocess
import sys
import time
import unittest

from harness import ROOT, EndToEnd, repeat_until, wait_until
from touch import TouchVisitor

SIZE = (480, 270)


def scenario_of(name):
    return ROOT / f"scenarios/{name}/{name}.x3d"


class Touch(EndToEnd):
    def play(self, scenario, activity):
        """Plays one activity by touch alone; those before it are begun by nobody, so it is started by a program."""
        self.server(scenario=scenario_of(scenario), records=False)
        with self.screen("x".join(map(str, SIZE))) as environment:
            window = self.start("window", "display", "--kiosk", "wall", "--size", "x".join(map(str, SIZE)), "--mute", "--ask", "none",
                                environment=environment)
            visitor = TouchVisitor(scenario_of(scenario), "wall", SIZE, environment)
            try:
                begins_with = visitor.status.now()["activities"][0]
                if activity != begins_with:
                    # Whom another visitor's program begins it for, as a museum's own may; it is gone before it has reached out.
                    other = self.start("other", "visitor", "--kiosk", "wall", "--scenario", scenario_of(scenario), "--activity", activity)
                    wait_until(lambda: visitor.status.now()["activity"] == activity, 20, f"{activity} has begun")
                    other.kill()
                began = time.monotonic()
                done = visitor.play(activity)
                story = f"{visitor.story}, {visitor.status.now()['step']}, {time.monotonic() - began:.0f} s"
                return done, story
            finally:
                visitor.stop()
                self.assertEqual(window.stop(), 0, window.text())


if __name__ == "__main__":
    unittest.main(verbosity=2)
