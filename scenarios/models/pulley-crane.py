"""Models the cranes of one and of two pulleys, and writes pulley-crane.glb and compound-pulley-crane.glb.

    blender -b --python pulley-crane.py -- pulley-crane.glb compound-pulley-crane.glb [PICTURES]      (Blender 3.4, with python3-numpy)

With PICTURES, the beginning of a path, it also renders both. Form: Vitruvius, De architectura X.2. Metres, glTF's axes (y up); the
visitor looks along -z. Ropes that run are not modelled: a display draws them where the rope is. The turns on the drum are those that a
winch keeps on it, and never come off.

Nodes at the root, all with identity transforms, each in the frame of its own body:
  FRAME    two legs, stays, the block at the head; origin at the world's
  DRUM     drum, ratchet wheel and crank; origin in the axle's middle (0.30, 0.80, 0), axis z
  LOAD     the stone, or the column's drum with the lower block; origin in the stone's middle
  WALL     what the load is to lie on; origin at the world's
  SCENE    ground and surroundings
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
from surfaces import Textures, fractal, iron_material, material, mix, museum_materials, step, surface, tint  # noqa: E402

AXLE = np.array([0.30, 0.80, 0.0])
DRUM_RADIUS, ROPE_RADIUS = 0.052, 0.008  # the rope's middle is 0.060 m from the axle
CRANK_RADIUS, GRIP_RADIUS, GRIP_LENGTH, ARM_Z, GRIP_Z = 0.30, 0.017, 0.130, 0.560, 0.650
TEETH, RATCHET_Z, RATCHET_RADIUS, TOOTH = 16, 0.305, 0.105, 0.014
FOOT, HEAD = np.array([0.62, 0.0, 0.55]), np.array([-0.24, 3.05, 0.09])
SHEAVE, SHEAVE_RADIUS = np.array([-0.30, 2.95, 0.0]), 0.080
LOWER_RADIUS, LOWER_Y = 0.070, 0.400  # of the load's own sheave: its rope's radius, its height over the stone's middle
HALF_HEIGHT, RING_Y = 0.125, 0.295
BAULK, COURSE = 0.06, 0.25
WALL_TOP = 0.80
SINGLE = {"name": "pulley-crane", "x": -0.38, "seat": -0.78, "compound": False}
DOUBLE = {"name": "compound-pulley-crane", "x": -0.45, "seat": -0.85, "compound": True}


# Materials -----------------------------------------------------------------------------------------------------------------------


def marble():
    rng = np.random.default_rng(45)
    shape = (1024, 1024)
    warp = fractal(shape, (4, 4), rng, 5, 0.55)
    vein = np.exp(-np.abs(np.sin(math.pi * (4 * warp + np.arange(1024)[:, None] * 2 / 1024 + np.arange(1024)[None, :] / 1024))) / 0.07)
    fine, broad = fractal(shape, (60, 60), rng, 3, 0.6), fractal(shape, (3, 3), rng, 5)
    stain = step(0.52, 0.72, fractal(shape, (5, 9), rng, 6, 0.6))
    colour = tint((0.60, 0.555, 0.475), (0.44, 0.395, 0.32), np.clip(1.7 * broad - 0.35, 0, 1)) * (0.84 + 0.28 * fine)[..., None]
    colour = mix(colour, np.array([0.27, 0.265, 0.26])[None, None, :], (0.55 * vein * step(0.35, 0.6, broad))[..., None])
    colour = mix(colour, np.array([0.36, 0.265, 0.155])[None, None, :], (0.45 * stain)[..., None])
    return np.clip(colour, 0, 1), 1.8 * fine + 1.0 * broad - 0.6 * vein


def make_materials(textures):
    made = museum_materials(textures)
    made["marble"] = material("marble", *surface(textures, "marble", *marble(), 0.7), roughness=0.6)
    made["iron"] = iron_material(textures)
    made["blade"] = material("blade", base=(0.17, 0.20, 0.05, 1), roughness=0.75, two_sided=True)
    made["straw"] = material("straw", base=(0.38, 0.31, 0.13, 1), roughness=0.8, two_sided=True)
    return made


# The crane -----------------------------------------------------------------------------------------------------------------------


def leg_at(y, side):
    """The middle of a leg at a height."""
    p = mix(FOOT, HEAD, y / HEAD[1])
    return np.array([p[0], p[1], side * p[2]])


def hoop(shape, outline, centre, tiles=1):
    """A closed outline turned about an axis along z."""
    return lathe(shape, outline + outline[:1], 40, centre, (0, 0, 1), uv_scale=(tiles, 5))


def sheave(shape, centre, radius):
    """A bronze wheel whose groove holds the rope's middle at `radius`."""
    groove, rim = radius - ROPE_RADIUS, radius + 0.010
    outline = [(0.011, -0.016), (0.024, -0.016), (0.026, -0.011), (groove - 0.014, -0.009), (groove - 0.010, -0.014), (rim - 0.003, -0.014), (rim, -0.012),
               (rim - 0.001, -0.009), (groove + 0.003, -0.006), (groove, 0.0), (groove + 0.003, 0.006), (rim - 0.001, 0.009), (rim, 0.012), (rim - 0.003, 0.014),
               (groove - 0.010, 0.014), (groove - 0.014, 0.009), (0.026, 0.011), (0.024, 0.016), (0.011, 0.016)]
    lathe(shape, outline, 56, centre, (0, 0, 1), uv_scale=(1.5, 6))


