"""Models Archimedes' screw and its place by the river, and writes archimedes-screw.glb.

    blender -b --python archimedes-screw.py -- archimedes-screw.glb        (Blender 3.4, with python3-numpy)

Proportions: Vitruvius, De architectura X.6. Everything below is in metres, in glTF's axes (y up); modelling.py turns them to Blender's.

Nodes at the root, all with identity transforms:
  OUTER, INNER     in the frame of their own body: z along the screw's axis, up the slope, the origin half way; the scenario places
                   them (body z to (cos 37 deg, sin 37 deg, 0), body x to (-sin 37 deg, cos 37 deg, 0), origin to (0, 0.55, 0))
  SCENE            what never moves, in the world's frame
  WATER_BASIN      the water's surface at the basin's floor: a display lifts it by the level
  WATER_RIVER      the river's surface
Children named part_* are touched as well as drawn, and are closed; children named visual_* are drawn only.
The same script gives the same file: every random number is seeded by what it is for.
"""
import math
import os
import sys
import tempfile

import bpy
import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from modelling import Model, Shape, block, earth, export, frame_of, lathe, rim, strip_uv, timber, tube  # noqa: E402
from surfaces import TEXTURE, WOOD_STRIPS, Textures, fractal, material, mix, museum_materials, noise, step, surface, tint  # noqa: E402

SLOPE = math.radians(37.0)
BARREL_MIDDLE = np.array([0.0, 0.55, 0.0])
BARREL_HALF = 1.15
BARREL_INNER, BARREL_OUTER = 0.153, 0.185
STAVES = 16
SCREW_HALF = 1.20
CORE_RADIUS, BLADE_RADIUS = 0.075, 0.150
BLADES, SECTORS = 8, 28
PITCH = math.pi * 2 * CORE_RADIUS  # Vitruvius: one turn advances by the core's circumference
BLADE_THICKNESS = 0.008
CRANK_Z, CRANK_RADIUS = 1.27, 0.25
GRIP_RADIUS, GRIP_LENGTH, GRIP_Z = 0.017, 0.130, 1.36
RIVER_LEVEL = -0.02
BASIN_X, BASIN_FLOOR, BASIN_DEPTH, BASIN_SIDE, BASIN_WALL = 1.22, 0.45, 0.35, 0.50, 0.07
GROUND_X, GROUND_Z = (-3.3, 2.7), (-2.3, 2.3)


def world_from_body(p):
    """A point of the body's frame, in the world's, with the machine in its place."""
    s, c = math.sin(SLOPE), math.cos(SLOPE)
    x, y, z = p
    return BARREL_MIDDLE + np.array([-s * x + c * z, c * x + s * z, y])


# Materials -----------------------------------------------------------------------------------------------------------------------


