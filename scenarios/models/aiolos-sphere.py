"""Models the sphere of Aiolos over its hearth, with a torch and a brazier to light it, and writes aiolos-sphere.glb.

    blender -b --python aiolos-sphere.py -- aiolos-sphere.glb [PICTURES]        (Blender 3.4, with python3-numpy)

With PICTURES, the beginning of a path, it also renders the exhibit cold and burning. Form: Heron, Pneumatica II.11. Metres, glTF's axes
(y up); the visitor looks along -z.

Nodes at the root, all with identity transforms, each body in its own frame; where that frame is at the start is in PLACES:
  HEARTH        stone, its mouth towards the visitor      CAULDRON   with its lid and the two tubes; both in the world's frame
  SPHERE        origin at its middle; turns about x       SHUTTER    origin at the plate's middle; slides along x over the mouth
  TORCH         origin at its grip; its head at z -0.34   TORCH_FLAME  in the torch's frame
  LEDGE, FLOOR  stone, in the world's frame               BRAZIER    origin amid the coals
  FLAMES        origin on the wood                        SCENE      what never moves and is not touched
Children named part_* are touched as well as drawn, and are closed and convex or nearly so; children named visual_* are drawn only.
"""
import math
import os
import sys
import tempfile

import bpy
import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from modelling import Model, Shape, block, export, lathe, paving, picture, timber, to_blender, tube  # noqa: E402
from surfaces import TEXTURE, Textures, fractal, material, mix, museum_materials, noise, step, surface, tint  # noqa: E402

HEARTH_X, HEARTH_Z, BED_Y, MOUTH_TOP, HOB_Y = 0.62, 0.42, 0.40, 0.72, 0.84
MOUTH = 0.18  # half the mouth's width, and half the opening under the cauldron
BOWL, RIM_Y, LID_Y = 0.225, 1.02, 1.09
AXIS_Y, RADIUS, NOZZLE = 1.36, 0.080, 0.100  # the sphere's axis; from it to a nozzle's mouth
TUBE, TUBE_X, TUBE_BEND = 0.013, 0.150, 0.05
SHUTTER_WIDTH, SHUTTER_HEIGHT, SHUTTER_Z, SHUTTER_OPEN = 0.42, 0.36, 0.440, -0.41
LEDGE_X, LEDGE_Y, TORCH_HALF, HEAD_Z = 0.95, 0.82, 0.015, -0.34
BRAZIER_Z = 0.05

PLACES = {
    "SPHERE": (0, AXIS_Y, 0),
    "SHUTTER": (SHUTTER_OPEN, 0.56, SHUTTER_Z),
    "TORCH": (LEDGE_X, LEDGE_Y + TORCH_HALF, 0.40),
    "TORCH_FLAME": (LEDGE_X, LEDGE_Y + TORCH_HALF, 0.40),
    "BRAZIER": (LEDGE_X, 0.79, BRAZIER_Z),
    "FLAMES": (0, 0.47, 0.05),
}


# Materials -----------------------------------------------------------------------------------------------------------------------


def hammered(seed, bright, dull, soot, soot_from):
    """Colour, height, and occlusion-roughness-metal of beaten metal: facets of the hammer, brown where it is handled less, soot in blots."""
    rng = np.random.default_rng(seed)
    shape = (TEXTURE, TEXTURE)
    broad, fine = fractal(shape, (4, 4), rng, 6, 0.55), fractal(shape, (60, 60), rng, 3, 0.6)
    rows, columns = np.mgrid[0:TEXTURE, 0:TEXTURE] / TEXTURE
    nearest = np.full(shape, 9.0)
    for x, y in rng.random((420, 2)):
        dx, dy = np.abs(columns - x), np.abs(rows - y)
        nearest = np.minimum(nearest, np.minimum(dx, 1 - dx) ** 2 + np.minimum(dy, 1 - dy) ** 2)
    dents = np.clip(np.sqrt(nearest) / 0.045, 0, 1)
    tarnish = np.clip(1.8 * broad - 0.5 + 0.25 * dents, 0, 1)
    colour = tint(bright, dull, tarnish) * (0.93 + 0.14 * fine)[..., None]
    dirt = step(soot_from, soot_from + 0.2, 0.7 * broad + 0.3 * fine)
    colour = mix(colour, np.array(soot)[None, None, :] * (0.7 + 0.6 * fine)[..., None], (0.8 * dirt)[..., None])
    roughness = np.clip(0.24 + 0.16 * tarnish + 0.10 * fine + 0.40 * dirt, 0, 1)
    return np.clip(colour, 0, 1), 2.2 * dents**2 + 0.4 * fine, np.dstack([np.ones(shape), roughness, 1 - 0.7 * dirt])


