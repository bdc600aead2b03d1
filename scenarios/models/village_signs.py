"""The eight signs of the village and the low wall that they stand on.

A sign is a board of oak that hangs by two loops from a bar. Its frame has the origin in the middle of the bar; x goes along the bar to the
visitor's right, y up, z to the visitor. It swings about x. Its outline tells it from the others by touch, its emblem in relief by sight.
"""
import math

import numpy as np

from modelling import Shape, block, rod, timber, tube
from village_shapes import arc, circle, prism, stroke

COLUMNS, ROWS = (-0.366, -0.122, 0.122, 0.366), ((1.180, 0.10), (0.995, 0.37))  # x; height of the bar and its z
THICK, MIDDLE, SIZE = 0.020, -0.106, 1.12  # of a board: its thickness, its middle below the bar, its size over that of the drawings below
WALL_TOP = 0.70
RED, BLUE, WHITE, BLACK, OCHRE = range(5)
PAINTS = ["paint_red", "paint_blue", "paint_white", "paint_black", "paint_ochre"]

# In the order of the places behind them, from the river on the left to the house on the right; the upper row first.
SIGNS = (("SCREW", 0, 0), ("CATAPULT", 1, 0), ("COMPOUND_CRANE", 2, 0), ("CRANE", 3, 0),
         ("SPHERE", 0, 1), ("CROSSBOW", 1, 1), ("ODOMETER", 2, 1), ("PUMP", 3, 1))


def place_of(column, row):
    return (COLUMNS[column], *ROWS[row])


# Outlines, about the board's middle, counter-clockwise --------------------------------------------------------------------------


def outline_of(name):
    """All are 0.15 m high and 0.14 to 0.16 m wide before SIZE."""
    h = 0.075
    if name == "SCREW":  # a leaning board, as the barrel leans
        return [(-0.080, -h), (0.052, -h), (0.080, h), (-0.052, h)]
    if name == "CATAPULT":  # a square, its corners cut
        c = 0.024
        return [(-h + c, -h), (h - c, -h), (h, -h + c), (h, h - c), (h - c, h), (-h + c, h), (-h, h - c), (-h, -h + c)]
    if name == "COMPOUND_CRANE":  # a temple's front
        return [(-0.070, -h), (0.070, -h), (0.070, 0.030), (0.080, 0.030), (0.0, h), (-0.080, 0.030), (-0.070, 0.030)]
    if name == "CRANE":  # wide below, as the crane's legs
        return [(-0.080, -h), (0.080, -h), (0.034, h), (-0.034, h)]
    if name == "SPHERE":
        return circle((0, 0), h, 36)
    if name == "CROSSBOW":  # a shield that ends in a point
        return [(0.0, -h - 0.004), (0.050, -0.040), (0.072, 0.0), (0.076, h), (-0.076, h), (-0.072, 0.0), (-0.050, -0.040)]
    if name == "ODOMETER":  # a milestone
        return [(-0.070, -h), (0.070, -h)] + arc((0, 0.005), 0.070, 0, math.pi, 17)
    if name == "PUMP":  # a jar: narrow above, round below
        lower = [(0.078 * math.cos(a), -0.004 + 0.071 * math.sin(a)) for a in np.linspace(-math.pi * 0.94, -math.pi * 0.06, 17)]
        return lower + [(0.078, 0.022), (0.056, 0.050), (0.056, h), (-0.056, h), (-0.056, 0.050), (-0.078, 0.022)]
    raise ValueError(name)


# Emblems: in relief on the face, each drawn into (shape, back, front) -------------------------------------------------------------


def bar(shape, a, b, width, z, slot):
    stroke(shape, [a, b], width, *z, slot)


def draw_screw(shape, z):
    a, b = np.array([-0.040, -0.030]), np.array([0.036, 0.042])
    along = (b - a) / np.linalg.norm(b - a)
    across = np.array([-along[1], along[0]])
    bar(shape, a, b, 0.036, z, RED)
    high = (z[0], z[1] + 0.0015)
    for k in range(5):
        p = a + (b - a) * (k + 0.5) / 5
        bar(shape, p - 0.019 * across - 0.007 * along, p + 0.019 * across + 0.007 * along, 0.0065, high, WHITE)
    bar(shape, b, b + 0.016 * along, 0.008, z, BLACK)
    for k, y in enumerate((-0.046, -0.060)):
        stroke(shape, [(x, y + 0.005 * math.sin((x + 0.02 * k) * 190)) for x in np.linspace(-0.062, 0.036, 21)], 0.006, *z, BLUE)
    for p in ((0.052, 0.016), (0.052, -0.006), (0.050, -0.028)):
        prism(shape, circle(p, 0.0055, 10, squash=1.5), *z, BLUE, False)


