"""The shapes that scenes are built of. Texture coordinates are metres divided by `tile`, the texture's size."""

import math

from .surface import Surface
from .vector import add, cross, normalised, scale, sub


def box(size, centre=(0.0, 0.0, 0.0), tile=1.0, without=""):
    """An axis-aligned box. `without` names faces to leave out: any of "-x +x -y +y -z +z"."""
    surface = Surface()
    half = scale(size, 0.5)
    for axis in range(3):
        u, v = ((2, 1), (0, 2), (0, 1))[axis]
        for sign in (-1, 1):
            if "-+"[sign > 0] + "xyz"[axis] in without:
                continue
            normal = tuple(float(sign) if k == axis else 0.0 for k in range(3))
            corners, uvs = [], []
            for su, sv in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner = list(centre)
                corner[axis] += sign * half[axis]
                corner[u] += su * half[u]
                corner[v] += sv * half[v]
                corners.append(tuple(corner))
                uvs.append((corner[u] / tile, -corner[v] / tile))
            surface.quad(corners, normal, uvs)
    return surface


def panel(width, height, tile=1.0):
    """A rectangle in the xy plane, its lower edge's middle at the origin, facing +z."""
    surface = Surface()
    corners = ((-width / 2, 0.0, 0.0), (width / 2, 0.0, 0.0), (width / 2, height, 0.0), (-width / 2, height, 0.0))
    surface.quad(corners, (0.0, 0.0, 1.0), [(x / tile, -y / tile) for x, y, _ in corners])
    return surface


def floor(x0, x1, z0, z1, y, tile=1.0, up=True):
    """A horizontal rectangle; its texture lies still in the world."""
    surface = Surface()
    corners = ((x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1))
    surface.quad(corners, (0.0, 1.0 if up else -1.0, 0.0), [(x / tile, z / tile) for x, _, z in corners])
    return surface


def _profile_normals(points):
    """Unit normals (right of the way a profile runs) at the points of a smooth profile."""
    normals = []
    for k in range(len(points)):
        before, after = points[max(k - 1, 0)], points[min(k + 1, len(points) - 1)]
        dx, dy = after[0] - before[0], after[1] - before[1]
        size = math.hypot(dx, dy)
        normals.append((dy / size, -dx / size))
    return normals


def turned(profile, segments, tile=1.0):
    """A solid of revolution about y. `profile` is a list of smooth runs of (radius, height) from bottom to top;
    where one run ends and the next begins there is an edge."""
    surface = Surface()
    widest = max(r for run in profile for r, _ in run)
    turns = max(1, round(2 * math.pi * widest / tile))
    travelled = 0.0
    for run in profile:
        normals, along = _profile_normals(run), [travelled]
        for (r0, y0), (r1, y1) in zip(run, run[1:]):
            along.append(along[-1] + math.hypot(r1 - r0, y1 - y0))
        travelled = along[-1]

        def vertex_at(i, j, run=run, normals=normals, along=along):
            angle = 2 * math.pi * (i % segments) / segments
            c, s = math.cos(angle), math.sin(angle)
            (r, y), (nr, ny) = run[j], normals[j]
            return (r * c, y, r * s), (nr * c, ny, nr * s), (-turns * i / segments, -along[j] / tile)

        surface.grid(segments, len(run) - 1, vertex_at)
    return surface


def arc(centre, radius, from_degrees, to_degrees, steps):
    """Points of a circular run, for profiles."""
    result = []
    for k in range(steps + 1):
        angle = math.radians(from_degrees + (to_degrees - from_degrees) * k / steps)
        result.append((centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)))
    return result


def ring(radius, thickness, segments, sides, tile=1.0):
    """A torus about y."""
    surface = Surface()

    def vertex_at(i, j):
        a, b = 2 * math.pi * (i % segments) / segments, 2 * math.pi * (j % sides) / sides
        ca, sa, cb, sb = math.cos(a), math.sin(a), math.cos(b), math.sin(b)
        reach = radius + thickness * cb
        return ((reach * ca, thickness * sb, reach * sa), (cb * ca, sb, cb * sa),
                (-round(2 * math.pi * radius / tile) * i / segments, -j / sides))

    surface.grid(segments, sides, vertex_at)
    return surface


def ball(radius, segments, rings, tile=1.0):
    return turned([arc((0.0, 0.0), radius, -90, 90, rings)], segments, tile)


