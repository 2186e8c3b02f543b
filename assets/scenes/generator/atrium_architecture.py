"""The atrium's masonry and carpentry: columns, piers, arches, mouldings, walls, floors, roof, doors."""

import math

from . import shapes
from .atrium_plan import (ARCADE, ASHLAR_TILE, COURT_X, COURT_Z, EAVES, HALL_X, HALL_Z, LOWER_CEILING, MARBLE_TILE,
                          OPENING, BAY, STONE_TILE, TERRACOTTA_TILE, TOP, UPPER_CEILING, UPPER_FLOOR, WALL, WOOD_TILE)
from .surface import Surface
from .vector import cross, normalised, sub


def _leafy_bell(low, high, r_low, r_high, segments, rows):
    """A capital's bell with two rows of eight leaves that curl outward at their tips."""
    def position_at(u, v):
        angle = 2 * math.pi * u
        radius = r_low + (r_high - r_low) * v ** 2.2
        for row, (start, end) in enumerate(((0.0, 0.52), (0.38, 0.92))):
            t = (v - start) / (end - start)
            if 0 < t < 1:
                leaf = (0.5 + 0.5 * math.cos(8 * angle + math.pi * row)) ** 1.5
                radius += leaf * (0.025 * math.sin(math.pi * t) + 0.34 * t ** 3 * (1 - t))
        return (radius * math.cos(angle), low + (high - low) * v, radius * math.sin(angle))

    return shapes.sheet(segments, rows, position_at, lambda u, v: (u, -v * (high - low) / STONE_TILE))


def column(height, radius):
    """A round column with base, swelling shaft and leafy capital; it stands at y = 0 and ends flat at `height`."""
    r, thin = radius, 0.86 * radius
    neck, shaft_foot = height - 0.72, 0.44
    shaft = [(1.12 * r, shaft_foot), (1.03 * r, shaft_foot + 0.05)]
    for k in range(6):
        t = k / 5
        shaft.append((r - (r - thin) * t ** 1.8, shaft_foot + 0.12 + (neck - 0.06 - shaft_foot - 0.12) * t))
    profile = [
        [(1.22 * r, 0.16), (1.22 * r, 0.18)],
        shapes.arc((1.18 * r, 0.245), 0.065, -90, 90, 5),
        [(1.18 * r, 0.31), (1.10 * r, 0.325), (1.07 * r, 0.345), (1.10 * r, 0.365)],
        shapes.arc((1.12 * r, 0.40), 0.035, -90, 90, 3),
        shaft,
        shapes.arc((thin, neck - 0.03), 0.03, -90, 90, 3),
    ]
    surface = shapes.turned(profile, 20, STONE_TILE)
    surface.append(_leafy_bell(neck, height - 0.15, thin, 1.22 * r, 40, 10))
    surface.append(shapes.box((2.56 * r, 0.16, 2.56 * r), (0, 0.08, 0), STONE_TILE, without="-y"))
    surface.append(shapes.box((2.55 * r, 0.06, 2.55 * r), (0, height - 0.12, 0), STONE_TILE))
    surface.append(shapes.box((2.72 * r, 0.09, 2.72 * r), (0, height - 0.045, 0), STONE_TILE))
    return surface


def pier(height, width, steps=((0.16, 1.18), (0.10, 1.10), (0.06, 1.04)),
         top=((0.06, 1.05), (0.08, 1.12), (0.10, 1.20))):
    """A square pier: stacked slabs for its base and capital."""
    surface, y = Surface(), 0.0
    rows = list(steps) + [(height - sum(h for h, _ in steps) - sum(h for h, _ in top), 1.0)] + list(top)
    for thickness, share in rows:
        surface.append(shapes.box((width * share, thickness, width * share), (0, y + thickness / 2, 0), STONE_TILE,
                                  without="-y" if y == 0 else ""))
        y += thickness
    return surface


def pilaster(height):
    """A flat pier against a wall; the wall is behind it, at z = 0."""
    surface, y = Surface(), 0.0
    for thickness, width, reach in ((0.22, 0.62, 0.22), (0.08, 0.56, 0.19), (height - 0.62, 0.48, 0.15),
                                    (0.08, 0.56, 0.19), (0.24, 0.64, 0.24)):
        surface.append(shapes.box((width, thickness, reach), (0, y + thickness / 2, reach / 2), STONE_TILE,
                                  without="-z"))
        y += thickness
    return surface


