"""The eight machines where they are used in the village, in their true size and seen from afar; each has an exhibit of its own, which shows it closely."""
import math

import numpy as np

from modelling import Shape, lathe, tube
from surfaces import mix
from village_place import RIVER_Y, TEMPLE, height_at, river_x, road_x
from village_shapes import beam, box, flames, pole, put


def add(model, scene, name, shapes, smooth=40):
    for what, shape in shapes.items():
        if shape.faces:
            model.add(f"visual_{name}_{what}", shape, [what], scene, smooth)


def make_screw(model, scene):
    """From the river up to a gutter that waters the field."""
    z = -7.4
    foot = np.array([river_x(z) + 1.35, RIVER_Y - 0.05, z])
    along = np.array([math.cos(math.radians(33)), math.sin(math.radians(33)), 0.0])
    head = foot + 2.7 * along
    wood, hoops, stone, water = Shape(), Shape(), Shape(), Shape()
    lathe(wood, [(0.0, 0.06), (0.22, 0.06), (0.25, 0.0), (0.27, 0.0), (0.27, 2.62), (0.25, 2.62), (0.22, 2.5), (0.0, 2.5)], 20, foot, along, (0, 0, 1), uv_scale=(3, 1 / 2.3))
    for t in (0.12, 0.9, 1.7, 2.5):
        lathe(hoops, [(0.272, t - 0.03), (0.285, t - 0.025), (0.285, t + 0.025), (0.272, t + 0.03)], 20, foot, along, (0, 0, 1), uv_scale=(2, 4))
    pole(wood, foot - 0.25 * along, head + 0.35 * along, 0.055, sides=10, seed=3)
    for s in (-1, 1):  # the trestle that bears its head, and a rail to hold while treading
        top = head + 0.1 * along + (0, 0.05, s * 0.42)
        pole(wood, (top[0] + 0.1, -0.1, top[2] + s * 0.15), tuple(top + (0, 0.85, 0)), 0.055, sides=8, seed=5 + s)
    for y in (-0.34, 0.80):
        pole(wood, tuple(head + 0.1 * along + (0, y, -0.5)), tuple(head + 0.1 * along + (0, y, 0.5)), 0.05, sides=8, seed=9)
    for k in range(8):  # treads round the barrel
        a = 2 * math.pi * k / 8
        side, up = np.array([0, 0, 1.0]), np.cross(np.array([0, 0, 1.0]), along)
        out = 0.28 * (math.cos(a) * side + math.sin(a) * up)
        beam(wood, tuple(foot + 1.75 * along + out), tuple(foot + 2.15 * along + out), 0.05, 0.05, up=tuple(out), seed=k)
    g = head + (0.05, -0.52, 0)
    for s in (-1, 1):
        beam(wood, (g[0] - 0.1, g[1], z + s * 0.20), (g[0] + 1.25, g[1] - 0.14, z + s * 0.20), 0.04, 0.20, seed=3)
    beam(wood, (g[0] - 0.1, g[1] - 0.09, z), (g[0] + 1.25, g[1] - 0.23, z), 0.40, 0.03, seed=4)
    beam(water, (g[0], g[1] - 0.02, z), (g[0] + 1.26, g[1] - 0.16, z), 0.34, 0.04)
    for x in (0.3, 1.1):
        pole(wood, (g[0] + x, -0.1, z), (g[0] + x, g[1] - 0.08 - 0.06 * x, z), 0.05, sides=7)
    box(stone, (g[0] + 0.85, -0.15, z - 0.55), (g[0] + 1.95, 0.36, z + 0.55), 1.2)
    add(model, scene, "screw", {"planks": wood, "bronze": hoops, "limestone": stone, "paint_water": water})


