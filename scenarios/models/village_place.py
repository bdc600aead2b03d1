"""The place of the village: its ground with river and hills, trees, house, temple, stoa, smithy, range and the wall that is being built.

Metres, y up. The visitor stands at about z = 1.1 and looks along -z. The agora is level at y = 0; the river's water is at RIVER_Y.
"""
import math

import bpy
import numpy as np

from modelling import Shape, earth, lathe, paving, to_blender, tube, tuft
from surfaces import mix, step
from village_shapes import beam, box, flames, gable, pole, prism, put, sheet

RIVER_Y, HALF_RIVER = -0.42, 2.0
TEMPLE = (6.3, -21.5)  # the middle of its front's lowest step


def river_x(z):
    return -5.3 + 0.27 * (z + 2) + 0.7 * math.sin(0.21 * z + 0.4)


def road_x(z):
    return 2.15 + 0.045 * (z + 4) - 0.9 * math.sin(0.10 * z) - 0.0016 * (z + 5) ** 2


def hills(x, z):
    far = max(0.0, math.hypot(x, 0.8 * (z + 6)) - 34)
    wave = 1.1 + 0.55 * math.sin(0.043 * x + 1.0) + 0.45 * math.sin(0.071 * x - 0.05 * z) + 0.25 * math.sin(0.17 * x + 2)
    rise = 0.17 * wave * far * (1 - 0.20 * min(1.0, far / 140)) if z < 0 else 0.05 * far
    return rise * float(step(0, 60, max(0.0, abs(x - river_x(max(z, -60.0))) - 3)) * 0.85 + 0.15)


def height_at(x, z):
    """Level about the agora, down to the river's bed, up to the hills."""
    off = abs(x - river_x(z))
    bed = -0.95 * (1 - float(step(HALF_RIVER - 0.7, HALF_RIVER + 0.75, off)))
    rough = 0.02 * math.sin(1.3 * x + 0.7 * z) + 0.015 * math.sin(2.1 * z - 1.7 * x + 1)
    level = min(1.0, max(0.0, math.hypot(x, z) - 5) / 10)
    return bed + (rough * level if off > HALF_RIVER else 0.0) + hills(x, z)


def make_ground(model, scene):
    xs = np.concatenate([np.linspace(-150, -22, 18)[:-1], np.linspace(-22, -9, 16)[:-1], np.linspace(-9, -1.5, 26)[:-1], np.linspace(-1.5, 9, 16)[:-1],
                         np.linspace(9, 22, 10)[:-1], np.linspace(22, 150, 18)])
    zs = np.concatenate([np.linspace(-190, -40, 22)[:-1], np.linspace(-40, -12, 26)[:-1], np.linspace(-12, 4, 24)[:-1], np.linspace(4, 40, 8)])
    grid = [[(x, height_at(x, z), z) for z in zs] for x in xs]
    shape, _ = earth(grid, 2.6)
    wide = lambda face: max(math.hypot(shape.vertices[i][0], shape.vertices[i][2] + 8) for i in face)
    shape.slots = [1 if wide(face) > 30 else 0 for face in shape.faces]
    for k, face in enumerate(shape.faces):  # fields far off: a coarser tile
        if shape.slots[k]:
            shape.uvs[k] = tuple((shape.vertices[i][0] / 26, shape.vertices[i][2] / 26) for i in face)
    model.add("visual_ground", shape, ["earth", "fields"], scene, 60)
    rows = []
    for z in np.linspace(-1.7, -46, 60):
        out = 0.03 * math.sin(2.1 * z)
        rows.append([(road_x(z) + w + out, height_at(road_x(z) + w, z) + h, z) for w, h in ((1.35, -0.02), (1.1, 0.025), (0.75, 0.012), (0, 0.04), (-0.75, 0.012), (-1.1, 0.025), (-1.35, -0.02))])
    model.add("visual_road", sheet(Shape(), [r[::-1] for r in rows], 2.2, level=True), ["gravel"], scene, 60)
    water = model.group("WATER_RIVER")
    rows = [[(river_x(z) - 3.2, RIVER_Y, z), (river_x(z) + 3.2, RIVER_Y, z)] for z in np.linspace(12, -44, 40)]
    model.add("visual_river", sheet(Shape(), [r[::-1] for r in rows]), ["water"], water, 60)


