"""The measured Cornell box, ten times its size (5.56 m instead of 0.556 m).

Geometry, reflectances, emission and camera: Cornell University Program of Computer Graphics, "Cornell Box Data",
https://www.graphics.cornell.edu/online/box/data.html. The published millimetres are read as centimetres; +Y is up
already. `cornell` has its lamp switched off and a spot in its place; `cornell_lamp` has the lamp on and no other
light.
"""

import math

from . import spectra
from .gltf import Gltf
from .surface import Surface
from .vector import about_axis, looking_along, scale

_METRES = 0.01
_SOURCE = "Measured data: Cornell University Program of Computer Graphics, Cornell Box Data"

# Reflectances from 400 to 700 nm, every 4 nm
_WHITE = (
    0.343, 0.445, 0.551, 0.624, 0.665, 0.687, 0.708, 0.723, 0.715, 0.710, 0.745, 0.758, 0.739, 0.767, 0.777, 0.765,
    0.751, 0.745, 0.748, 0.729, 0.745, 0.757, 0.753, 0.750, 0.746, 0.747, 0.735, 0.732, 0.739, 0.734, 0.725, 0.721,
    0.733, 0.725, 0.732, 0.743, 0.744, 0.748, 0.728, 0.716, 0.733, 0.726, 0.713, 0.740, 0.754, 0.764, 0.752, 0.736,
    0.734, 0.741, 0.740, 0.732, 0.745, 0.755, 0.751, 0.744, 0.731, 0.733, 0.744, 0.731, 0.712, 0.708, 0.729, 0.730,
    0.727, 0.707, 0.703, 0.729, 0.750, 0.760, 0.751, 0.739, 0.724, 0.730, 0.740, 0.737)
_GREEN = (
    0.092, 0.096, 0.098, 0.097, 0.098, 0.095, 0.095, 0.097, 0.095, 0.094, 0.097, 0.098, 0.096, 0.101, 0.103, 0.104,
    0.107, 0.109, 0.112, 0.115, 0.125, 0.140, 0.160, 0.187, 0.229, 0.285, 0.343, 0.390, 0.435, 0.464, 0.472, 0.476,
    0.481, 0.462, 0.447, 0.441, 0.426, 0.406, 0.373, 0.347, 0.337, 0.314, 0.285, 0.277, 0.266, 0.250, 0.230, 0.207,
    0.186, 0.171, 0.160, 0.148, 0.141, 0.136, 0.130, 0.126, 0.123, 0.121, 0.122, 0.119, 0.114, 0.115, 0.117, 0.117,
    0.118, 0.120, 0.122, 0.128, 0.132, 0.139, 0.144, 0.146, 0.150, 0.152, 0.157, 0.159)
_RED = (
    0.040, 0.046, 0.048, 0.053, 0.049, 0.050, 0.053, 0.055, 0.057, 0.056, 0.059, 0.057, 0.061, 0.061, 0.060, 0.062,
    0.062, 0.062, 0.061, 0.062, 0.060, 0.059, 0.057, 0.058, 0.058, 0.058, 0.056, 0.055, 0.056, 0.059, 0.057, 0.055,
    0.059, 0.059, 0.058, 0.059, 0.061, 0.061, 0.063, 0.063, 0.067, 0.068, 0.072, 0.080, 0.090, 0.099, 0.124, 0.154,
    0.192, 0.255, 0.287, 0.349, 0.402, 0.443, 0.487, 0.513, 0.558, 0.584, 0.620, 0.606, 0.609, 0.651, 0.612, 0.610,
    0.650, 0.638, 0.627, 0.620, 0.630, 0.628, 0.642, 0.639, 0.657, 0.639, 0.635, 0.642)
_LAMP_REFLECTANCE = 0.78
_LAMP_EMISSION = ((400, 0.0), (500, 8.0), (600, 15.6), (700, 18.4))