def make_pump(model, scene):
    """Over the cistern before the house: two cylinders in a frame, the beam, the jet's pipe."""
    x, z = 4.1, -5.9
    stone, wood, bronze, iron = Shape(), Shape(), Shape(), Shape()
    lathe(stone, [(0.50, 0.0), (0.72, 0.0), (0.70, 0.66), (0.74, 0.70), (0.74, 0.80), (0.52, 0.80), (0.50, 0.74), (0.50, 0.1), (0.0, 0.1)], 22, (x, 0, z), (0, 1, 0), (0, 0, 1), uv_scale=(3, 0.8))
    for s in (-1, 1):
        beam(wood, (x + s * 0.16, 0.82, z - 0.66), (x + s * 0.16, 0.82, z + 0.66), 0.12, 0.10, seed=2 + s)
        lathe(bronze, [(0, 0), (0.13, 0), (0.13, 0.04), (0.11, 0.06), (0.11, 0.50), (0.13, 0.52), (0.13, 0.55), (0.09, 0.55), (0, 0.50)], 16, (x + s * 0.33, 0.80, z), (0, 1, 0), (0, 0, 1), uv_scale=(1.5, 1.5))
        pole(iron, (x + s * 0.33, 1.25, z), (x + s * 0.35, 1.78 + s * 0.10, z), 0.02, sides=7)
    pole(bronze, (x, 0.86, z), (x, 1.55, z), 0.075, 0.05, 12)
    tube(bronze, [(x, 1.5, z), (x, 1.72, z + 0.02), (x + 0.02, 1.84, z + 0.16), (x + 0.02, 1.84, z + 0.42)], 0.035, 8)
    for s in (-1, 1):
        beam(wood, (x + s * 0.07, 0.85, z - 0.30), (x + s * 0.07, 1.95, z - 0.12), 0.08, 0.09, up=(0, 0, 1), seed=7 + s)
    beam(wood, (x - 1.15, 1.55, z - 0.08), (x + 1.15, 2.05, z - 0.08), 0.09, 0.11, seed=5)
    pole(wood, (x - 1.08, 1.58, z - 0.5), (x - 1.08, 1.58, z + 0.4), 0.035, sides=8)
    add(model, scene, "pump", {"limestone": stone, "planks": wood, "bronze": bronze, "iron": iron})


def sheave(shape, at, radius=0.13, axis=(0, 0, 1)):
    r = radius
    lathe(shape, [(0, -0.05), (r, -0.05), (r, -0.03), (r - 0.03, 0.0), (r, 0.03), (r, 0.05), (0, 0.05)], 16, at, axis, (0, 1, 0) if axis[1] == 0 else (1, 0, 0), uv_scale=(1, 4))


def shears(wood, rope, foot, head, spread, stays):
    """Two legs that meet at the head, tied by crossbars, held by ropes to pegs."""
    foot, head = np.asarray(foot, float), np.asarray(head, float)
    way = head - foot
    across = np.cross(way, (0, 1, 0))
    across /= np.linalg.norm(across)
    for s in (-1, 1):
        pole(wood, tuple(foot + s * spread * across - (0, 0.1, 0)), tuple(head + s * 0.10 * across), 0.11, 0.08, 10, seed=3 + s)
    for t in (0.32, 0.62):
        p, half = foot + way * t, mix(spread, 0.1, t) + 0.12
        pole(wood, tuple(p - half * across), tuple(p + half * across), 0.05, sides=7, seed=int(10 * t))
    p = foot + way * 0.14
    pole(wood, tuple(p - (spread + 0.2) * across), tuple(p + (spread + 0.2) * across), 0.12, sides=10, seed=8)  # the winch
    for s in (-1, 1):
        for k in range(2):
            a = 0.6 + k * math.pi / 2
            reach = 0.5 * (math.cos(a) * np.array([0, 1, 0]) + math.sin(a) * way / np.linalg.norm(way))
            end = p + s * (spread + 0.1) * across
            pole(wood, tuple(end - reach), tuple(end + reach), 0.025, sides=6)
    for k in range(5):
        ring = [p + 0.06 * (k - 2) * across + 0.135 * np.array([math.sin(a), math.cos(a), 0]) for a in np.linspace(0, 2 * math.pi, 13)]
        tube(rope, ring, 0.022, 5)
    for q in stays:
        tube(rope, [tuple(head), tuple(mix(head, np.asarray(q, float), 0.5) - (0, 0.12, 0)), q], 0.018, 5)
        pole(wood, (q[0], q[1] - 0.2, q[2]), (q[0], q[1] + 0.3, q[2]), 0.06, sides=6)
    return p


