"""`animated`: a knot that turns as it flies a figure of eight among columns, before coloured walls, under a spot. One
loop takes four seconds."""

import math

from . import shapes
from .gallery import knot
from .gltf import Gltf
from .vector import about_axis, looking_along

_HALF, _HEIGHT = 5.0, 6.0
_LOOP, _KEYS = 4.0, 24
_LIGHT, _AIM = (3.2, 8.2, 6.4), (-0.4, 0.8, -0.8)
_EYE, _TARGET, _VFOV = (0.6, 3.0, 9.2), (0.0, 1.75, 0.0), 42.0


def _column():
    """A plain round column, 3.4 m high."""
    profile = [[(0.34, 0.0), (0.34, 0.12)], [(0.34, 0.12), (0.30, 0.12)], shapes.arc((0.27, 0.18), 0.06, -80, 90, 4),
               [(0.24, 0.24), (0.235, 1.4), (0.20, 3.05)], [(0.20, 3.05), (0.22, 3.12), (0.30, 3.22)],
               [(0.30, 3.22), (0.34, 3.24)], [(0.34, 3.24), (0.34, 3.40)], [(0.34, 3.40), (0.0, 3.40)]]
    return shapes.turned(profile, 28)


def _place(share):
    """Where the knot is at a share of the loop: a figure of eight round the two front columns, rising a little at
    its ends."""
    t = 2 * math.pi * share
    return (3.1 * math.sin(t), 1.35 - 0.25 * math.cos(2 * t), 0.2 + 1.75 * math.sin(2 * t))


def animated():
    gltf = Gltf("animated",
                "A knot that turns as it flies a figure of eight among columns, before coloured walls; one spot; "
                "a loop of four seconds.")
    material = {
        "floor": gltf.material("floor", (0.55, 0.53, 0.50), roughness=0.9),
        "back": gltf.material("back_wall", (0.66, 0.64, 0.60)),
        "left": gltf.material("left_wall", (0.60, 0.14, 0.07)),
        "right": gltf.material("right_wall", (0.08, 0.22, 0.52)),
        "column": gltf.material("column", (0.68, 0.66, 0.62), roughness=0.9),
        "knot": gltf.material("knot", (0.86, 0.60, 0.14), roughness=0.35),
    }
    h = _HALF
    floor = shapes.floor(-h, h, -h, h, 0.0)
    back, left, right = (shapes.panel(2 * h, _HEIGHT) for _ in range(3))
    gltf.node("floor", mesh=gltf.mesh("floor", [(floor, material["floor"])]))
    gltf.node("back_wall", mesh=gltf.mesh("back_wall", [(back, material["back"])]), translation=(0, 0, -h))
    gltf.node("left_wall", mesh=gltf.mesh("left_wall", [(left, material["left"])]), translation=(-h, 0, 0),
              rotation=about_axis((0, 1, 0), 90))
    gltf.node("right_wall", mesh=gltf.mesh("right_wall", [(right, material["right"])]), translation=(h, 0, 0),
              rotation=about_axis((0, 1, 0), -90))
    column = gltf.mesh("column", [(_column(), material["column"])])
    for x, z in ((-2.1, 0.2), (2.1, 0.2), (0.0, -2.6), (-3.6, -3.2), (3.6, -3.2)):
        gltf.node("column", mesh=column, translation=(x, 0, z))

    flyer = gltf.node("knot", mesh=gltf.mesh("knot", [(knot(0.5, 0.13, 144, 16), material["knot"])]),
                      translation=_place(0.0), rotation=(0.0, 0.0, 0.0, 1.0))
    times = [_LOOP * k / _KEYS for k in range(_KEYS + 1)]
    gltf.animate(flyer, "translation", times, [_place(k / _KEYS) for k in range(_KEYS + 1)])
    gltf.animate(flyer, "rotation", times, [about_axis((0.48, 0.6, 0.64), 360.0 * k / _KEYS) for k in range(_KEYS + 1)])

    gltf.spot("spot", _LIGHT, looking_along(tuple(a - l for a, l in zip(_AIM, _LIGHT))), 400.0, 24.0, 36.0)
    gltf.camera("from the open side", _EYE, looking_along(tuple(t - e for t, e in zip(_TARGET, _EYE))), _VFOV, 16 / 9)
    return gltf