def moulding_round_court(half_x, half_z, profile, tile=1.0):
    """A moulding that runs round the inside of a rectangular court. `profile` is a list of straight runs' points
    (reach into the court, height), from bottom to top; corners are mitred."""
    surface = Surface()
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        dr, dy = r1 - r0, y1 - y0
        size = math.hypot(dr, dy)
        out, up = dy / size, -dr / size
        for axis, sign in ((0, 1), (0, -1), (2, 1), (2, -1)):
            across, along = (half_x, half_z) if axis == 0 else (half_z, half_x)
            normal = (-sign * out, up, 0.0) if axis == 0 else (0.0, up, -sign * out)
            corners, uvs = [], []
            for reach, y, end in ((r0, y0, -1), (r0, y0, 1), (r1, y1, 1), (r1, y1, -1)):
                a, b = sign * (across - reach), end * (along - reach)
                corners.append((a, y, b) if axis == 0 else (b, y, a))
                uvs.append((b / tile, -(y + reach) / tile))
            surface.quad(corners, normal, uvs)
    return surface


def arch(width, opening, spring, top, depth, segments, tile=1.0):
    """A wall in the xy plane, `width` wide from `spring` to `top`, with a half-round opening of radius `opening` in
    its lower edge: both faces and the soffit."""
    surface = Surface()
    arc_points = [(opening * math.cos(math.pi * k / segments), spring + opening * math.sin(math.pi * k / segments))
                  for k in range(segments + 1)]
    outline = [(width / 2, spring)] + arc_points + [(-width / 2, spring)]
    for sign in (1.0, -1.0):
        z = sign * depth / 2

        def vertex_at(i, j, z=z, sign=sign):
            x, y = outline[i]
            y = y if j == 0 else top
            return (x, y, z), (0.0, 0.0, sign), (x / tile, -y / tile)

        surface.grid(len(outline) - 1, 1, vertex_at)

    def soffit_at(i, j):
        x, y = arc_points[i]
        z = (j - 0.5) * depth
        angle = math.pi * i / segments
        return (x, y, z), (-math.cos(angle), -math.sin(angle), 0.0), (z / tile, opening * angle / tile)

    surface.grid(segments, 1, soffit_at)
    for sign in (1.0, -1.0):  # the strips that rest on the capitals
        x0, x1 = sorted((sign * opening, sign * width / 2))
        surface.append(floor(x0, x1, -depth / 2, depth / 2, spring, tile, up=False))
    return surface


def archivolt(opening, spring, profile, segments, tile=1.0):
    """A moulding that follows a half-round arch. `profile` runs from the opening's edge outward as (added radius,
    reach toward +z) points."""
    surface = Surface()
    for (a0, z0), (a1, z1) in zip(profile, profile[1:]):
        da, dz = a1 - a0, z1 - z0
        size = math.hypot(da, dz)
        radial, forward = -dz / size, da / size

        def vertex_at(i, j, a0=a0, z0=z0, a1=a1, z1=z1, radial=radial, forward=forward):
            angle = math.pi * i / segments
            c, s = math.cos(angle), math.sin(angle)
            added, z = (a0, z0) if j == 0 else (a1, z1)
            r = opening + added
            return ((r * c, spring + r * s, z), (radial * c, radial * s, forward),
                    (r * angle / tile, (added + z) / tile))

        surface.grid(segments, 1, vertex_at)
    return surface


def sheet(columns, rows, position_at, uv_at):
    """A smooth sheet. Its normals come from differences of position_at(u, v), u a little beyond [0, 1], and point
    to the side from which u runs to the right when v runs down."""
    surface = Surface()
    step = 1e-3

    def vertex_at(i, j):
        u, v = i / columns, j / rows
        along = sub(position_at(u + step, v), position_at(u - step, v))
        down = sub(position_at(u, min(1.0, v + step)), position_at(u, max(0.0, v - step)))
        return position_at(u, v), normalised(cross(down, along)), uv_at(u, v)

    surface.grid(columns, rows, vertex_at)
    return surface


def rod(start, end, radius, sides=8, tile=1.0):
    """A round rod without ends."""
    surface = Surface()
    axis = normalised(sub(end, start))
    side = normalised(cross(axis, (0.0, 1.0, 0.0) if abs(axis[1]) < 0.9 else (1.0, 0.0, 0.0)))
    other = cross(axis, side)

    def vertex_at(i, j):
        angle = 2 * math.pi * (i % sides) / sides
        normal = add(scale(side, math.cos(angle)), scale(other, math.sin(angle)))
        return add((start, end)[j], scale(normal, radius)), normal, (i / sides, float(j) / tile)

    surface.grid(sides, 1, vertex_at)
    return surface