def arch_wall(spring, top):
    return shapes.arch(BAY, OPENING, spring, top, ARCADE, 22, ASHLAR_TILE)


def arch_moulding(spring):
    """The archivolts of both faces, and a keystone through the wall."""
    profile = ((0.0, 0.0), (0.0, 0.05), (0.10, 0.05), (0.12, 0.08), (0.20, 0.08), (0.24, 0.03), (0.26, 0.03),
               (0.26, 0.0))
    surface = Surface()
    one = shapes.archivolt(OPENING, spring, [(a, z + ARCADE / 2) for a, z in profile], 22, STONE_TILE)
    surface.append(one)
    surface.append(one, rotation=(0.0, 1.0, 0.0, 0.0))
    return surface.append(_keystone(spring + OPENING - 0.06))


def _keystone(foot):
    """A wedge, wider at its head, that stands out from both faces."""
    low, high, height, half = 0.10, 0.15, 0.44, ARCADE / 2 + 0.13
    outline = ((-low, foot), (low, foot), (high, foot + height), (-high, foot + height))
    surface = Surface()
    for sign in (1.0, -1.0):
        surface.quad([(x, y, sign * half) for x, y in outline], (0.0, 0.0, sign),
                     [(x / STONE_TILE, -y / STONE_TILE) for x, y in outline])
    for (x0, y0), (x1, y1) in zip(outline, outline[1:] + outline[:1]):
        corners = ((x0, y0, -half), (x1, y1, -half), (x1, y1, half), (x0, y0, half))
        normal = normalised(cross(sub(corners[1], corners[0]), (0.0, 0.0, 1.0)))
        surface.quad(corners, normal, [(z / STONE_TILE, -(x + y) / STONE_TILE) for x, y, z in corners])
    return surface


def corner_block(spring, top):
    """Fills the corner where two arcades meet."""
    return shapes.box((ARCADE + 0.04, top - spring, ARCADE + 0.04), (0, (spring + top) / 2, 0), ASHLAR_TILE)


def cornices():
    """The mouldings round the court, at the upper floor and under the eaves."""
    face_x, face_z = COURT_X - ARCADE / 2, COURT_Z - ARCADE / 2
    surface = Surface()
    for base in (UPPER_FLOOR - 0.42, EAVES - 0.46):
        profile = ((0.0, 0.0), (0.05, 0.0), (0.05, 0.12), (0.09, 0.14), (0.13, 0.19), (0.15, 0.25), (0.19, 0.25),
                   (0.19, 0.30), (0.22, 0.33),
                   (0.26, 0.40), (0.26, 0.44), (0.0, 0.44))
        surface.append(shapes.moulding_round_court(face_x, face_z, [(r, base + y) for r, y in profile], STONE_TILE))
    return surface


def dado():
    """The stone foot of the outer walls, in both storeys."""
    surface = Surface()
    for base in (0.0, UPPER_FLOOR):
        profile = ((0.09, 0.0), (0.09, 0.16), (0.06, 0.20), (0.06, 1.10), (0.09, 1.13), (0.09, 1.20), (0.0, 1.24))
        surface.append(shapes.moulding_round_court(HALL_X, HALL_Z, [(r, base + y) for r, y in profile], ASHLAR_TILE))
    return surface


def outer_walls():
    """They end a little below the roof's edge."""
    surface, height = Surface(), TOP - 0.03
    for sign in (1, -1):
        surface.append(shapes.box((2 * (HALL_X + WALL), height, WALL), (0, height / 2, sign * (HALL_Z + WALL / 2)),
                                  STONE_TILE, without="-y"))
        surface.append(shapes.box((WALL, height, 2 * HALL_Z), (sign * (HALL_X + WALL / 2), height / 2, 0), STONE_TILE,
                                  without="-y-z+z"))
    return surface


def _round_the_court(inset, y, tile, up):
    """A horizontal ring from the outer walls to `inset` inside the arcades' axes."""
    x, z, surface = COURT_X - inset, COURT_Z - inset, Surface()
    for x0, x1, z0, z1 in ((-HALL_X, HALL_X, z, HALL_Z), (-HALL_X, HALL_X, -HALL_Z, -z), (-HALL_X, -x, -z, z),
                           (x, HALL_X, -z, z)):
        surface.append(shapes.floor(x0, x1, z0, z1, y, tile, up))
    return surface


def court_floor():
    edge = ARCADE / 2 + 0.1
    x, z = COURT_X - edge, COURT_Z - edge
    return shapes.floor(-x, x, -z, z, 0.0, MARBLE_TILE)


