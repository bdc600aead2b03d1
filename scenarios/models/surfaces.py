"""Textures and materials of the museum's models: wood, stone, earth, bronze, iron, rope, baked from noise of fixed seeds."""
import math
import os

import bpy
import numpy as np

TEXTURE = 1024


def noise(shape, cells, rng):
    """Smooth random values in 0..1 on a grid of `cells`, periodic both ways."""
    lattice = rng.random(cells)
    result = np.zeros(shape)
    places = []
    for size, count in zip(shape, cells):
        at = np.arange(size) * count / size
        low = np.floor(at).astype(int)
        f = at - low
        places.append((low % count, (low + 1) % count, f * f * (3 - 2 * f)))
    (y0, y1, fy), (x0, x1, fx) = places
    fy = fy[:, None]
    result = (lattice[np.ix_(y0, x0)] * (1 - fx) + lattice[np.ix_(y0, x1)] * fx) * (1 - fy)
    result += (lattice[np.ix_(y1, x0)] * (1 - fx) + lattice[np.ix_(y1, x1)] * fx) * fy
    return result


def fractal(shape, cells, rng, octaves=5, gain=0.5):
    total, weight, amplitude = np.zeros(shape), 0.0, 1.0
    for octave in range(octaves):
        count = tuple(min(c * 2**octave, s) for c, s in zip(cells, shape))
        total += amplitude * noise(shape, count, rng)
        weight += amplitude
        amplitude *= gain
    return total / weight


def mix(a, b, t):
    return a + (b - a) * t


def step(low, high, x):
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def tint(a, b, t):
    return mix(np.array(a)[None, None, :], np.array(b)[None, None, :], t[..., None])


def normal_map(height, strength):
    """Tangent-space normals of a periodic height, green towards larger v."""
    du = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) * strength
    dv = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) * strength
    n = np.dstack([-du, -dv, np.ones_like(height)])
    n /= np.linalg.norm(n, axis=2, keepdims=True)
    return n * 0.5 + 0.5


WOOD_STRIPS = 8