def make_bank(model, scene):
    """Stones and reeds along the water, grass on the ground."""
    rng, stones, grass = np.random.default_rng(401), Shape(), Shape()
    for _ in range(120):
        z = rng.uniform(-26, 2)
        x = river_x(z) + HALF_RIVER * rng.uniform(0.86, 1.22) * (1 if rng.random() < 0.75 else -1)
        r = rng.uniform(0.05, 0.17)
        squat = [(0, -0.5 * r), (0.85 * r, -0.3 * r), (r, 0.1 * r), (0.62 * r, 0.5 * r), (0, 0.58 * r)]
        lathe(stones, squat, 7, (x, height_at(x, z) + 0.1 * r, z), (rng.normal(0, 0.15), 1, rng.normal(0, 0.15)), (0, 0, 1), uv_scale=(0.4, 0.7), uv_offset=tuple(rng.random(2)))
    model.add("visual_bank_stones", stones, ["limestone"], scene, 60)
    for _ in range(150):  # reeds
        z = rng.uniform(-24, 1.5)
        x = river_x(z) + (HALF_RIVER + rng.normal(-0.25, 0.22)) * (1 if rng.random() < 0.7 else -1)
        if abs(z + 6.3) > 1.0:
            tuft(grass, rng, x, z, height_at, 7, 0.10, 1.15 if rng.random() < 0.5 else 0.6, 0.25)
    made = 0
    while made < 420:
        z = -2 - 26 * rng.random() ** 1.5
        x = rng.uniform(-0.8, 0.8) * (2.5 - z)
        if abs(x - road_x(z)) < 1.4 or abs(x - river_x(z)) < HALF_RIVER or (abs(x) < 2.4 and z > -5):
            continue
        made += 1
        tuft(grass, rng, x, z, height_at, 5, 0.09, 0.22, 0.7)
    model.add("visual_grass", grass, ["blade", "straw"], scene, 60)


def make_agora(model, scene):
    """A paved place by the wall of the signs; the altar before the temple."""
    model.add("visual_flags", paving((-1.75, 1.70), (-1.75, 1.3), 1.80, (0.40, 0.56), (0.48, 0.80), (0.004, 0.010)), ["flagstone"], scene, 42)
    flags, rng = Shape(), np.random.default_rng(411)
    for row in range(11):
        z, left = -1.84 - 0.58 * row, -3.1 + 0.25 * (row % 2) + 0.12 * row
        while left < 0.35 - 0.03 * row:
            width = rng.uniform(0.55, 0.95)
            if rng.random() < 0.93:
                box(flags, (left, -0.06, z - 0.56), (left + width - 0.025, rng.uniform(0.012, 0.022), z), 1.4, 0, int(rng.integers(1000)))
            left += width
    model.add("visual_square", flags, ["flagstone"], scene, 42)
    altar, (x, z) = Shape(), (3.3, -15.8)
    for low, high, half in ((0.0, 0.16, 0.62), (0.16, 0.30, 0.52), (0.30, 0.98, 0.40), (0.98, 1.10, 0.50)):
        box(altar, (x - 1.6 * half, low, z - half), (x + 1.6 * half, high, z + half), 1.2, 0, int(100 * low))
    for s in (-1, 1):
        pole(altar, (x + s * 0.66, 1.15, z - 0.44), (x + s * 0.66, 1.15, z + 0.44), 0.07, sides=10)
    model.add("visual_altar", altar, ["pale_stone"], scene, 30)
    pots(model, scene)


