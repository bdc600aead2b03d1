"""Models the stone-thrower and the wall that it breaks, and writes catapult.glb.

    blender -b --python catapult.py -- catapult.glb [PICTURES]      (Blender 3.4, with python3-numpy)

With PICTURES, the beginning of a path, it also renders them. Form: Philon, Belopoeica 51-56; Vitruvius, De architectura X.10-12. Metres,
glTF's axes (y up); the visitor stands at +z and looks along -z, and so flies the stone.

Nodes at the root, all with identity transforms, each in the frame of its own body:
  FRAME      spring frame, springs, stock, stand, winch posts; origin at the world's
  SLIDER     it runs on the stock; origin on its top, where its claw holds the string
  ARM_R, _L  origin in the spring's middle, x outwards along the arm (the left one along -x)
  STRING_R, _L   half of the bowstring; origin in its middle, x (or -x) towards the arm's tip
  WINCH      drum, ratchet wheel, handspikes; origin in the axle's middle, axis x
  LEVER      the trigger; origin in its pivot, axis x
  PIN        keeps the lever from being pulled; origin at the world's
  STONE      the ball with its carrying cord; origin in the ball's middle
  BLOCK_A, BLOCK_B, HALF   of the wall; origin in the middle
  GROUND     what things fall on; origin at the world's
  SCENE      surroundings
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
from modelling import Model, Shape, block, cut_cube, earth, export, lathe, picture, rod, timber, to_blender, tube, tuft  # noqa: E402
from surfaces import Textures, fractal, iron_material, material, mix, museum_materials, noise, step, surface, tint  # noqa: E402

SPRING_X, SPRING_Z, ARM_Y, ARM = 0.42, -1.76, 1.10, 0.95
REST, DRAWN, HALF_STRING = 0.12, -0.78, 1.48  # angle of the arms forward of sideways, at rest and drawn
SLIDER_Y, STRING_OVER = 1.06, 0.04            # top of the slider; the string's height over it
STOCK_Y = 1.00
WINCH, SPIKE, GRIP_RADIUS = np.array([0.0, 0.985, 0.42]), 0.50, 0.018
DRUM_RADIUS, ROPE_RADIUS = 0.037, 0.008       # the rope's middle is 0.045 m from the axle
SPIKE_X, RATCHET_X, TEETH, RATCHET_RADIUS, TOOTH = 0.36, 0.205, 24, 0.105, 0.013
LEVER = np.array([0.155, 0.93, -0.02])
BALL = 0.074
STAND = np.array([0.85, 0.62, 0.05])          # where the stone waits: the top of the stump
WALL_Z, FOOTING = -7.08, 0.40
SLAB = (2.8, 1.6, -11.0)                      # what things fall on: half its width, its near and its far end
BLOCK = np.array([0.36, 0.20, 0.16])


def nock_z(angle):
    """Of the string's middle, with the arms at an angle."""
    x = SPRING_X + ARM * math.cos(angle)
    return SPRING_Z - ARM * math.sin(angle) + math.sqrt(HALF_STRING**2 - x**2)


# Materials -----------------------------------------------------------------------------------------------------------------------


def sinew():
    """Cords of sinew laid side by side along v, oiled and a little dusty."""
    rng = np.random.default_rng(81)
    shape = (512, 256)
    v, u = np.mgrid[0:512, 0:256] / np.array([512, 256])[:, None, None]
    cords = np.abs(np.sin(math.pi * (4 * u + 2 * v)))
    fibre = 0.6 * noise(shape, (6, 128), rng) + 0.4 * noise(shape, (20, 80), rng)
    tone = np.clip(cords * (0.55 + 0.6 * fibre), 0, 1)
    colour = tint((0.20, 0.125, 0.06), (0.66, 0.50, 0.31), tone)
    dust = step(0.55, 0.8, fractal(shape, (5, 5), rng, 4))
    colour = mix(colour, np.array([0.52, 0.44, 0.34])[None, None, :], (0.35 * dust)[..., None])
    return np.clip(colour, 0, 1), 3.0 * cords + 0.8 * fibre


def make_materials(textures):
    made = museum_materials(textures)
    made["sinew"] = material("sinew", *surface(textures, "sinew", *sinew(), 0.6), roughness=0.6)
    made["iron"] = iron_material(textures)
    made["blade"] = material("blade", base=(0.17, 0.20, 0.05, 1), roughness=0.75, two_sided=True)
    made["straw"] = material("straw", base=(0.38, 0.31, 0.13, 1), roughness=0.8, two_sided=True)
    return made


# Small shapes --------------------------------------------------------------------------------------------------------------------


def hoop(shape, outline, centre, axis, tiles=1):
    """A closed outline turned about an axis."""
    return lathe(shape, outline + outline[:1], 36, centre, axis, (0, 1, 0) if abs(axis[1]) < 0.5 else (0, 0, 1), uv_scale=(tiles, 5))


def nail(shape, at, out, radius=0.013):
    """A bronze nail's head."""
    lathe(shape, [(radius, -0.002), (radius, 0.002), (radius * 0.6, 0.005), (0, 0.006)], 10, at, out, (0, 1, 0) if abs(out[1]) < 0.5 else (0, 0, 1), uv_scale=(1, 9))