def draw_pump(shape, z):
    for s in (-1, 1):
        for out, front, slot in ((0.0165, z[1] - 0.001, BLACK), (0.013, z[1], OCHRE)):
            low, top = -0.052 + 0.013 - out, 0.004 - 0.013 + out
            prism(shape, [(s * 0.030 - out, low), (s * 0.030 + out, low), (s * 0.030 + out, top), (s * 0.030 - out, top)], z[0], front, slot, False)
        bar(shape, (s * 0.030, 0.0), (s * 0.030, 0.030 + 0.011 * s), 0.006, z, BLACK)
        bar(shape, (s * 0.018, -0.044), (0.0, -0.044), 0.008, z, BLACK)
    bar(shape, (0, -0.048), (0, 0.052), 0.009, z, BLACK)
    high = (z[0], z[1] + 0.0015)
    bar(shape, (-0.050, 0.012), (0.050, 0.050), 0.010, high, RED)
    for s in (-1, 1):
        stroke(shape, arc((s * 0.016, 0.048), 0.016, math.pi / 2 * (1 + s), math.pi / 2 - s * 1.0, 9), 0.005, *high, BLUE)


def draw_frame_of_crane(shape, z, head):
    for s in (-1, 1):
        bar(shape, (s * 0.042, -0.062), (s * 0.006, head), 0.010, z, RED)
    bar(shape, (-0.026, -0.020), (0.026, -0.020), 0.007, z, RED)
    prism(shape, circle((0, -0.040), 0.011, 16), *z, BLACK, False)  # the winch
    bar(shape, (-0.022, -0.040), (0.022, -0.040), 0.005, (z[0], z[1] + 0.001), BLACK)


def draw_crane(shape, z):
    draw_frame_of_crane(shape, z, 0.048)
    high = (z[0], z[1] + 0.0015)
    stroke(shape, circle((0, 0.046), 0.012, 18), 0.006, *high, OCHRE, True)
    bar(shape, (0.0, 0.036), (0.0, 0.012), 0.0035, high, BLACK)
    prism(shape, [(-0.016, -0.012), (0.016, -0.012), (0.016, 0.012), (-0.016, 0.012)], *high, WHITE, False)


def draw_compound_crane(shape, z):
    bar(shape, (-0.052, -0.062), (-0.004, 0.052), 0.010, z, RED)  # one mast with its stay
    bar(shape, (0.056, -0.062), (0.000, 0.052), 0.005, z, BLACK)
    high = (z[0], z[1] + 0.0015)
    for p in ((0.002, 0.043), (0.002, 0.013)):
        stroke(shape, circle(p, 0.010, 18), 0.006, *high, OCHRE, True)
    for x in (-0.008, 0.012):
        bar(shape, (x, 0.043), (x, 0.013), 0.003, high, BLACK)
    bar(shape, (0.002, 0.003), (0.002, -0.016), 0.0035, high, BLACK)
    for k in range(5):  # a column's drum
        x = 0.002 + (k - 2) * 0.0088
        prism(shape, [(x - 0.0036, -0.056), (x + 0.0036, -0.056), (x + 0.0036, -0.016), (x - 0.0036, -0.016)], *high, WHITE, False)
    for y in (-0.058, -0.016):
        bar(shape, (-0.022, y), (0.026, y), 0.006, high, WHITE)


def draw_catapult(shape, z):
    bar(shape, (0, -0.062), (0, 0.056), 0.013, z, RED)
    high = (z[0], z[1] + 0.0015)
    bar(shape, (-0.044, 0.030), (0.044, 0.030), 0.012, z, RED)
    for s in (-1, 1):
        bar(shape, (s * 0.033, 0.014), (s * 0.033, 0.046), 0.017, high, WHITE)
        bar(shape, (s * 0.032, 0.028), (s * 0.060, -0.014), 0.008, high, BLACK)
        bar(shape, (s * 0.060, -0.014), (s * 0.006, -0.040), 0.003, high, BLACK)
    prism(shape, circle((0, -0.034), 0.015, 22), z[0], z[1] + 0.004, WHITE, False)