def pots(model, scene):
    """Jars and a basket or two where people would leave them."""
    jar = [(0.0, 0.0), (0.05, 0.0), (0.17, 0.26), (0.19, 0.42), (0.13, 0.56), (0.06, 0.62), (0.055, 0.74), (0.085, 0.77), (0.075, 0.78), (0.04, 0.74), (0.0, 0.73)]
    bowl = [(0.0, 0.0), (0.11, 0.0), (0.21, 0.22), (0.23, 0.40), (0.20, 0.43), (0.18, 0.40), (0.0, 0.34)]
    shape, rng = Shape(), np.random.default_rng(421)
    for x, z, what in ((3.25, -4.9, jar), (3.45, -4.55, jar), (3.02, -5.2, bowl), (4.95, -7.4, jar), (-2.3, -12.5, jar), (-2.55, -12.2, bowl), (-3.3, -5.2, jar), (-3.05, -5.4, bowl), (5.0, -4.6, jar)):
        lathe(shape, [(r, h * rng.uniform(0.95, 1.05)) for r, h in what], 14, (x, height_at(x, z) - 0.01, z), (rng.normal(0, 0.03), 1, rng.normal(0, 0.03)), (0, 0, 1), uv_scale=(1, 1))
    model.add("visual_pots", shape, ["terracotta"], scene, 60)


def tiles(model, parent, name, x, low, high, z, thick=0.10, over=0.3):
    """A roof of pan and cover tiles on a slab of boards."""
    model.add(f"visual_{name}_roof", gable(Shape(), x, low, high, z, thick, (0, 1), over), ["rooftiles", "plaster"], parent, 20)
    covers, middle = Shape(), (x[0] + x[1]) / 2
    for s, eave in ((-1, x[0]), (1, x[1])):
        slope = np.array([eave - middle, low - high])
        edge = np.array([eave, low]) + slope / np.linalg.norm(slope) * (over + 0.02)
        count = max(4, int((z[1] - z[0]) / 0.42))
        for k in range(count + 1):
            at = mix(z[0] + 0.06, z[1] - 0.06, k / count)
            pole(covers, (middle, high + thick + 0.01, at), (edge[0], edge[1] + thick + 0.01, at), 0.062, sides=6, seed=k)
    pole(covers, (middle, high + thick + 0.03, z[0] - 0.05), (middle, high + thick + 0.03, z[1] + 0.05), 0.10, sides=8)
    model.add(f"visual_{name}_covers", covers, ["rooftiles"], parent, 60)