def coil(shape, centre, axis, half_u, half_v, turns, radius=0.006, pitch=0.0125, seed=0):
    """Turns of cord round a beam, square or round."""
    rng = np.random.default_rng(3100 + seed)
    w = np.asarray(axis, float) / np.linalg.norm(axis)
    u = np.cross((0.0, 1.0, 0.0) if abs(w[1]) < 0.8 else (0.0, 0.0, 1.0), w)
    u /= np.linalg.norm(u)
    v = np.cross(w, u)
    path = []
    for a in np.arange(turns * 24 + 1) * 2 * math.pi / 24:
        c, s = math.cos(a), math.sin(a)
        square = (abs(c) ** 4 + abs(s) ** 4) ** -0.25
        path.append(np.asarray(centre) + u * half_u * square * c + v * half_v * square * s + w * (pitch * (a / (2 * math.pi) - turns / 2) + rng.normal(0, 0.0003)))
    tube(shape, path, radius, 7, v_scale=9)


# The spring frame ----------------------------------------------------------------------------------------------------------------

LOW, HIGH, THICK = 0.66, 1.54, 0.10  # the springs' free height; the hole-carriers lie outside of it


def spring(model, frame, s):
    """A bundle of twisted cords between two bronze washers, with the iron bars that it goes over."""
    cords, bronze, bars = Shape(), Shape(), Shape()
    x = s * SPRING_X
    bottom, top = LOW - THICK - 0.075, HIGH + THICK + 0.075
    for k in range(11):
        start = 2 * math.pi * k / 11
        path = []
        for t in np.linspace(0, 1, 21):
            waist = 0.088 - 0.030 * math.exp(-((t - 0.5) / 0.16) ** 2) * abs(math.cos(start + 0.4))
            a = start + s * 1.15 * (t - 0.5)
            path.append((x + waist * math.cos(a), mix(bottom, top, t), SPRING_Z + waist * math.sin(a)))
        tube(cords, path, 0.0285, 9, v_scale=3)
    for end, sign in ((LOW - THICK, -1), (HIGH + THICK, 1)):
        up = (0, sign, 0)
        lathe(bronze, [(0.112, 0.0), (0.150, 0.0), (0.154, 0.004), (0.154, 0.020), (0.150, 0.026), (0.135, 0.030), (0.132, 0.060), (0.136, 0.066), (0.136, 0.078), (0.132, 0.082),
                       (0.112, 0.082), (0.110, 0.070), (0.110, 0.0)], 48, (x, end, SPRING_Z), up, (0, 0, 1), uv_scale=(2, 4))
        for k in range(8):
            a = 2 * math.pi * (k + 0.5) / 8
            nail(bronze, (x + 0.144 * math.cos(a), end + sign * 0.027, SPRING_Z + 0.144 * math.sin(a)), up, 0.008)
        y = end + sign * 0.092
        timber(bars, (x - 0.150, y, SPRING_Z), (x + 0.150, y, SPRING_Z), 0.034, 0.042, bevel=0.005, seed=3, rough=0)
        for k in range(7):  # the cords over the bar
            d = -0.081 + 0.027 * k
            arc = [(x + d, end + sign * (0.060 + 0.062 * math.sin(b)), SPRING_Z + 0.052 * math.cos(b)) for b in np.linspace(0, math.pi, 11)]
            tube(cords, arc, 0.0150, 8, v_scale=5)
    name = "rl"[s < 0]
    for what, part, used in (("cords", cords, "sinew"), ("washers", bronze, "bronze"), ("bars", bars, "iron")):
        model.add(f"visual_{what}_{name}", part, [used], frame, 45)


def make_spring_frame(model, frame):
    bronze = Shape()
    for k, s in enumerate((-1, 1)):
        x = s * SPRING_X
        for n, y in enumerate((LOW - THICK / 2, HIGH + THICK / 2)):
            plate = timber(Shape(), (x - s * 0.25, y, SPRING_Z), (x + s * 0.27, y, SPRING_Z), 0.44, THICK, bevel=0.012, seed=31 + 2 * k + n, rough=0.0008)
            model.add(f"part_carrier_{k}{n}", plate, ["timber"], frame)
            for z in (-0.223, 0.223):  # bronze bands on the edges
                timber(bronze, (x - 0.235, y, SPRING_Z + z), (x + 0.235, y, SPRING_Z + z), 0.006, 0.055, bevel=0.002, seed=1, rough=0)
                for d in (-0.20, -0.10, 0, 0.10, 0.20):
                    nail(bronze, (x + d, y, SPRING_Z + z * 1.014), (0, 0, math.copysign(1, z)), 0.009)
        for n, (dx, dz, size) in enumerate(((-0.165, 0.155, 0.085), (0.185, -0.165, 0.075))):  # inner and behind; outer and before: the arm swings between
            post = timber(Shape(), (x + s * dx, LOW - 0.004, SPRING_Z + dz), (x + s * dx, HIGH + 0.004, SPRING_Z + dz), size, 0.115, up=(0, 0, 1), bevel=0.010, seed=41 + 2 * k + n,
                          rough=0.0010)
            model.add(f"part_post_{k}{n}", post, ["planks"], frame)
            for y in (LOW + 0.05, HIGH - 0.05):
                timber(bronze, (x + s * (dx - size / 2 - 0.002), y, SPRING_Z + dz), (x + s * (dx + size / 2 + 0.002), y, SPRING_Z + dz), 0.121, 0.030, bevel=0.003, seed=2, rough=0)
        spring(model, frame, s)
    for n, (y, z) in enumerate(((LOW - THICK - 0.055, 0.15), (LOW - THICK - 0.055, -0.15), (HIGH + THICK + 0.045, 0.16), (HIGH + THICK + 0.045, -0.16))):
        beam = timber(Shape(), (-0.74, y, SPRING_Z + 1.25 * z), (0.74, y, SPRING_Z + 1.25 * z), 0.085, 0.11 if n < 2 else 0.09, bevel=0.010, seed=51 + n, rough=0.0014)
        model.add(f"visual_beam_{n}", beam, ["planks"], frame)
    model.add("visual_frame_bronze", bronze, ["bronze"], frame, 35)