def wood_strip(shape, rng, width_m, length_m, ring_m):
    """One plank: (ring darkness, fibre, crack and knot darkness), each 0..1. Rings of a log cut off its middle."""
    rows, columns = shape
    x = (np.arange(columns) / columns - 0.5)[None, :] * width_m
    y = (np.arange(rows) / rows)[:, None] * length_m
    wander = (fractal(shape, (5, 1), rng, 4) - 0.5) * 0.022 + (fractal(shape, (24, 3), rng, 3) - 0.5) * 0.003
    centre, depth = rng.uniform(-0.05, 0.05), rng.uniform(0.012, 0.06)
    radius = np.sqrt((x - centre + wander) ** 2 + depth**2)
    knots = np.zeros(shape)
    for _ in range(rng.integers(1, 4)):
        kx, ky, size = rng.uniform(-0.4, 0.4) * width_m, rng.uniform(0.05, 0.95) * length_m, rng.uniform(0.004, 0.010)
        d2 = ((x - kx) / size) ** 2 + ((y - ky) / (1.8 * size)) ** 2
        radius = radius + 0.012 * np.exp(-d2 / 6)
        knots = np.maximum(knots, np.exp(-d2))
    rings = np.mod(radius / ring_m + (fractal(shape, (30, 2), rng, 2) - 0.5) * 0.4, 1.0)
    late = step(0.25, 0.92, rings) * (1 - step(0.92, 1.0, rings))
    fibre = 0.6 * noise(shape, (14, columns // 2), rng) + 0.4 * noise(shape, (50, columns // 3), rng)
    crack_line = noise(shape, (3, columns // 5), rng) * noise(shape, (7, columns // 3), rng)
    cracks = step(0.74, 0.84, crack_line)
    return late, fibre, np.maximum(cracks, 0.9 * knots)


def wood(seed, light, dark, weathered, weathering, ring_m=0.0042):
    """An atlas of planks side by side, grain along v. Returns colour and height."""
    rng = np.random.default_rng(seed)
    colours, heights = [], []
    columns = TEXTURE // WOOD_STRIPS
    for _ in range(WOOD_STRIPS):
        shape = (TEXTURE, columns)
        late, fibre, marks = wood_strip(shape, rng, 0.075, 2.3, ring_m)
        tone = np.clip(0.62 * late + 0.35 * (fibre - 0.5) + 0.12, 0, 1)
        colour = tint(light, dark, tone)
        grey = weathering * step(0.35, 0.75, fractal(shape, (6, 2), rng, 4)) * (0.65 + 0.35 * fibre)
        colour = mix(colour, np.array(weathered)[None, None, :] * (0.75 + 0.5 * fibre[..., None]), grey[..., None])
        colour *= rng.uniform(0.84, 1.12) * (1 - 0.72 * marks[..., None])
        u = (np.arange(columns) + 0.5) / columns
        edge = 1 - 0.35 * np.maximum(np.exp(-u / 0.05), np.exp(-(1 - u) / 0.05))
        colours.append(colour * edge[None, :, None])
        heights.append(-0.30 * late - 0.45 * (1 - fibre) - 1.3 * marks)
    return np.clip(np.concatenate(colours, 1), 0, 1), np.concatenate(heights, 1)


def stone():
    rng = np.random.default_rng(41)
    shape = (TEXTURE, TEXTURE)
    broad, fine = fractal(shape, (3, 3), rng, 6, 0.55), fractal(shape, (48, 48), rng, 4, 0.6)
    pits = step(0.63, 0.78, fractal(shape, (40, 40), rng, 3)) * step(0.4, 0.6, broad)
    bedding = noise(shape, (26, 2), rng)
    colour = tint((0.50, 0.44, 0.345), (0.33, 0.28, 0.205), np.clip(1.6 * broad - 0.4 + 0.25 * (bedding - 0.5), 0, 1))
    colour *= (0.82 + 0.32 * fine)[..., None] * (1 - 0.5 * pits)[..., None]
    lichen = step(0.60, 0.70, fractal(shape, (9, 9), rng, 5, 0.6)) * 0.45
    colour = mix(colour, np.array([0.30, 0.29, 0.19])[None, None, :], lichen[..., None])
    chisel = np.sin((np.arange(TEXTURE)[:, None] + np.arange(TEXTURE)[None, :]) * 2 * math.pi * 24 / TEXTURE + 6 * broad)
    height = 1.6 * fine + 2.0 * broad - 2.2 * pits + 0.10 * chisel
    return np.clip(colour, 0, 1), height


def ground():
    rng = np.random.default_rng(51)
    shape = (TEXTURE, TEXTURE)
    broad, grit = fractal(shape, (4, 4), rng, 6, 0.55), fractal(shape, (90, 90), rng, 3, 0.7)
    crumbs = fractal(shape, (28, 28), rng, 4, 0.6)
    colour = tint((0.315, 0.235, 0.145), (0.185, 0.13, 0.078), np.clip(1.8 * broad - 0.4, 0, 1))
    colour *= (0.62 + 0.5 * grit + 0.3 * crumbs)[..., None]
    grass = step(0.50, 0.66, fractal(shape, (6, 6), rng, 6, 0.62)) * (0.35 + 0.65 * grit)
    colour = mix(colour, np.array([0.165, 0.185, 0.055])[None, None, :] * (0.6 + 0.9 * grit[..., None]), 0.8 * grass[..., None])
    lie = fractal(shape, (5, 5), rng, 2) > 0.5
    straw = np.where(lie, step(0.78, 0.86, noise(shape, (50, 300), rng)), step(0.78, 0.86, noise(shape, (300, 50), rng)))
    colour = mix(colour, np.array([0.52, 0.43, 0.25])[None, None, :], np.clip(0.35 * straw, 0, 0.5)[..., None])
    return np.clip(colour, 0, 1), 2.4 * crumbs + 1.6 * grit + 0.8 * grass


def bronze():
    rng = np.random.default_rng(61)
    shape = (512, 512)
    broad, fine = fractal(shape, (4, 4), rng, 6, 0.6), fractal(shape, (40, 40), rng, 4, 0.6)
    patina = step(0.54, 0.68, 0.7 * broad + 0.3 * fine)
    colour = tint((0.80, 0.52, 0.24), (0.42, 0.245, 0.115), np.clip(1.7 * broad - 0.4, 0, 1))
    colour = mix(colour, np.array([0.21, 0.27, 0.20])[None, None, :], (0.55 * patina)[..., None])
    rough, metal = np.clip(0.30 + 0.20 * fine + 0.35 * patina, 0, 1), 1 - 0.45 * patina
    return np.clip(colour, 0, 1), np.dstack([np.ones(shape), rough, metal])


def iron():
    """Forged, dark, rusty in blots; with its occlusion, roughness and metal."""
    rng = np.random.default_rng(47)
    shape = (256, 256)
    broad, fine = fractal(shape, (5, 5), rng, 5, 0.6), fractal(shape, (40, 40), rng, 3, 0.6)
    rust = step(0.48, 0.66, 0.6 * broad + 0.4 * fine)
    colour = mix(tint((0.13, 0.125, 0.12), (0.065, 0.06, 0.058), fine), np.array([0.17, 0.075, 0.032])[None, None, :], (0.75 * rust)[..., None])
    orm = np.dstack([np.ones(shape), np.clip(0.42 + 0.4 * rust + 0.1 * fine, 0, 1), 0.85 - 0.7 * rust])
    return np.clip(colour, 0, 1), 1.2 * fine + broad, orm


def rope():
    shape = (256, 256)
    rng = np.random.default_rng(71)
    v, u = np.mgrid[0:256, 0:256] / 256
    strand = np.abs(np.sin(math.pi * (3 * u + 8 * v)))
    fibre = noise(shape, (100, 60), rng)
    colour = tint((0.20, 0.14, 0.075), (0.56, 0.44, 0.27), np.clip(strand * (0.7 + 0.5 * fibre), 0, 1))
    return np.clip(colour, 0, 1), 3.0 * strand + 0.6 * fibre


class Textures:
    """Writes arrays to JPEG files of a temporary folder and gives them to Blender, which copies their bytes into the glb."""

    def __init__(self, folder):
        self.folder = folder

    def image(self, name, rgb, linear=False, quality=86):
        """`rgb` is what the file shall hold for data, and linear light for colour."""
        value = rgb if linear else np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * np.power(np.maximum(rgb, 1e-9), 1 / 2.4) - 0.055)
        height, width, _ = rgb.shape
        made = bpy.data.images.new(name, width, height)
        made.colorspace_settings.name = "Non-Color"  # the numbers go to the file as they are
        made.pixels.foreach_set(np.dstack([value, np.ones((height, width))]).astype(np.float32).ravel())
        scene = bpy.context.scene
        scene.view_settings.view_transform = "Raw"
        scene.render.image_settings.file_format = "JPEG"
        scene.render.image_settings.quality = quality
        path = os.path.join(self.folder, name + ".jpg")
        made.save_render(path, scene=scene)
        bpy.data.images.remove(made)
        loaded = bpy.data.images.load(path)
        loaded.name = name
        loaded.colorspace_settings.name = "Non-Color" if linear else "sRGB"
        return loaded


def material(name, colour=None, normal=None, orm=None, base=(1, 1, 1, 1), roughness=0.7, metallic=0.0, two_sided=False):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.use_backface_culling = not two_sided
    nodes, links = made.node_tree.nodes, made.node_tree.links
    shader = nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = base
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Metallic"].default_value = metallic
    if base[3] < 1:
        shader.inputs["Alpha"].default_value = base[3]
        made.blend_method = "BLEND"

    def texture(image):
        node = nodes.new("ShaderNodeTexImage")
        node.image = image
        return node.outputs["Color"]

    if colour:
        links.new(texture(colour), shader.inputs["Base Color"])
    if normal:
        node = nodes.new("ShaderNodeNormalMap")
        links.new(texture(normal), node.inputs["Color"])
        links.new(node.outputs["Normal"], shader.inputs["Normal"])
    if orm:
        node = nodes.new("ShaderNodeSeparateColor")
        links.new(texture(orm), node.inputs["Color"])
        links.new(node.outputs["Green"], shader.inputs["Roughness"])
        links.new(node.outputs["Blue"], shader.inputs["Metallic"])
    return made


def surface(textures, name, colour, height, strength):
    """Colour and normals as two images."""
    return textures.image(name, colour), textures.image(name + "_normal", normal_map(height, strength), linear=True, quality=82)


def museum_materials(textures):
    """Those that any of the models may use. Blender leaves out of the file what none of its meshes has."""
    barrel = surface(textures, "planks", *wood(11, (0.40, 0.255, 0.135), (0.19, 0.105, 0.048), (0.33, 0.285, 0.235), 0.75), 0.55)
    core = surface(textures, "timber", *wood(21, (0.52, 0.325, 0.155), (0.27, 0.145, 0.060), (0.45, 0.34, 0.22), 0.25, 0.0055), 0.40)
    limestone = surface(textures, "limestone", *stone(), 0.9)
    earth = surface(textures, "earth", *ground(), 0.8)
    bronze_colour, bronze_orm = bronze()
    hemp = surface(textures, "hemp", *rope(), 0.5)
    return {
        "planks": material("planks", *barrel, roughness=0.78),
        "timber": material("timber", *core, roughness=0.62),
        "grip": material("grip", core[0], roughness=0.38),
        "bronze": material("bronze", textures.image("bronze", bronze_colour), None, textures.image("bronze_orm", bronze_orm, linear=True)),
        "limestone": material("limestone", *limestone, roughness=0.85),
        "earth": material("earth", *earth, roughness=0.95),
        "hemp": material("hemp", *hemp, roughness=0.9),
        "terracotta": material("terracotta", base=(0.46, 0.17, 0.075, 1), roughness=0.72),
        "water": material("water", base=(0.045, 0.10, 0.095, 0.72), roughness=0.06, two_sided=True),
    }


def iron_material(textures):
    colour, height, orm = iron()
    return material("iron", *surface(textures, "iron", colour, height, 0.6), textures.image("iron_orm", orm, linear=True))