def wrap(shape, centre, direction, half_u, half_v, u, turns, pitch=0.0135, radius=0.0065, seed=0):
    """Turns of rope round a beam, or two, that runs along `direction`; `u` is the way of half_u."""
    rng = np.random.default_rng(3100 + seed)
    w = np.asarray(direction, float) / np.linalg.norm(direction)
    u = np.asarray(u, float) - w * (np.asarray(u, float) @ w)
    u /= np.linalg.norm(u)
    v = np.cross(w, u)
    path = []
    for a in np.arange(turns * 28 + 1) * 2 * math.pi / 28:
        c, s = math.cos(a), math.sin(a)
        square = (abs(c) ** 5 + abs(s) ** 5) ** -0.2
        path.append(np.asarray(centre) + u * (half_u * square * c) + v * (half_v * square * s) + w * (pitch * (a / (2 * math.pi) - turns / 2) + rng.normal(0, 0.0004)))
    tube(shape, path, radius, 8, v_scale=9)


def make_frame(model, kind):
    frame = model.group("FRAME")
    for k, s in enumerate((-1, 1)):
        foot, head = leg_at(-0.03, s), leg_at(3.17, s)
        shape = timber(Shape(), foot, head, 0.105, 0.110, up=(1, 0, 0), bevel=0.012, seed=11 + k, rough=0.0025, taper=0.86)
        model.add(f"part_leg_{k}", shape, ["planks"], frame)
    for k, (y, size) in enumerate(((0.30, 0.085), (1.75, 0.075))):
        z = leg_at(y, 1)[2] + 0.115
        shape = timber(Shape(), leg_at(y, -1) * (1, 1, 0) + (0.078, 0, -z), leg_at(y, 1) * (1, 1, 0) + (0.078, 0, z), size, size * 0.8, bevel=0.008, seed=14 + k, rough=0.002)
        model.add(f"part_tie_{k}", shape, ["planks"], frame)
    bearings, bronze, lashing = Shape(), Shape(), Shape()
    for k, s in enumerate((-1, 1)):
        z = s * 0.432
        timber(bearings, AXLE + (-0.055, 0, z), AXLE + (0.075, 0, z), 0.085, 0.150, up=(0, 1, 0), bevel=0.010, seed=19 + k, rough=0.001)
        for d in (-1, 1):  # bronze bushes, and bolts through bearing and leg
            hoop(bronze, [(0.0185, -0.005), (0.031, -0.005), (0.031, 0.005), (0.0185, 0.005)], AXLE + (0, 0, z + d * 0.043))
            rod(bronze, AXLE + (-0.062, d * 0.055, z), AXLE + (0.085, d * 0.055, z), 0.009)
        for n, y in enumerate((0.30, 1.75)):
            along = (HEAD - FOOT) * (1, 1, s) / np.linalg.norm(HEAD - FOOT)
            for slant in (-1, 1):  # both ways across leg and tie
                wrap(lashing, leg_at(y, s) + (0.032, 0, 0), along + (0, 0, slant), 0.092, 0.078, (1, 0, 0), 4, seed=10 * k + n)
    direction = leg_at(3, 0) - leg_at(0, 0)
    for n in range(2):
        wrap(lashing, leg_at(2.76 + 0.36 * n, 0), direction, 0.066, leg_at(2.76 + 0.36 * n, 1)[2] + 0.064, (1, 0, 0), 6, seed=40 + n)
    make_head(model, frame, kind, bronze)
    make_pawl(model, frame, bronze)
    make_stays(model, frame, lashing)
    model.add("visual_bearings", bearings, ["timber"], frame)
    model.add("visual_bronze", bronze, ["bronze"], frame, 40)
    model.add("visual_lashing", lashing, ["hemp"], frame, 60)