# Stock, stand, winch posts -------------------------------------------------------------------------------------------------------


def make_stock(model, frame):
    front, back = -2.55, 0.30
    rails, bronze, rope, iron_parts = Shape(), Shape(), Shape(), Shape()
    core = timber(Shape(), (0, STOCK_Y - 0.08, front), (0, STOCK_Y - 0.08, back), 0.19, 0.16, bevel=0.010, seed=61, rough=0.0012)
    model.add("part_stock", core, ["planks"], frame)
    for k, s in enumerate((-1, 1)):  # the rails that the slider runs between
        timber(rails, (s * 0.098, STOCK_Y + 0.005, front), (s * 0.098, STOCK_Y + 0.005, back - 0.03), 0.028, 0.085, bevel=0.006, seed=62 + k, rough=0.0006)
        cheek = timber(Shape(), (s * 0.130, 0.945, 0.06), (s * 0.130, 0.945, 0.60), 0.060, 0.185, bevel=0.012, seed=64 + k, rough=0.0010)
        model.add(f"part_cheek_{k}", cheek, ["timber"], frame)
    model.add("visual_rails", rails, ["timber"], frame)
    for z in (-2.48, -1.90, -1.30, -0.70, -0.10):
        for s in (-1, 1):
            timber(bronze, (s * 0.1135, STOCK_Y - 0.165, z), (s * 0.1135, STOCK_Y + 0.045, z), 0.004, 0.035, up=(s, 0, 0), bevel=0.001, seed=1, rough=0)
            for y in (STOCK_Y - 0.12, STOCK_Y):
                nail(bronze, (s * 0.1155, y, z), (s, 0, 0), 0.009)
    for s in (-1, 1):  # bearings
        hoop(bronze, [(0.020, -0.006), (0.040, -0.006), (0.040, 0.006), (0.020, 0.006)], WINCH + (s * 0.163, 0, 0), (1, 0, 0))
        for z in (0.12, 0.56):
            nail(bronze, (s * 0.161, 0.945, z), (s, 0, 0), 0.014)
    # The rope lies in the stock's groove; the slider covers it as it comes back.
    tail = nock_z(REST) + 0.30
    tube(rope, [(0, SLIDER_Y - 0.03, z) for z in np.linspace(tail, 0.20, 20)] + [(0, SLIDER_Y - 0.03, 0.30), (0, SLIDER_Y - 0.028, 0.42)], ROPE_RADIUS, 9, v_scale=9)
    model.add("visual_rope", rope, ["hemp"], frame, 60)
    make_pawl(iron_parts)
    # The lever's bracket, and the plate beside it that the pin goes through.
    timber(iron_parts, LEVER + (-0.045, 0, 0), LEVER + (-0.012, 0, 0), 0.06, 0.07, bevel=0.004, seed=4, rough=0)
    rod(iron_parts, LEVER + (-0.05, 0, 0), LEVER + (0.030, 0, 0), 0.010)
    model.add("visual_stock_bronze", bronze, ["bronze"], frame, 35)
    model.add("visual_stock_iron", iron_parts, ["iron"], frame, 35)


def make_pawl(iron_parts):
    """It rests in a tooth; its pin is on the post."""
    a = math.radians(360 / TEETH * 19)  # from y towards z
    r = RATCHET_RADIUS - 0.010
    tooth = WINCH + np.array([RATCHET_X, r * math.cos(a), r * math.sin(a)])
    pivot = tooth + 0.115 * np.array([0, math.sin(a), -math.cos(a)])
    timber(iron_parts, pivot - (tooth - pivot) * 0.15, tooth, 0.022, 0.024, up=(1, 0, 0), bevel=0.003, seed=5, rough=0, taper=0.7)
    rod(iron_parts, (0.150, pivot[1], pivot[2]), (RATCHET_X + 0.022, pivot[1], pivot[2]), 0.009)


