"""`gallery`: a closed dark room of four alcoves over a polished floor, lit by nothing but emissive strips and one
glowing picture.

The strips of the alcoves are 4, 2, 1 and 0.5 voxels wide in a grid of 128 voxels a side round the scene (a cube whose
side is the longest edge times 1 + 2/128). Each sends out the same flux, so that what a method loses with the width
shows at once.
"""

import math

from . import atrium_furnishing, shapes, textures
from .gltf import Gltf
from .surface import Surface
from .vector import about_axis, looking_along

_HALF_X, _HEIGHT, _HALF_Z, _WALL = 5.8, 3.8, 3.6, 0.2  # the inner faces; walls, floor and ceiling are 0.2 m thick
_VOXEL = 2 * (_HALF_X + _WALL) * (1 + 2 / 128) / 128
_STRIPS = ((4.0, (1.0, 0.62, 0.30)), (2.0, (0.28, 0.62, 1.0)), (1.0, (1.0, 0.24, 0.34)), (0.5, (0.42, 1.0, 0.52)))
_WIDEST_RADIANCE = 8.0  # of the strip of four voxels
_ALCOVE, _FIN, _FIN_DEPTH = 2.9, 0.2, 1.3
_EYE, _TARGET, _VFOV = (3.3, 1.75, 3.3), (-1.3, 1.3, -2.6), 60.0


def _room():
    """{walls, floor, ceiling}: slabs that close on each other."""
    x, z, w = _HALF_X, _HALF_Z, _WALL
    walls = Surface()
    for sign in (-1, 1):
        walls.append(shapes.box((2 * (x + w), _HEIGHT, w), (0, _HEIGHT / 2, sign * (z + w / 2)), without="-y+y"))
        walls.append(shapes.box((w, _HEIGHT, 2 * z), (sign * (x + w / 2), _HEIGHT / 2, 0), without="-y+y-z+z"))
    for k in (-1, 0, 1):
        walls.append(shapes.box((_FIN, _HEIGHT, _FIN_DEPTH), (k * _ALCOVE, _HEIGHT / 2, -z + _FIN_DEPTH / 2),
                                without="-y+y-z"))
    slab = (2 * (x + w), w, 2 * (z + w))
    return {"wall": walls, "floor": shapes.box(slab, (0, -w / 2, 0)),
            "ceiling": shapes.box(slab, (0, _HEIGHT + w / 2, 0))}


def _picture_frame(width, height):
    """(canvas, frame) against a wall at z = 0, the canvas's middle at the origin."""
    canvas = Surface()
    corners = ((-width / 2, -height / 2, 0.03), (width / 2, -height / 2, 0.03), (width / 2, height / 2, 0.03),
               (-width / 2, height / 2, 0.03))
    canvas.quad(corners, (0.0, 0.0, 1.0))
    frame, edge = Surface(), 0.09
    for sign in (-1, 1):
        frame.append(shapes.box((width + 2 * edge, edge, 0.07), (0, sign * (height + edge) / 2, 0.035), without="-z"))
        frame.append(shapes.box((edge, height, 0.07), (sign * (width + edge) / 2, 0, 0.035), without="-z-y+y"))
    return canvas, frame


def knot(radius, thickness, segments, sides):
    """A trefoil knot about the origin."""
    def centre(t):
        reach = 2.0 + math.cos(3 * t)
        return (radius / 3 * reach * math.cos(2 * t), radius / 3 * math.sin(3 * t),
                radius / 3 * reach * math.sin(2 * t))

    def position_at(u, v):
        t, a = 2 * math.pi * u, 2 * math.pi * v
        c, ahead = centre(t), centre(t + 1e-3)
        way = [q - p for p, q in zip(c, ahead)]
        size = math.sqrt(sum(w * w for w in way))
        way = [w / size for w in way]
        flat = math.hypot(way[0], way[2])
        side = (way[2] / flat, 0.0, -way[0] / flat)
        top = (-way[1] * way[0] / flat, flat, -way[1] * way[2] / flat)
        return tuple(p + thickness * (math.cos(a) * s + math.sin(a) * t) for p, s, t in zip(c, side, top))

    return shapes.sheet(segments, sides, position_at, lambda u, v: (16 * u, v))


