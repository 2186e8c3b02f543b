"""`hairball`: a ball of 17,280 thin curved strands, over a floor, under a spot: 1.0 million triangles of hair.

The strands are drawn by turning and mirroring a few bundles about the ball's centre: each bundle is one mesh of strands that
leave the middle in directions spread over the whole sphere, so that any turn of it is a hairball of its own, only thinner.
That keeps the files below half a megabyte. Random numbers are a fixed sequence: the bytes are the same everywhere.
"""

import math

from . import shapes
from .gltf import Gltf
from .surface import Surface
from .vector import about_axis, add, cross, dot, looking_along, normalised, scale, sub

_RADIUS, _MIDDLE = 1.0, (0.0, 1.1, 0.0)
_BUNDLES, _STRANDS, _TURNS = 6, 64, 45  # meshes, strands in each, times each is drawn
_SEGMENTS, _SIDES = 10, 3  # of a strand's tube
_THICKNESS = 0.003  # radius at the root
_EYE, _TARGET, _VFOV = (0.0, 1.5, 4.3), (0.0, 1.05, 0.0), 36.0
_COLOURS = ((0.62, 0.46, 0.28), (0.55, 0.36, 0.20), (0.70, 0.56, 0.38))
_LIGHT = (1.7, 3.9, 3.9)


class _Random:
    """A 64-bit linear congruential sequence (Knuth's MMIX constants), from its upper half."""

    def __init__(self, seed):
        self.state = seed

    def next(self):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return (self.state >> 33) / 2**31


def _sphere_direction(i, count):
    """The i-th of `count` directions spread evenly: a spiral of equal areas."""
    y = 1.0 - (2.0 * i + 1.0) / count
    turn = i * math.pi * (3.0 - math.sqrt(5.0))
    reach = math.sqrt(1.0 - y * y)
    return (reach * math.cos(turn), y, reach * math.sin(turn))


def _centre_line(direction, random):
    """A strand from near the middle outward: it bends aside and curls, more toward its end."""
    aside = normalised(cross(direction, (random.next() - 0.5, random.next() - 0.5, random.next() - 0.5)))
    across = cross(direction, aside)
    length = _RADIUS * (0.82 + 0.18 * random.next())
    bend = 0.55 * (random.next() - 0.2)
    curls, phase = 0.5 + 2.2 * random.next(), 2 * math.pi * random.next()
    points = []
    for k in range(_SEGMENTS + 1):
        t = k / _SEGMENTS
        angle = phase + 2 * math.pi * curls * t
        curl = 0.07 * t * (1.0 - 0.3 * t)
        way = normalised(add(direction, scale(aside, bend * t * t)))
        point = scale(way, length * (0.08 + 0.92 * t))
        point = add(point, add(scale(aside, curl * (math.cos(angle) - math.cos(phase))),
                               scale(across, curl * (math.sin(angle) - math.sin(phase)))))
        points.append(point)
    return points


def _strand(surface, points):
    """A tube of three sides round a line, thinner toward the tip, appended to the surface."""
    first = len(surface.positions)
    across = None
    for k, point in enumerate(points):
        ahead = normalised(sub(points[min(k + 1, _SEGMENTS)], points[max(k - 1, 0)]))
        if across is None:
            across = normalised(cross(ahead, (0.31, 0.84, -0.44)))
        across = normalised(sub(across, scale(ahead, dot(across, ahead))))
        other = cross(ahead, across)
        radius = _THICKNESS * (1.0 - 0.6 * k / _SEGMENTS)
        for side in range(_SIDES):
            angle = 2 * math.pi * side / _SIDES
            normal = add(scale(across, math.cos(angle)), scale(other, math.sin(angle)))
            surface.vertex(add(point, scale(normal, radius)), normal)
    for k in range(_SEGMENTS):
        for side in range(_SIDES):
            a, b = first + k * _SIDES + side, first + k * _SIDES + (side + 1) % _SIDES
            surface.triangle(a, b, b + _SIDES)
            surface.triangle(a, b + _SIDES, a + _SIDES)


def _bundle(seed):
    surface, random = Surface(has_uv=False), _Random(seed)
    for i in range(_STRANDS):
        _strand(surface, _centre_line(_sphere_direction(i, _STRANDS), random))
    return surface


def hairball():
    gltf = Gltf("hairball",
                "A ball of 17,280 thin curved strands over a floor, under a spot: a few bundles drawn many times.")
    hair = [gltf.material("hair_%d" % k, colour, roughness=0.8)
            for k, colour in enumerate(_COLOURS)]
    ground = gltf.material("floor", (0.55, 0.55, 0.53), roughness=0.95)
    gltf.node("floor", mesh=gltf.mesh("floor", [(shapes.floor(-3.0, 3.0, -3.0, 3.0, 0.0), ground)]))
    random = _Random(2026)
    for k in range(_BUNDLES):
        mesh = gltf.mesh("bundle_%d" % k, [(_bundle(17 + k), hair[k % len(hair)])])
        for turn in range(_TURNS):
            axis = _sphere_direction(turn, _TURNS)
            gltf.node("bundle", mesh=mesh, translation=_MIDDLE,
                      rotation=about_axis(axis, 360.0 * random.next()))
    aim = (0.0, 0.9, 0.0)
    gltf.spot("spot", _LIGHT, looking_along(sub(aim, _LIGHT)), 90.0, 20.0, 28.0)
    gltf.camera("front", _EYE, looking_along(sub(_TARGET, _EYE)), _VFOV, 16 / 9)
    return gltf