def make_crane(model, scene):
    """Vitruvius' two legs with one pulley, by the wall that is being built: a stone hangs over its place."""
    wood, rope, stone, bronze, iron = Shape(), Shape(), Shape(), Shape(), Shape()
    z = -12.6
    head = np.array([5.05, 5.0, z + 0.25])
    foot = (4.75, 0.0, z + 2.0)
    winch = shears(wood, rope, foot, head, 0.95, [(3.4, 0.0, z + 5.6), (4.9, 0.0, z + 6.2), (2.6, 0.05, z - 5.0)])
    block_y = 4.45
    tube(rope, [tuple(head), (head[0], block_y, head[2])], 0.02, 5)
    sheave(wood, (head[0], block_y - 0.1, head[2]), 0.15)
    for s in (-1, 1):
        box(iron, (head[0] - 0.05, block_y - 0.25, head[2] + s * 0.075 - 0.012), (head[0] + 0.05, block_y + 0.1, head[2] + s * 0.075 + 0.012))
    tube(rope, [(head[0] - 0.14, block_y - 0.1, head[2]), tuple(winch + (-0.1, 0.1, 0))], 0.02, 5)
    tube(rope, [(head[0] + 0.14, block_y - 0.1, head[2]), (head[0] + 0.10, 3.05, head[2])], 0.02, 5)
    y = 2.25
    box(stone, (head[0] - 0.30, y, head[2] - 0.45), (head[0] + 0.50, y + 0.40, head[2] - 0.05), 1.4, 0, 9)
    for s in (-1, 1):
        for t in (-0.43, -0.07):
            tube(rope, [(head[0] + 0.10, 3.05, head[2] - 0.1), (head[0] + 0.1 + s * 0.38, y + 0.40, head[2] + t)], 0.014, 4)
    tube(rope, [(head[0] + 0.10, 3.05, head[2]), (head[0] + 0.10, 3.05, head[2] - 0.1)], 0.03, 5)
    add(model, scene, "crane", {"planks": wood, "hemp": rope, "limestone": stone, "bronze": bronze, "iron": iron})


def make_compound_crane(model, scene):
    """Larger, with a block of several sheaves, at the temple: the third drum of the column is on its way up."""
    wood, rope, stone, iron = Shape(), Shape(), Shape(), Shape()
    x, z = TEMPLE[0] - 3.3, TEMPLE[1] - 0.45
    head = np.array([x - 0.1, 8.2, z + 0.05])
    winch = shears(wood, rope, (x - 2.7, height_at(x - 2.7, z + 2.8), z + 2.8), head, 1.2, [(x - 4.9, 0.1, z + 5.5), (x + 2.2, 0.1, z + 7.0), (x - 5.0, 0.2, z - 6.0)])
    low = 4.9
    for p in (7.55, low):
        for dx in (-0.11, 0.11):
            sheave(wood, (head[0] + dx, p, head[2]), 0.17, (1, 0, 0))
        box(iron, (head[0] - 0.24, p - 0.26, head[2] - 0.05), (head[0] - 0.19, p + 0.26, head[2] + 0.05))
        box(iron, (head[0] + 0.19, p - 0.26, head[2] - 0.05), (head[0] + 0.24, p + 0.26, head[2] + 0.05))
    tube(rope, [tuple(head), (head[0], 7.75, head[2])], 0.03, 5)
    for dx in (-0.11, 0.11):
        for dz in (-0.17, 0.17):
            tube(rope, [(head[0] + dx, 7.55, head[2] + dz), (head[0] + dx, low, head[2] + dz)], 0.018, 5)
    tube(rope, [(head[0] - 0.11, 7.6, head[2] + 0.17), tuple(winch + (0, 0.15, 0))], 0.02, 5)
    y = 3.45
    lathe(stone, [(0, 0), (0.385, 0), (0.37, 0.79), (0, 0.79)], 16, (head[0], y, head[2]), (0, 1, 0), (0, 0, 1), uv_scale=(1.6, 0.7))
    for a in np.arange(4) * math.pi / 2 + 0.5:
        tube(rope, [(head[0], low - 0.2, head[2]), (head[0] + 0.39 * math.cos(a), y + 0.5, head[2] + 0.39 * math.sin(a)), (head[0] + 0.38 * math.cos(a), y + 0.05, head[2] + 0.38 * math.sin(a))], 0.014, 4)
    add(model, scene, "compound_crane", {"planks": wood, "hemp": rope, "pale_stone": stone, "iron": iron})