# Every face counter-clockwise as seen from inside the room, or from outside the block
_ROOM = (
    ("floor", "white", ((552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2))),
    ("back_wall", "white", ((549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2))),
    ("right_wall", "green", ((0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2))),
    ("left_wall", "red", ((552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0))),
)
_CEILING = ((556, 548.8, 0), (556, 548.8, 559.2), (0, 548.8, 559.2), (0, 548.8, 0))
_LAMP = ((343, 548.8, 227), (343, 548.8, 332), (213, 548.8, 332), (213, 548.8, 227))
_SHORT_BLOCK = (
    ((130, 165, 65), (82, 165, 225), (240, 165, 272), (290, 165, 114)),
    ((290, 0, 114), (290, 165, 114), (240, 165, 272), (240, 0, 272)),
    ((130, 0, 65), (130, 165, 65), (290, 165, 114), (290, 0, 114)),
    ((82, 0, 225), (82, 165, 225), (130, 165, 65), (130, 0, 65)),
    ((240, 0, 272), (240, 165, 272), (82, 165, 225), (82, 0, 225)),
)
_TALL_BLOCK = (
    ((423, 330, 247), (265, 330, 296), (314, 330, 456), (472, 330, 406)),
    ((423, 0, 247), (423, 330, 247), (472, 330, 406), (472, 0, 406)),
    ((472, 0, 406), (472, 330, 406), (314, 330, 456), (314, 0, 456)),
    ((314, 0, 456), (314, 330, 456), (265, 330, 296), (265, 0, 296)),
    ((265, 0, 296), (265, 330, 296), (423, 330, 247), (423, 0, 247)),
)

_EYE = (278, 273, -800)
_FOCAL_LENGTH, _FILM = 35.0, 25.0

# Just below the middle of the lamp; wide, yet within what one perspective shadow map can hold
_SPOT = (278, 546.8, 279.5)
_SPOT_INTENSITY, _SPOT_INNER, _SPOT_OUTER = 75.0, 45.0, 60.0


def _faces(*quads):
    """Two flat triangles a quad, each with its own normal: the left wall is not quite planar."""
    surface = Surface(has_uv=False)
    for quad in quads:
        a, b, c, d = (scale(corner, _METRES) for corner in quad)
        surface.flat_triangle((a, b, c))
        surface.flat_triangle((a, c, d))
    return surface


def _ceiling_around_lamp():
    """The ceiling with the lamp cut out: four quads from its edges to the lamp's."""
    return [(_CEILING[i], _CEILING[(i + 1) % 4], _LAMP[(i + 1) % 4], _LAMP[i]) for i in range(4)]


def _box(name, about, lamp_is_on):
    gltf = Gltf(name, about, _SOURCE)
    wavelengths = range(400, 701, 4)
    materials = {key: gltf.material(key, spectra.albedo(list(zip(wavelengths, samples))))
                 for key, samples in (("white", _WHITE), ("green", _GREEN), ("red", _RED))}
    emission = spectra.radiance(_LAMP_EMISSION) if lamp_is_on else None
    materials["lamp"] = gltf.material("lamp", (_LAMP_REFLECTANCE,) * 3, emission=emission)

    parts = [(key, material, (quad,)) for key, material, quad in _ROOM]
    parts += [("ceiling", "white", _ceiling_around_lamp()), ("lamp", "lamp", (_LAMP,)),
              ("short_block", "white", _SHORT_BLOCK), ("tall_block", "white", _TALL_BLOCK)]
    for key, material, quads in parts:
        gltf.node(key, mesh=gltf.mesh(key, [(_faces(*quads), materials[material])]))

    vfov = 2 * math.degrees(math.atan(_FILM / 2 / _FOCAL_LENGTH))
    gltf.camera("published", scale(_EYE, _METRES), about_axis((0, 1, 0), 180), vfov, 1.0)
    return gltf


def cornell():
    gltf = _box("cornell",
                "The measured Cornell box, ten times its size, its lamp switched off, lit by a spot in the ceiling.",
                False)
    gltf.spot("spot", scale(_SPOT, _METRES), looking_along((0, -1, 0)), _SPOT_INTENSITY, _SPOT_INNER, _SPOT_OUTER)
    return gltf


def cornell_lamp():
    return _box("cornell_lamp", "The measured Cornell box, ten times its size, lit by its own lamp.", True)