def make_stand(model, frame):
    """A post under the spring frame on a cross of sills with struts; a prop under the stock's end."""
    column = timber(Shape(), (0, 0.10, SPRING_Z), (0, LOW - THICK - 0.10, SPRING_Z), 0.24, 0.24, up=(0, 0, 1), bevel=0.016, seed=71, rough=0.002)
    timber(column, (0, 0.50, SPRING_Z), (0, STOCK_Y - 0.16, SPRING_Z), 0.17, 0.16, up=(0, 0, 1), bevel=0.010, seed=72, rough=0.0012)
    model.add("visual_column", column, ["planks"], frame)
    struts = timber(Shape(), (-0.85, 0.055, SPRING_Z), (0.85, 0.055, SPRING_Z), 0.16, 0.12, bevel=0.014, seed=73, rough=0.002)
    timber(struts, (0, 0.060, SPRING_Z - 0.85), (0, 0.060, 0.35), 0.16, 0.12, bevel=0.014, seed=74, rough=0.002)
    for k, (dx, dz) in enumerate(((0.70, 0), (-0.70, 0), (0, 0.62), (0, -0.62))):
        timber(struts, (dx, 0.11, SPRING_Z + dz), (0.10 * np.sign(dx), 0.47, SPRING_Z + 0.10 * np.sign(dz)), 0.075, 0.085, up=(0.1, 1, 0.1), bevel=0.008, seed=75 + k, rough=0.0014)
    for k, s in enumerate((-1, 1)):  # two legs under the stock's end, spread
        leg = timber(Shape(), (s * 0.34, 0.0, 0.22), (s * 0.075, STOCK_Y - 0.15, 0.16), 0.085, 0.085, up=(0, 0, 1), bevel=0.010, seed=81 + k, rough=0.0016)
        model.add(f"part_leg_{k}", leg, ["planks"], frame)
    timber(struts, (-0.30, 0.28, 0.205), (0.30, 0.28, 0.205), 0.055, 0.055, bevel=0.007, seed=83, rough=0.001)  # a rung between them
    model.add("visual_struts", struts, ["planks"], frame)
    lashing = Shape()
    for s in (-1, 1):
        coil(lashing, (s * 0.262, 0.28, 0.205), (-0.265 * s, 0.85, -0.06), 0.062, 0.062, 6, seed=s + 3)
    model.add("visual_lashing", lashing, ["hemp"], frame, 60)


# What moves ----------------------------------------------------------------------------------------------------------------------


def make_slider(model):
    slider = model.group("SLIDER")
    plank = timber(Shape(), (0, -0.030, -1.42), (0, -0.030, 0.30), 0.150, 0.050, bevel=0.006, seed=91, rough=0.0005)
    model.add("part_slider", plank, ["timber"], slider)
    lips, iron_parts, bronze = Shape(), Shape(), Shape()
    for s in (-1, 1):  # a low lip on either side: the stone runs between
        timber(lips, (s * 0.064, 0.002, -1.40), (s * 0.064, 0.002, -0.03), 0.020, 0.026, bevel=0.005, seed=92 + s, rough=0.0004)
        timber(iron_parts, (s * 0.030, 0.018, 0.16), (s * 0.030, 0.052, -0.012), 0.016, 0.030, bevel=0.003, seed=6, rough=0, taper=0.8)  # the claw's two fingers
        timber(iron_parts, (s * 0.030, 0.050, -0.010), (s * 0.030, 0.012, -0.016), 0.014, 0.014, up=(0, 0, 1), bevel=0.002, seed=7, rough=0, taper=0.7)
        timber(bronze, (s * 0.058, 0.016, 0.10), (s * 0.058, 0.016, 0.17), 0.014, 0.062, bevel=0.003, seed=8, rough=0)
    rod(bronze, (-0.068, 0.028, 0.135), (0.068, 0.028, 0.135), 0.010)
    timber(iron_parts, (0, 0.010, 0.15), (0, 0.016, 0.285), 0.050, 0.018, bevel=0.003, seed=9, rough=0, taper=0.8)
    ring = [(0, -0.030 + 0.026 * math.sin(a), 0.318 + 0.026 * math.cos(a)) for a in np.arange(24) * 2 * math.pi / 24]
    tube(iron_parts, ring, 0.0065, 9, closed=True)
    timber(bronze, (-0.077, -0.030, -1.40), (0.077, -0.030, -1.40), 0.036, 0.054, bevel=0.003, seed=1, rough=0)
    timber(bronze, (-0.077, -0.030, 0.275), (0.077, -0.030, 0.275), 0.036, 0.054, bevel=0.003, seed=2, rough=0)
    for what, part, used in (("lips", lips, "timber"), ("claw", iron_parts, "iron"), ("slider_bronze", bronze, "bronze")):
        model.add("visual_" + what, part, [used], slider)