def make_head(model, frame, kind, bronze):
    """The block at the head: two cheeks between the legs, a sheave; for two pulleys also the pin that the rope ends on."""
    reach = -0.565 if kind["compound"] else -0.370
    shape = Shape()
    for k, z in enumerate((-0.034, 0.034)):
        timber(shape, (-0.135, 2.985, z), (reach, 2.925 if kind["compound"] else 2.945, z), 0.026, 0.112, bevel=0.006, seed=23 + k, rough=0.0008)
    model.add("visual_block", shape, ["timber"], frame)
    sheave(bronze, SHEAVE, SHEAVE_RADIUS)
    pins = [SHEAVE, (-0.195, 2.98, 0)] + ([(kind["x"] - LOWER_RADIUS, 2.90, 0)] if kind["compound"] else [])
    for p, half in zip(pins, (0.056, 0.185, 0.056)):
        rod(bronze, np.asarray(p) + (0, 0, -half), np.asarray(p) + (0, 0, half), 0.011)
    for z in (-0.049, 0.049):
        hoop(bronze, [(0.010, -0.0025), (0.026, -0.0025), (0.026, 0.0025), (0.010, 0.0025)], SHEAVE + (0, 0, z))


def make_pawl(model, frame, bronze):
    """It rests in a tooth and bears the drum by its pin on the leg."""
    a = math.radians(360 / TEETH * 2)
    tooth = AXLE + np.array([(RATCHET_RADIUS - 0.010) * math.cos(a), (RATCHET_RADIUS - 0.010) * math.sin(a), RATCHET_Z])
    pivot = tooth + 0.125 * np.array([math.sin(a), -math.cos(a), 0])
    timber(bronze, pivot - (tooth - pivot) * 0.12, tooth, 0.020, 0.024, up=(0, 1, 0.01), bevel=0.003, seed=5, rough=0, taper=0.72)
    rod(bronze, pivot + (0, 0, -0.022), pivot + (0, 0, 0.11), 0.009)


def make_stays(model, frame, lashing):
    """Two ropes that keep the legs from falling forward, at pegs in the ground; they do not move."""
    pegs = Shape()
    for k, s in enumerate((-1, 1)):
        foot, top = np.array([2.25, 0.13, s * 0.95]), leg_at(3.09, s) + (0.05, 0, 0)
        sag = [mix(foot, top, t) - (0, 0.10 * math.sin(math.pi * t), 0) for t in np.linspace(0, 1, 25)]
        tube(lashing, sag, 0.010, 9, v_scale=6)
        wrap(lashing, leg_at(3.09, s), HEAD * (1, 1, s) - FOOT * (1, 1, s), 0.062, 0.058, (1, 0, 0), 3, 0.018, 0.010, 50 + k)
        wrap(lashing, foot + (0.0, 0, 0), (0.35, 1, 0), 0.038, 0.038, (1, 0, 0), 3, 0.018, 0.010, 60 + k)
        peg = foot + np.array([0.07, 0.20, 0])
        lathe(pegs, [(0.0, -0.45), (0.030, -0.20), (0.030, 0.0), (0.024, 0.006), (0.0, 0.007)], 18, peg, (0.35, 1, 0), uv_scale=(0.11, 1), uv_offset=(0.25, 0.1))
    model.add("visual_pegs", pegs, ["timber"], frame)