def flame():
    """Light of a flame from its foot (v 0) to its tip (v 1), streaked along."""
    rng = np.random.default_rng(7)
    shape = (256, 256)
    v = np.mgrid[0:256, 0:256][0] / 255 + 0.30 * (noise(shape, (3, 12), rng) - 0.5)
    hot = tint((1.0, 0.62, 0.16), (1.0, 0.24, 0.025), step(0.05, 0.55, v))
    return np.clip(mix(hot, np.array([0.62, 0.055, 0.004])[None, None, :], step(0.5, 1.0, v)[..., None]), 0, 1)


def coals():
    rng = np.random.default_rng(9)
    shape = (256, 256)
    heat = step(0.45, 0.75, fractal(shape, (10, 10), rng, 4, 0.6))
    return np.clip(tint((0.03, 0.025, 0.022), (1.0, 0.22, 0.02), heat), 0, 1)


def glowing(name, image, strength):
    made = material(name, base=(0.02, 0.015, 0.01, 1), roughness=0.95)
    nodes, links = made.node_tree.nodes, made.node_tree.links
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    links.new(texture.outputs["Color"], nodes["Principled BSDF"].inputs["Emission"])
    nodes["Principled BSDF"].inputs["Emission Strength"].default_value = strength
    return made


def make_materials(textures):
    made = museum_materials(textures)
    for name, values in (("copper", (63, (0.90, 0.50, 0.30), (0.52, 0.25, 0.13), (0.10, 0.07, 0.05), 0.66)),
                         ("cauldron", (67, (0.66, 0.40, 0.19), (0.34, 0.19, 0.09), (0.022, 0.019, 0.017), 0.44))):
        colour, height, orm = hammered(*values)
        images = surface(textures, f"aiolos_{name}", colour, height, 0.22)
        made[name] = material(f"aiolos_{name}", *images, textures.image(f"aiolos_{name}_orm", orm[::2, ::2], linear=True))
    made["soot"] = material("soot", base=(0.022, 0.019, 0.017, 1), roughness=0.95)
    made["pitch"] = material("pitch", base=(0.035, 0.022, 0.014, 1), roughness=0.8)
    made["flame"] = glowing("flame", textures.image("flame", flame()), 1.0)
    made["coals"] = glowing("coals", textures.image("coals", coals()), 1.0)
    return made


# Parts ---------------------------------------------------------------------------------------------------------------------------


def make_hearth(model):
    hearth = model.group("HEARTH")
    x, z, m = HEARTH_X, HEARTH_Z, MOUTH

    def stones(name, low, high, seed):
        model.add(f"part_{name}", block(Shape(), low, high, 0.012, seed, 0.003), ["limestone"], hearth, 42)

    stones("base", (-x - 0.04, -0.02, -z - 0.04), (x + 0.04, BED_Y, z - 0.005), 11)
    stones("left", (-x, BED_Y + 0.002, -z), (-m, HOB_Y, z), 12)
    stones("right", (m, BED_Y + 0.002, -z), (x, HOB_Y, z), 13)
    stones("back", (-m + 0.002, BED_Y + 0.002, -z), (m - 0.002, HOB_Y, -m), 14)
    stones("lintel", (-m + 0.002, MOUTH_TOP, m), (m - 0.002, HOB_Y, z), 15)
    lining = Shape()
    e = 0.004
    for a, b, c, d in (((-m + e, BED_Y + e, z - 0.03), (-m + e, HOB_Y - 0.02, z - 0.03), (-m + e, HOB_Y - 0.02, -m), (-m + e, BED_Y + e, -m)),
                       ((m - e, BED_Y + e, -m), (m - e, HOB_Y - 0.02, -m), (m - e, HOB_Y - 0.02, z - 0.03), (m - e, BED_Y + e, z - 0.03)),
                       ((-m, BED_Y + e, -m + e), (-m, HOB_Y - 0.02, -m + e), (m, HOB_Y - 0.02, -m + e), (m, BED_Y + e, -m + e))):
        corners = lining.points([a, b, c, d])
        lining.face(tuple(reversed(corners)), ((0, 0), (0, 1), (1, 1), (1, 0)))
    bed = lining.points([(-m, BED_Y + e, -m), (-m, BED_Y + e, z - 0.03), (m, BED_Y + e, z - 0.03), (m, BED_Y + e, -m)])
    lining.face(tuple(bed), ((0, 0), (0, 1), (1, 1), (1, 0)))
    model.add("visual_lining", lining, ["soot"], hearth)
    shape = Shape()  # the rails that the shutter slides in
    half = SHUTTER_HEIGHT / 2
    for y, lip in ((0.56 + half + 0.010, -1), (0.56 - half - 0.010, 1)):
        low, high = -x + 0.005, m + 0.07
        block(shape, (low, y - 0.012, z - 0.006), (high, y + 0.012, SHUTTER_Z + 0.014), 0.002, 4, 0.0, 0.3)
        block(shape, (low, y - 0.012 + 0.012 * lip, SHUTTER_Z + 0.010), (high, y + 0.012 + 0.012 * lip, SHUTTER_Z + 0.018), 0.002, 5, 0.0, 0.3)
    block(shape, (m + 0.056, 0.56 - half, z - 0.006), (m + 0.068, 0.56 + half, SHUTTER_Z + 0.014), 0.002, 6, 0.0, 0.3)
    model.add("visual_rails", shape, ["bronze"], hearth, 40)