def make_arms(model):
    for name, s in (("ARM_R", 1), ("ARM_L", -1)):
        arm = model.group(name)
        profile = [(0.0, -0.17), (0.036, -0.17), (0.043, -0.155), (0.046, 0.0), (0.045, 0.35), (0.039, 0.70), (0.031, ARM - 0.04), (0.031, ARM + 0.055), (0.026, ARM + 0.068), (0.0, ARM + 0.070)]
        wood_part = lathe(Shape(), profile, 24, (0, 0, 0), (s, 0, 0), (0, 1, 0), uv_scale=(0.5, 1 / 2.3), uv_offset=(0.02, 0.1 if s > 0 else 0.55), end_grain=(0, len(profile) - 2))
        model.add("part_arm_" + name[-1].lower(), wood_part, ["timber"], arm, 40)
        cord, bronze = Shape(), Shape()
        for x in (0.26, 0.45, 0.64, 0.82):
            coil(cord, (s * x, 0, 0), (s, 0, 0), 0.0455 - 0.020 * max(0.0, x - 0.35), 0.0455 - 0.020 * max(0.0, x - 0.35), 5, 0.0048, 0.0098, seed=int(100 * x))
        coil(cord, (s * ARM, 0, 0), (s, 0, 0), 0.036, 0.036, 3, 0.0095, 0.018, seed=7)
        for x in (ARM - 0.045, ARM + 0.045):
            hoop(bronze, [(0.029, -0.007), (0.037, -0.007), (0.037, 0.007), (0.029, 0.007)], (s * x, 0, 0), (1, 0, 0))
        model.add("visual_cord_" + name[-1].lower(), cord, ["hemp"], arm, 60)
        model.add("visual_tip_" + name[-1].lower(), bronze, ["bronze"], arm, 35)
    for name, s in (("STRING_R", 1), ("STRING_L", -1)):
        half = model.group(name)
        cord = Shape()
        # A flat girdle of cords in the middle that pushes the stone, a thick string with a serving, a loop at the tip.
        for dy in (-0.024, -0.008, 0.008, 0.024):
            path = [(s * x, dy * (1 if x < 0.10 else max(0.15, 1 - (x - 0.10) / 0.14)), 0) for x in np.linspace(-0.002, 0.26, 14)]
            tube(cord, path, 0.0085, 8, v_scale=9)
        tube(cord, [(s * x, 0, 0) for x in np.linspace(0.24, HALF_STRING, 24)], 0.0115, 9, v_scale=7)
        coil(cord, (s * 0.27, 0, 0), (s, 0, 0), 0.0135, 0.0135, 9, 0.004, 0.0082, seed=11)
        coil(cord, (s * (HALF_STRING - 0.14), 0, 0), (s, 0, 0), 0.0135, 0.0135, 8, 0.004, 0.0082, seed=12)
        model.add("visual_string_" + name[-1].lower(), cord, ["sinew"], half, 60)


def make_winch(model):
    winch = model.group("WINCH")
    log = [(0.0, -0.098), (DRUM_RADIUS - 0.004, -0.098), (DRUM_RADIUS, -0.094), (DRUM_RADIUS, 0.094), (DRUM_RADIUS - 0.004, 0.098), (0.0, 0.098)]
    model.add("part_drum", lathe(Shape(), log, 32, (0, 0, 0), (1, 0, 0), uv_scale=(0.5, 1 / 2.3), uv_offset=(0, 0.15), end_grain=(0, 4)), ["timber"], winch, 35)
    bronze, iron_parts, rope, hubs = Shape(), Shape(), Shape(), Shape()
    rod(iron_parts, (-0.43, 0, 0), (0.43, 0, 0), 0.019)
    for s in (-1, 1):
        x = s * SPIKE_X
        lathe(hubs, [(0.0, -0.055), (0.070, -0.055), (0.078, -0.047), (0.080, 0.0), (0.078, 0.047), (0.070, 0.055), (0.0, 0.055)], 40, (x, 0, 0), (1, 0, 0), uv_scale=(0.5, 1),
              uv_offset=(0.3, 0.4), end_grain=(0, 5))
        for d in (-0.050, 0.050):
            hoop(bronze, [(0.066, -0.004), (0.0795, -0.004), (0.0795, 0.004), (0.066, 0.004)], (x + d, 0, 0), (1, 0, 0), 2)
        for k in range(4):
            a = math.pi / 2 * k  # from z towards -y: the first points to the visitor
            out = (0, -math.sin(a), math.cos(a))
            spike = [(0.0, 0.060), (0.021, 0.060), (0.021, 0.12), (0.0175, 0.20), (0.0165, 0.30), (GRIP_RADIUS, 0.42), (GRIP_RADIUS + 0.0015, SPIKE - 0.03), (GRIP_RADIUS, SPIKE - 0.008),
                     (GRIP_RADIUS - 0.006, SPIKE), (0.0, SPIKE + 0.001)]
            shape = lathe(Shape(), spike, 20, (x, 0, 0), out, (1, 0, 0), uv_scale=(0.115, 1.2), uv_offset=(0.13 * (k + 4 * (s > 0)) % 1, 0.1 * k))
            model.add(f"{'part' if s > 0 else 'visual'}_spike_{k}_{'rl'[s < 0]}", shape, ["grip"], winch, 45)
    core = lathe(Shape(), [(0.0, -0.053), (0.076, -0.053), (0.076, 0.053), (0.0, 0.053)], 20, (SPIKE_X, 0, 0), (1, 0, 0))  # what a hand may touch of a hub
    model.add("part_hub", core, ["timber"], winch, 35)
    model.add("visual_hubs", hubs, ["timber"], winch, 35)
    pitch = 2 * ROPE_RADIUS * 1.03
    path = [(-0.05 + pitch * a / (2 * math.pi), (DRUM_RADIUS + ROPE_RADIUS) * math.cos(a), (DRUM_RADIUS + ROPE_RADIUS) * math.sin(a)) for a in np.arange(0, 6 * 28 + 1) * 2 * math.pi / 28]
    tube(rope, path, ROPE_RADIUS, 9, v_scale=9)
    for x in (-0.088, 0.088):
        hoop(bronze, [(DRUM_RADIUS - 0.001, -0.006), (0.062, -0.006), (0.062, 0.006), (DRUM_RADIUS - 0.001, 0.006)], (x, 0, 0), (1, 0, 0), 2)
    make_ratchet_wheel(iron_parts)
    for what, part, used in (("turns", rope, "hemp"), ("winch_bronze", bronze, "bronze"), ("winch_iron", iron_parts, "iron")):
        model.add("visual_" + what, part, [used], winch, 40)


