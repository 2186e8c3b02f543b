"""`strip_room` and `strip`: a closed grey room, and an emissive strip one metre wide to hang in it. Shots scale the strip
to 4, 2, 1 and 0.5 voxels of a grid of 128 voxels a side round the room, so that each width is alone with its error.
"""

from .gltf import Gltf
from .surface import Surface

_X, _HEIGHT, _Z = 3.0, 3.0, 2.0  # half the room's length, its height, half its depth
_STRIP_HEIGHT, _RADIANCE = 2.0, (10.0, 10.0, 10.0)


def _inward(axis, sign):
    """One side of the room, facing in."""
    low, high = (-_X, 0.0, -_Z), (_X, _HEIGHT, _Z)
    u, v = (axis + 1) % 3, (axis + 2) % 3
    corners = []
    for at_u, at_v in ((low[u], low[v]), (high[u], low[v]), (high[u], high[v]), (low[u], high[v])):
        corner = [0.0, 0.0, 0.0]
        corner[axis], corner[u], corner[v] = (high if sign > 0 else low)[axis], at_u, at_v
        corners.append(tuple(corner))
    surface = Surface(has_uv=False)
    surface.quad(corners, tuple(-float(sign) if k == axis else 0.0 for k in range(3)))
    return surface


def strip_room():
    gltf = Gltf("strip_room", "A closed grey room, 6 m long, 3 m high, 4 m deep, without light.")
    wall = gltf.material("wall", (0.6, 0.6, 0.6), roughness=1.0)
    floor = gltf.material("floor", (0.4, 0.4, 0.4), roughness=1.0)
    for name, axis, sign in (("left", 0, -1), ("right", 0, 1), ("floor", 1, -1), ("ceiling", 1, 1), ("back", 2, -1),
                             ("front", 2, 1)):
        gltf.node(name, mesh=gltf.mesh(name, [(_inward(axis, sign), floor if name == "floor" else wall)]))
    return gltf


def strip():
    gltf = Gltf("strip", "An emissive upright strip, 1 m wide and 2 m high, that faces +z.")
    glow = gltf.material("glow", (0.0, 0.0, 0.0), emission=_RADIANCE)
    surface = Surface(has_uv=False)
    surface.quad(((-0.5, 0, 0), (0.5, 0, 0), (0.5, _STRIP_HEIGHT, 0), (-0.5, _STRIP_HEIGHT, 0)), (0.0, 0.0, 1.0))
    gltf.node("strip", mesh=gltf.mesh("strip", [(surface, glow)]))
    return gltf