def make_house(model, scene):
    """Stone below, plastered mud brick above; small high windows with shutters of wood; a door of planks; a yard wall."""
    x0, x1, z0, z1 = 5.2, 9.7, -9.8, -5.4
    socle, walls, wood = Shape(), Shape(), Shape()
    box(socle, (x0 - 0.05, -0.3, z0 - 0.05), (x1 + 0.05, 0.62, z1 + 0.05), 1.4)
    box(walls, (x0, 0.6, z0), (x1, 3.05, z1), 3.0)
    prism(walls, [(x0, 3.0), (x1, 3.0), ((x0 + x1) / 2, 4.25)], z0, z1, 0, False, 3.0)
    for x, y, w, h in ((5.95, 2.05, 0.50, 0.55), (8.8, 2.05, 0.50, 0.55)):  # windows of the front
        for s in (-1, 1):
            box(wood, (x + s * w / 4 - w / 4 + 0.008, y, z1 - 0.02), (x + s * w / 4 + w / 4 - 0.008, y + h, z1 + 0.035), 0.6, 0, int(10 * x) + s)
        beam(wood, (x - w / 2 - 0.12, y + h + 0.05, z1 + 0.01), (x + w / 2 + 0.12, y + h + 0.05, z1 + 0.01), 0.10, 0.09, seed=3)
        beam(wood, (x - w / 2 - 0.08, y - 0.03, z1 + 0.02), (x + w / 2 + 0.08, y - 0.03, z1 + 0.02), 0.10, 0.06, seed=4)
    for y, z in ((2.1, -6.6), (2.1, -8.7)):  # and of the side that looks to the agora
        box(wood, (x0 - 0.035, y, z - 0.25), (x0 + 0.02, y + 0.5, z + 0.25), 0.6)
        beam(wood, (x0 - 0.01, y + 0.55, z - 0.4), (x0 - 0.01, y + 0.55, z + 0.4), 0.10, 0.09, seed=5)
    for k in range(4):
        box(wood, (7.0 + 0.23 * k, 0.02, z1 - 0.02), (7.22 + 0.23 * k, 2.05, z1 + 0.065), 0.9, 0, k)
    for s in (-1, 1):
        beam(wood, (7.45 + s * 0.55, 0, z1 + 0.03), (7.45 + s * 0.55, 2.15, z1 + 0.03), 0.15, 0.14, up=(0, 0, 1), seed=6 + s)
    beam(wood, (6.7, 2.17, z1 + 0.03), (8.2, 2.17, z1 + 0.03), 0.16, 0.16, seed=8)
    for z in np.linspace(z0 + 0.2, z1 - 0.2, 8):  # rafters
        beam(wood, (x0 - 0.28, 2.93, z), (x0 + 0.3, 3.10, z), 0.09, 0.10, seed=int(-10 * z))
    model.add("visual_house_socle", socle, ["rubble"], scene, 20)
    model.add("visual_house_walls", walls, ["plaster"], scene, 20)
    model.add("visual_house_wood", wood, ["planks"], scene, 30)
    tiles(model, scene, "house", (x0, x1), 3.03, 4.28, (z0 - 0.3, z1 + 0.3))
    yard, cap = Shape(), Shape()
    box(yard, (9.0, -0.3, -5.2), (9.3, 1.45, -1.2), 1.4)
    box(cap, (8.92, 1.45, -5.2), (9.38, 1.55, -1.15), 1.0)
    model.add("visual_yard", yard, ["rubble"], scene, 20)
    model.add("visual_yard_cap", cap, ["rooftiles"], scene, 20)


def column(shape, x, y, z, height, radius, whole=True, drums=None):
    """Doric, without a base: five drums, echinus, abacus; or only its first drums."""
    each = (height - 0.36 * radius * 2) / 5
    for k in range(drums or 5):
        r0, r1 = (radius * (1 - 0.20 * t - 0.06 * t * t) for t in (k / 5, (k + 1) / 5))
        flutes = [(0, 0), (r0 - 0.006, 0), (r0, 0.006), (r1, each - 0.006), (r1 - 0.006, each), (0, each)]
        lathe(shape, flutes, 16, (x, y + k * each, z), (0, 1, 0), (0, 0, 1), uv_scale=(1.6, 0.7), uv_offset=(0.19 * k, 0.31 * k))
    if whole:
        top, r = y + 5 * each, radius * 0.75
        lathe(shape, [(0, 0), (r, 0), (r * 1.06, 0.03), (r * 1.42, 0.16), (r * 1.42, 0.18), (0, 0.18)], 16, (x, top, z), (0, 1, 0), (0, 0, 1), uv_scale=(1.6, 0.7))
        box(shape, (x - r * 1.5, top + 0.18, z - r * 1.5), (x + r * 1.5, top + 0.34, z + r * 1.5), 1.4)
    return y + drums * each if drums else y + height


