"""Models the crossbow with a winch, and writes crossbow.glb.

    blender -b --python crossbow.py -- crossbow.glb [PICTURES]      (Blender 3.4, with python3-numpy)

With PICTURES, the beginning of a path, it also renders it. Form: Heron, Belopoeica 75-81; the winch and the base as Biton has them. Metres,
glTF's axes (y up); the visitor stands behind the stock and looks along -z, as it shoots.

Nodes at the root, all with identity transforms, each in the frame of its own body:
  FRAME          base, stock with its groove and toothed bars, the bow's middle, the winch's cheeks; origin at the world's
  SLIDER         slider with channel, claw, pawls and knob; origin where the string lies in the claw, the arrow along -z
  TRIGGER        lever that hangs at the slider's side; origin at its pin, which is along x
  DRUM           winch and crank; origin in the axle's middle, axis x
  LIMB_L, _R     limbs of the bow, as they are when it is at rest; origin where they leave its middle
  STRING_L, _R   halves of the string, as they are at rest; origin at the limb's tip
  ARROW          arrow; origin in its middle, tip along -z
  TABLE          what the arrow waits on; origin at the world's
  GROUND         what a dropped arrow falls on; origin at the world's
  TARGET         straw butt; origin in the middle of its face, which looks along z
  SCENE          meadow and surroundings
Children named part_* are touched as well as drawn, and are closed; children named visual_* are drawn only.
"""
import math
import os
import sys
import tempfile

import bpy
import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from modelling import Model, Shape, block, earth, export, lathe, picture, rod, skirt, timber, to_blender, tube, tuft  # noqa: E402
from surfaces import Textures, fractal, material, mix, museum_materials, noise, step, surface, tint  # noqa: E402

ARROW_Y, CLAW_START, CLAW_HOME, CLAW_DRAWN = 1.03, 0.10, -0.15, 0.30
FLOOR, RAIL_TOP, HALF_WIDTH = 0.962, 0.983, 0.052  # of the groove; of its rails; of the stock
PITCH, TOOTH = 0.015, 0.009
PAWL_TIP = -0.038  # along z from the claw
AXLE = np.array([0.0, 0.92, 0.75])
DRUM_RADIUS, ROPE_RADIUS = 0.023, 0.007  # the rope's middle is 0.030 m from the axle
CRANK_RADIUS, ARM_X, GRIP_X, GRIP_LENGTH, GRIP_RADIUS = 0.25, 0.245, 0.330, 0.120, 0.016
PIVOT = np.array([0.085, 0.995, CLAW_START + 0.035])
ROOT, TIP = np.array([0.13, 0.945, -0.30]), np.array([0.62, ARROW_Y, CLAW_HOME])
ARROW_LENGTH, SHAFT = 0.46, 0.006
ARROW_REST = np.array([-0.45, 0.838, 0.45])
FACE = np.array([0.0, 0.715, -15.16])
FACE_RADIUS = 0.42


# Materials -----------------------------------------------------------------------------------------------------------------------


def straw():
    """Bundled stalks along u, bound every so often."""
    rng = np.random.default_rng(81)
    shape = (512, 512)
    stalks = 0.6 * noise(shape, (90, 6), rng) + 0.4 * noise(shape, (200, 14), rng)
    broad = fractal(shape, (5, 5), rng, 4)
    colour = tint((0.30, 0.205, 0.075), (0.66, 0.52, 0.235), np.clip(1.5 * stalks - 0.25, 0, 1)) * (0.75 + 0.5 * broad)[..., None]
    u = np.mod(np.arange(512) / 512 * 6, 1.0)[None, :] + 0.06 * (noise(shape, (20, 1), rng) - 0.5)
    bound = np.exp(-((u - 0.5) / 0.035) ** 2)
    colour = mix(colour, np.array([0.20, 0.12, 0.055])[None, None, :], (0.8 * bound)[..., None])
    return np.clip(colour, 0, 1), 2.2 * stalks - 1.6 * bound


def horn():
    """A composite bow's skin: sinew laid along, lacquered dark, worn to the horn."""
    rng = np.random.default_rng(83)
    shape = (512, 512)
    fibre = 0.5 * noise(shape, (4, 120), rng) + 0.5 * noise(shape, (9, 200), rng)
    broad = fractal(shape, (6, 4), rng, 5)
    colour = tint((0.185, 0.075, 0.034), (0.085, 0.030, 0.016), fibre) * (0.7 + 0.6 * broad)[..., None]
    worn = step(0.56, 0.70, fractal(shape, (7, 5), rng, 5, 0.6))
    colour = mix(colour, np.array([0.43, 0.31, 0.155])[None, None, :] * (0.6 + 0.6 * fibre)[..., None], (0.75 * worn)[..., None])
    return np.clip(colour, 0, 1), 0.8 * fibre - 0.4 * worn