def make_wood(model, scene):
    """Split logs on the hearth's bed, two by two crosswise."""
    rng = np.random.default_rng(17)
    shape = Shape()
    for k, (start, end, r) in enumerate((((-0.15, 0.435, 0.27), (0.15, 0.435, 0.25), 0.034), ((-0.15, 0.435, -0.04), (0.15, 0.435, -0.06), 0.034),
                                         ((-0.10, 0.495, 0.33), (-0.08, 0.500, -0.13), 0.036), ((0.02, 0.497, 0.34), (0.00, 0.495, -0.14), 0.032),
                                         ((0.11, 0.495, 0.31), (0.09, 0.497, -0.12), 0.035), ((-0.12, 0.555, 0.20), (0.13, 0.558, 0.17), 0.028))):
        start, end = np.array(start), np.array(end)
        length = np.linalg.norm(end - start)
        profile = [(0.0, 0.0), (r * 0.93, 0.0), (r, 0.006), (r * 1.03, length * 0.4), (r * 0.97, length * 0.7), (r * 0.94, length - 0.006), (r * 0.86, length), (0.0, length)]
        lathe(shape, profile, 11, start, end - start, (0, 1, 0), uv_scale=(0.115, 0.6), uv_offset=(0.01 + 0.125 * k, rng.uniform(0, 1)), end_grain=(0, 6))
    model.add("visual_wood", shape, ["planks"], scene, 40)


def bend(centre, start, stop, radius, plane, count=9):
    """Points of an arc about `centre`, in the plane of the two unit vectors."""
    u, v = (np.asarray(p, float) for p in plane)
    return [np.asarray(centre) + radius * (u * math.cos(a) + v * math.sin(a)) for a in np.linspace(start, stop, count)]