def make_catapult(model, scene):
    """The stone-thrower looks down the range; seen from behind."""
    wood, sinew, rope, stone, iron = Shape(), Shape(), Shape(), Shape(), Shape()
    for s in (-1, 1):  # the two spring frames
        for dx in (0.24, 0.60):
            beam(wood, (s * dx, 0.80, -0.9), (s * dx, 1.62, -0.9), 0.13, 0.20, up=(0, 0, 1), seed=5 + s)
        pole(sinew, (s * 0.42, 0.70, -0.9), (s * 0.42, 1.72, -0.9), 0.085, sides=12)
        for y in (0.70, 1.70):
            pole(iron, (s * 0.42 - 0.13, y, -0.9), (s * 0.42 + 0.13, y, -0.9), 0.035, sides=7)
        tip = (s * 1.28, 1.21, -0.50)
        pole(wood, (s * 0.36, 1.21, -0.93), tip, 0.06, 0.035, 8, seed=3)
        tube(rope, [tip, (s * 0.10, 1.17, 0.25), (0, 1.17, 0.26)], 0.017, 5)
    for y in (0.76, 1.66):
        beam(wood, (-0.78, y, -0.9), (0.78, y, -0.9), 0.26, 0.10, seed=7)
    beam(wood, (0, 1.06, -1.1), (0, 1.06, 1.7), 0.26, 0.14, seed=2)
    beam(wood, (0, 1.15, 0.10), (0, 1.15, 1.1), 0.14, 0.06, seed=3)
    for s in (-1, 1):
        beam(wood, (s * 0.55, -0.05, -0.95), (s * 0.12, 1.0, -0.7), 0.11, seed=4)
        beam(wood, (s * 0.48, -0.05, 1.35), (s * 0.06, 1.0, 1.2), 0.09, seed=6)
        pole(wood, (0, 1.10, 1.55), (s * 0.55, 1.10, 1.55), 0.07, sides=8)
        for a in (0.5, 0.5 + math.pi / 2):
            c = (s * 0.50, 1.10, 1.55)
            d = (0, 0.38 * math.cos(a), 0.38 * math.sin(a))
            pole(wood, tuple(np.subtract(c, d)), tuple(np.add(c, d)), 0.022, sides=6)
    beam(wood, (0, 0.15, -0.95), (0, 0.15, 1.35), 0.12, seed=8)
    lathe(stone, [(0, -0.09), (0.064, -0.064), (0.09, 0), (0.064, 0.064), (0, 0.09)], 12, (0, 1.28, 0.12), (0, 1, 0), (0, 0, 1), uv_scale=(0.5, 1))
    for k, (dx, dz) in enumerate(((1.0, 1.2), (1.2, 1.25), (1.08, 1.42), (1.1, 1.28))):
        lathe(stone, [(0, -0.09), (0.064, -0.064), (0.09, 0), (0.064, 0.064), (0, 0.09)], 12, (dx, 0.09 + (0.14 if k == 3 else 0), dz), (0, 1, 0), (0, 0, 1), uv_scale=(0.5, 1))
    turned = {}
    for name, shape in (("planks", wood), ("straw_bale", sinew), ("hemp", rope), ("limestone", stone), ("iron", iron)):
        turned[name] = put(Shape(), shape, (-0.35, 0.0, -9.3), 0.0)
    add(model, scene, "catapult", turned)


def make_crossbow(model, scene):
    """The belly-bow leans on a rest, its bolts in a basket."""
    wood, horn, rope, iron = Shape(), Shape(), Shape(), Shape()
    beam(wood, (0, 1.02, 0.7), (0, 1.16, -0.75), 0.09, 0.10, seed=1)
    bow = [(0.95 * math.sin(a), 1.17, -0.62 + 0.42 * (1 - math.cos(a))) for a in np.linspace(-1.15, 1.15, 15)]
    tube(horn, bow, lambda t: 0.038 - 0.045 * abs(t - 0.5), 8)
    tube(rope, [bow[0], (0, 1.13, 0.05), bow[-1]], 0.009, 5)
    yoke = [(0.26 * math.sin(a), 1.01, 0.86 - 0.16 * math.cos(a) + 0.1) for a in np.linspace(-1.2, 1.2, 9)]
    tube(wood, yoke, 0.035, 7)
    for x, z in ((-0.35, -0.55), (0.35, -0.55), (0.0, 0.15)):
        pole(wood, (x, 0, z), (0, 1.07, -0.30), 0.035, sides=7)
    for x, z in ((0, 0.62),):
        pole(wood, (x, 0, z), (0, 0.98, 0.55), 0.03, sides=7)
    pole(iron, (0, 1.19, -0.95), (0, 1.10, 0.02), 0.010, sides=6)
    pole(wood, (-0.20, 1.02, 0.55), (0.20, 1.02, 0.55), 0.045, sides=9)  # the winch and its handspikes
    for s in (-1, 1):
        for a in (0.4, 0.4 + math.pi / 2):
            reach = (0, 0.19 * math.cos(a), 0.19 * math.sin(a))
            pole(wood, (s * 0.19, 1.02 - reach[1], 0.55 - reach[2]), (s * 0.19, 1.02 + reach[1], 0.55 + reach[2]), 0.016, sides=6)
    lathe(wood, [(0, 0), (0.14, 0), (0.18, 0.45), (0.16, 0.45), (0, 0.40)], 14, (0.72, 0, 0.35), (0, 1, 0), (0, 0, 1), uv_scale=(2, 1))
    for k in range(7):
        a = 0.9 * k
        pole(iron, (0.72 + 0.06 * math.cos(a), 0.2, 0.35 + 0.06 * math.sin(a)), (0.72 + 0.13 * math.cos(a), 0.78, 0.35 + 0.13 * math.sin(a)), 0.011, sides=5)
    turned = {}
    for name, shape in (("planks", wood), ("paint_black", horn), ("hemp", rope), ("iron", iron)):
        turned[name] = put(Shape(), shape, (-1.95, 0.0, -7.0), 0.03)
    add(model, scene, "crossbow", turned)