def make_ratchet_wheel(shape):
    """Saw teeth: it turns from y towards z, and the pawl meets the upright faces on the way back."""
    outline = []
    for k in range(TEETH):
        a = 2 * math.pi * k / TEETH
        for t in (0.0, 0.33, 0.66, 0.985):
            r, b = RATCHET_RADIUS - TOOTH * t, a + 2 * math.pi / TEETH * t
            outline.append((r * math.cos(b), r * math.sin(b)))
    rings = [[(RATCHET_X + x, y * f, z * f) for y, z in outline] for x, f in ((-0.011, 0.985), (-0.009, 1.0), (0.009, 1.0), (0.011, 0.985))]
    shape.loft(rings, lambda i, j: (j / len(outline) * 2, i * 0.02), cap_scale=4)


def make_lever(model):
    lever = model.group("LEVER")
    shaft = timber(Shape(), (0, -0.05, 0), (0, 0.20, 0), 0.026, 0.044, up=(0, 0, 1), bevel=0.005, seed=95, rough=0.0004, taper=0.9)
    model.add("part_shaft", shaft, ["timber"], lever)
    swell = [(0.0, -1.0), (0.012, -1.0), (0.0155, -0.96), (0.0165, -0.85), (0.0165, -0.5), (0.0175, 0.0), (0.0185, 0.5), (0.0185, 0.85), (0.016, 0.97), (0.011, 1.0), (0.0, 1.0)]
    grip = lathe(Shape(), [(r, 0.265 + 0.075 * t) for r, t in swell], 28, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(0.115, 1.2), uv_offset=(0.4, 0.5))
    model.add("part_grip", grip, ["grip"], lever, 45)
    iron_parts = Shape()
    lathe(iron_parts, [(0.012, -0.004), (0.020, -0.004), (0.020, 0.004), (0.012, 0.004)], 24, (0.017, 0, 0), (1, 0, 0), uv_scale=(1, 5))
    timber(iron_parts, (-0.010, 0.075, 0.0), (-0.120, 0.075, 0.0), 0.020, 0.020, bevel=0.003, seed=5, rough=0)  # under the claw's tail
    hoop(iron_parts, [(0.012, -0.010), (0.0215, -0.010), (0.0215, 0.010), (0.012, 0.010)], (0, 0.195, 0), (0, 1, 0))
    model.add("visual_lever_iron", iron_parts, ["iron"], lever, 35)
    pin, shape, cord = model.group("PIN"), Shape(), Shape()
    at = LEVER + (0, 0.055, 0.036)
    rod(shape, at + (-0.06, 0, 0), at + (0.040, 0, 0), 0.009)
    ring = [at + (0.046, 0.018 * math.sin(a), 0.018 * math.cos(a)) for a in np.arange(20) * 2 * math.pi / 20]
    tube(shape, ring, 0.004, 8, closed=True)
    tube(cord, [at + (0.048, -0.018, 0.0), at + (0.055, -0.06, 0.01), at + (0.040, -0.12, 0.02), at + (0.010, -0.14, 0.03), at + (-0.04, -0.11, 0.03)], 0.004, 7, v_scale=9)
    for name, part, used in (("visual_pin", shape, "iron"), ("visual_pin_cord", cord, "hemp")):
        model.add(name, part, [used], pin, 50)


def ball(radius, segments=36, rings=20, seed=0, rough=0.0):
    """A dressed stone ball."""
    rng = np.random.default_rng(8000 + seed)
    profile = [(radius * math.sin(a), -radius * math.cos(a)) for a in np.linspace(0, math.pi, rings)]
    profile[0], profile[-1] = (0.0, -radius), (0.0, radius)
    shape = lathe(Shape(), profile, segments, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(0.45, 1.0), uv_offset=(0.1, 0.3))
    if rough:
        shape.vertices = [tuple(np.asarray(v) * (1 + rng.normal(0, rough))) for v in shape.vertices]
    return shape


def make_stone(model):
    stone = model.group("STONE")
    model.add("part_ball", ball(BALL, seed=1, rough=0.004), ["limestone"], stone, 60)
    toggle = lathe(Shape(), [(0, -0.060), (0.010, -0.060), (0.0145, -0.054), (0.0160, -0.03), (0.0165, 0), (0.0160, 0.03), (0.0145, 0.054), (0.010, 0.060), (0, 0.060)], 24,
                   (0, BALL + 0.034, 0), (1, 0, 0), uv_scale=(0.115, 1.2), uv_offset=(0.62, 0.2))
    model.add("part_toggle", toggle, ["grip"], stone, 45)
    cord = Shape()
    r = BALL + 0.0035
    for about in ("x", "z"):
        ring = [(0, r * math.sin(a), r * math.cos(a)) if about == "x" else (r * math.cos(a), r * math.sin(a), 0) for a in np.arange(48) * 2 * math.pi / 48]
        tube(cord, ring, 0.0045, 8, v_scale=9, closed=True)
    coil(cord, (0, BALL + 0.034, 0), (1, 0, 0), 0.019, 0.019, 4, 0.0042, 0.0086, seed=21)
    for x in (-0.012, 0.012):
        tube(cord, [(0, BALL + 0.002, 0), (x * 0.6, BALL + 0.008, 0.004), (x, BALL + 0.018, 0.006)], 0.0048, 8, v_scale=9)
    model.add("visual_cord", cord, ["hemp"], stone, 60)