def make_temple(model, scene):
    """The house of the god stands; of the porch before it one column has only two of its drums, and the beams over it are missing."""
    x, z = TEMPLE
    stone, dark = Shape(), Shape()
    for k in range(3):
        out = 0.34 * (3 - k)
        box(stone, (x - 3.9 - out, 0.26 * k - (0.4 if k == 0 else 0), z - 11 - out), (x + 3.9 + out, 0.26 * (k + 1), z + 0.2 + out - 0.2), 1.8, 0, k)
    floor, high = 0.78, 4.3
    xs = [x - 3.3, x - 1.1, x + 1.1, x + 3.3]
    for k, at in enumerate(xs):
        if k == 0:
            column(stone, at, floor, z - 0.45, high, 0.40, False, 2)
        else:
            column(stone, at, floor, z - 0.45, high, 0.40)
    for k in range(1, 4):
        for at in (xs[0], xs[3]):
            column(stone, at, floor, z - 0.45 - 2.35 * k, high, 0.40)
    top = floor + high
    box(stone, (xs[1] - 0.1, top, z - 0.80), (xs[3] + 0.42, top + 0.50, z - 0.10), 1.8, 0, 5)
    for at in (xs[0], xs[3]):
        box(stone, (at - 0.34, top, z - 7.9), (at + 0.34, top + 0.50, z - (2.3 if at == xs[0] else 0.80)), 1.8, 0, 6)
    box(stone, (x - 2.3, floor, z - 10.6), (x + 2.3, top + 0.5, z - 3.2), 1.8, 0, 7)
    prism(stone, [(x - 2.35, top + 0.5), (x + 2.35, top + 0.5), (x, top + 1.62)], z - 10.6, z - 3.15, 0, False, 1.8)
    box(dark, (x - 0.75, floor, z - 3.25), (x + 0.75, floor + 3.0, z - 3.17), 1.0)
    box(stone, (x - 1.0, floor + 3.0, z - 3.3), (x + 1.0, floor + 3.28, z - 3.06), 1.4)
    for s in (-1, 1):
        box(stone, (x + s * 0.87 - 0.13, floor, z - 3.3), (x + s * 0.87 + 0.13, floor + 3.0, z - 3.08), 1.4)
    for k, (dx, dz, turn) in enumerate(((-5.6, 1.2, 0.3), (-4.5, 2.0, 1.2), (-6.6, 2.3, 0.7))):  # drums that wait
        y = height_at(x + dx, z + dz)
        lathe(stone, [(0, 0), (0.38, 0), (0.38, 0.76), (0, 0.76)], 16, (x + dx, y + (0 if k == 1 else 0.38), z + dz), (0, 1, 0) if k == 1 else (math.cos(turn), 0, math.sin(turn)), (0, 0, 1) if k == 1 else (0, 1, 0), uv_scale=(1.6, 0.7))
    model.add("visual_temple", stone, ["pale_stone"], scene, 34)
    model.add("visual_temple_door", dark, ["paint_black"], scene, 34)
    tiles(model, scene, "temple", (x - 2.35, x + 2.35), top + 0.5, top + 1.66, (z - 10.7, z - 2.95), 0.10, 0.35)


def make_masonry(model, scene):
    """A wall of squared stones, one end of it still in steps, with a scaffold and stones that wait."""
    rng, wall, wood = np.random.default_rng(431), Shape(), Shape()
    x0, z = 3.8, -12.6
    for course in range(6):
        left, right = x0 + (0.62 * course + 0.1 if course else 0), 9.2
        y = 0.40 * course - 0.02
        at = left - (0.35 if course % 2 else 0) * (course > 0)
        while at < right:
            width = rng.uniform(0.68, 0.92)
            box(wall, (at, y, z - 0.38), (min(at + width, right) - 0.012, y + 0.390, z + 0.03 * rng.random()), 1.4, 0, int(rng.integers(1000)))
            at += width
    for k, (x, dz, turn) in enumerate(((3.5, 1.5, 0.2), (4.4, 2.0, -0.3), (3.95, 1.7, 0.1))):
        put(wall, box(Shape(), (-0.38, 0, -0.2), (0.38, 0.39, 0.2), 1.4, 0, k), (x, height_at(x, z + dz) + (0.39 if k == 2 else 0), z + dz), turn)
    for x in (6.7, 7.8, 8.9):
        pole(wood, (x, 0, z + 0.75), (x, 3.0, z + 0.75), 0.05, 0.04, 7, seed=int(x))
        beam(wood, (x, 1.55, z + 0.9), (x, 1.55, z + 0.0), 0.07, seed=int(x))
    for k in range(3):
        beam(wood, (6.5, 1.61, z + 0.72 - 0.2 * k), (9.1, 1.61, z + 0.72 - 0.2 * k), 0.19, 0.04, seed=k)
    beam(wood, (6.6, 0.05, z + 0.75), (7.9, 2.5, z + 0.75), 0.06, seed=5)
    model.add("visual_masonry", wall, ["limestone"], scene, 30)
    model.add("visual_scaffold", wood, ["planks"], scene, 40)