def make_materials(textures):
    made = museum_materials(textures)
    made["straw"] = material("straw", *surface(textures, "straw", *straw(), 0.8), roughness=0.9)
    made["horn"] = material("horn", *surface(textures, "horn", *horn(), 0.4), roughness=0.42)
    made["iron"] = material("iron", base=(0.075, 0.07, 0.066, 1), roughness=0.48, metallic=0.85)
    made["ochre"] = material("ochre", base=(0.30, 0.060, 0.028, 1), roughness=0.92)
    made["feather"] = material("feather", base=(0.50, 0.44, 0.36, 1), roughness=0.85, two_sided=True)
    made["dyed"] = material("dyed", base=(0.42, 0.075, 0.035, 1), roughness=0.85, two_sided=True)
    made["blade"] = material("blade", base=(0.17, 0.20, 0.05, 1), roughness=0.75, two_sided=True)
    made["hay"] = material("hay", base=(0.38, 0.31, 0.13, 1), roughness=0.8, two_sided=True)
    return made


# Small shapes --------------------------------------------------------------------------------------------------------------------


def binding(shape, centre, direction, half_u, half_v, u, turns, pitch=0.0085, radius=0.0042, seed=0):
    """Turns of cord round something that runs along `direction`; `u` is the way of half_u."""
    rng = np.random.default_rng(3300 + seed)
    w = np.asarray(direction, float) / np.linalg.norm(direction)
    u = np.asarray(u, float) - w * (np.asarray(u, float) @ w)
    u /= np.linalg.norm(u)
    v = np.cross(w, u)
    path = []
    for a in np.arange(turns * 24 + 1) * 2 * math.pi / 24:
        c, s = math.cos(a), math.sin(a)
        square = (abs(c) ** 5 + abs(s) ** 5) ** -0.2
        path.append(np.asarray(centre) + u * (half_u * square * c) + v * (half_v * square * s) + w * (pitch * (a / (2 * math.pi) - turns / 2) + rng.normal(0, 0.0002)))
    return tube(shape, path, radius, 7, v_scale=11)