def make_cauldron(model):
    cauldron = model.group("CAULDRON")
    bowl = [(0.0, 0.750), (0.07, 0.756), (0.13, 0.778), (0.175, 0.815), (0.205, 0.865), (BOWL, 0.92), (BOWL + 0.002, 0.96), (BOWL - 0.006, 1.00), (BOWL - 0.004, RIM_Y - 0.008),
            (BOWL + 0.012, RIM_Y), (BOWL + 0.012, RIM_Y + 0.008), (0.0, RIM_Y + 0.008)]
    model.add("part_bowl", lathe(Shape(), bowl, 56, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(3, 3)), ["cauldron"], cauldron, 32)
    lid = [(0.0, RIM_Y + 0.009), (BOWL + 0.010, RIM_Y + 0.009), (BOWL + 0.013, RIM_Y + 0.014), (BOWL + 0.010, RIM_Y + 0.021), (0.20, RIM_Y + 0.030), (0.14, RIM_Y + 0.049),
           (0.08, RIM_Y + 0.061), (0.0, RIM_Y + 0.065)]
    model.add("part_lid", lathe(Shape(), lid, 56, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(3, 3), uv_offset=(0.1, 0.3)), ["copper"], cauldron, 32)
    shape = Shape()
    foot = RIM_Y + 0.040
    turn = AXIS_Y - TUBE_BEND
    for s in (-1, 1):
        end = [np.array([s * (RADIUS + 0.004), AXIS_Y, 0])]
        arc = bend((s * (TUBE_X - TUBE_BEND), turn, 0), 0, math.pi / 2, TUBE_BEND, ((s, 0, 0), (0, 1, 0)))
        path = [np.array([s * TUBE_X, foot, 0]), np.array([s * TUBE_X, mix(foot, turn, 0.5), 0])] + arc + end
        tube(shape, path, TUBE, 20, v_scale=5)
        collar = [(0.0, -0.004), (0.034, -0.004), (0.034, 0.006), (0.022, 0.012), (0.019, 0.030), (TUBE, 0.034), (0.0, 0.034)]
        lathe(shape, collar, 24, (s * TUBE_X, foot + 0.001, 0), (0, 1, 0), (0, 0, 1), uv_scale=(1, 5))
        ring = [(0.0, -0.006), (0.017, -0.006), (0.020, -0.003), (0.020, 0.003), (0.017, 0.006), (0.0, 0.006)]
        lathe(shape, ring, 24, (s * (RADIUS + 0.014), AXIS_Y, 0), (1, 0, 0), uv_scale=(1, 5))
    for s in (-1, 1):  # handles on the bowl's shoulders, front and back
        eye = np.array([0, 0.945, s * (BOWL + 0.004)])
        loop = [eye + np.array([0.045 * math.cos(a), -0.040 + 0.045 * math.sin(a), s * (0.014 + 0.010 * math.sin(a))]) for a in np.arange(20) * 2 * math.pi / 20]
        tube(shape, loop, 0.006, 10, closed=True, v_scale=5)
        lathe(shape, [(0.0, -0.010), (0.018, -0.010), (0.016, 0.016), (0.0, 0.020)], 16, eye + np.array([0, 0.005, 0]), (0, 0, s), uv_scale=(0.5, 5))
    rivet = [(0.008, 0.0), (0.0075, 0.003), (0.004, 0.006), (0.0, 0.0065)]
    for k in range(16):
        a = 2 * math.pi * (k + 0.5) / 16
        lathe(shape, rivet, 10, (0.216 * math.cos(a), RIM_Y + 0.026, 0.216 * math.sin(a)), (0, 1, 0), (0, 0, 1), uv_scale=(0.1, 3))
    model.add("visual_tubes", shape, ["bronze"], cauldron, 40)


def make_sphere(model):
    sphere = model.group("SPHERE")
    halves = [(RADIUS * math.sin(a), -RADIUS * math.cos(a)) for a in np.linspace(0, math.pi, 33)]
    halves[0], halves[-1] = (0.0, -RADIUS), (0.0, RADIUS)
    model.add("part_ball", lathe(Shape(), halves, 56, (0, 0, 0), (1, 0, 0), uv_scale=(2, 4)), ["copper"], sphere, 60)
    shape = Shape()
    seam = [(RADIUS - 0.004, -0.006), (RADIUS + 0.0015, -0.006), (RADIUS + 0.003, -0.004), (RADIUS + 0.003, 0.004), (RADIUS + 0.0015, 0.006), (RADIUS - 0.004, 0.006)]
    lathe(shape, seam, 64, (0, 0, 0), (1, 0, 0), uv_scale=(3, 5))
    for s in (-1, 1):
        boss = [(0.0, 0.0), (0.020, 0.0), (0.016, 0.006), (0.011, 0.008), (0.011, 0.018), (0.0, 0.018)]
        lathe(shape, boss, 24, (s * (RADIUS - 0.003), 0, 0), (s, 0, 0), uv_scale=(0.5, 5))
        # A nozzle: out of the ball, then bent along the tangent. The upper one blows to the back, so that the ball turns to the front above.
        up, back = np.array([0, s, 0]), np.array([0, 0, -s])
        arc = bend(up * (NOZZLE - 0.018) + back * 0.018, math.pi, math.pi / 2, 0.018, (back, up), 8)
        path = [up * (RADIUS - 0.010), up * (RADIUS - 0.001)] + arc + [up * NOZZLE + back * 0.050]
        tube(shape, path, lambda t: 0.0085 - 0.0028 * t, 16, v_scale=5)
        lathe(shape, [(0.0, 0.0), (0.018, 0.0), (0.014, 0.006), (0.0, 0.008)], 20, up * (RADIUS - 0.004), up, (1, 0, 0), uv_scale=(0.5, 5))
        bore = [(0.0, 0.0), (0.0030, 0.0), (0.0, 0.0004)]
        lathe(shape, bore, 12, up * NOZZLE + back * 0.0502, back, (1, 0, 0), slots=[1, 1])
    model.add("visual_nozzles", shape, ["bronze", "soot"], sphere, 40)