def make_sphere(model, scene):
    """By the smithy: a cauldron over a fire, and over it the sphere."""
    x, z = -3.55, -11.0
    bronze, iron, fire, stone, wood = Shape(), Shape(), Shape(), Shape(), Shape()
    lathe(bronze, [(0.0, 0.46), (0.20, 0.48), (0.33, 0.60), (0.37, 0.76), (0.36, 0.88), (0.30, 0.96), (0.12, 1.02), (0.0, 1.03)], 20, (x, 0, z), (0, 1, 0), (0, 0, 1), uv_scale=(1.5, 1.5))
    for s in (-1, 1):
        tube(bronze, [(x + s * 0.24, 0.97, z), (x + s * 0.24, 1.40, z), (x + s * 0.23, 1.45, z), (x + s * 0.16, 1.45, z)], 0.024, 8)
        tube(bronze, [(x, 1.45 + s * 0.17, z), (x, 1.45 + s * 0.25, z), (x, 1.45 + s * 0.27, z + s * 0.03), (x, 1.45 + s * 0.27, z + s * 0.10)], 0.020, 7)
    ball = [(0.18 * math.sin(a), -0.18 * math.cos(a)) for a in np.linspace(0, math.pi, 11)]
    ball[0], ball[-1] = (0, -0.18), (0, 0.18)
    lathe(bronze, ball, 20, (x, 1.45, z), (1, 0, 0), (0, 1, 0), uv_scale=(1.5, 1.5))
    for k in range(3):
        a = 0.5 + 2 * math.pi * k / 3
        pole(iron, (x + 0.46 * math.cos(a), 0, z + 0.46 * math.sin(a)), (x + 0.32 * math.cos(a), 0.68, z + 0.32 * math.sin(a)), 0.026, sides=6)
    flames(fire, np.random.default_rng(471), (x, 0.05, z), 22, 0.14, 0.55)
    for k in range(6):
        a = math.pi * k / 3
        pole(wood, (x + 0.50 * math.cos(a), 0.04, z + 0.50 * math.sin(a)), (x - 0.05 * math.cos(a), 0.10, z - 0.05 * math.sin(a)), 0.045, sides=6, seed=k)
    for k in range(11):
        a = 2 * math.pi * k / 11
        box(stone, (x + 0.62 * math.cos(a) - 0.11, -0.05, z + 0.62 * math.sin(a) - 0.10), (x + 0.62 * math.cos(a) + 0.11, 0.14, z + 0.62 * math.sin(a) + 0.10), 1.2, 0, k)
    for k in range(3):  # a stack of logs
        for j in range(4 - k):
            pole(wood, (x - 1.0 + 0.02 * k, 0.07 + 0.12 * k, z - 0.7 + 0.14 * j + 0.07 * k), (x - 0.25, 0.07 + 0.12 * k, z - 0.72 + 0.14 * j + 0.07 * k), 0.066, sides=7, seed=j)
    add(model, scene, "aeolipile", {"bronze": bronze, "iron": iron, "fire": fire, "rubble": stone, "bark": wood})