def box(shape, low, high, bevel=0.003, seed=0, rough=0.0):
    """A dressed bar along its longest side."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    centre, size = (low + high) / 2, high - low
    along = int(np.argmax(size))
    start, end = centre.copy(), centre.copy()
    start[along], end[along] = low[along], high[along]
    up = (0, 0, 1) if along == 1 else (0, 1, 0)
    width, height = {0: (size[2], size[1]), 1: (size[0], size[2]), 2: (size[0], size[1])}[along]
    return timber(shape, start, end, width, height, up=up, bevel=bevel, seed=seed, rough=rough)


def sweep(shape, path, size, sides=14, tiles=3.0):
    """An oval bar along a path: `size(t)` is half its height and half its thickness across."""
    rings, along = [], [0.0]
    for i, p in enumerate(path):
        d = path[min(i + 1, len(path) - 1)] - path[max(i - 1, 0)]
        d = d / np.linalg.norm(d)
        top = np.array([0.0, 1.0, 0.0]) - d * d[1]
        top /= np.linalg.norm(top)
        side = np.cross(top, d)
        h, w = size(i / (len(path) - 1))
        rings.append([p + top * (h * math.sin(a)) + side * (w * math.cos(a)) for a in np.arange(sides) * 2 * math.pi / sides])
        if i:
            along.append(along[-1] + np.linalg.norm(p - path[i - 1]))
    return shape.loft(rings, lambda i, j: (j / sides, along[i] * tiles), cap_scale=3)


def smooth(points, steps=6):
    """A Catmull-Rom curve through the points."""
    p = [np.asarray(q, float) for q in points]
    p = [2 * p[0] - p[1]] + p + [2 * p[-1] - p[-2]]
    out = []
    for i in range(1, len(p) - 2):
        for k in range(steps):
            t = k / steps
            out.append(0.5 * (2 * p[i] + (p[i + 1] - p[i - 1]) * t + (2 * p[i - 1] - 5 * p[i] + 4 * p[i + 1] - p[i + 2]) * t**2
                              + (3 * p[i] - p[i - 1] - 3 * p[i + 1] + p[i + 2]) * t**3))
    return out + [p[-2]]


# The crossbow --------------------------------------------------------------------------------------------------------------------


def make_frame(model):
    frame = model.group("FRAME")
    model.add("part_stock", box(Shape(), (-HALF_WIDTH, 0.830, -0.36), (HALF_WIDTH, 0.922, 0.62), 0.008, 11, 0.0012), ["timber"], frame)
    for k, s in enumerate((-1, 1)):
        low, high = sorted((s * 0.031, s * HALF_WIDTH))
        model.add(f"part_rail_{k}", box(Shape(), (low, 0.918, -0.255), (high, RAIL_TOP, 0.62), 0.004, 13 + k, 0.0005), ["timber"], frame)
        low, high = sorted((s * (HALF_WIDTH + 0.003), s * (HALF_WIDTH + 0.031)))
        model.add(f"part_cheek_{k}", box(Shape(), (low, 0.845, 0.47), (high, 0.972, 0.865), 0.008, 15 + k, 0.001), ["planks"], frame)
    model.add("part_post", box(Shape(), (-0.06, 0.05, 0.10), (0.06, 0.835, 0.22), 0.010, 21, 0.002), ["planks"], frame)
    floor, bronze, cord, rope, wood = Shape(), Shape(), Shape(), Shape(), Shape()
    for k, s in enumerate((-1, 1)):
        low, high = sorted((s * 0.011, s * 0.032))
        box(floor, (low, 0.918, -0.255), (high, FLOOR, 0.62), 0.002, 17 + k)
        make_rack(bronze, s)
        for z in (0.52, 0.60):  # bolts through cheeks and stock, bushes of the axle
            rod(bronze, (s * 0.020, 0.876, z), (s * (HALF_WIDTH + 0.038), 0.876, z), 0.008, least_u=0.3)
        x = s * (HALF_WIDTH + 0.033)
        lathe(bronze, [(0.0135, -0.004), (0.026, -0.004), (0.027, 0), (0.026, 0.004), (0.0135, 0.004), (0.0135, -0.004)], 32, (x, AXLE[1], AXLE[2]), (1, 0, 0), uv_scale=(1, 5))
    rod(wood, (-0.088, 0.885, 0.835), (0.088, 0.885, 0.835), 0.013)
    model.add("visual_floor", floor, ["timber"], frame)
    # The rope of the winch, as far as it is always the same: the rest lies under the slider.
    rod(rope, (0, 0.950, CLAW_DRAWN - 0.36), (0, 0.950, AXLE[2]), ROPE_RADIUS, 10, 9, least_u=0.3)
    model.add("visual_rope", rope, ["hemp"], frame, 60)
    make_middle(model, frame, cord, bronze)
    make_base(model, frame, cord, bronze)
    model.add("visual_bronze", bronze, ["bronze"], frame, 38)
    model.add("visual_cord", cord, ["hemp"], frame, 60)
    model.add("visual_tie", wood, ["timber"], frame)


def make_rack(shape, side):
    """Saw teeth on a rail: a pawl drags over them towards the archer, and their upright faces hold it from going back."""
    first = CLAW_HOME + PAWL_TIP - 0.001
    outline = [(first - PITCH * 2, RAIL_TOP - 0.004), (first - PITCH * 2, RAIL_TOP)]
    for k in range(-1, 33):
        z = first + k * PITCH
        outline += [(z - PITCH * 0.9, RAIL_TOP + 0.001), (z - 0.0010, RAIL_TOP + TOOTH), (z, RAIL_TOP + TOOTH - 0.0008), (z, RAIL_TOP + 0.001)]
    outline += [(first + 33 * PITCH, RAIL_TOP), (first + 33 * PITCH, RAIL_TOP - 0.004)]
    low, high = side * 0.0345, side * 0.0485
    rings = [[(x, y, z) for z, y in (outline if high > low else outline[::-1])] for x in (low, high)]
    index = [shape.points(r) for r in rings]
    n = len(outline)
    for j in range(n):
        k = (j + 1) % n
        shape.face((index[0][j], index[0][k], index[1][k], index[1][j])[::-1], tuple((rings[i][c][2] * 6, 0.1 * i + rings[i][c][1] * 6) for i, c in ((0, j), (0, k), (1, k), (1, j)))[::-1])
    for i in (0, 1):
        for t in range(-1, 33):  # each tooth by itself: the outline as a whole bends inwards
            b = 2 + 4 * (t + 1)
            own = [b, b + 1, b + 2, b + 3] if high > low else [n - 1 - b, n - 2 - b, n - 3 - b, n - 4 - b]
            corners = tuple(index[i][c] for c in (own if i else own[::-1]))
            shape.face(corners[::-1], tuple((shape.vertices[c][2] * 6, shape.vertices[c][1] * 6) for c in corners[::-1]))


def make_middle(model, frame, cord, bronze):
    """The bow's middle, a wooden grip let into the stock's end, lashed and bolted."""
    shape = Shape()
    path = smooth([(-0.165, 0.947, -0.294), (-0.08, 0.934, -0.303), (0.0, 0.931, -0.305), (0.08, 0.934, -0.303), (0.165, 0.947, -0.294)])
    sweep(shape, path, lambda t: (0.027 - 0.004 * abs(2 * t - 1), 0.030 - 0.008 * abs(2 * t - 1)), 16, 0.45)
    model.add("visual_middle", shape, ["planks"], frame, 50)
    for k, s in enumerate((-1, 1)):
        binding(cord, (s * 0.140, 0.943, -0.297), (s, 0.13, 0.09), 0.027, 0.025, (0, 1, 0), 6, seed=k)
        binding(cord, (s * 0.030, 0.886, -0.305), (1, 0, 0), 0.078, 0.040, (0, 1, 0), 4, 0.009, 0.0045, 5 + k)
    rod(bronze, (0, 0.845, -0.372), (0, 0.845, -0.345), 0.012)


def make_base(model, frame, cord, bronze):
    """Post, cross feet, struts."""
    wood = Shape()
    timber(wood, (-0.48, 0.045, 0.16), (0.48, 0.045, 0.16), 0.105, 0.085, bevel=0.010, seed=31, rough=0.002)
    timber(wood, (0, 0.050, -0.34), (0, 0.050, 0.74), 0.105, 0.085, bevel=0.010, seed=33, rough=0.002)
    for s in (-1, 1):
        timber(wood, (s * 0.40, 0.08, 0.16), (s * 0.035, 0.52, 0.16), 0.060, 0.060, up=(0, 0, 1), bevel=0.007, seed=35 + s, rough=0.0015)
        timber(wood, (0, 0.08, 0.16 + s * 0.44), (0, 0.72, 0.16 + s * 0.035), 0.060, 0.060, up=(1, 0, 0), bevel=0.007, seed=38 + s, rough=0.0015)
        binding(cord, (s * 0.078, 0.468, 0.16), (s * -0.366, 0.44, 0), 0.036, 0.036, (0, 0, 1), 4, 0.009, 0.0045, 20 + s)
        rod(bronze, (s * 0.066, 0.79, 0.16), (s * 0.055, 0.79, 0.16), 0.016)
    block(wood, (-0.075, 0.795, 0.085), (0.075, 0.832, 0.235), 0.006, 41, 0.001)
    model.add("visual_base", wood, ["planks"], frame)


def make_slider(model):
    slider = model.group("SLIDER")
    model.add("part_beam", box(Shape(), (-0.029, FLOOR + 0.002 - ARROW_Y, -0.425), (0.029, -0.0075, 0.300), 0.004, 51, 0.0004), ["planks"], slider)
    strips = Shape()
    for k, s in enumerate((-1, 1)):
        low, high = sorted((s * 0.0085, s * 0.019))
        box(strips, (low, -0.010, -0.425), (high, -0.0005, -0.022), 0.0025, 53 + k)
    model.add("visual_channel", strips, ["timber"], slider)
    knob = [(0.0, -0.012), (0.013, -0.012), (0.0125, 0.020), (0.0135, 0.040), (0.0160, 0.065), (0.0168, 0.085), (0.0150, 0.103), (0.0090, 0.114), (0.0, 0.117)]
    model.add("part_knob", lathe(Shape(), knob, 32, (0, 0, 0.20), (0, 1, 0), (0, 0, 1), uv_scale=(0.115, 1.2), uv_offset=(0.38, 0.2)), ["grip"], slider, 45)
    bronze = Shape()
    for s in (-1, 1):  # the claw between its cheeks; the pawls
        low, high = sorted((s * 0.0125, s * 0.0175))
        box(bronze, (low, -0.009, 0.010), (high, 0.026, 0.062), 0.002, 5)
        low, high = sorted((s * 0.0035, s * 0.0105))
        x = (low + high) / 2
        sweep(bronze, smooth([(x, 0.013, 0.052), (x, 0.017, 0.030), (x, 0.016, 0.012), (x, 0.009, -0.003), (x, -0.004, -0.0065)]),
              lambda t: (mix(0.0060, 0.0032, t), 0.0035), 10)
        pin, tip = np.array([s * 0.0415, -0.012, 0.034]), np.array([s * 0.0415, RAIL_TOP + 0.006 - ARROW_Y, PAWL_TIP + 0.002])
        timber(bronze, pin + (pin - tip) * 0.12, tip, 0.011, 0.011, bevel=0.002, seed=7, rough=0, taper=0.7)
    rod(bronze, (-0.047, -0.012, 0.034), (0.047, -0.012, 0.034), 0.0055, least_u=0.3)
    rod(bronze, (-0.021, 0.015, 0.045), (0.021, 0.015, 0.045), 0.0045, least_u=0.3)
    rod(bronze, (0.020, PIVOT[1] - ARROW_Y, 0.035), (0.096, PIVOT[1] - ARROW_Y, 0.035), 0.0055, least_u=0.3)
    lathe(bronze, [(0.0165, -0.0005), (0.026, -0.0005), (0.026, 0.0035), (0.0165, 0.0035)], 28, (0, -0.008, 0.20), (0, 1, 0), (0, 0, 1), uv_scale=(1, 5))
    for z in (-0.40, 0.275):
        box(bronze, (-0.0305, -0.0100, z - 0.009), (0.0305, -0.0055, z + 0.009), 0.0015, 3)
    model.add("visual_bronze", bronze, ["bronze"], slider, 40)


def make_trigger(model):
    trigger = model.group("TRIGGER")
    model.add("part_lever", box(Shape(), (-0.006, -0.128, -0.009), (0.006, 0.018, 0.009), 0.003, 57), ["bronze"], trigger)
    grip = [(0.0, -0.010), (0.0105, -0.010), (0.0125, -0.006), (0.0130, 0.030), (0.0145, 0.055), (0.0140, 0.075), (0.0100, 0.084), (0.0, 0.086)]
    model.add("part_knob", lathe(Shape(), grip, 28, (0, -0.125, 0), (1, 0, 0), uv_scale=(0.115, 1.2), uv_offset=(0.63, 0.4)), ["grip"], trigger, 45)
    hub = Shape()
    rod(hub, (-0.009, 0, 0), (0.009, 0, 0), 0.014)
    model.add("visual_hub", hub, ["bronze"], trigger, 40)


def make_drum(model):
    drum = model.group("DRUM")
    x_axis = {"axis": (1, 0, 0), "up": (0, 1, 0)}
    fittings, wood, turns = Shape(), Shape(), Shape()
    lathe(wood, [(0, -0.050), (DRUM_RADIUS, -0.050), (DRUM_RADIUS, 0.050), (0, 0.050)], 32, **x_axis, uv_scale=(0.4, 0.43), uv_offset=(0.05, 0.3), end_grain=(0, 2))
    for x in (-0.046, 0.046):
        lathe(wood, [(DRUM_RADIUS - 0.001, x - 0.005), (0.040, x - 0.005), (0.042, x - 0.003), (0.042, x + 0.003), (0.040, x + 0.005), (DRUM_RADIUS - 0.001, x + 0.005)], 36, **x_axis,
              uv_scale=(0.5, 1), uv_offset=(0.3, 0.3), end_grain=(0, 4))
    model.add("visual_log", wood, ["timber"], drum, 35)
    pitch = 2 * ROPE_RADIUS * 1.02
    path = [(pitch * (a / (2 * math.pi) - 2), (DRUM_RADIUS + ROPE_RADIUS) * math.cos(a), (DRUM_RADIUS + ROPE_RADIUS) * math.sin(a)) for a in np.arange(0, 4 * 28 + 1) * 2 * math.pi / 28]
    tube(turns, path, ROPE_RADIUS, 9, v_scale=9)
    model.add("visual_turns", turns, ["hemp"], drum, 60)
    rod(fittings, (-0.125, 0, 0), (ARM_X + 0.026, 0, 0), 0.0125, 20)
    arm = timber(Shape(), (ARM_X, 0, -0.050), (ARM_X, 0, CRANK_RADIUS + 0.036), 0.034, 0.048, up=(0, 1, 0), bevel=0.007, seed=61, rough=0.0006, taper=0.88)
    model.add("part_arm", arm, ["timber"], drum)
    swell = [(0.0, -1.0), (0.0100, -1.0), (0.0130, -0.97), (0.0143, -0.92), (0.0141, -0.85), (0.0150, -0.6), (0.0158, -0.3), (GRIP_RADIUS, 0.0), (0.0158, 0.3),
             (0.0150, 0.6), (0.0141, 0.85), (0.0143, 0.92), (0.0130, 0.97), (0.0100, 1.0), (0.0, 1.0)]
    grip = lathe(Shape(), [(r, GRIP_X + t * GRIP_LENGTH / 2) for r, t in swell], 36, (0, 0, CRANK_RADIUS), **x_axis, uv_scale=(0.115, 1.2), uv_offset=(0.13, 0.3))
    model.add("part_grip", grip, ["grip"], drum, 45)
    rod(fittings, (ARM_X - 0.022, 0, CRANK_RADIUS), (GRIP_X + GRIP_LENGTH / 2 + 0.006, 0, CRANK_RADIUS), 0.0065, least_u=0.3)
    for z, r in ((0.0, 0.026), (CRANK_RADIUS, 0.019)):
        for x in (ARM_X - 0.021, ARM_X + 0.017):
            lathe(fittings, [(0.006, x), (r, x), (r + 0.001, x + 0.001), (r, x + 0.004), (0.006, x + 0.004)], 28, (0, 0, z), **x_axis, uv_scale=(1, 5))
    model.add("visual_bronze", fittings, ["bronze"], drum, 40)


def make_bow(model):
    reach = TIP - ROOT
    for name, s in (("L", -1), ("R", 1)):
        limb = model.group(f"LIMB_{name}")
        flip = np.array([s, 1, 1])
        bare = [(0, 0, 0), (0.13, 0.022, 0.004), (0.27, 0.044, 0.048), (0.40, 0.068, 0.118), tuple(reach), tuple(reach + (0.050, 0.007, 0.000))]
        path = [p * flip for p in smooth(bare)]
        shape = sweep(Shape(), path, lambda t: (mix(0.026, 0.0105, t**1.3), mix(0.0155, 0.0075, t)), 16, 2.2)
        model.add("visual_limb", shape, ["horn"], limb, 50)
        cord = Shape()
        for k, i in enumerate((7, 14, 20)):
            t = i / (len(path) - 1)
            binding(cord, path[i], path[i + 1] - path[i - 1], mix(0.026, 0.0105, t**1.3) * 0.86, mix(0.0155, 0.0075, t) * 0.86, (0, 1, 0), 5, 0.0046, 0.0023, 30 + k)
        binding(cord, reach * flip, path[-1] - path[-8], 0.0100, 0.0078, (0, 1, 0), 2, 0.006, 0.0032, 40)
        model.add("visual_cord", cord, ["hemp"], limb, 60)
        string = model.group(f"STRING_{name}")
        made = Shape()
        tube(made, [(-s * x, 0, 0) for x in np.linspace(0, TIP[0], 24)], lambda t: 0.0036 + 0.0016 * (t > 0.86), 8, v_scale=14)
        model.add("visual_string", made, ["hemp"], string, 60)


def make_arrow(model):
    arrow = model.group("ARROW")
    half = ARROW_LENGTH / 2
    shaft = [(0.0, -half), (SHAFT - 0.0015, -half), (SHAFT, -half + 0.0015), (SHAFT, half - 0.040), (SHAFT - 0.001, half - 0.036), (0.0, half - 0.036)]
    model.add("part_shaft", lathe(Shape(), shaft, 18, (0, 0, 0), (0, 0, -1), uv_scale=(0.115, 0.8), uv_offset=(0.5, 0.1)), ["grip"], arrow, 45)
    # Whipped with cord where a hand takes it: thicker to the touch, too.
    sleeve = [(0.0, -0.052), (0.0062, -0.052), (0.0082, -0.049), (0.0082, 0.049), (0.0062, 0.052), (0.0, 0.052)]
    model.add("part_grip", lathe(Shape(), sleeve, 20, uv_scale=(1, 34)), ["hemp"], arrow, 45)
    head = Shape()
    lathe(head, [(SHAFT - 0.001, half - 0.070), (SHAFT + 0.0016, half - 0.068), (SHAFT + 0.0016, half - 0.040), (0.0085, half - 0.034), (0.0050, half - 0.014), (0.0, half)], 4,
          (0, 0, 0), (0, 0, -1), uv_scale=(1, 8))
    model.add("visual_head", head, ["iron"], arrow, 30)
    vanes = Shape()
    for k, degrees in enumerate((90, 182, -2)):
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        outline = [(SHAFT - 0.001, 0.120), (0.014, 0.155), (0.020, 0.185), (0.0215, 0.208), (0.013, 0.2095), (SHAFT - 0.001, 0.207)]
        index = vanes.points([(r * c, r * s, z) for r, z in outline])
        vanes.face(tuple(index), tuple((r * 20, z * 20) for r, z in outline), 0 if k else 1)
    model.add("visual_vanes", vanes, ["feather", "dyed"], arrow, 20)
    cord = Shape()
    for z in (0.116, 0.211):
        binding(cord, (0, 0, z), (0, 0, 1), SHAFT - 0.0006, SHAFT - 0.0006, (1, 0, 0), 5, 0.0018, 0.0011, 50)
    model.add("visual_cord", cord, ["hemp"], arrow, 60)


def make_table(model):
    table = model.group("TABLE")
    x, top = ARROW_REST[0], ARROW_REST[1] - SHAFT - 0.030
    model.add("part_top", box(Shape(), (x - 0.10, top - 0.030, 0.14), (x + 0.10, top, 0.76), 0.004, 71, 0.0006), ["planks"], table)
    for k, z in enumerate((0.31, 0.59)):
        model.add(f"part_rest_{k}", box(Shape(), (x - 0.075, top - 0.004, z - 0.016), (x + 0.075, top + 0.030, z + 0.016), 0.003, 73 + k), ["timber"], table)
        for n, s in enumerate((-1, 1)):  # so that it does not roll
            low, high = sorted((s * 0.010, s * 0.022))
            model.add(f"part_ridge_{k}_{n}", box(Shape(), (x + low, top + 0.024, z - 0.015), (x + high, top + 0.039, z + 0.015), 0.002, 72 + k), ["timber"], table)
    legs = Shape()
    for sx in (-1, 1):
        for k, z in enumerate((0.19, 0.71)):
            timber(legs, (x + sx * 0.125, 0.0, z + (k - 0.5) * 0.06), (x + sx * 0.068, top - 0.02, z), 0.036, 0.036, up=(0, 0, 1), bevel=0.005, seed=75 + k, rough=0.001)
    for z in (0.19, 0.71):
        box(legs, (x - 0.105, 0.34, z - 0.012), (x + 0.105, 0.37, z + 0.012), 0.003, 79)
    model.add("visual_legs", legs, ["timber"], table)


def make_target(model):
    target = model.group("TARGET")
    coils, paint, wood = Shape(), Shape(), Shape()
    lathe(coils, [(0, -0.24), (FACE_RADIUS - 0.03, -0.24), (FACE_RADIUS, -0.20), (FACE_RADIUS, -0.03), (FACE_RADIUS - 0.015, -0.012), (0, -0.012)], 56, (0, 0, 0), uv_scale=(6, 2))
    pitch, a = 0.036, np.arange(0, 11.2 * 36 + 1) * 2 * math.pi / 36
    tube(coils, [((0.014 + pitch * t / (2 * math.pi)) * math.cos(t), (0.014 + pitch * t / (2 * math.pi)) * math.sin(t), -0.016) for t in a], 0.0185, 8, v_scale=1.6)
    model.add("visual_coils", coils, ["straw"], target, 50)
    for radius, width in ((0.0, 0.075), (0.21, 0.030), (0.36, 0.030)):
        if radius == 0:
            lathe(paint, [(width, 0.0005), (width * 0.6, 0.0035), (0, 0.0040)], 40)
        else:
            lathe(paint, [(radius + width, 0.0010), (radius + width / 2, 0.0035), (radius, 0.0010)], 64)
    model.add("visual_paint", paint, ["ochre"], target, 40)
    for s in (-1, 1):
        timber(wood, (s * 0.36, -FACE[1] - 0.05, -0.10), (s * 0.30, 0.52, -0.15), 0.065, 0.060, up=(0, 0, 1), bevel=0.008, seed=83 + s, rough=0.002)
        timber(wood, (s * 0.26, -FACE[1] - 0.05, -0.95), (s * 0.24, 0.34, -0.26), 0.055, 0.055, up=(1, 0, 0), bevel=0.007, seed=86 + s, rough=0.002)
    for y in (-0.455, 0.46):
        timber(wood, (-0.47, y, -0.19), (0.47, y, -0.19), 0.055, 0.060, bevel=0.008, seed=89, rough=0.002)
    model.add("visual_stand", wood, ["planks"], target)


# Surroundings --------------------------------------------------------------------------------------------------------------------


def height_at(x, z):
    """Trodden over the slab, uneven beyond it; at its borders, which wander, the meadow sinks under the plain."""
    level = step(0.0, 1.2, max(abs(x) - 1.4, abs(z - 0.05) - 1.5))
    uneven = 0.02 * math.sin(1.3 * x + 1.1) * math.sin(0.9 * z) + 0.008 * math.sin(5.1 * x + 2) * math.sin(4.3 * z + 1)
    wander = 0.5 * math.sin(0.8 * z + 2) + 0.3 * math.sin(2.1 * z) + 0.4 * math.sin(1.1 * x + 1) + 0.15 * math.sin(3.7 * (x + z))
    border = max(abs(x) - 5.2, z - 2.6, -17.6 - z) + wander
    return 0.005 + level * uneven - 0.13 * step(0.0, 1.0, border)


def make_ground(model, scene):
    slab = model.group("GROUND")
    model.add("part_slab", box(Shape(), (-1.3, -0.12, -1.4), (1.3, 0.0, 1.5), 0.01, 91), ["earth"], slab)
    xs, zs = np.linspace(-7.2, 7.2, 90), np.concatenate([np.linspace(-20.2, -2.0, 90), np.linspace(-1.85, 4.6, 44)])
    rng = np.random.default_rng(191)
    grid = [[(x, height_at(x, z) + abs(rng.normal(0, 0.002)), z) for z in zs] for x in xs]
    shape, index = earth(grid, 1.6)
    skirt(shape, grid, index, -0.30)
    model.add("visual_ground", shape, ["earth"], scene, 40)


def make_wall(model, scene):
    """A field wall behind the target, to stop what misses it."""
    rng = np.random.default_rng(151)
    shape, seed = Shape(), 300
    for course in range(4):
        x = -3.1 + 0.16 * (course % 2)
        while x < 2.9:
            length = rng.uniform(0.42, 0.72)
            y = 0.34 * course - 0.05
            block(shape, (x + 0.004, y + 0.002, -17.75 + rng.normal(0, 0.012)), (min(x + length, 3.1), y + 0.338, -17.25 + rng.normal(0, 0.012)), 0.022, seed, 0.006)
            x, seed = x + length, seed + 1
    model.add("visual_wall", shape, ["limestone"], scene, 42)
    bales = Shape()
    for k, (x, z, turn) in enumerate(((1.75, -14.6, 0.4), (2.15, -15.5, -0.2), (-1.9, -13.2, 0.9))):
        d = np.array([math.cos(turn), 0, math.sin(turn)]) * 0.42
        lathe(bales, [(0, 0), (0.17, 0.0), (0.205, 0.02), (0.19, 0.22), (0.165, 0.42), (0.19, 0.62), (0.205, 0.82), (0.17, 0.84), (0, 0.84)], 30,
              np.array([x, height_at(x, z) + 0.185, z]) - d, d, (0, 1, 0), uv_scale=(3, 1.2))
    model.add("visual_bales", bales, ["straw"], scene, 45)
    pegs = Shape()
    for k in range(3):  # marks of the range, each five metres
        for s in (-1, 1):
            x, z = s * 0.95, -0.16 - 5.0 * (k + 1) + 0.35 * (k == 2)
            lathe(pegs, [(0.024, -0.1), (0.024, 0.24 + 0.05 * k), (0.018, 0.255 + 0.05 * k), (0, 0.258 + 0.05 * k)], 14, (x, height_at(x, z), z), (0, 1, 0), (0, 0, 1), uv_scale=(0.11, 1),
                  uv_offset=(0.13 * k, 0.2))
    model.add("visual_pegs", pegs, ["timber"], scene)


def make_grass(model, scene):
    rng = np.random.default_rng(171)
    shape = Shape()
    made = 0
    while made < 800:
        x, z = rng.normal(0, 2.4), 2.4 - 20.0 * rng.random() ** 1.2
        if (abs(x) < 0.9 and -0.8 < z < 1.5) or (abs(x) < 0.7 and rng.random() < 0.75) or z < -17.1 or height_at(x, z) < -0.03:
            continue
        made += 1
        tuft(shape, rng, x, z, height_at, spread=0.04, dry=0.55)
    model.add("visual_grass", shape, ["blade", "hay"], scene, 60)


# The file ------------------------------------------------------------------------------------------------------------------------


def place(name, position, axis=(0, 1, 0), angle=0.0):
    made = bpy.data.objects[name]
    made.location = to_blender(position)
    made.rotation_mode = "AXIS_ANGLE"
    made.rotation_axis_angle = (angle, *to_blender(axis))


def pose(claw, arrow):
    """Puts the bodies where they are while the claw is at `claw`, for the pictures."""
    place("SLIDER", (0, ARROW_Y, claw))
    place("TRIGGER", PIVOT + (0, 0, claw - CLAW_START))
    place("DRUM", AXLE, (1, 0, 0), (claw - CLAW_START) / 0.03)
    place("ARROW", (0, ARROW_Y, claw - ARROW_LENGTH / 2) if arrow else ARROW_REST)
    place("TARGET", FACE)
    arm, half = math.hypot(TIP[0] - ROOT[0], TIP[2] - ROOT[2]), TIP[0]
    across, back = -ROOT[0], claw - ROOT[2]
    between = math.hypot(across, back)
    along = (arm**2 - half**2 + between**2) / (2 * between)
    off = math.sqrt(arm**2 - along**2)
    x = ROOT[0] + (across * along + back * off) / between
    z = ROOT[2] + (back * along - across * off) / between
    limb = math.atan2(TIP[2] - ROOT[2], TIP[0] - ROOT[0]) - math.atan2(z - ROOT[2], x - ROOT[0])
    string = -math.atan2(claw - z, x)
    for name, s in (("L", -1), ("R", 1)):
        place(f"LIMB_{name}", ROOT * (s, 1, 1), angle=s * limb)
        place(f"STRING_{name}", (s * x, ARROW_Y, z), angle=-s * string)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with tempfile.TemporaryDirectory() as folder:
        model = Model(make_materials(Textures(folder)))
        for make in (make_frame, make_slider, make_trigger, make_drum, make_bow, make_arrow, make_table, make_target):
            make(model)
        scene = model.group("SCENE")
        for make in (make_ground, make_wall, make_grass):
            make(model, scene)
        export(os.path.abspath(arguments[0]))
        if len(arguments) < 2:
            return
        for name, claw, arrow, eye, look_at in (("whole", CLAW_START, False, (1.35, 1.75, 2.5), (-0.05, 0.75, 0.1)),
                                                ("drawn", CLAW_DRAWN, True, (0.75, 1.65, 1.25), (0.0, 0.95, 0.1)),
                                                ("claw", CLAW_DRAWN, True, (0.42, 1.30, 0.72), (0.02, 0.99, 0.28)),
                                                ("target", CLAW_DRAWN, True, (0.9, 1.35, -12.9), (0.0, 0.65, -15.2))):
            if len(arguments) > 2 and name not in arguments[2:]:
                continue
            pose(claw, arrow)
            picture(f"{os.path.abspath(arguments[1])}-{name}.png", eye, look_at, samples=20)


main()