def make_smithy(model, scene):
    """Three walls of rubble, a tiled lean-to roof on posts, a hearth with its fire, an anvil on a stump."""
    x, z = -6.3, -12.8
    walls, wood, fire, stone, iron = Shape(), Shape(), Shape(), Shape(), Shape()
    box(walls, (x - 0.1, -0.2, z - 3.0), (x + 3.9, 2.5, z - 2.65), 1.4)
    box(walls, (x - 0.1, -0.2, z - 3.0), (x + 0.25, 2.1, z - 0.6), 1.4, 0, 1)
    for px in (x + 0.1, x + 1.95, x + 3.8):
        pole(wood, (px, 0, z), (px, 2.12, z), 0.085, 0.07, 8, seed=int(10 * px))
    beam(wood, (x - 0.3, 2.18, z), (x + 4.2, 2.18, z), 0.16, 0.15, seed=2)
    for k in range(7):
        px = mix(x - 0.1, x + 3.9, k / 6)
        beam(wood, (px, 2.62, z - 3.0), (px, 2.24, z + 0.45), 0.09, 0.10, seed=k)
    roof = [[(px, y, q) for px in (x + 4.35, x - 0.45)] for y, q in ((2.85, z - 3.3), (2.36, z + 0.6))]
    roof_top = sheet(Shape(), roof, 0.14)
    under = sheet(Shape(), [[(a, b - 0.07, c) for a, b, c in row[::-1]] for row in roof], 0.5)
    covers = Shape()
    for k in range(14):
        px = mix(x - 0.35, x + 4.25, k / 13)
        pole(covers, (px, 2.86, z - 3.3), (px, 2.37, z + 0.64), 0.055, sides=6, seed=k)
    box(stone, (x + 0.7, 0, z - 2.1), (x + 2.0, 0.78, z - 0.95), 1.2)
    for low, high in (((x + 0.7, 0.78, z - 2.1), (x + 2.0, 1.15, z - 1.9)), ((x + 0.7, 0.78, z - 2.1), (x + 0.9, 1.15, z - 0.95))):
        box(stone, low, high, 1.2)
    flames(fire, np.random.default_rng(441), (x + 1.4, 0.76, z - 1.5), 26, 0.17, 0.75)
    pole(wood, (x + 2.85, 0, z - 0.9), (x + 2.85, 0.55, z - 0.9), 0.22, 0.20, 10, seed=4)
    box(iron, (x + 2.66, 0.55, z - 1.0), (x + 3.04, 0.72, z - 0.8), 1.0)
    for name, shape, what, smooth in (("walls", walls, "rubble", 20), ("wood", wood, "planks", 40), ("roof", roof_top, "rooftiles", 20), ("boards", under, "planks", 20), ("covers", covers, "rooftiles", 50),
                                      ("hearth", stone, "rubble", 20), ("fire", fire, "fire", 60), ("anvil", iron, "paint_black", 20)):
        model.add("visual_smithy_" + name, shape, [what], scene, smooth)


