"""A visitor with one finger: plays a scenario's scripted visits on a display's window, in pixels, by pressing, dragging and letting go."""

import json
import math
import subprocess
import threading
import time
import xml.etree.ElementTree

from harness import BIN, PATIENCE, wait_until

FINGER = 3  # the hand of the kiosk that a display takes


def add(a, b): return [x + y for x, y in zip(a, b)]
def sub(a, b): return [x - y for x, y in zip(a, b)]
def scaled(a, s): return [x * s for x in a]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
def unit(a): return scaled(a, 1 / math.sqrt(dot(a, a)))
def numbers(text): return [float(word) for word in text.split()]


def turned(axis_angle, v):
    """v, turned about x y z by an angle (Rodrigues)."""
    size = math.sqrt(dot(axis_angle[:3], axis_angle[:3]))
    if size < 1e-12:
        return v
    k, c, s = scaled(axis_angle[:3], 1 / size), math.cos(axis_angle[3]), math.sin(axis_angle[3])
    return add(add(scaled(v, c), scaled(cross(k, v), s)), scaled(k, dot(k, v) * (1 - c)))


def turned_by(q, v):
    w, u = q[0], q[1:]
    t = scaled(cross(u, v), 2)
    return add(add(v, scaled(t, w)), cross(u, t))


def placed(pose, p):
    return add(pose["p"], turned_by(pose["q"], p))


def back(pose, p):
    q = pose["q"]
    return turned_by([q[0], -q[1], -q[2], -q[3]], sub(p, pose["p"]))


def fields(node):
    return {child.get("name"): child.get("value", "").strip('"') for child in node}


class Screen:
    """Where a point of the world is seen: the first Viewpoint, as a display stands there, and the room that it makes above a long caption."""

    def __init__(self, scenario, width, height):
        view = next(scenario.iter("Viewpoint"))
        look = numbers(view.get("orientation", "0 0 1 0"))
        half = math.tan(float(view.get("fieldOfView", "0.785398")) / 2)
        self.half = half / (1 - 0.12)  # room for the caption
        self.eye, up = numbers(view.get("position")), turned(look, [0, 1, 0])
        self.ahead = unit(sub(turned(look, [0, 0, -1]), scaled(up, self.half - half)))
        self.right = unit(cross(self.ahead, up))
        self.up = cross(self.right, self.ahead)
        self.width, self.height = width, height
        self.room = 1

    def see_room(self, p, at):
        """What is at p is seen at a pixel: everything is smaller by so much, towards the middle of the upper edge."""
        (x, y), middle = self.framed(p), self.width / 2
        framed, seen = (x - middle, y), (at[0] - middle, at[1])
        self.room = min(max(dot(framed, seen) / max(dot(seen, seen), 1), 1), 1.8)

    def pixel(self, p, room=None):
        x, y = self.framed(p)
        return self.width / 2 + (x - self.width / 2) / (room or self.room), y / (room or self.room)

    def framed(self, p):
        d = sub(p, self.eye)
        share = self.height / 2 / (dot(d, self.ahead) * self.half)
        return self.width / 2 + dot(d, self.right) * share, self.height / 2 - dot(d, self.up) * share