def make_drum(model):
    drum = model.group("DRUM")
    log = [(0.0, -0.372), (DRUM_RADIUS - 0.006, -0.372), (DRUM_RADIUS, -0.366)] + [(DRUM_RADIUS, z) for z in np.linspace(-0.27, 0.27, 5)] + \
          [(DRUM_RADIUS, 0.366), (DRUM_RADIUS - 0.006, 0.372), (0.0, 0.372)]
    model.add("part_log", lathe(Shape(), log, 40, uv_scale=(0.5, 1 / 2.3), uv_offset=(0, 0.15), end_grain=(0, len(log) - 2)), ["timber"], drum, 35)
    arm = timber(Shape(), (-0.060, 0, ARM_Z), (CRANK_RADIUS + 0.045, 0, ARM_Z), 0.058, 0.040, up=(0, 0, 1), bevel=0.008, seed=31, rough=0.0008, taper=0.86)
    model.add("part_arm", arm, ["timber"], drum)
    swell = [(0.0, -1.0), (0.0110, -1.0), (0.0140, -0.975), (0.0152, -0.93), (0.0150, -0.85), (0.0158, -0.6), (0.0168, -0.3), (GRIP_RADIUS, 0.0), (0.0168, 0.3),
             (0.0158, 0.6), (0.0150, 0.85), (0.0152, 0.93), (0.0140, 0.975), (0.0110, 1.0), (0.0, 1.0)]
    grip = lathe(Shape(), [(r, GRIP_Z + t * GRIP_LENGTH / 2) for r, t in swell], 36, (CRANK_RADIUS, 0, 0), uv_scale=(0.115, 1.2), uv_offset=(0.13, 0.3))
    model.add("part_grip", grip, ["grip"], drum, 45)
    fittings = Shape()
    rod(fittings, (0, 0, -0.520), (0, 0, -0.368), 0.018)
    rod(fittings, (0, 0, 0.368), (0, 0, 0.598), 0.018)
    rod(fittings, (CRANK_RADIUS, 0, ARM_Z - 0.028), (CRANK_RADIUS, 0, GRIP_Z + GRIP_LENGTH / 2 + 0.006), 0.0075)
    for z in (ARM_Z - 0.024, ARM_Z + 0.0205):
        lathe(fittings, [(0.017, z), (0.030, z), (0.031, z + 0.001), (0.030, z + 0.0045), (0.017, z + 0.0045)], 32, uv_scale=(1, 5))
        lathe(fittings, [(0.007, z), (0.019, z), (0.020, z + 0.001), (0.019, z + 0.0045), (0.007, z + 0.0045)], 28, (CRANK_RADIUS, 0, 0), uv_scale=(1, 5))
    for z in (-0.350, 0.350):
        hoop(fittings, [(DRUM_RADIUS - 0.001, -0.012), (DRUM_RADIUS + 0.005, -0.012), (DRUM_RADIUS + 0.005, 0.012), (DRUM_RADIUS - 0.001, 0.012)], (0, 0, z), 2)
    make_ratchet_wheel(fittings)
    model.add("visual_bronze", fittings, ["bronze"], drum, 35)
    cheeks = Shape()
    for z in (-0.135, 0.135):
        lathe(cheeks, [(DRUM_RADIUS - 0.002, z - 0.013), (0.100, z - 0.013), (0.106, z - 0.008), (0.106, z + 0.008), (0.100, z + 0.013), (DRUM_RADIUS - 0.002, z + 0.013)], 48,
              uv_scale=(0.5, 1), uv_offset=(0.02, 0.3), end_grain=(0, 4))
    model.add("visual_cheeks", cheeks, ["planks"], drum, 35)
    turns = Shape()
    pitch = 2 * ROPE_RADIUS * 1.03
    path = [((DRUM_RADIUS + ROPE_RADIUS) * math.cos(a), (DRUM_RADIUS + ROPE_RADIUS) * math.sin(a), 0.108 - pitch * a / (2 * math.pi)) for a in np.arange(0, 5 * 32 + 1) * 2 * math.pi / 32]
    tube(turns, path, ROPE_RADIUS, 10, v_scale=9)
    model.add("visual_turns", turns, ["hemp"], drum, 60)