def make_range(model, scene):
    """A lane to the hill: a butt of straw with a painted mark, and a wall that has been shot at."""
    wall, straw, wood, mark = Shape(), Shape(), Shape(), Shape()
    rng = np.random.default_rng(451)
    x, z = -2.6, -27.0
    for course in range(6):
        for k in range(7):
            at, y = x + 0.5 + 0.62 * k + 0.31 * (course % 2), 0.34 * course
            if course > 2 and abs(k - 3.2 + 0.5 * (course % 2)) < 0.7 * (course - 2):
                continue  # the breach
            box(wall, (at, y - 0.1 * (course == 0), z - 0.45), (at + 0.60, y + 0.33, z + 0.03 * rng.random()), 1.3, 0, int(rng.integers(1000)))
    for _ in range(12):
        px, pz, r = x + 2.6 + rng.normal(0, 0.8), z + 0.6 + abs(rng.normal(0, 0.5)), rng.uniform(0.10, 0.24)
        put(wall, box(Shape(), (-r, -0.6 * r, -r), (r, 0.6 * r, r), 1.3, 0, int(rng.integers(100))), (px, height_at(px, pz) + 0.3 * r, pz), rng.uniform(0, 3))
    bx, bz = -2.5, -21.5
    lathe(straw, [(0, 0), (0.66, 0), (0.72, 0.06), (0.72, 0.28), (0.66, 0.34), (0, 0.34)], 20, (bx, 1.25, bz - 0.3), (0, 0.10, 1), uv_scale=(4, 3))
    for r, y, slot in ((0.48, 0.346, 0), (0.33, 0.352, 1), (0.15, 0.358, 0)):
        lathe(mark, [(r, 0), (0, 0.003)], 20, (bx, 1.25 + 0.1 * y, bz - 0.3 + y), (0, 0.10, 1), slots=[slot])
    for s in (-1, 1):
        pole(wood, (bx + s * 0.55, 0, bz - 0.1), (bx + s * 0.45, 2.0, bz - 0.35), 0.06, sides=7)
        pole(wood, (bx + s * 0.45, 1.2, bz - 0.3), (bx + s * 0.50, 0, bz - 1.2), 0.05, sides=7)
    pole(wood, (bx - 0.6, 0.56, bz + 0.02), (bx + 0.6, 0.56, bz + 0.02), 0.05, sides=7)
    model.add("visual_broken_wall", wall, ["limestone"], scene, 20)
    model.add("visual_butt", straw, ["straw_bale"], scene, 40)
    model.add("visual_butt_mark", mark, ["paint_red", "paint_white"], scene, 60)
    model.add("visual_butt_posts", wood, ["planks"], scene, 40)


# Trees ----------------------------------------------------------------------------------------------------------------------------


def crown(shape, centre, radius, seed, leaves, size):
    """A ball of short leafy twigs, thinner below: grey-green above, dark inside."""
    rng = np.random.default_rng(seed)
    for _ in range(leaves):
        d = rng.normal(size=3)
        d /= np.linalg.norm(d)
        p = np.asarray(centre) + d * radius * (1, 0.78, 1) * rng.uniform(0.62, 1.0)
        a, b = rng.normal(size=(2, 3))
        a = a / np.linalg.norm(a) * size
        b = np.cross(a, b)
        b = b / np.linalg.norm(b) * size * 0.55
        i = shape.points([p - a, p + b, p + a, p - b])
        bright = 0.5 + 0.5 * d[1] + rng.normal(0, 0.2)
        shape.face(tuple(i), ((0.5, 0.5),) * 4, 1 if bright > 0.62 else 2)