class Watch:
    """The newest sample of a topic of a kiosk's world, as `mechane echo` prints it."""

    def __init__(self, topic, kiosk, environment):
        self._line = None
        self.process = subprocess.Popen([str(BIN / "mechane"), "echo", topic, "--kiosk", kiosk, "--count", "0", "--json"],
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=environment, text=True)
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.process.stdout:
            self._line = line

    def now(self):
        return json.loads(self._line) if self._line else None

    def stop(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


class TouchVisitor:
    def __init__(self, scenario, kiosk, size, environment):
        self.x3d = xml.etree.ElementTree.parse(scenario).getroot()
        self.screen = Screen(self.x3d, *size)
        self.kiosk, self.environment = kiosk, environment
        self.objects = {body.get("DEF"): i for i, body in enumerate(b for b in self.x3d.iter("RigidBody") if b.get("DEF"))}
        self.frames = Watch("SceneFrame", kiosk, environment)
        self.status = Watch("WorldStatus", kiosk, environment)
        self.story = []
        wait_until(lambda: self.frames.now() and self.status.now(), 30, "the kiosk has a world")

    def stop(self):
        self.frames.stop()
        self.status.stop()

    def visit(self, activity):
        """The moves of the first visit of an activity."""
        (visits,) = [node for node in self.x3d.iter("MetadataSet") if node.get("name") == "visits"]
        for visit in visits:
            if fields(visit).get("activity") == activity:
                return [fields(move) for move in visit if move.get("name").startswith("move:")]
        raise AssertionError(f"no visit of {activity}")

    def pose(self, body):
        index = self.objects[body]
        for other in self.frames.now()["bodies"]:
            if other["object"] == index:
                return other["X_WB"]
        (node,) = [b for b in self.x3d.iter("RigidBody") if b.get("DEF") == body]
        look = numbers(node.get("orientation", "0 0 1 0"))
        s = math.sin(look[3] / 2)
        return {"p": numbers(node.get("position", "0 0 0")), "q": [math.cos(look[3] / 2), *scaled(unit(look[:3]), s)]}

    def hand(self):
        return next((h for h in self.frames.now()["hands"] if h["kiosk"] == self.kiosk and h["user"] == FINGER), None)

    def holding(self):
        hand = self.hand()
        return hand is not None and hand["holding"]

    def done(self, activity):
        status = self.status.now()
        return status["activity"] != activity or status["done"]

    def xdo(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self.environment, stderr=subprocess.DEVNULL, check=True)

    def point(self, at, *more):
        self.at = at
        self.xdo("mousemove", round(at[0]), round(at[1]), *more)

    def drag(self, way, seconds):
        """Along way(0..1), at some 25 places a second; slower where pictures come late, for a person waits for what is seen."""
        seconds *= PATIENCE
        began = time.monotonic()
        while (share := (time.monotonic() - began) / seconds) < 1:
            self.point(way(share))
            time.sleep(0.03)  # sleeps: the pace
        self.point(way(1))

    def take(self, body, grip):
        """Presses on it where its grip is seen, and again beside it, as a person does who sees that nothing was taken. How much room the view
        makes is not known before something is held."""
        rooms = [(room, (0, 0)) for room in dict.fromkeys((self.screen.room, 1, 1.04, 1.08))]
        for room, aside in rooms + [(self.screen.room, aside) for aside in ((5, 0), (-5, 0), (0, 5), (0, -5))]:
            at = self.screen.pixel(placed(self.pose(body), grip), room)
            self.point((at[0] + aside[0], at[1] + aside[1]), "mousedown", 1)
            try:
                wait_until(self.holding, 5, "it is held")
                p_WH = self.hand()["X_WS"][0]["p"]
                self.p_BH = back(self.pose(body), p_WH)
                self.screen.see_room(p_WH, self.at)
                return True
            except AssertionError:
                self.xdo("mouseup", 1)
        return False

    def carry(self, body, move):
        look = numbers(move.get("orientation", "0 0 1 0"))
        goal = self.screen.pixel(add(numbers(move["position"]), turned(look, self.p_BH)))
        begin = self.at
        self.drag(lambda s: tuple(b + s * (g - b) for b, g in zip(begin, goal)), float(move.get("seconds", 1)))
        if not self.arrives():
            self.story.append(f"{body} lags")

    def behind(self):
        """How far the hand that holds something is seen from the finger, in pixels; 0 for an empty hand."""
        hand = self.hand()
        return math.dist(self.screen.pixel(hand["X_WS"][0]["p"]), self.at) if hand is not None and hand["holding"] else 0

    def arrives(self):
        """As a person, looks whether the hand has come to the finger, before going on; what is stuck does not come."""
        try:
            return wait_until(lambda: self.behind() < 0.03 * self.screen.height, 3, "the hand is under the finger")
        except AssertionError:
            return False

    def circle(self, joint):
        """The way round, as the display's dots show it: way(angle) in pixels, and the larger half axis."""
        (node,) = [j for j in self.x3d.iter("SingleAxisHingeJoint") if j.get("DEF") == joint]
        axis, anchor = unit(numbers(node.get("axis"))), numbers(node.get("anchorPoint"))
        hand = self.hand()["X_WS"][0]["p"]
        middle = add(anchor, scaled(axis, dot(sub(hand, anchor), axis)))
        arm = sub(hand, middle)
        m = self.screen.pixel(middle)
        x = [a - b for a, b in zip(self.screen.pixel(add(middle, arm)), m)]
        y = [a - b for a, b in zip(self.screen.pixel(add(middle, cross(axis, arm))), m)]
        # The ellipse's half axes (of x cos + y sin), the smaller one never below 0.4 of the larger: nobody drags round a line.
        t0 = 0.5 * math.atan2(2 * (x[0] * y[0] + x[1] * y[1]), dot(x, x) - dot(y, y))
        at = lambda t: [x[i] * math.cos(t) + y[i] * math.sin(t) for i in range(2)]
        major, minor = at(t0), at(t0 + math.pi / 2)
        size, small = math.hypot(*major), math.hypot(*minor)
        if small < 0.4 * size:
            side = -1 if major[0] * minor[1] - major[1] * minor[0] < 0 else 1
            minor = [-major[1] * 0.4 * side, major[0] * 0.4 * side]
        way = lambda t: tuple(m[i] + major[i] * math.cos(t - t0) + minor[i] * math.sin(t - t0) for i in range(2))
        return way, size

    def work(self, move, activity, last):
        way, size = self.circle(move["joint"])
        if move["kind"] == "turn":
            whole = 2 * math.pi * float(move["turns"])
            rate = 2 * math.pi * float(move.get("rpm", 20)) / 60
            angle = lambda t: math.copysign(rate * t, whole)
            seconds = abs(whole) / rate
        else:
            rate = 2 * math.pi * float(move.get("perMinute", 20)) / 60
            angle = lambda t: float(move["angle"]) * math.sin(rate * t)
            seconds = 2 * math.pi * float(move.get("cycles", 1)) / rate
        step = self.status.now()["step"]
        # A heavy crank comes after the finger, and a screw that is turned in jerks spills: who sees that it is not over goes on.
        goes_on = lambda t: t < seconds or last or (t < 1.3 * seconds and self.status.now()["step"] == step)
        # Where pictures come late, the hand is seen far behind the finger: a person waits for it, not for ever.
        t, before, end = 0, time.monotonic(), time.monotonic() + 5 * seconds * PATIENCE
        while goes_on(t) and not self.done(activity) and before < end:
            self.point(way(angle(t)))
            time.sleep(0.03)  # sleeps: the pace
            now = time.monotonic()
            t, before = t if self.behind() > size else t + now - before, now

    def play(self, activity, patience=60):
        """True when the activity is done."""
        body, grip = None, None
        moves = self.visit(activity)
        work = [i for i, move in enumerate(moves) if move["kind"] in ("reach", "move_to", "turn", "swing")]
        for i, move in enumerate(moves):
            if self.done(activity):
                break
            kind = move["kind"]
            if kind == "reach":
                body, grip = move["body"], numbers(move["grip"])
            elif kind == "grasp":
                self.story.append(f"take {body}: {self.take(body, grip)}")
            elif kind == "move_to" and self.holding():
                self.carry(body, move)
            elif kind in ("turn", "swing") and self.holding():
                self.work(move, activity, last=i == work[-1])
                self.story.append(f"{kind}: still held {self.holding()}, at step {self.status.now()['step']}")
            elif kind == "release":
                time.sleep(0.3)  # sleeps: as a person, who holds still before letting go
                self.xdo("mouseup", 1)
                wait_until(lambda: not self.holding(), 5, "it is let go")
            elif kind == "wait":
                end = time.monotonic() + float(move.get("seconds", 1))
                while time.monotonic() < end and not self.done(activity):
                    time.sleep(0.1)  # sleeps: between two looks
        self.xdo("mouseup", 1)
        end = time.monotonic() + patience * PATIENCE
        while not self.done(activity) and time.monotonic() < end:
            time.sleep(0.1)  # sleeps: between two looks
        return self.done(activity)