# Wall, ground, surroundings ------------------------------------------------------------------------------------------------------


def dressed(half, seed, bevel=0.007, hollow=0.004, boss=0.007, tile=0.75):
    """A building stone with anathyrosis: beds and joints are dressed at their margins and hollowed inside, so that stones meet along their
    edges (and few points carry them); the faces are left a little bulging."""
    rng = np.random.default_rng(2200 + seed)
    shape, seen, offset = Shape(), {}, rng.uniform(0, 1, 2)
    cuts = [[-1.0] + list(np.linspace(-1 + bevel / h, 1 - bevel / h, 9)) + [1.0] for h in half]

    def vertex(p, axis):
        key = tuple(np.round(p, 6))
        if key not in seen:
            q = np.array(p) * half
            inner = np.clip(q, -half + bevel, half - bevel)
            out = q - inner
            length = np.linalg.norm(out)
            place = inner + out / length * bevel if length > 0 else q
            depth = math.prod(1 - min(1.0, abs(inner[k]) / (half[k] - bevel)) ** 2 for k in range(3) if k != axis)
            way = -hollow if axis < 2 else boss * (1 + 0.5 * math.sin(31 * q[0] + seed) * math.sin(27 * q[1] + 2 * seed))
            place[axis] += math.copysign(1, p[axis]) * way * depth
            seen[key] = shape.points([place])[0]
        return seen[key]

    def uv(c, axis, u, v):
        return tuple(np.array([c[u] * half[u], c[v] * half[v]]) / tile + offset + 0.37 * axis)

    return cut_cube(shape, cuts, vertex, uv)


def make_wall(model):
    gap = np.array([0.0015, 0, 0])
    for name, size, seed in (("BLOCK_A", BLOCK / 2 - gap, 1), ("BLOCK_B", BLOCK / 2 - gap, 2), ("HALF", BLOCK * (0.25, 0.5, 0.5) - gap, 3)):
        group = model.group(name)
        model.add("part_" + name.lower(), dressed(size, seed), ["limestone"], group, 30)


def make_ground(model):
    ground = model.group("GROUND")
    for name, low, high in (("near", -4.4, SLAB[1]), ("far", SLAB[2], -4.4)):
        slab = block(Shape(), (-SLAB[0], -0.30, low), (SLAB[0], 0.0, high), 0.01, 211, 0.0, 1.5)
        model.add("part_ground_" + name, slab, ["earth"], ground, 30)
    model.add("part_footing", block(Shape(), (-0.80, -0.05, WALL_Z - 0.15), (0.80, FOOTING, WALL_Z + 0.15), 0.010, 213, 0.0, 0.9), ["limestone"], ground, 30)
    stump = [(0.0, -0.02), (0.20, -0.02), (0.175, 0.05), (0.160, 0.20), (0.156, 0.45), (0.158, STAND[1] - 0.006), (0.152, STAND[1]), (0.0, STAND[1])]
    model.add("part_stump", lathe(Shape(), stump, 28, (STAND[0], 0, STAND[2]), (0, 1, 0), (0, 0, 1), uv_scale=(1, 0.9), uv_offset=(0.02, 0.3), end_grain=(6,)), ["planks"], ground, 40)
    ring = Shape()
    path = [STAND + (0.062 * math.cos(a), 0.010, 0.062 * math.sin(a)) for a in np.arange(40) * 2 * math.pi / 40]
    tube(ring, path, 0.011, 10, v_scale=7, closed=True)
    model.add("visual_ring", ring, ["hemp"], ground, 60)


def height_at(x, z):
    """A little over the slab that things fall on; beyond its edges it comes down to the plain that displays draw."""
    wave = math.sin(1.7 * x + 0.6 * z) + math.sin(0.9 * z - 1.3 * x + 2)
    beyond = max(0.0, math.hypot(max(0.0, abs(x) - SLAB[0]), max(0.0, z - SLAB[1], SLAB[2] - z)) - 0.05)
    fall = min(1.0, beyond / (0.85 + 0.15 * wave))
    return 0.005 + 0.003 * math.sin(2.3 * x + 1.1) * math.sin(1.9 * z) + 0.002 * math.sin(7.1 * x + 2) * math.sin(6.3 * z + 1) - 0.16 * fall * fall * (3 - 2 * fall)


def make_earth(model, scene):
    xs, zs = np.linspace(-4.1, 4.1, 66), np.linspace(-12.2, 2.8, 116)
    rng = np.random.default_rng(191)
    grid = [[(x, height_at(x, z) + rng.normal(0, 0.001), z) for z in zs] for x in xs]
    shape, _ = earth(grid)
    model.add("visual_earth", shape, ["earth"], scene, 40)