def make_shutter(model):
    shutter = model.group("SHUTTER")
    w, h = SHUTTER_WIDTH / 2, SHUTTER_HEIGHT / 2
    model.add("part_plate", block(Shape(), (-w, -h, -0.005), (w, h, 0.005), 0.002, 21, 0.0, 0.3), ["cauldron"], shutter, 40)
    grip = [(0.0, -0.075), (0.012, -0.075), (0.015, -0.068), (0.0155, -0.05), (0.017, 0.0), (0.0155, 0.05), (0.015, 0.068), (0.012, 0.075), (0.0, 0.075)]
    model.add("part_grip", lathe(Shape(), grip, 28, (0.12, 0, 0.062), (0, 1, 0), (0, 0, 1), uv_scale=(0.115, 1.2), uv_offset=(0.13, 0.3)), ["grip"], shutter, 45)
    shape = Shape()
    for s in (-1, 1):
        y = s * 0.085
        tube(shape, [np.array([0.12, y + s * 0.008, 0.0]), np.array([0.12, y + s * 0.008, 0.045])] + [np.array([0.12, y + s * 0.004, 0.057]), np.array([0.12, y - s * 0.014, 0.062])], 0.007, 12)
        lathe(shape, [(0.0, 0.004), (0.020, 0.004), (0.018, 0.009), (0.0, 0.010)], 18, (0.12, y + s * 0.008, 0), (0, 0, 1), uv_scale=(0.5, 5))
        block(shape, (-w + 0.02, s * 0.13 - 0.014, 0.004), (w - 0.02, s * 0.13 + 0.014, 0.009), 0.0015, 23 + s, 0.0, 0.3)
        for k in range(6):
            rivet = [(0.007, 0.0), (0.0065, 0.003), (0.0035, 0.005), (0.0, 0.0055)]
            lathe(shape, rivet, 10, (-w + 0.045 + 0.066 * k, s * 0.13, 0.009), (0, 0, 1), uv_scale=(0.1, 3))
    model.add("visual_straps", shape, ["bronze"], shutter, 40)


def flame_tongue(shape, foot, height, radius, lean, seed):
    """A closed tongue of fire: fat below, drawn out and swaying above."""
    rng = np.random.default_rng(300 + seed)
    sway, turn = rng.uniform(0.6, 1.3), rng.uniform(0, 2 * math.pi)
    rings, along = [], np.linspace(0, 1, 12)
    for t in along:
        r = radius * (math.sin(math.pi * (0.16 + 0.84 * t)) ** 0.8) * (1 - 0.55 * t) + 0.0008
        middle = np.asarray(foot) + np.array([lean[0] * t**1.5, height * t, lean[1] * t**1.5])
        middle = middle + radius * 0.5 * t * np.array([math.sin(5 * sway * t + turn), 0, math.cos(4 * sway * t + turn)])
        rings.append([middle + r * (1 + 0.18 * math.sin(3 * a + turn + 4 * t)) * np.array([math.cos(a), 0, -math.sin(a)]) for a in np.arange(12) * 2 * math.pi / 12])
    shape.loft(rings, lambda i, j: (j / 12 + 0.1 * seed, min(0.98, along[i])))