def make_ratchet_wheel(shape):
    """Saw teeth: it turns counter-clockwise seen from its front, and the pawl meets the upright faces on the way back."""
    outline = []
    for k in range(TEETH):
        a = 2 * math.pi * k / TEETH
        for t in (0.0, 0.33, 0.66, 0.985):
            r, b = RATCHET_RADIUS - TOOTH * t, a + 2 * math.pi / TEETH * t
            outline.append((r * math.cos(b), r * math.sin(b)))
    rings = [[(x * f, y * f, RATCHET_Z + z) for x, y in outline] for z, f in ((-0.011, 0.985), (-0.009, 1.0), (0.009, 1.0), (0.011, 0.985))]
    shape.loft(rings, lambda i, j: (j / len(outline) * 2, i * 0.02), cap_scale=4)
    lathe(shape, [(DRUM_RADIUS - 0.001, 0.0), (0.070, 0.0), (0.071, 0.002), (0.069, 0.006), (DRUM_RADIUS - 0.001, 0.007)], 40, (0, 0, RATCHET_Z + 0.010), uv_scale=(1, 5))


# The load and its place ----------------------------------------------------------------------------------------------------------


def round_stone(radius, low, high, seed, segments=44, rough=0.0012):
    """A column's drum: dressed, not yet fluted; its edges worn."""
    rng = np.random.default_rng(7000 + seed)
    b = 0.008
    section = [(radius - b, low), (radius - b * 0.3, low + b * 0.3), (radius, low + b)] + [(radius, y) for y in np.linspace(low, high, 6)[1:-1]] + \
              [(radius, high - b), (radius - b * 0.3, high - b * 0.3), (radius - b, high)]
    rings = [[((r + rng.normal(0, rough)) * math.cos(a), y, -(r + rng.normal(0, rough)) * math.sin(a)) for a in np.arange(segments) * 2 * math.pi / segments] for r, y in section]
    run = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(np.asarray(section), axis=0).T))])
    shift = rng.random(2)
    return Shape().loft(rings, lambda i, j: (shift[0] + j / segments, shift[1] + run[i] / 1.1), cap_scale=0.9, cap_uv=tuple(shift))


def make_tongs(shape, half):
    """Iron tongs that bite the harder the more they bear; their ring is where the rope pulls."""
    for s in (-1, 1):
        arm = [(0.012 * s, 0.045, s * (half + 0.012)), (0.012 * s, 0.115, s * (half + 0.024)), (0.012 * s, 0.165, s * (half - 0.004)), (0.012 * s, 0.205, s * 0.060),
               (0.012 * s, 0.225, 0.0), (0.012 * s, 0.243, -s * 0.030), (0.008 * s, 0.262, -s * 0.040), (0.0, RING_Y - 0.012, -s * 0.026)]
        fine = []
        for k in range(len(arm) - 1):
            fine += [mix(np.array(arm[k]), np.array(arm[k + 1]), t / 3) for t in range(3)]
        tube(shape, fine + [arm[-1]], lambda t: mix(0.013, 0.008, t), 10, v_scale=6)
        rod(shape, (0.012 * s, 0.045, s * (half + 0.020)), (0.012 * s, 0.045, s * (half - 0.012)), 0.017)
    rod(shape, (-0.030, 0.225, 0), (0.030, 0.225, 0), 0.009)
    ring = [(0, RING_Y - 0.004 + 0.030 * math.sin(a), 0.030 * math.cos(a)) for a in np.arange(24) * 2 * math.pi / 24]
    tube(shape, ring, 0.0065, 9, closed=True)