def make_yard(model, scene):
    """Spare shot, chips of stone about the wall, a jar of oil for the springs."""
    shot, rng = Shape(), np.random.default_rng(161)
    places = [(1.28, -0.30), (1.44, -0.32), (1.36, -0.17), (1.52, -0.18), (1.35, -0.255), (1.46, -0.24)]
    for k, (x, z) in enumerate(places):
        y, first, piece = height_at(x, z) + BALL - 0.004 + (0.118 if k > 3 else 0), len(shot.vertices), ball(BALL, 28, 16, 10 + k, 0.005)
        shot.vertices += [(a + x, b + y, c + z) for a, b, c in piece.vertices]
        for face, uvs in zip(piece.faces, piece.uvs):
            shot.face(tuple(i + first for i in face), tuple((u + 0.17 * k, v + 0.23 * k) for u, v in uvs))
    model.add("visual_shot", shot, ["limestone"], scene, 60)
    chips = Shape()
    for _ in range(150):
        x, z, size = rng.normal(0, 1.0), WALL_Z + rng.normal(0.1, 0.6), rng.uniform(0.006, 0.026)
        if abs(x) > 2.6:
            continue
        points = [np.array([x, height_at(x, z), z]) + rng.normal(0, size, 3) * (1, 0.5, 1) for _ in range(4)]
        i = chips.points(points)
        if np.dot(np.cross(points[1] - points[0], points[2] - points[0]), points[3] - points[0]) > 0:
            i = [i[1], i[0], i[2], i[3]]
        u = tuple(rng.random(2))
        for face in ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)):
            chips.face(tuple(i[f] for f in face), (u, (u[0] + size, u[1]), (u[0], u[1] + size)))
    model.add("visual_chips", chips, ["limestone"], scene, 20)
    jar = Shape()
    lathe(jar, [(0.0, 0.0), (0.055, 0.0), (0.10, 0.08), (0.115, 0.17), (0.10, 0.25), (0.055, 0.30), (0.045, 0.33), (0.062, 0.35), (0.056, 0.352), (0.038, 0.33), (0.0, 0.31)], 32,
          (-0.95, height_at(-0.95, -0.6), -0.6), (0, 1, 0), (0, 0, 1))
    model.add("visual_jar", jar, ["terracotta"], scene, 50)


def make_grass(model, scene):
    rng = np.random.default_rng(171)
    shape = Shape()
    made = 0
    while made < 420:
        x, z = rng.uniform(-3.9, 3.9), rng.uniform(-12.0, 2.6)
        if abs(x) < 1.15 and rng.random() < 0.93:
            continue
        made += 1
        tuft(shape, rng, x, z, height_at)
    model.add("visual_grass", shape, ["blade", "straw"], scene, 60)


# The file ------------------------------------------------------------------------------------------------------------------------


def place(name, p, turn=0.0):
    bpy.data.objects[name].location, bpy.data.objects[name].rotation_euler = to_blender(p), (0, 0, turn)


def pose(angle):
    """For pictures: everything as it stands with the arms at an angle, and the wall built."""
    z = nock_z(angle)
    place("SLIDER", (0, SLIDER_Y, z))
    swing = math.asin((z - SPRING_Z + ARM * math.sin(angle)) / HALF_STRING)
    for side, s in (("R", 1), ("L", -1)):
        place("ARM_" + side, (s * SPRING_X, ARM_Y, SPRING_Z), s * angle)
        place("STRING_" + side, (0, SLIDER_Y + STRING_OVER, z), s * swing)
    place("WINCH", WINCH)
    place("LEVER", LEVER)
    place("STONE", (0, SLIDER_Y + 0.066, z - 0.10) if angle == DRAWN else STAND + (0, BALL, 0))


def build_wall(model):
    for course in range(4):
        y = FOOTING + BLOCK[1] * (course + 0.5)
        row = [(-0.36, "BLOCK_A"), (0.0, "BLOCK_B"), (0.36, "BLOCK_A")] if course % 2 == 1 else [(-0.45, "HALF"), (-0.18, "BLOCK_B"), (0.18, "BLOCK_A"), (0.45, "HALF")]
        for x, node in row:
            copy = bpy.data.objects.new("seen", bpy.data.objects["part_" + node.lower()].data)
            copy.location = to_blender((x, y, WALL_Z))
            model.collection.objects.link(copy)
    for node in ("block_a", "block_b", "half"):
        bpy.data.objects["part_" + node].hide_render = True


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with tempfile.TemporaryDirectory() as folder:
        model = Model(make_materials(Textures(folder)))
        frame = model.group("FRAME")
        make_spring_frame(model, frame)
        make_stock(model, frame)
        make_stand(model, frame)
        make_slider(model)
        make_arms(model)
        make_winch(model)
        make_lever(model)
        make_stone(model)
        make_wall(model)
        make_ground(model)
        scene = model.group("SCENE")
        make_earth(model, scene)
        make_yard(model, scene)
        make_grass(model, scene)
        export(os.path.abspath(arguments[0]))
        if len(arguments) < 2:
            return
        build_wall(model)
        for name, angle, eye, look_at in (("whole", REST, (2.3, 1.9, 2.6), (0, 0.8, -1.5)), ("drawn", DRAWN, (1.3, 1.75, 1.3), (0, 1.0, -0.5)),
                                          ("frame", REST, (1.9, 1.7, -3.6), (0, 1.0, -1.4)), ("wall", DRAWN, (1.6, 1.5, -4.6), (0, 0.6, -7.0))):
            if len(arguments) > 2 and name not in arguments[2:]:
                continue
            pose(angle)
            picture(f"{os.path.abspath(arguments[1])}-{name}.png", eye, look_at, samples=20)


main()