def willow():
    """Strips of willow laid along the blade, smeared with pitch: six across u, the blade's length along v."""
    rng = np.random.default_rng(31)
    rows, columns, strips = TEXTURE, TEXTURE // 2, 6
    shape = (rows, columns)
    u = (np.arange(columns) + 0.5)[None, :] / columns + (noise(shape, (6, 2), rng) - 0.5) * 0.012
    across = np.mod(u * strips, 1.0)
    which = np.clip((u * strips).astype(int), 0, strips - 1)
    seam = np.maximum(np.exp(-across / 0.05), np.exp(-(1 - across) / 0.05))
    fibre = 0.6 * noise(shape, (16, columns // 3), rng) + 0.4 * noise(shape, (60, columns // 4), rng)
    shade = rng.uniform(0.8, 1.2, strips)[which]
    colour = tint((0.36, 0.205, 0.085), (0.17, 0.085, 0.032), np.clip(fibre * 1.1 - 0.05, 0, 1)) * shade[..., None]
    pitch = step(0.50, 0.72, fractal(shape, (10, 5), rng, 5))
    colour = mix(colour, np.array([0.055, 0.034, 0.020])[None, None, :], np.maximum(0.55 * pitch, 0.85 * seam)[..., None])
    roughness = np.clip(0.62 - 0.27 * pitch - 0.1 * seam, 0, 1)
    height = 0.9 * np.sin(np.pi * across) ** 0.6 - 0.5 * (1 - fibre) * (1 - 0.6 * pitch) - 0.6 * seam
    return np.clip(colour, 0, 1), height, roughness


def make_materials(textures):
    willow_colour, willow_height, willow_rough = willow()
    blade = surface(textures, "willow", willow_colour, willow_height, 0.8)
    gloss = np.dstack([np.ones_like(willow_rough), willow_rough, np.zeros_like(willow_rough)])
    willow_gloss = textures.image("willow_gloss", gloss[::2, ::2], linear=True)
    return {
        **museum_materials(textures),
        "willow": material("willow", *blade, willow_gloss),
        "reed": material("reed", base=(0.15, 0.19, 0.045, 1), roughness=0.7, two_sided=True),
        "straw": material("straw", base=(0.36, 0.30, 0.12, 1), roughness=0.8, two_sided=True),
    }


# The machine ---------------------------------------------------------------------------------------------------------------------


def stave_outline(middle, rng, shrink=0.0):
    """Cross-section of a stave: outer arc counter-clockwise, then inner arc back; (point, u) with u across the plank."""
    outer = BARREL_OUTER + shrink
    half = math.pi / STAVES
    gap = 0.0005
    edge = 0.0028
    points = []
    top = half - (gap + edge) / outer
    for k in range(7):
        points.append((outer, middle - top + 2 * top * k / 6, 0.06 + 0.88 * k / 6))
    points.append((outer - edge, middle + half - gap / outer, 0.97))
    for k in range(6):
        a = half - gap / BARREL_INNER
        points.append((BARREL_INNER, middle + a - 2 * a * k / 5, 0.94 - 0.88 * k / 5))
    points.append((outer - edge, middle - half + gap / outer, 0.03))
    return points


def make_barrel(model, outer):
    for s in range(STAVES):
        rng = np.random.default_rng(3000 + s)
        middle = 2 * math.pi * (s + 0.5) / STAVES
        swell = rng.uniform(-0.0016, 0.0)
        ends = [BARREL_HALF + rng.uniform(-0.004, 0.0), BARREL_HALF + rng.uniform(-0.004, 0.0)]
        strip, flip, shift = int(rng.integers(WOOD_STRIPS)) if s % 2 else (s // 2) % WOOD_STRIPS, s % 3 == 1, rng.uniform(0, 0.3)
        along = [-ends[0], -ends[0] + 0.004] + list(np.linspace(-1.0, 1.0, 9)) + [ends[1] - 0.004, ends[1]]
        rings = []
        for i, z in enumerate(along):
            end = i in (0, len(along) - 1)
            wear = 0.0 if end else rng.normal(0, 0.0005)
            outline = stave_outline(middle, rng, swell + wear - (0.004 if end else 0.0))
            rings.append([(r * math.cos(a), r * math.sin(a), z) for r, a, _ in outline])
            us = [u for _, _, u in outline] + [outline[0][2]]

        def uv(i, j):
            v = 0.5 + along[i] / 2.32
            return strip_uv(strip, us[j], (1 - v if flip else v) + shift)

        shape = Shape().loft(rings, uv, cap_scale=1.0, cap_uv=((strip + 0.5) / WOOD_STRIPS, 0.4))
        model.add(f"part_stave_{s:02d}", shape, ["planks"], outer, 30)


def band(radius, width, thickness):
    """Profile of a hoop whose inner side lies at `radius`, as a ring to be turned: it closes on itself."""
    o, b = radius + thickness, 0.0012
    return [(radius, -width / 2), (o - b, -width / 2), (o, -width / 2 + b), (o, width / 2 - b), (o - b, width / 2), (radius, width / 2),
            (radius, -width / 2)]


def make_hoops(model, outer):
    for h, z in enumerate((-1.09, -0.56, 0.0, 0.56, 1.09)):
        shape = Shape()
        lathe(shape, [(r, z + dz) for r, dz in band(BARREL_OUTER - 0.002, 0.042, 0.0055)], 96, uv_scale=(4, 4), up=(0, 1, 0))
        for k in range(STAVES):  # a rivet on each stave
            a = 2 * math.pi * (k + 0.5) / STAVES
            direction = np.array([math.cos(a), math.sin(a), 0])
            centre = direction * (BARREL_OUTER + 0.003) + np.array([0, 0, z])
            lathe(shape, [(0.0058, 0.0), (0.0055, 0.0018), (0.0038, 0.0034), (0, 0.0041)], 10, centre, direction, (0, 0, 1), uv_scale=(0.1, 1))
        model.add(f"visual_hoop_{h}", shape, ["bronze"], outer, 40)


def make_footstep(model, outer):
    """The lower bearing: a bar across the barrel's foot, hung on two bronze straps, with a socket for the screw's pivot."""
    bar = timber(Shape(), (0, -0.205, -1.235), (0, 0.205, -1.235), 0.06, 0.046, up=(1, 0, 0), seed=5)
    model.add("visual_foot_bar", bar, ["timber"], outer)
    shape = Shape()
    for side in (-1, 1):
        y = side * (BARREL_OUTER + 0.005)
        block(shape, (-0.017, min(y, y + side * 0.004), -1.262), (0.017, max(y, y + side * 0.004), -0.98), 0.0015, 7, 0.0, 0.3)
    lathe(shape, [(0.034, -1.214), (0.034, -1.205), (0.031, -1.2025), (0.019, -1.2025)], 32, uv_scale=(1, 2))
    model.add("visual_foot_bronze", shape, ["bronze"], outer)


def blade_profile():
    """(radius, side, u, radial part of the normal, axial part): the blade's section, upper side first, from the root outwards."""
    tip, lip = BLADE_RADIUS, 0.0025
    radii = [CORE_RADIUS - 0.002, 0.098, 0.124, tip - lip]
    upper = [(r, 1.0) for r in radii] + [(tip - 0.3 * lip, 0.72), (tip, 0.3)]
    return upper + [(r, -s) for r, s in reversed(upper)]


def blade_point(radius, side, angle, z):
    lean = math.atan2(PITCH, 2 * math.pi * radius)
    return (radius * math.cos(angle), radius * math.sin(angle), z + side * 0.5 * BLADE_THICKNESS / math.cos(lean))


def blade_normal(radius, side, angle):
    """Outward normal of the section's face or lip at the given angle."""
    k = PITCH / (2 * math.pi)
    axial = np.array([k * math.sin(angle) / radius, -k * math.cos(angle) / radius, 1.0])
    axial /= np.linalg.norm(axial)
    radial = np.array([math.cos(angle), math.sin(angle), 0.0])
    rounding = {1.0: 0.0, 0.72: 0.75, 0.3: 0.96}[abs(side)]
    return radial * rounding + axial * math.copysign(math.sqrt(1 - rounding * rounding), side)


def make_blades(model, inner):
    profile = blade_profile()
    count, steps = len(profile), 12
    low, high = -SCREW_HALF + 0.012, SCREW_HALF - 0.012
    for b in range(BLADES):
        rng = np.random.default_rng(4000 + b)
        v_shift = rng.uniform(0, 1)
        for s in range(SECTORS):
            z_of = [low + (high - low) * (s + k / steps) / SECTORS for k in range(steps + 1)]
            angle_of = [2 * math.pi * (b / BLADES + (z - low) / PITCH) for z in z_of]
            shape = Shape()
            index = [shape.points([blade_point(r, side, a, z) for r, side in profile]) for z, a in zip(z_of, angle_of)]
            u_of = [0.02 + 0.96 * (r - CORE_RADIUS) / (BLADE_RADIUS - CORE_RADIUS) for r, _ in profile]
            v_of = [v_shift + (z - low) * 2.0 for z in z_of]
            for i in range(steps):
                for j in range(count):
                    k = (j + 1) % count
                    root = j == count - 1
                    quad = ((i, j), (i, k), (i + 1, k), (i + 1, j))
                    normals = [(-math.cos(angle_of[c]), -math.sin(angle_of[c]), 0) if root else
                               blade_normal(profile[p][0], profile[p][1], angle_of[c]) for c, p in quad]
                    shape.face(tuple(index[c][p] for c, p in quad), tuple((u_of[p], v_of[c]) for c, p in quad), 0, normals)
            for ring, angle, sign in ((index[0], angle_of[0], -1), (index[-1], angle_of[-1], 1)):
                order = list(range(count)) if sign > 0 else list(range(count))[::-1]
                across = sign * np.array([-math.sin(angle), math.cos(angle), 0])
                shape.face(tuple(ring[j] for j in order), tuple((u_of[j], 0.02 * profile[j][1]) for j in order), 0,
                           [across] * count)
            model.add(f"part_blade_{b}_{s:02d}", shape, ["willow"], inner, 180)


def make_core(model, inner):
    r, e = CORE_RADIUS, SCREW_HALF
    pivot = [(0, -1.258), (0.012, -1.258), (0.016, -1.252), (0.016, -e - 0.002), (0.040, -e), (r - 0.006, -e)]
    trunk = [(r, -e + 0.006)] + [(r, z) for z in np.linspace(-1.0, 1.0, 9)] + [(r, e - 0.006), (r - 0.006, e)]
    stub = [(0.036, e), (0.030, e + 0.004), (0.030, 1.295), (0.025, 1.300), (0, 1.300)]
    profile = pivot + trunk + stub
    slots = [1] * 4 + [0] * (len(trunk) + 2) + [1] * 5
    shape = lathe(Shape(), profile, 64, slots=slots[:len(profile) - 1], uv_scale=(1, 1 / 2.3), uv_offset=(0, 0.05),
                  end_grain=(4, len(pivot) + len(trunk) - 1))
    model.add("part_core", shape, ["timber", "bronze"], inner, 30)


def hull_outline(r0, r1, length, steps=14):
    """Counter-clockwise outline round two circles: radius r0 at the origin, r1 at (length, 0)."""
    lean = math.asin((r0 - r1) / length)
    start = math.pi / 2 - lean
    first = [(r0 * math.cos(a), r0 * math.sin(a)) for a in np.linspace(start, 2 * math.pi - start, 2 * steps)]
    last = [(length + r1 * math.cos(a), r1 * math.sin(a)) for a in np.linspace(-start, start, steps)]
    return first + last


def make_crank(model, inner):
    half, bevel = 0.020, 0.005
    rings = []
    for z, inset in ((-half, bevel), (-half + bevel * 0.35, bevel * 0.3), (-half + bevel, 0), (half - bevel, 0), (half - bevel * 0.35, bevel * 0.3),
                     (half, bevel)):
        rings.append([(x, y, CRANK_Z + z) for x, y in hull_outline(0.052 - inset, 0.032 - inset, CRANK_RADIUS)])
    shape = Shape()
    index = [shape.points(ring) for ring in rings]
    count = len(rings[0])
    for i in range(len(rings) - 1):
        for j in range(count):
            k = (j + 1) % count
            quad = ((i, j), (i, k), (i + 1, k), (i + 1, j))
            shape.face(tuple(index[a][b] for a, b in quad),
                       tuple(strip_uv(6, 0.5 + 8 * (rings[a][b][2] - CRANK_Z), 0.2 + rings[a][b][0] / 2.3) for a, b in quad))
    for ring, points, flip in ((index[0], rings[0], True), (index[-1], rings[-1], False)):
        order = list(range(count))[::-1] if flip else list(range(count))
        shape.face(tuple(ring[j] for j in order), tuple(strip_uv(5, 0.5 + points[j][1] * 8.5, 0.2 + points[j][0] / 2.3) for j in order))
    model.add("part_crank", shape, ["timber"], inner, 40)

    swell = [(0.0, -1.0), (0.0110, -1.0), (0.0140, -0.975), (0.0152, -0.93), (0.0150, -0.85), (0.0158, -0.6), (0.0168, -0.3), (GRIP_RADIUS, 0.0),
             (0.0168, 0.3), (0.0158, 0.6), (0.0150, 0.85), (0.0152, 0.93), (0.0140, 0.975), (0.0110, 1.0), (0.0, 1.0)]
    profile = [(r, GRIP_Z + t * GRIP_LENGTH / 2) for r, t in swell]
    grip = lathe(Shape(), profile, 40, (CRANK_RADIUS, 0, 0), uv_scale=(0.115, 1.2), uv_offset=(0.13, 0.3))
    model.add("part_grip", grip, ["grip"], inner, 45)

    fittings = Shape()
    top = CRANK_Z + half
    lathe(fittings, [(0.0, top - 0.001), (0.0235, top - 0.001), (0.0235, top + 0.003), (0.021, top + 0.0045), (0.0, top + 0.0045)], 32,
          (CRANK_RADIUS, 0, 0), uv_scale=(0.5, 3))
    end = GRIP_Z + GRIP_LENGTH / 2
    lathe(fittings, [(0.0085, end - 0.001), (0.0085, end + 0.002), (0.0055, end + 0.0045), (0.0, end + 0.0052)], 20, (CRANK_RADIUS, 0, 0),
          uv_scale=(0.2, 3))
    for z in (CRANK_Z - half - 0.001, top - 0.003):  # plates that bind the hub, above and below
        lathe(fittings, [(0.028, z), (0.043, z), (0.0445, z + 0.001), (0.0445, z + 0.0035), (0.043, z + 0.004), (0.028, z + 0.004)], 40,
              uv_scale=(1, 4))
    timber(fittings, (0, -0.036, 1.2955), (0, 0.036, 1.2955), 0.007, 0.010, up=(0, 0, 1), bevel=0.0015, seed=9, rough=0)
    model.add("visual_crank_bronze", fittings, ["bronze"], inner, 35)


# Its place -----------------------------------------------------------------------------------------------------------------------


def trestle(model, scene, name, axial, steepness, seed):
    """Two crossed timbers that carry the barrel in their fork; pegged and lashed where they cross, a spreader near the ground."""
    centre = world_from_body((0, 0, axial))
    width, depth = 0.070, 0.078
    lift = math.hypot(steepness * (BARREL_OUTER + 0.004), (BARREL_OUTER + 0.004) / math.cos(SLOPE))
    cross_y = centre[1] - lift - width / 2 * math.hypot(1, steepness)
    foot = (cross_y + 0.06) / steepness
    reach = 0.30 / math.hypot(1, steepness) * 1.35
    shape = Shape()
    for side in (-1, 1):
        x = centre[0] + side * (depth / 2 - 0.014)
        timber(shape, (x, -0.06, side * foot), (x, cross_y + reach * steepness, -side * reach), depth, width, up=(0, side * 0.6, 1), bevel=0.008,
               seed=seed + side, rough=0.0022, taper=0.9)
    y = 0.17 if cross_y > 0.4 else 0.10
    z = (cross_y - y) / steepness
    for side in (-1, 1):
        x = centre[0] + side * (depth + 0.004)
        timber(shape, (x, y, -z - 0.09), (x, y, z + 0.09), 0.032, 0.052, bevel=0.005, seed=seed + 4 + side, rough=0.0015)
    model.add(f"visual_{name}_timber", shape, ["planks"], scene)

    pegs = Shape()
    places = [(cross_y, 0.0, 0.066)] + [(y, s * z, 0.098) for s in (-1, 1)]
    for py, pz, half in places:
        lathe(pegs, [(0.0, -half), (0.010, -half), (0.0125, -half + 0.004), (0.0125, half - 0.004), (0.010, half), (0.0, half)], 14,
              (centre[0], py, pz), (1, 0, 0), uv_scale=(0.11, 1), uv_offset=(0.25, 0.1))
    model.add(f"visual_{name}_pegs", pegs, ["timber"], scene)

    lashing = Shape()
    slant = math.atan(steepness)
    rng = np.random.default_rng(5000 + seed)
    for diagonal in (-1, 1):  # turns across both forks of the crossing
        for turn in range(5):
            shift = (turn - 2) * 0.0125
            along = np.array([0, math.sin(math.pi / 2), 0]) if diagonal > 0 else np.array([0, 0, 1.0])
            other = np.array([0, 0, 1.0]) if diagonal > 0 else np.array([0, 1.0, 0])
            reach_along = 0.052 / (math.cos(slant) if diagonal > 0 else math.sin(slant))
            loop = []
            for a in np.arange(28) * 2 * math.pi / 28:
                c, s = math.cos(a), math.sin(a)
                squareness = (abs(c) ** 4 + abs(s) ** 4) ** -0.25
                out = 0.070 * squareness * c
                loop.append(np.array([centre[0] + out, cross_y, 0]) + along * (reach_along * squareness * s) +
                            other * (shift + rng.normal(0, 0.0006)))
            tube(lashing, loop, 0.0068, 8, closed=True, v_scale=9)
    model.add(f"visual_{name}_lashing", lashing, ["hemp"], scene, 60)


def make_basin(model, scene):
    """A tub cut from one limestone block, on two bearers; its wall leans a little and carries a moulding at the rim."""
    inner, wall = BASIN_SIDE / 2, BASIN_WALL
    rim, floor = BASIN_FLOOR + BASIN_DEPTH, BASIN_FLOOR
    foot = floor - 0.09
    # (half side, height, corner radius) from the foot, outside upwards, over the rim and down inside.
    section = [(inner + wall - 0.055, foot, 0.03), (inner + wall - 0.045, foot + 0.008, 0.035), (inner + wall - 0.040, foot + 0.05, 0.035),
               (inner + wall - 0.020, foot + 0.16, 0.04), (inner + wall - 0.012, rim - 0.085, 0.04), (inner + wall - 0.012, rim - 0.080, 0.04),
               (inner + wall + 0.004, rim - 0.066, 0.045), (inner + wall + 0.008, rim - 0.055, 0.045), (inner + wall + 0.008, rim - 0.014, 0.045),
               (inner + wall - 0.002, rim - 0.002, 0.04), (inner + wall - 0.012, rim, 0.04), (inner + 0.010, rim, 0.03), (inner + 0.002, rim - 0.004, 0.025),
               (inner, rim - 0.014, 0.02), (inner, rim - 0.12, 0.02), (inner, floor + 0.12, 0.02), (inner, floor + 0.012, 0.02), (inner - 0.012, floor, 0.012)]
    rng = np.random.default_rng(81)
    segments = 9
    rings, travelled, run = [], [], 0.0
    for i, (half, y, corner) in enumerate(section):
        outline = []
        for cx, cz, start in ((1, 1, 0), (-1, 1, 90), (-1, -1, 180), (1, -1, 270)):
            for a in np.radians(start + np.linspace(0, 90, 5)):
                outline.append((cx * (half - corner) + corner * math.cos(a), cz * (half - corner) + corner * math.sin(a)))
        dense = []
        for k, (x, z) in enumerate(outline):
            nx, nz = outline[(k + 1) % len(outline)]
            pieces = segments if math.hypot(nx - x, nz - z) > 0.2 else 1
            dense += [(mix(x, nx, t / pieces), mix(z, nz, t / pieces)) for t in range(pieces)]
        rough = 0.0012 if 2 < i < len(section) - 2 else 0.0004
        # Clockwise seen from above, so that rings going up face outwards.
        rings.append([(BASIN_X + x + rng.normal(0, rough), y + rng.normal(0, rough * 0.4), -z + rng.normal(0, rough)) for x, z in dense])
        if i:
            run += math.hypot(half - section[i - 1][0], y - section[i - 1][1])
        travelled.append(run)
    around = [0.0]
    wide = [(x, z) for x, _, z in rings[8]]
    for k in range(len(wide)):
        nx, nz = wide[(k + 1) % len(wide)]
        around.append(around[-1] + math.hypot(nx - wide[k][0], nz - wide[k][1]))
    shape = Shape().loft(rings, lambda i, j: (around[j] / 1.1, travelled[i] / 1.1), cap_scale=0.9, cap_uv=(0.3, 0.3))
    for k, z in enumerate((-0.19, 0.19)):
        block(shape, (BASIN_X - 0.27, -0.04, z - 0.09), (BASIN_X + 0.27, foot + 0.004, z + 0.09), 0.012, 20 + k, 0.004)
    model.add("visual_basin", shape, ["limestone"], scene, 32)


def bank_height(x, z):
    """Height of the ground. The near bank falls to the river under the barrel's foot; the far bank rises again."""
    wobble = 0.05 * math.sin(1.7 * z + 0.4) + 0.03 * math.sin(4.1 * z)
    level = 0.014 * math.sin(2.3 * x + 1.1) * math.sin(1.9 * z) + 0.008 * math.sin(7.1 * x + 2) * math.sin(6.3 * z + 1)
    away = max(0.0, (abs(z) - 1.0)) * 0.06
    near = 1 / (1 + math.exp((x + 0.70 + wobble * 0.4) / 0.07))
    far = 1 / (1 + math.exp((x + 2.55 + wobble * 1.5) / 0.10))
    height = mix(level + away, -0.46 + 2 * level, near)
    return mix(height, 0.05 + 1.5 * level, far)


def make_ground(model, scene):
    xs = np.concatenate([np.linspace(GROUND_X[0], -1.0, 34)[:-1], np.linspace(-1.0, -0.3, 24)[:-1], np.linspace(-0.3, GROUND_X[1], 46)])
    zs = np.linspace(GROUND_Z[0], GROUND_Z[1], 64)
    rng = np.random.default_rng(91)
    grid = [[(x, bank_height(x, z) + rng.normal(0, 0.0025), z) for z in zs] for x in xs]
    tile = 1.5
    shape, index = earth(grid, tile, 0.6)
    # The cut sides of the model's base.
    bottom = -0.62
    edge = rim(grid)
    top = [index[i][j] for i, j in edge]
    low = shape.points([(grid[i][j][0], bottom, grid[i][j][2]) for i, j in edge])
    run = 0.0
    for k in range(len(edge)):
        n = (k + 1) % len(edge)
        p, q = shape.vertices[top[k]], shape.vertices[top[n]]
        nxt = run + math.hypot(q[0] - p[0], q[2] - p[2])
        shape.face((top[k], top[n], low[n], low[k]),
                   ((run / tile, p[1] / tile), (nxt / tile, q[1] / tile), (nxt / tile, bottom / tile), (run / tile, bottom / tile)))
        run = nxt
    model.add("visual_ground", shape, ["earth"], scene, 40)


def make_quay(model, scene):
    """Two courses of dressed stone hold the bank on both sides of the barrel, and a sloping sill lies under it."""
    rng = np.random.default_rng(101)
    shape = Shape()
    seed = 40
    for side in (-1, 1):
        for course, (low, high, front) in enumerate(((-0.50, -0.19, -0.70), (-0.19, 0.055, -0.67))):
            z = 0.27 + 0.02 * course
            while z < 2.29:
                length = min(rng.uniform(0.34, 0.62), 2.29 - z)
                if 2.29 - z - length < 0.2:
                    length = 2.29 - z
                a, b = sorted((side * z, side * (z + length - 0.006)))
                jut, rise = rng.uniform(-0.012, 0.012), rng.uniform(-0.012, 0.008) if course else 0.0
                block(shape, (front + jut, low, a), (-0.36 + rng.uniform(-0.03, 0.03), high + rise, b), 0.016, seed, 0.005)
                seed += 1
                z += length
    model.add("visual_quay", shape, ["limestone"], scene, 42)
    sill = Shape()
    for k in range(3):
        s = -0.66 - 0.20 * k
        for half in (-1, 1):
            p = world_from_body((-0.262 - 0.012 * k, 0.0, s))
            block(sill, (p[0] - 0.12, p[1] - 0.16, min(0.005 * half, 0.262 * half)), (p[0] + 0.10, p[1] + 0.035, max(0.005 * half, 0.262 * half)), 0.016,
                  70 + 2 * k + half, 0.005)
    model.add("visual_sill", sill, ["limestone"], scene, 42)


def make_amphora(model, scene, name, x, z, lean, turn):
    outline = [(0.0, 0.0), (0.022, 0.003), (0.030, 0.02), (0.040, 0.05), (0.075, 0.12), (0.112, 0.22), (0.130, 0.31), (0.128, 0.37), (0.105, 0.43),
               (0.070, 0.465), (0.047, 0.49), (0.041, 0.53), (0.041, 0.58), (0.048, 0.60), (0.058, 0.607), (0.060, 0.618), (0.057, 0.628), (0.047, 0.63),
               (0.036, 0.622), (0.033, 0.58), (0.033, 0.53), (0.0, 0.50)]
    base = np.array([x, -0.015, z])
    axis = np.array([math.sin(lean) * math.cos(turn), math.cos(lean), math.sin(lean) * math.sin(turn)])
    shape = lathe(Shape(), outline, 40, base, axis, (0, 0, 1))
    side, _, w = frame_of(axis, (0, 0, 1))
    for s in (-1, 1):
        path = [base + w * h + side * s * r for r, h in ((0.040, 0.585), (0.075, 0.592), (0.098, 0.575), (0.107, 0.535), (0.108, 0.48), (0.098, 0.425))]
        fine = []
        for k in range(len(path) - 1):
            fine += [mix(path[k], path[k + 1], t / 3) for t in range(3)]
        tube(shape, fine + [path[-1]], 0.0115, 8)
    model.add(f"visual_{name}", shape, ["terracotta"], scene, 40)


def make_plants(model, scene):
    rng = np.random.default_rng(111)
    for name, count, place, height, leaves in (("reeds", 34, "water", (0.35, 0.85), 6), ("grass", 190, "land", (0.05, 0.15), 7)):
        shape = Shape()
        made = 0
        while made < count:
            if place == "water":
                x, z = rng.uniform(-2.75, -2.25), rng.uniform(-2.2, 2.2)
                if rng.random() < 0.35:
                    x, z = rng.uniform(-1.0, -0.78), rng.choice([-1, 1]) * rng.uniform(1.2, 2.2)
            else:
                x, z = rng.uniform(*GROUND_X) * 0.98, rng.uniform(*GROUND_Z) * 0.98
                worked = abs(z) < 0.75 and -0.75 < x < 2.0
                if worked and rng.random() < 0.93 or -2.6 < x < -0.30:
                    continue
            made += 1
            for _ in range(leaves):
                a, lean = rng.uniform(0, 2 * math.pi), rng.uniform(0.05, 0.5)
                h, w = rng.uniform(*height), 0.0055 if place == "water" else 0.003
                ox, oz = x + rng.normal(0, 0.03), z + rng.normal(0, 0.03)
                base = np.array([ox, bank_height(ox, oz) - 0.01, oz])
                out, across = np.array([math.cos(a), 0, math.sin(a)]), np.array([-math.sin(a), 0, math.cos(a)])
                spine = [base + np.array([0, h * t, 0]) * (1 - 0.25 * lean * t) + out * (h * lean * t * t) for t in (0, 0.35, 0.7, 1.0)]
                widths = (w, w * 0.9, w * 0.6, 0)
                points = []
                for p, half in zip(spine[:3], widths):
                    points += [p - across * half, p + across * half]
                i = shape.points(points + [spine[3]])
                slot = int(rng.random() < (0.25 if place == "water" else 0.6))
                uv = (0.5, 0.5)
                shape.face((i[0], i[1], i[3], i[2]), (uv,) * 4, slot)
                shape.face((i[2], i[3], i[5], i[4]), (uv,) * 4, slot)
                shape.face((i[4], i[5], i[6]), (uv,) * 3, slot)
        model.add(f"visual_{name}", shape, ["reed", "straw"], scene, 60)


def make_pebbles(model, scene):
    rng = np.random.default_rng(121)
    shape = Shape()
    made = 0
    while made < 130:
        x, z = rng.uniform(-1.7, 2.5), rng.uniform(-2.2, 2.2)
        if x < -0.75 and rng.random() < 0.4 or -0.75 < x < -0.33 or (x > -0.33 and rng.random() < 0.45):
            continue
        made += 1
        size = rng.uniform(0.008, 0.030) * (1.8 if x < -0.7 else 1.0)
        stretch, turn = rng.uniform(0.6, 1.3, 3) * (1, 0.55, 1), rng.uniform(0, math.pi)
        rings = []
        for lat in np.radians((-60, -25, 10, 45, 75)):
            ring = []
            for lon in np.arange(9) * 2 * math.pi / 9:
                d = np.array([math.cos(lat) * math.cos(lon), math.sin(lat), -math.cos(lat) * math.sin(lon)]) * stretch
                d *= size * (1 + 0.16 * math.sin(3 * lon + 5 * turn) * math.cos(lat) + rng.normal(0, 0.04))
                c, s = math.cos(turn), math.sin(turn)
                ring.append((x + c * d[0] + s * d[2], bank_height(x, z) + d[1] + size * 0.12, z - s * d[0] + c * d[2]))
            rings.append(ring)
        u, v = rng.random(2)
        shape.loft(rings, lambda i, j: (u + j / 9 * size * 4, v + i * size), cap_scale=1.0, cap_uv=(u, v))
    model.add("visual_pebbles", shape, ["limestone"], scene, 70)


def make_water(model):
    inner = BASIN_SIDE / 2 - 0.001
    for name, x0, x1, z0, z1, y, cells in (("WATER_BASIN", BASIN_X - inner, BASIN_X + inner, -inner, inner, BASIN_FLOOR + 0.001, 8),
                                           ("WATER_RIVER", -2.75, -0.40, GROUND_Z[0] + 0.005, GROUND_Z[1] - 0.005, RIVER_LEVEL, 24)):
        shape = Shape()
        xs, zs = np.linspace(x0, x1, cells + 1), np.linspace(z0, z1, cells + 1)
        index = [shape.points([(x, y, z) for z in zs]) for x in xs]
        for i in range(cells):
            for j in range(cells):
                quad = ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))
                shape.face(tuple(index[a][b] for a, b in quad), tuple((xs[a], zs[b]) for a, b in quad))
        model.add(name, shape, ["water"])


def main():
    path = os.path.abspath(sys.argv[sys.argv.index("--") + 1])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with tempfile.TemporaryDirectory() as folder:
        model = Model(make_materials(Textures(folder)))
        outer, inner, scene = model.group("OUTER"), model.group("INNER"), model.group("SCENE")
        make_barrel(model, outer)
        make_hoops(model, outer)
        make_footstep(model, outer)
        make_core(model, inner)
        make_blades(model, inner)
        make_crank(model, inner)
        trestle(model, scene, "lower_trestle", -0.12, 0.75, 1)
        trestle(model, scene, "upper_trestle", 0.78, 1.25, 3)
        make_basin(model, scene)
        make_ground(model, scene)
        make_quay(model, scene)
        make_amphora(model, scene, "amphora_1", 1.79, 0.20, 0.26, math.pi)
        make_amphora(model, scene, "amphora_2", 1.80, -0.12, 0.23, 3.3)
        make_plants(model, scene)
        make_pebbles(model, scene)
        make_water(model)
        export(path)


main()