def make_flames(model):
    group = model.group("FLAMES")
    rng = np.random.default_rng(33)
    shape = Shape()
    for k in range(15):
        x, z = rng.uniform(-0.12, 0.12), rng.uniform(-0.12, 0.22)
        height = rng.uniform(0.13, 0.24) * (1 - 1.2 * abs(x))
        flame_tongue(shape, (x, 0.0, z), height, rng.uniform(0.022, 0.036), (-0.3 * x, rng.uniform(-0.03, 0.01)), k)
    model.add("visual_fire", shape, ["flame"], group, 80)
    glow = Shape()
    for k in range(26):
        p = np.array([rng.uniform(-0.14, 0.14), rng.uniform(-0.035, 0.0), rng.uniform(-0.14, 0.24)])
        r = rng.uniform(0.010, 0.018)
        lathe(glow, [(0.0, -r), (0.8 * r, -0.6 * r), (r, 0.1 * r), (0.6 * r, 0.8 * r), (0.0, r)], 7, p, rng.normal(size=3), (0.31, 0.87, 0.38), uv_scale=(1, 12), uv_offset=tuple(rng.random(2)))
    model.add("visual_embers", glow, ["coals"], group, 40)

    group = model.group("TORCH_FLAME")
    shape = Shape()
    for k, (dx, dz, height, r) in enumerate(((0, 0, 0.17, 0.034), (0.018, 0.02, 0.12, 0.024), (-0.018, -0.015, 0.13, 0.024), (0.004, -0.03, 0.10, 0.02))):
        flame_tongue(shape, (dx, -0.005, HEAD_Z + dz), height, r, (0.01, 0.03), 20 + k)
    model.add("visual_fire", shape, ["flame"], group, 80)


def make_torch(model):
    torch = model.group("TORCH")
    handle = timber(Shape(), (0, 0, 0.10), (0, 0, -0.30), 2 * TORCH_HALF, 2 * TORCH_HALF, bevel=0.004, seed=91, rough=0.0004)
    model.add("part_handle", handle, ["timber"], torch, 40)
    head = [(0.0, 0.0), (0.020, 0.0), (0.030, 0.012), (0.034, 0.045), (0.032, 0.085), (0.022, 0.110), (0.0, 0.114)]
    model.add("part_head", lathe(Shape(), head, 28, (0, 0, -0.285), (0, 0, -1), uv_scale=(1, 6)), ["pitch"], torch, 40)
    shape = Shape()
    for start in (-0.290, -0.318, -0.346, -0.374):
        r = 0.029 if start == -0.290 else 0.0345 if start > -0.37 else 0.031
        ring = [np.array([r * math.cos(a), r * math.sin(a), start + 0.012 * a / (2 * math.pi)]) for a in np.linspace(0, 2 * math.pi, 25)]
        tube(shape, ring, 0.005, 8, v_scale=8)
    for z in (0.088, -0.020):
        ring = [np.array([0.019 * math.cos(a), 0.019 * math.sin(a), z]) for a in np.arange(24) * 2 * math.pi / 24]
        tube(shape, ring, 0.003, 8, closed=True, v_scale=8)
    model.add("visual_rope", shape, ["hemp"], torch, 60)


def make_brazier(model):
    brazier = model.group("BRAZIER")
    shape = Shape()
    bowl = [(0.0, -0.085), (0.045, -0.080), (0.078, -0.055), (0.092, -0.020), (0.098, 0.0), (0.104, 0.004), (0.100, 0.008), (0.090, 0.002), (0.082, -0.020), (0.0, -0.030)]
    lathe(shape, bowl, 40, (0, 0, 0), (0, 1, 0), (0, 0, 1), uv_scale=(2, 5))
    for k in range(3):
        a = 2 * math.pi * (k + 0.75) / 3
        out = np.array([math.cos(a), 0, math.sin(a)])
        path = [out * 0.075 + np.array([0, -0.045, 0]), out * 0.10 + np.array([0, -0.16, 0]), out * 0.095 + np.array([0, -0.45, 0]), out * 0.12 + np.array([0, -0.72, 0]),
                out * 0.155 + np.array([0, -0.785, 0])]
        tube(shape, path, 0.010, 10, v_scale=5)
        lathe(shape, [(0.0, 0.0), (0.022, 0.0), (0.018, 0.014), (0.0, 0.018)], 16, out * 0.155 + np.array([0, -0.792, 0]), (0, 1, 0), (0, 0, 1), uv_scale=(0.5, 5))
    brace = [np.array([0.103 * math.cos(a), -0.34, 0.103 * math.sin(a)]) for a in np.arange(32) * 2 * math.pi / 32]
    tube(shape, brace, 0.006, 8, closed=True, v_scale=5)
    model.add("visual_tripod", shape, ["bronze"], brazier, 40)
    rng = np.random.default_rng(41)
    glow, fire = Shape(), Shape()
    for k in range(34):
        a, d = rng.uniform(0, 2 * math.pi), 0.078 * math.sqrt(rng.uniform(0, 1))
        r = rng.uniform(0.011, 0.018)
        p = np.array([d * math.cos(a), -0.012 + rng.uniform(-0.008, 0.010), d * math.sin(a)])
        lathe(glow, [(0.0, -r), (0.8 * r, -0.6 * r), (r, 0.1 * r), (0.6 * r, 0.8 * r), (0.0, r)], 7, p, rng.normal(size=3), (0.31, 0.87, 0.38), uv_scale=(1, 12), uv_offset=tuple(rng.random(2)))
    model.add("visual_coals", glow, ["coals"], brazier, 40)
    for k in range(5):
        a = 2 * math.pi * k / 5
        flame_tongue(fire, (0.045 * math.cos(a), -0.01, 0.045 * math.sin(a)), rng.uniform(0.06, 0.10), 0.018, (0, 0), 40 + k)
    model.add("visual_fire", fire, ["flame"], brazier, 80)