def make_load(model, kind):
    load = model.group("LOAD")
    rock = "marble" if kind["compound"] else "limestone"
    if kind["compound"]:
        model.add("part_stone", round_stone(0.17, -HALF_HEIGHT, HALF_HEIGHT, 1), [rock], load, 35)
    else:
        model.add("part_stone", block(Shape(), (-0.18, -HALF_HEIGHT, -0.14), (0.18, HALF_HEIGHT, 0.14), 0.010, 61, 0.0016), [rock], load, 42)
    side = 0.17 if kind["compound"] else 0.18
    boss = block(Shape(), (side - 0.025, -0.029, -0.029), (side + 0.085, 0.029, 0.029), 0.012, 63, 0.0008)
    model.add("part_boss", boss, [rock], load, 60)
    tongs = Shape()
    make_tongs(tongs, 0.17 if kind["compound"] else 0.14)
    model.add("visual_tongs", tongs, ["iron"], load, 50)
    if not kind["compound"]:
        return
    cheeks, bronze = Shape(), Shape()
    for k, z in enumerate((-0.034, 0.034)):
        timber(cheeks, (0, RING_Y + 0.006, z), (0, LOWER_Y + 0.075, z), 0.105, 0.024, up=(0, 0, 1), bevel=0.006, seed=71 + k, rough=0.0008)
    model.add("visual_lower_block", cheeks, ["timber"], load)
    sheave(bronze, (0, LOWER_Y, 0), LOWER_RADIUS)
    for y in (LOWER_Y, RING_Y + 0.026):
        rod(bronze, (0, y, -0.054), (0, y, 0.054), 0.010)
    model.add("visual_lower_bronze", bronze, ["bronze"], load, 40)


def make_wall(model, scene, kind):
    wall = model.group("WALL")
    for k, s in enumerate((-1, 1)):
        x = kind["x"] + s * 0.105
        model.add(f"part_baulk_{k}", timber(Shape(), (x, BAULK / 2 - 0.006, -0.27), (x, BAULK / 2 - 0.006, 0.27), 0.085, BAULK + 0.012, bevel=0.006, seed=81 + k, rough=0.0006), ["planks"],
                  wall)
    if kind["compound"]:
        make_columns(model, scene, wall, kind["seat"])
        return
    rng = np.random.default_rng(151)
    right = kind["seat"] + 0.18
    seed = 300
    for course in range(4):
        low = WALL_TOP - 3 * COURSE + course * COURSE
        x = right - (0.365 if course == 3 else 0.0)
        first = (0.52, 0.34, 0.46, 0.44)[course]
        count = 0
        end = -2.2 + 0.05 * course
        while x > end + 0.10:
            length = first if count == 0 else rng.uniform(0.38, 0.56)
            edge = max(x - length, end)
            shape = block(Shape(), (edge + 0.003, low + 0.001, -0.14), (x, low + COURSE - 0.002, 0.14), 0.008, seed, 0.0018)
            near = count < 2
            model.add(f"part_stone_{course}_{count}" if near else f"visual_stone_{course}_{count}", shape, ["limestone"], wall if near else scene, 42)
            x, count, seed = edge - 0.001, count + 1, seed + 1
    footing = block(Shape(), (-2.2, -0.12, -0.19), (right + 0.04, 0.05, 0.19), 0.012, 340, 0.003)
    model.add("visual_footing", footing, ["limestone"], scene, 42)