def draw_crossbow(shape, z):
    bar(shape, (0, -0.060), (0, 0.046), 0.012, z, RED)
    high = (z[0], z[1] + 0.0015)
    stroke(shape, arc((0, -0.046), 0.088, 0.24 * math.pi, 0.76 * math.pi, 19), 0.011, *high, BLACK)
    for s in (-1, 1):
        bar(shape, (s * 0.0635, 0.016), (0, -0.022), 0.003, high, WHITE)
    bar(shape, (0, -0.022), (0, 0.056), 0.0045, (z[0], z[1] + 0.003), WHITE)
    prism(shape, [(-0.008, 0.054), (0.008, 0.054), (0, 0.070)], z[0], z[1] + 0.003, OCHRE, False)
    stroke(shape, arc((0, -0.074), 0.020, 0.15 * math.pi, 0.85 * math.pi, 9), 0.006, *high, RED)  # the yoke for the belly


def draw_sphere(shape, z):
    high = (z[0], z[1] + 0.002)
    prism(shape, circle((0, 0.022), 0.029, 28), *z, BLACK, False)
    prism(shape, circle((0, 0.022), 0.025, 28), *high, OCHRE, False)
    stroke(shape, [(0.014, 0.042), (0.030, 0.052), (0.040, 0.046)], 0.006, *high, OCHRE)
    stroke(shape, [(-0.014, 0.002), (-0.030, -0.008), (-0.040, -0.002)], 0.006, *high, OCHRE)
    for s in (-1, 1):
        bar(shape, (s * 0.033, -0.022), (s * 0.033, 0.022), 0.005, z, BLACK)
        bar(shape, (s * 0.033, 0.022), (s * 0.020, 0.022), 0.005, z, BLACK)
        for k in range(2):
            stroke(shape, [(s * (0.044 + 0.007 * k), 0.022 + s * (0.022 - 0.004 * k)), (s * (0.052 + 0.005 * k), 0.022 + s * (0.012 - 0.008 * k))], 0.0035, *z, WHITE)
    prism(shape, [(-0.040, -0.028)] + arc((0, -0.028), 0.034, 1.15 * math.pi, 1.85 * math.pi, 9) + [(0.040, -0.028), (0.044, -0.020), (-0.044, -0.020)], *z, BLACK, False)
    for x, h in ((-0.018, 0.010), (-0.006, 0.014), (0.006, 0.012), (0.018, 0.010)):
        prism(shape, [(x - 0.005, -0.068), (x + 0.005, -0.068), (x + 0.001, -0.066 + h)], *high, RED, False)


def draw_odometer(shape, z):
    high = (z[0], z[1] + 0.0015)
    stroke(shape, circle((0, -0.022), 0.042, 30), 0.009, *z, RED, True)
    for k in range(8):
        a = 2 * math.pi * (k + 0.5) / 8
        bar(shape, (0.008 * math.cos(a), -0.022 + 0.008 * math.sin(a)), (0.039 * math.cos(a), -0.022 + 0.039 * math.sin(a)), 0.005, z, RED)
    prism(shape, circle((0, -0.022), 0.012, 16), *high, BLACK, False)
    cog = []
    for k in range(14):  # the toothed drum over it
        for r, d in ((0.0165, -0.16), (0.0165, 0.05), (0.0215, 0.10), (0.0215, 0.30)):
            a = 2 * math.pi * k / 14 + d
            cog.append((r * math.cos(a), 0.042 + r * math.sin(a)))
    prism(shape, cog, *high, OCHRE, False)
    prism(shape, circle((0, 0.042), 0.005, 10), z[0], z[1] + 0.003, BLACK, False)


EMBLEMS = {"SCREW": draw_screw, "PUMP": draw_pump, "CRANE": draw_crane, "COMPOUND_CRANE": draw_compound_crane, "CATAPULT": draw_catapult,
           "CROSSBOW": draw_crossbow, "SPHERE": draw_sphere, "ODOMETER": draw_odometer}


# The signs and their stand --------------------------------------------------------------------------------------------------------