def make_place(model, scene):
    """A ledge for the torch, and flagstones, no two alike."""
    ledge = model.group("LEDGE")
    x = LEDGE_X
    model.add("part_ledge", block(Shape(), (x - 0.17, 0.74, 0.13), (x + 0.17, LEDGE_Y, 0.43), 0.006, 25, 0.0, 1.0), ["limestone"], ledge, 42)
    pillar = Shape()
    block(pillar, (x - 0.12, -0.01, 0.17), (x + 0.12, 0.738, 0.40), 0.012, 26, 0.004)
    block(pillar, (x - 0.16, -0.02, 0.13), (x + 0.16, 0.09, 0.44), 0.014, 27, 0.004)
    model.add("visual_pillar", pillar, ["limestone"], ledge, 42)
    floor = model.group("FLOOR")
    model.add("part_floor", block(Shape(), (-1.54, -0.30, -1.24), (1.72, 0.0, 1.6), 0.01, 28, 0.0, 1.0), ["earth"], floor, 42)
    model.add("visual_flags", paving((-1.55, 1.65), (-1.25, 1.6), 1.74, (0.30, 0.44), (0.36, 0.64), (0.002, 0.007)), ["limestone"], scene, 42)
    bed = Shape()
    corners = bed.points([(-1.65, -0.03, -1.32), (-1.65, -0.03, 1.85), (1.80, -0.03, 1.85), (1.80, -0.03, -1.32)])
    bed.face(tuple(corners), ((0, 0), (0, 1.8), (2, 1.8), (2, 0)))
    model.add("visual_bed", bed, ["earth"], scene)


# The file ------------------------------------------------------------------------------------------------------------------------


def put(moved, hidden):
    """Puts the bodies where they are at the start, but for those moved; hides some: for pictures."""
    for name, place in {**PLACES, **moved}.items():
        bpy.data.objects[name].location = to_blender(place)
    for name in ("FLAMES", "TORCH_FLAME"):
        for child in bpy.data.objects[name].children:
            child.hide_render = name in hidden


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with tempfile.TemporaryDirectory() as folder:
        model = Model(make_materials(Textures(folder)))
        for make in (make_hearth, make_cauldron, make_sphere, make_shutter, make_torch, make_brazier, make_flames):
            make(model)
        scene = model.group("SCENE")
        for make in (make_wood, make_place):
            make(model, scene)
        export(os.path.abspath(arguments[0]))
        if len(arguments) > 1:
            at_wood = (0.0, 0.58, 0.64)
            for name, moved, hidden, eye, look_at in (
                    ("cold", {}, ("FLAMES",), (1.15, 1.75, 2.05), (0.28, 0.80, 0.0)),
                    ("lit", {"TORCH": at_wood, "TORCH_FLAME": at_wood}, (), (0.50, 1.20, 1.55), (0.02, 0.82, 0.05)),
                    ("near", {}, (), (0.35, 1.50, 0.75), (0.0, 1.25, 0)),
                    ("shut", {"SHUTTER": (0, 0.56, SHUTTER_Z)}, ("FLAMES",), (-0.75, 1.15, 1.45), (0.05, 0.70, 0.1))):
                put(moved, hidden)
                picture(os.path.abspath(arguments[1]) + f"-{name}.png", eye, look_at, samples=24)


main()