def make_columns(model, scene, wall, x):
    for k in range(3):
        shape = round_stone(0.172 - 0.0006 * k, 0.05 + COURSE * k + 0.001, 0.05 + COURSE * (k + 1) - 0.001, 10 + k)
        shape.vertices = [(a + x, y, z) for a, y, z in shape.vertices]
        model.add(f"part_drum_{k}", shape, ["marble"], wall, 35)
    model.add("part_step", block(Shape(), (x - 0.27, -0.10, -0.27), (x + 0.27, 0.05, 0.27), 0.010, 351, 0.002), ["marble"], wall, 42)
    steps = Shape()
    for k in range(3):
        a = x - 0.28 - 0.57 * k
        block(steps, (a - 0.555, -0.10, -0.27), (a, 0.05, 0.27), 0.010, 352 + k, 0.002)
    for k in range(4):
        a = x + 0.36 - 0.58 * k
        block(steps, (a - 0.572, -0.16, -0.60), (a, -0.028, -0.275), 0.010, 360 + k, 0.002)
        block(steps, (a - 0.572, -0.16, 0.275), (a, -0.028, 0.44), 0.010, 370 + k, 0.002)
    model.add("visual_steps", steps, ["marble"], scene, 42)
    far, y, radius = Shape(), 0.05, 0.172
    for k in range(8):
        piece = round_stone(radius - 0.004 * k, y + 0.001, y + 0.279, 20 + k, 40)
        offset = len(far.vertices)
        far.vertices += [(a + x - 1.10, b, c) for a, b, c in piece.vertices]
        for face, uvs in zip(piece.faces, piece.uvs):
            far.face(tuple(i + offset for i in face), uvs)
        y += 0.28
    lathe(far, [(0.0, y), (0.140, y), (0.150, y + 0.02), (0.195, y + 0.085), (0.205, y + 0.10), (0.0, y + 0.10)], 40, (x - 1.10, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(1, 1))
    block(far, (x - 1.32, y + 0.10, -0.22), (x - 0.88, y + 0.19, 0.22), 0.008, 380, 0.0015)
    model.add("visual_column", far, ["marble"], scene, 35)


# Surroundings --------------------------------------------------------------------------------------------------------------------


def height_at(x, z):
    away = max(0.0, abs(z) - 0.9) * 0.05 + max(0.0, x - 1.4) * 0.02
    return -0.006 + away + 0.010 * math.sin(2.3 * x + 1.1) * math.sin(1.9 * z) + 0.005 * math.sin(7.1 * x + 2) * math.sin(6.3 * z + 1) * (abs(z) > 0.3)


def make_ground(model, scene):
    xs, zs = np.linspace(-2.6, 2.6, 70), np.linspace(-1.7, 1.6, 46)
    rng = np.random.default_rng(191)
    grid = [[(x, height_at(x, z) + rng.normal(0, 0.002), z) for z in zs] for x in xs]
    shape, index = earth(grid)
    skirt(shape, grid, index, -0.22)
    model.add("visual_ground", shape, ["earth"], scene, 40)


def make_yard(model, scene, kind):
    """Stones that wait, chips of dressing them, handspikes, a mallet."""
    rock = "marble" if kind["compound"] else "limestone"
    waiting = Shape()
    for k, (x, z, turn) in enumerate(((1.35, -0.95, 0.3), (1.95, -0.70, -0.2), (-1.55, -1.05, 0.1))):
        first = len(waiting.vertices)
        block(waiting, (-0.22, 0.0, -0.15), (0.22, 0.25, 0.15), 0.012, 400 + k, 0.003)
        c, s = math.cos(turn), math.sin(turn)
        waiting.vertices[first:] = [(x + c * a + s * b, y + height_at(x, z) - 0.01, z - s * a + c * b) for a, y, b in waiting.vertices[first:]]
    model.add("visual_waiting", waiting, [rock], scene, 42)
    rng = np.random.default_rng(161)
    chips = Shape()
    for _ in range(170):
        x, z, size = rng.normal(0.9, 0.9), rng.normal(-0.55, 0.55), rng.uniform(0.006, 0.024)
        if not (-2.4 < x < 2.5 and -1.6 < z < 1.5):
            continue
        points = [np.array([x, height_at(x, z), z]) + rng.normal(0, size, 3) * (1, 0.5, 1) for _ in range(4)]
        i = chips.points(points)
        if np.dot(np.cross(points[1] - points[0], points[2] - points[0]), points[3] - points[0]) > 0:
            i = [i[1], i[0], i[2], i[3]]
        u = tuple(rng.random(2))
        for face in ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)):
            chips.face(tuple(i[f] for f in face), (u, (u[0] + size, u[1]), (u[0], u[1] + size)))
    model.add("visual_chips", chips, [rock], scene, 20)
    tools = Shape()
    for k, (x, z, turn) in enumerate(((1.05, 0.85, 0.25), (1.12, 0.95, 0.34))):
        d = np.array([math.cos(turn), 0, math.sin(turn)]) * 0.48
        p = np.array([x, height_at(x, z) + 0.022, z])
        lathe(tools, [(0, 0), (0.016, 0), (0.020, 0.02), (0.022, 0.5), (0.018, 0.94), (0.012, 0.96), (0, 0.96)], 14, p - d, d, (0, 1, 0), uv_scale=(0.11, 1),
              uv_offset=(0.25 + 0.12 * k, 0.2))
    mallet = np.array([1.50, height_at(1.5, -0.9) + 0.32, -0.93])
    lathe(tools, [(0, -0.07), (0.040, -0.07), (0.050, -0.05), (0.052, 0.05), (0.044, 0.07), (0, 0.07)], 24, mallet - (0.02, 0.032, 0), (1, 0, 0.3), uv_scale=(0.2, 1), uv_offset=(0.4, 0.3))
    lathe(tools, [(0, 0), (0.013, 0), (0.016, 0.22), (0, 0.225)], 14, mallet - (0.02, 0.032, 0), (0.3, -0.12, -1), uv_scale=(0.1, 1), uv_offset=(0.6, 0.3))
    model.add("visual_tools", tools, ["timber"], scene, 35)