def make_sign(model, name):
    group = model.group("SIGN_" + name)
    outline = [(SIZE * x, SIZE * y + MIDDLE) for x, y in outline_of(name)]
    half = THICK / 2
    model.add("part_" + name.lower(), prism(Shape(), outline, -half, half), ["timber"], group, 20)
    middle = np.array([0, MIDDLE])
    rim = Shape()
    inside = [tuple(middle + 0.90 * (np.array(p) - middle)) for p in outline]
    for i in range(len(outline)):  # a raised edge
        k = (i + 1) % len(outline)
        prism(rim, [outline[i], outline[k], inside[k], inside[i]], half - 0.001, half + 0.003, 0)
    model.add("visual_rim_" + name.lower(), rim, ["planks"], group, 20)
    emblem = Shape()
    EMBLEMS[name](emblem, (half - 0.001, half + 0.0035))
    emblem.vertices = [(SIZE * x, SIZE * y + MIDDLE, z) for x, y, z in emblem.vertices]
    model.add("visual_emblem_" + name.lower(), emblem, PAINTS, group, 20)
    loops = Shape()
    for s in (-1, 1):
        path = [(s * 0.026, -0.0095 + 0.0155 * math.cos(a), 0.0155 * math.sin(a)) for a in np.arange(14) * 2 * math.pi / 14]
        tube(loops, path, 0.0026, 6, closed=True, v_scale=20)
        prism(loops, [(s * 0.026 - 0.005, -0.052), (s * 0.026 + 0.005, -0.052), (s * 0.026 + 0.005, -0.020), (s * 0.026 - 0.005, -0.020)], -half - 0.002, half + 0.004, 0, False)
    model.add("visual_loops_" + name.lower(), loops, ["bronze"], group, 60)


def make_stand(model):
    """A low wall of dressed stones in two steps, and an oak post for each sign with an arm that holds its bar."""
    stand = model.group("STAND")
    posts = Shape()
    for k, (_, column, row) in enumerate(SIGNS):
        x, y, z = place_of(column, row)
        back, foot = z - 0.105, WALL_TOP - 0.12
        model.add(f"part_post_{k}", timber(Shape(), (x, foot, back), (x, y + 0.044, back), 0.038, 0.038, up=(0, 0, 1), bevel=0.005, seed=40 + k, rough=0.0004), ["timber"], stand, 40)
        timber(posts, (x, y + 0.016, back - 0.032), (x, y + 0.016, z + 0.020), 0.022, 0.028, bevel=0.003, seed=50 + k, rough=0.0003)
        timber(posts, (x, y - 0.060, back + 0.018), (x, y + 0.004, z - 0.028), 0.016, 0.016, bevel=0.002, seed=60 + k, rough=0.0003)
    model.add("visual_arms", posts, ["timber"], stand, 40)
    bars = Shape()
    for _, column, row in SIGNS:
        x, y, z = place_of(column, row)
        rod(bars, (x - 0.046, y, z), (x + 0.046, y, z), 0.0055, 12)
    model.add("visual_bars", bars, ["bronze"], stand, 50)
    rng, course = np.random.default_rng(311), Shape()
    for level, (low, high) in enumerate(((0.0, 0.24), (0.24, 0.46), (0.46, WALL_TOP - 0.075))):
        left = -0.60 - 0.10 * (level % 2)
        while left < 0.60:
            right = min(left + rng.uniform(0.26, 0.40), 0.66)
            right = 0.66 if 0.66 - right < 0.14 else right
            block(course, (left, low, -0.10 + 0.008 * rng.random()), (right - 0.003, high - 0.003, 0.40 - 0.010 * rng.random()), 0.008, int(rng.integers(1000)), 0.0025)
            left = right
    model.add("visual_wall", course, ["rubble"], stand, 42)
    cap = Shape()
    for k, (a, b) in enumerate(((-0.72, -0.25), (-0.247, 0.22), (0.223, 0.70))):
        block(cap, (a, WALL_TOP - 0.077, -0.125), (b, WALL_TOP, 0.425), 0.010, 330 + k, 0.002)
    model.add("visual_cap", cap, ["pale_stone"], stand, 42)
    core = Shape()
    block(core, (-0.645, 0.0, -0.085), (0.645, WALL_TOP - 0.006, 0.38), 0.010, 77, 0.0, 1.0)
    model.add("part_wall", core, ["limestone"], stand, 42)
