"""What stands and hangs in the atrium: curtains, railings, lamps, vases, plants, the fountain."""

import math

from . import shapes
from .atrium_plan import BAY, CLOTH_TILE, STONE_TILE
from .noise import hashed
from .surface import Surface
from .vector import about_axis


def curtain(width, height, folds, seed):
    """(cloth, golden hem) of a hanging curtain in the xy plane, its upper edge's middle at the origin. Folds deepen
    downward and wander a little."""
    shares = [hashed(k, 0, seed) for k in range(6)]
    hem = 0.94

    def position_at(u, v):
        wander = 0.5 * math.sin(2 * math.pi * (u * 1.5 + shares[0]))
        wander += 0.35 * math.sin(2 * math.pi * (0.8 * v + shares[1]))
        phase = 2 * math.pi * (folds * u + shares[2]) + wander
        depth = 0.035 + 0.085 * v ** 0.8 * (0.75 + 0.25 * math.sin(2 * math.pi * (2 * u + shares[3])))
        fall = depth * (math.sin(phase) + 0.12 * math.sin(2 * phase + 6 * shares[4]))
        billow = 0.16 * v * v * math.sin(math.pi * (u + 0.25 * (shares[5] - 0.5)))
        x = (u - 0.5) * width * (1 - 0.05 * math.sin(math.pi * v)) + 0.12 * depth * math.sin(2 * phase)
        return (x, -height * v, fall + billow)

    def part(top, bottom, rows):
        return shapes.sheet(80, rows, lambda u, v: position_at(u, top + (bottom - top) * v),
                            lambda u, v: (u * width * 1.35 / CLOTH_TILE,
                                          height * (top + (bottom - top) * v) / CLOTH_TILE))

    return part(0.0, hem, 16), part(hem, 1.0, 1)


def tapestry(width, height):
    """A cloth laid over the railing: (cloth, golden hem), the rail at the origin, the court toward +z."""
    def position_at(u, v):
        wave = 0.018 * math.sin(9.0 * u + 2.0 * v) + 0.03 * v * math.sin(4.0 * u + 1.0)
        return ((u - 0.5) * width, -height * v, 0.05 + 0.44 * min(1.0, 2.1 * v) ** 2 + wave)

    def part(top, bottom, rows):
        return shapes.sheet(12, rows, lambda u, v: position_at(u, top + (bottom - top) * v),
                            lambda u, v: (u * width / CLOTH_TILE, height * (top + (bottom - top) * v) / CLOTH_TILE))

    return part(0.0, 0.93, 16), part(0.93, 1.0, 1)


def railing():
    """(iron lattice to be cut out by its texture, rails) between two columns of the upper storey; it stands at y =
    0."""
    width, height = BAY - 0.56, 0.84
    lattice = Surface()
    corners = ((-width / 2, 0.08, 0.0), (width / 2, 0.08, 0.0), (width / 2, height + 0.08, 0.0),
               (-width / 2, height + 0.08, 0.0))
    lattice.quad(corners, (0.0, 0.0, 1.0), ((0, 2), (6, 2), (6, 0), (0, 0)))
    rails = shapes.box((width, 0.06, 0.10), (0, height + 0.11, 0))
    return lattice, rails.append(shapes.box((width, 0.05, 0.06), (0, 0.06, 0)))


def curtain_rod(width):
    surface = shapes.rod((-width / 2, 0.0, 0.0), (width / 2, 0.0, 0.0), 0.022)
    for side in (-1, 1):
        surface.append(shapes.ball(0.045, 10, 6), (side * width / 2, 0.0, 0.0))
    return surface


def lamp():
    """A pierced brass bowl on a long rod; it hangs from the origin."""
    bowl = [[(0.0, -1.42), (0.03, -1.41), (0.02, -1.37)], shapes.arc((0.0, -1.18), 0.19, -84, -8, 6),
            [(0.188, -1.206), (0.205, -1.19), (0.205, -1.175), (0.17, -1.16)],
            [(0.17, -1.16), (0.11, -1.09), (0.05, -1.04), (0.035, -0.98), (0.02, -0.96)]]
    return shapes.turned(bowl, 16).append(shapes.rod((0.0, -0.97, 0.0), (0.0, 0.0, 0.0), 0.012, 6))


def vase():
    """A bronze krater with a foot, 0.95 m high."""
    profile = [[(0.0, 0.0), (0.20, 0.0)], [(0.20, 0.0), (0.20, 0.04)],
               [(0.20, 0.04), (0.12, 0.07), (0.075, 0.14), (0.07, 0.19)],
               [(0.07, 0.19), (0.10, 0.20), (0.10, 0.22)],
               [(0.08, 0.23), (0.20, 0.28), (0.28, 0.38), (0.305, 0.50), (0.28, 0.62), (0.20, 0.72), (0.165, 0.79),
                (0.18, 0.86), (0.26, 0.93), (0.275, 0.95)],
               [(0.275, 0.95), (0.245, 0.95)], [(0.245, 0.95), (0.16, 0.87), (0.14, 0.79), (0.0, 0.70)]]
    surface = shapes.turned(profile, 28, 0.7)
    for side in (0.0, 180.0):  # handles: half rings that stand upright
        half = shapes.ring(0.13, 0.02, 20, 8, 0.7)
        upright = Surface().append(half, rotation=about_axis((1, 0, 0), 90))
        surface.append(Surface().append(upright, (0.255, 0.70, 0.0)), rotation=about_axis((0, 1, 0), side))
    return surface