def gallery():
    gltf = Gltf("gallery",
                "A closed dark room of four alcoves over a polished floor; emissive strips 4, 2, 1 and 0.5 voxels wide "
                "at 128 voxels a side, and a glowing picture. No other light.")
    material = {
        "wall": gltf.material("wall", (0.52, 0.50, 0.47), roughness=0.95),
        "ceiling": gltf.material("ceiling", (0.60, 0.60, 0.60), roughness=1.0),
        "floor": gltf.material("floor", (0.09, 0.085, 0.08), roughness=0.16),
        "pedestal": gltf.material("pedestal", (0.62, 0.62, 0.60), roughness=0.8),
        "frame": gltf.material("frame", (0.83, 0.62, 0.28), metallic=1.0, roughness=0.35),
        "chrome": gltf.material("chrome", (0.90, 0.90, 0.91), metallic=1.0, roughness=0.08),
        "copper": gltf.material("copper", (0.93, 0.58, 0.44), metallic=1.0, roughness=0.28),
        "lacquer": gltf.material("lacquer", (0.35, 0.025, 0.02), roughness=0.12),
        "porcelain": gltf.material("porcelain", (0.72, 0.74, 0.76), roughness=0.3),
        "canvas": gltf.material("canvas", roughness=0.9, colour_texture=gltf.texture(
            "gallery/canvas.png", textures.canvas(192, 128), clamp=True)),
        "glow": gltf.material("glowing_picture", (0.02, 0.02, 0.02), roughness=0.4, emission=(2.4, 2.4, 2.4),
                              emission_texture=gltf.texture(
                                  "gallery/glow.png", textures.stained_glass(192, 128), clamp=True)),
    }
    for key, surface in _room().items():
        gltf.node(key, mesh=gltf.mesh(key, [(surface, material[key])]))

    for k, (voxels, colour) in enumerate(_STRIPS):
        width, middle = voxels * _VOXEL, (k - 1.5) * _ALCOVE
        radiance = tuple(c * _WIDEST_RADIANCE * 4.0 / voxels for c in colour)
        name = "strip_%g_voxels" % voxels
        glow = gltf.material(name, (0.05, 0.05, 0.05), emission=radiance)
        strip = shapes.box((width, 2.8, 0.03), (0, 1.9, 0.015), without="-z")
        gltf.node(name, mesh=gltf.mesh(name, [(strip, glow)]), translation=(middle - 0.55, 0, -_HALF_Z))

    plinth = shapes.box((0.6, 1.0, 0.6), (0, 0.5, 0)).append(shapes.box((0.7, 0.06, 0.7), (0, 0.03, 0)))
    pedestal = gltf.mesh("pedestal", [(plinth, material["pedestal"])])
    exhibits = (("ball", shapes.ball(0.36, 40, 24), "chrome", 1.36),
                ("knot", knot(0.42, 0.10, 120, 14), "copper", 1.42),
                ("vase", atrium_furnishing.vase(), "porcelain", 1.0),
                ("sphere", atrium_furnishing.armillary_sphere(), "lacquer", 1.56))
    for k, (name, surface, key, height) in enumerate(exhibits):
        x, z = (k - 1.5) * _ALCOVE + 0.5, -2.0
        gltf.node("pedestal", mesh=pedestal, translation=(x, 0, z))
        gltf.node(name, mesh=gltf.mesh(name, [(surface, material[key])]), translation=(x, height, z),
                  rotation=about_axis((0, 1, 0), 30.0 * k))
    cube = gltf.mesh("lacquer_cube", [(shapes.box((0.7, 0.7, 0.7), (0, 0.35, 0)), material["lacquer"])])
    gltf.node("lacquer_cube", mesh=cube, translation=(-2.6, 0, 0.5), rotation=about_axis((0, 1, 0), 28.0))

    canvas, frame = _picture_frame(2.4, 1.6)
    for name, key, x, turn in (("picture", "canvas", _HALF_X, -90.0), ("glowing_picture", "glow", -_HALF_X, 90.0)):
        gltf.node(name, mesh=gltf.mesh(name, [(canvas, material[key]), (frame, material["frame"])]),
                  translation=(x, 1.9, 0.8), rotation=about_axis((0, 1, 0), turn))

    gltf.camera("toward the alcoves", _EYE, looking_along(tuple(t - e for t, e in zip(_TARGET, _EYE))), _VFOV, 16 / 9)
    return gltf