def gallery_floors():
    """Lower and upper; the upper one reaches to the arcade's face."""
    lower = _round_the_court(ARCADE / 2 + 0.1, 0.0, TERRACOTTA_TILE, True)
    return lower.append(_round_the_court(ARCADE / 2, UPPER_FLOOR, TERRACOTTA_TILE, True))


def ceilings():
    lower = _round_the_court(-ARCADE / 2, LOWER_CEILING, WOOD_TILE, False)
    return lower.append(_round_the_court(-ARCADE / 2, UPPER_CEILING, WOOD_TILE, False))


def beam():
    """From the arcade's back (z = 0) to the outer wall; its top is at y = 0."""
    span = HALL_Z - COURT_Z - ARCADE / 2
    surface = shapes.box((0.24, 0.30, span), (0, -0.15, span / 2), WOOD_TILE, without="+y-z+z")
    for z in (0.0, span):  # corbels
        reach = 0.42 if z == 0 else -0.42
        surface.append(shapes.box((0.20, 0.16, abs(reach)), (0, -0.38, z + reach / 2), WOOD_TILE))
    return surface


def roof():
    """A tiled slope from the outer walls' tops down to eaves that stand out over the court, with a fascia board's
    face below."""
    outer_x, outer_z, out = HALL_X + WALL, HALL_Z + WALL, 0.42
    inner_x, inner_z = COURT_X - ARCADE / 2 - out, COURT_Z - ARCADE / 2 - out
    surface = Surface()
    for axis, sign in ((0, 1), (0, -1), (2, 1), (2, -1)):
        reach_in, reach_out = (inner_x, outer_x) if axis == 0 else (inner_z, outer_z)
        half_in, half_out = (inner_z, outer_z) if axis == 0 else (inner_x, outer_x)

        def place(reach, y, along, axis=axis, sign=sign):
            return (sign * reach, y, along) if axis == 0 else (along, y, sign * reach)

        inner, outer = EAVES + 0.10, TOP
        slope = normalised((outer - inner, reach_out - reach_in, 0.0))
        normal = (-sign * slope[0], slope[1], 0.0) if axis == 0 else (0.0, slope[1], -sign * slope[0])
        corners = [place(reach_in, inner, -half_in), place(reach_in, inner, half_in), place(reach_out, outer, half_out),
                   place(reach_out, outer, -half_out)]
        surface.quad(corners, normal,
                     [(c[2 - axis] / TERRACOTTA_TILE, abs(c[axis]) / TERRACOTTA_TILE) for c in corners])
        corners = [place(reach_in, inner - 0.14, -half_in), place(reach_in, inner - 0.14, half_in),
                   place(reach_in, inner, half_in),
                   place(reach_in, inner, -half_in)]
        normal = tuple(-sign * float(k == axis) for k in range(3))
        surface.quad(corners, normal, [(c[2 - axis] / TERRACOTTA_TILE, -c[1] / TERRACOTTA_TILE) for c in corners])
        back = reach_in + out
        corners = [place(reach_in, inner - 0.14, -half_in), place(reach_in, inner - 0.14, half_in),
                   place(back, inner - 0.14, half_in + out),
                   place(back, inner - 0.14, -half_in - out)]
        surface.quad(corners, (0.0, -1.0, 0.0),
                     [(c[2 - axis] / TERRACOTTA_TILE, c[axis] / TERRACOTTA_TILE) for c in corners])
    return surface


def door():
    """(stone frame, wooden leaves) of a double door against a wall at z = 0."""
    frame, leaves = Surface(), Surface()
    for x in (-0.92, 0.92):
        frame.append(shapes.box((0.24, 2.7, 0.20), (x, 1.35, 0.10), STONE_TILE, without="-y-z"))
    frame.append(shapes.box((2.20, 0.26, 0.24), (0, 2.83, 0.12), STONE_TILE, without="-z"))
    frame.append(shapes.box((2.44, 0.10, 0.32), (0, 3.01, 0.16), STONE_TILE, without="-z"))
    for x in (-0.4, 0.4):
        leaves.append(shapes.box((0.79, 2.68, 0.08), (x, 1.36, 0.07), WOOD_TILE, without="-z"))
        for y, height in ((0.62, 0.9), (1.62, 0.8), (2.34, 0.36)):
            leaves.append(shapes.box((0.52, height, 0.05), (x, y, 0.13), WOOD_TILE, without="-z"))
    return frame, leaves