def pedestal():
    surface, y = Surface(), 0.0
    for thickness, width in ((0.10, 0.74), (0.06, 0.66), (0.62, 0.56), (0.06, 0.64), (0.08, 0.72)):
        surface.append(shapes.box((width, thickness, width), (0, y + thickness / 2, 0), STONE_TILE,
                                  without="-y" if y == 0 else ""))
        y += thickness
    return surface


def pot():
    """A fired pot, 0.6 m high, and the soil in it."""
    profile = [[(0.24, 0.0), (0.30, 0.30), (0.345, 0.50)], [(0.345, 0.50), (0.375, 0.51), (0.375, 0.60)],
               [(0.375, 0.60), (0.335, 0.60)],
               [(0.335, 0.60), (0.325, 0.52)]]
    return shapes.turned(profile, 24, 0.6), shapes.turned([[(0.325, 0.53), (0.0, 0.55)]], 16)


def _frond(length, width, rise, droop):
    """A leaf that leaves the origin toward +z, rises, and bends down by its own weight; folded along its stem."""
    def position_at(u, v):
        side = 2 * u - 1
        bend = droop * v
        z = length * (math.sin(rise + math.pi / 2 - bend) * v * 0.55 + math.cos(rise) * v * 0.45)
        y = length * (math.sin(rise) * v - 0.5 * droop * v * v)
        return (side * width * 0.5, y + 0.10 * width * abs(side), z)

    # the stem must be a column of vertices: two halves side by side
    return shapes.sheet(2, 9, position_at, lambda u, v: (u, 1 - v))


def plant(seed, count):
    """Fronds round one foot, the outer ones lower."""
    surface = Surface()
    for k in range(count):
        share = [hashed(k, j, seed) for j in range(4)]
        outer = k % 3 / 2
        leaf = _frond(1.05 + 0.35 * share[0], 0.42 + 0.10 * share[1], 1.15 - 0.55 * outer + 0.2 * share[2],
                      1.0 + 0.35 * outer + 0.3 * share[3])
        surface.append(leaf, rotation=about_axis((0, 1, 0), 360.0 * (k * 0.381966 + 0.05 * share[1])))
    return surface


def fountain():
    """{stone, water, bronze} of the basin in the court's middle; the bowl's rim is at 1.75 m."""
    basin = [[(1.78, 0.0), (1.78, 0.12)], [(1.78, 0.12), (1.66, 0.12)],
             [(1.66, 0.12), (1.60, 0.16), (1.58, 0.24), (1.58, 0.40), (1.62, 0.46)],
             [(1.62, 0.46), (1.70, 0.47), (1.72, 0.51), (1.70, 0.55)], [(1.70, 0.55), (1.42, 0.55)],
             [(1.42, 0.55), (1.40, 0.10)]]
    stem = [[(0.34, 0.10), (0.34, 0.48)],
            [(0.34, 0.48), (0.26, 0.53), (0.17, 0.66), (0.14, 0.86), (0.15, 1.02), (0.20, 1.10)],
            [(0.20, 1.10), (0.24, 1.13), (0.24, 1.17), (0.20, 1.20)], [(0.14, 1.20), (0.11, 1.30), (0.13, 1.42)]]
    bowl = [[(0.13, 1.40), (0.30, 1.44), (0.55, 1.55), (0.74, 1.70), (0.80, 1.75)],
            [(0.80, 1.75), (0.77, 1.77), (0.74, 1.75)],
            [(0.74, 1.75), (0.50, 1.62), (0.24, 1.53), (0.0, 1.51)],
            [(0.0, 1.50), (0.07, 1.52), (0.06, 1.62), (0.045, 1.74), (0.07, 1.80)]]
    stone = shapes.turned(basin, 64, STONE_TILE).append(shapes.turned(stem, 32, STONE_TILE))
    water = shapes.turned([[(1.41, 0.42), (0.33, 0.42)]], 48).append(shapes.turned([[(0.66, 1.70), (0.05, 1.70)]], 40))
    return {"stone": stone, "water": water, "bronze": shapes.turned(bowl, 48, 0.7)}


def armillary_sphere():
    """Three rings, an axis and a ball, about the origin."""
    surface = shapes.ball(0.11, 24, 16)
    for axis, degrees, radius in (((1, 0, 0), 23.0, 0.42), ((1, 0, 0), 90.0, 0.44), ((0.6, 0.0, 0.8), 66.0, 0.40)):
        surface.append(shapes.ring(radius, 0.016, 56, 8), rotation=about_axis(axis, degrees))
    surface.append(Surface().append(shapes.rod((0.0, -0.56, 0.0), (0.0, 0.50, 0.0), 0.012, 8)),
                   rotation=about_axis((0, 0, 1), 12))
    return surface