def olive(seed, leaves=420, size=0.13):
    """Trunk and crown; materials: bark, pale leaf, dark leaf."""
    rng, shape = np.random.default_rng(500 + seed), Shape()
    fork = np.array([rng.normal(0, 0.12), 1.0 + 0.15 * rng.random(), rng.normal(0, 0.12)])
    tube(shape, [(0, -0.25, 0), (0.06, 0.4, 0.03), tuple(fork)], lambda t: 0.24 - 0.09 * t, 7, 0, v_scale=0.5)
    for k in range(3):
        a = 2 * math.pi * k / 3 + rng.uniform(0, 1)
        tip = fork + np.array([0.85 * math.cos(a), 0.85 + 0.3 * rng.random(), 0.85 * math.sin(a)])
        tube(shape, [tuple(fork), tuple(mix(fork, tip, 0.5) + (0, 0.1, 0)), tuple(tip)], lambda t: 0.13 - 0.09 * t, 5, 0, v_scale=0.5)
        crown(shape, tip + (0, 0.1, 0), rng.uniform(0.72, 0.95), 510 + 10 * seed + k, leaves // 4, size)
    crown(shape, fork + (0, 1.25, 0), 1.0, 540 + seed, leaves // 3, size)
    return shape


def cypress(seed):
    rng, shape = np.random.default_rng(600 + seed), Shape()
    tube(shape, [(0, -0.2, 0), (0, 0.9, 0)], 0.12, 6, 0)
    for k in range(150):
        t = rng.random()
        r, a = 0.62 * math.sin(math.pi * (0.12 + 0.86 * t)) ** 0.8 * (1 - 0.35 * t), rng.uniform(0, 2 * math.pi)
        p = np.array([r * math.cos(a), 0.5 + 5.6 * t, r * math.sin(a)])
        out, side = np.array([math.cos(a), 0, math.sin(a)]) * 0.10, np.array([-math.sin(a), 0, math.cos(a)]) * 0.17
        i = shape.points([p - side, p + out - (0, 0.12, 0), p + side, p + (0, 0.50, 0)])
        shape.face(tuple(i), ((0.5, 0.5),) * 4, 2)
    return shape


def plant(model, parent, mesh, name, x, z, turn):
    made = bpy.data.objects.new(name, mesh)
    made.parent = parent
    made.location, made.rotation_euler = to_blender((x, height_at(x, z), z)), (0, 0, turn)
    model.collection.objects.link(made)


def make_trees(model, scene):
    kinds = [model.add(f"visual_olive_{k}", olive(k), ["bark", "leaf_pale", "leaf_dark"], None, 60) for k in range(3)]
    kinds += [model.add(f"visual_grove_{k}", olive(7 + k, 110, 0.26), ["bark", "leaf_pale", "leaf_dark"], None, 60) for k in range(2)]
    kinds.append(model.add("visual_cypress", cypress(1), ["bark", "leaf_pale", "leaf_cypress"], None, 60))
    meshes = [k.data for k in kinds]
    for made in kinds:
        bpy.data.objects.remove(made)
    rng = np.random.default_rng(461)
    near = [(-6.6, -18.0), (-4.6, -22.5), (-11.6, -12.4), (-12.6, -8.0), (12.4, -14.5), (12.9, -18.5), (-3.6, -31), (-14.2, -16), (-15.5, -11), (14.5, -22), (3.0, -36), (-7.6, -27), (-10.5, -5.0), (-6.9, -15.8)]
    for k, (x, z) in enumerate(near):
        plant(model, scene, meshes[k % 3], f"visual_tree_{k}", x, z, 1.3 * k)
    made = 0
    while made < 150:
        z = -26 - 90 * rng.random() ** 1.25
        x = rng.uniform(-0.95, 0.95) * (8 - z)
        if abs(x - river_x(z)) < 4.5 or abs(x - road_x(z)) < 2.5 or (abs(x - TEMPLE[0]) < 7 and z > -36) or (-4.5 < x < 2.5 and z > -30):
            continue
        plant(model, scene, meshes[3 + made % 2], f"visual_far_{made}", x, z, rng.uniform(0, 6))
        made += 1
    for k, (x, z) in enumerate(((-1.3, -35), (10.8, -27), (11.9, -29.5), (0.2, -37), (12.4, -25), (9.9, -36), (-7.6, -33))):
        plant(model, scene, meshes[5], f"visual_cypress_{k}", x, z, 0.9 * k)