def wheel(wood, iron, at, radius):
    at = np.asarray(at, float)
    r = radius
    lathe(wood, [(r - 0.10, -0.035), (r - 0.01, -0.035), (r - 0.01, 0.035), (r - 0.10, 0.035), (r - 0.10, -0.035)], 28, at, (0, 0, 1), (0, 1, 0), uv_scale=(5, 1))
    lathe(iron, [(r - 0.01, -0.038), (r + 0.005, -0.038), (r + 0.005, 0.038), (r - 0.01, 0.038)], 28, at, (0, 0, 1), (0, 1, 0), uv_scale=(5, 4))
    lathe(wood, [(0, -0.13), (0.07, -0.13), (0.10, 0.0), (0.07, 0.15), (0, 0.15)], 12, at, (0, 0, 1), (0, 1, 0), uv_scale=(1, 1))
    for k in range(10):
        a = 2 * math.pi * k / 10
        out = np.array([math.cos(a), math.sin(a), 0])
        beam(wood, tuple(at + 0.07 * out), tuple(at + (r - 0.08) * out), 0.045, 0.05, up=(0, 0, 1), seed=k)


def make_cart(model, scene):
    """On the road: the way-measurer's case stands on the axle, over the hub."""
    wood, iron, bronze, sacks = Shape(), Shape(), Shape(), Shape()
    for s in (-1, 1):
        wheel(wood, iron, (0, 0.59, s * 0.78), 0.59)
    pole(wood, (0, 0.59, -0.78), (0, 0.59, 0.78), 0.06, sides=8)
    for k in range(6):
        beam(wood, (-1.15, 0.76, -0.56 + 0.225 * k), (1.10, 0.76, -0.56 + 0.225 * k), 0.215, 0.05, seed=k)
    for s in (-1, 1):
        for px in (-1.1, -0.35, 0.4, 1.05):
            beam(wood, (px, 0.66, s * 0.66), (px, 1.18, s * 0.70), 0.055, up=(1, 0, 0), seed=int(10 * px) % 8)
        for y in (0.92, 1.12):
            beam(wood, (-1.2, y, s * 0.69), (1.15, y, s * 0.69), 0.10, 0.035, up=(0, 0, 1), seed=3)
    beam(wood, (0.9, 0.66, 0), (3.0, 0.50, 0), 0.10, 0.10, seed=4)  # the pole, its yoke on the ground's trestle
    beam(wood, (2.9, 0.56, -0.62), (2.9, 0.56, 0.62), 0.09, seed=5)
    pole(wood, (2.55, 0, 0), (2.55, 0.5, 0), 0.05, sides=6)
    box(wood, (-0.36, 0.79, 0.20), (0.36, 1.52, 0.56), 1.2)  # the case
    lathe(wood, [(0, 0), (0.29, 0), (0.29, 0.03), (0, 0.03)], 26, (0, 1.15, 0.565), (0, 0, 1), (0, 1, 0), uv_scale=(2, 1))
    lathe(bronze, [(0, 0), (0.05, 0), (0.04, 0.05), (0, 0.05)], 12, (0, 1.15, 0.59), (0, 0, 1), (0, 1, 0))
    pole(wood, (0, 1.52, 0.38), (0, 1.60, 0.38), 0.20, sides=16)
    lathe(bronze, [(0, 0), (0.10, 0), (0.14, 0.10), (0.12, 0.16), (0.10, 0.16), (0, 0.10)], 14, (0.54, 0.80, 0.38), (0, 1, 0), (0, 0, 1), uv_scale=(1, 2))
    for k, (px, pz) in enumerate(((-0.8, -0.2), (-0.75, 0.25), (-0.3, -0.3), (0.6, -0.3))):
        lathe(sacks, [(0, 0), (0.19, 0.02), (0.24, 0.22), (0.18, 0.42), (0.07, 0.50), (0.09, 0.56), (0, 0.55)], 12, (px, 0.78, pz), (0.1 * (-1) ** k, 1, 0.05), (0, 0, 1), uv_scale=(1, 1))
    z = -7.9
    turned = {}
    for name, shape in (("planks", wood), ("iron", iron), ("bronze", bronze), ("cloth", sacks)):
        turned[name] = put(Shape(), shape, (road_x(z) + 0.1, 0.03, z), -0.98)
    add(model, scene, "cart", turned)


def make_machines(model, scene):
    for make in (make_screw, make_pump, make_crane, make_compound_crane, make_catapult, make_crossbow, make_sphere, make_cart):
        make(model, scene)