def make_grass(model, scene, kind):
    rng = np.random.default_rng(171)
    shape = Shape()
    made = 0
    while made < 170:
        x, z = rng.uniform(-2.5, 2.5), rng.uniform(-1.6, 1.5)
        if (abs(z) < 0.75 and -2.3 < x < 1.2) or (kind["compound"] and x < 0 and -0.7 < z < 0.55) or (abs(z) < 1.2 and rng.random() < 0.7):
            continue
        made += 1
        tuft(shape, rng, x, z, height_at, 8, tallest=0.15)
    model.add("visual_grass", shape, ["blade", "straw"], scene, 60)


# The files -----------------------------------------------------------------------------------------------------------------------


def make(kind, path, pictures):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with tempfile.TemporaryDirectory() as folder:
        model = Model(make_materials(Textures(folder)))
        make_frame(model, kind)
        make_drum(model)
        make_load(model, kind)
        scene = model.group("SCENE")
        make_wall(model, scene, kind)
        make_ground(model, scene)
        make_yard(model, scene, kind)
        make_grass(model, scene, kind)
        export(os.path.abspath(path))
        if not pictures:
            return
        bpy.data.objects["DRUM"].location = to_blender(AXLE)
        for name, load, eye, look_at in (("whole", (kind["x"], BAULK + HALF_HEIGHT, 0), (1.2, 1.75, 5.6), (-0.1, 1.45, 0)),
                                         ("head", (kind["x"], 0.96, 0), (-1.35, 2.75, 1.15), (-0.30, 2.85, 0)),
                                         ("winch", (kind["x"], 0.96, 0), (1.15, 1.25, 1.45), (0.25, 0.75, 0.1)),
                                         ("load", (kind["seat"], WALL_TOP + HALF_HEIGHT, 0), (0.35, 1.45, 1.45), (-0.75, 0.85, 0))):
            bpy.data.objects["LOAD"].location = to_blender(load)
            picture(f"{os.path.abspath(pictures)}-{kind['name']}-{name}.png", eye, look_at, samples=24)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:]
    for kind, path in zip((SINGLE, DOUBLE), arguments):
        make(kind, path, arguments[2] if len(arguments) > 2 else "")


main()
