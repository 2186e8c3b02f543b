"""Procedural textures. Colours are given linear and stored as sRGB; every texture repeats at its edges unless it says
otherwise."""

import math

from .noise import field, hashed
from .numbers import to_byte
from .png import Picture


def _to_srgb(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


_SRGB = [to_byte(_to_srgb(k / 4096)) for k in range(4097)]


def _srgb(colour):
    return [_SRGB[max(0, min(4096, int(c * 4096)))] for c in colour]


def _mix(a, b, t):
    return [x + (y - x) * t for x, y in zip(a, b)]


def _smooth(low, high, value):
    t = max(0.0, min(1.0, (value - low) / (high - low)))
    return t * t * (3 - 2 * t)


def _picture(width, height, channels, pixel_at):
    pixels = bytearray()
    for y in range(height):
        for x in range(width):
            pixels += bytes(pixel_at(x, y))
    return Picture(width, height, channels, pixels)


def normal_map(heights, width, height, strength):
    """A tangent-space normal map (green toward the top of the picture) from heights in pixels."""
    def pixel_at(x, y):
        row = y * width
        dx = heights[row + (x + 1) % width] - heights[row + x - 1 if x else row + width - 1]
        dy = heights[(y + 1) % height * width + x] - heights[(y - 1) % height * width + x]
        nx, ny = -0.5 * strength * dx, 0.5 * strength * dy
        size = math.sqrt(nx * nx + ny * ny + 1)
        return [to_byte(0.5 + 0.5 * n / size) for n in (nx, ny, 1.0)]
    return _picture(width, height, 3, pixel_at)


def stone(size):
    """Warm limestone: soft stains and grain."""
    stains, grain = field(size, size, 3, 4, 4, 1), field(size, size, 64, 64, 2, 2)

    def pixel_at(x, y):
        k = y * size + x
        tone = 0.80 + 0.32 * stains[k] + 0.12 * (grain[k] - 0.5)
        return _srgb([c * tone for c in _mix((0.67, 0.535, 0.38), (0.70, 0.59, 0.45), stains[k])])
    return _picture(size, size, 3, pixel_at)


class Ashlar:
    """Dressed blocks in six courses of three, every other course shifted by half a block. Colour and normals of the
    same wall."""
    _COURSES, _BLOCKS = 6, 3

    def __init__(self, size):
        self.size = size
        stains, grain = field(size, size, 4, 4, 4, 5), field(size, size, 64, 64, 2, 6)
        wobble = field(size, size, 12, 12, 2, 7)
        self.heights, self.tones, self.hues = [], [], []
        for y in range(size):
            for x in range(size):
                k = y * size + x
                course = y * self._COURSES / size + 0.03 * (wobble[k] - 0.5)
                row = math.floor(course) % self._COURSES
                along = x * self._BLOCKS / size + 0.5 * (row % 2) + 0.015 * (wobble[k] - 0.5)
                block = math.floor(along) % self._BLOCKS
                course, along = course % 1.0, along % 1.0
                edge = min(min(course, 1 - course) / self._COURSES,
                           min(along, 1 - along) / self._BLOCKS)  # share of the picture
                face = _smooth(0.002, 0.009, edge)
                self.heights.append(3.0 * face + 0.9 * (grain[k] - 0.5) + 1.2 * (stains[k] - 0.5))
                own = hashed(block, row, 9)
                wear = 0.22 * (stains[k] - 0.5) + 0.10 * (grain[k] - 0.5)
                self.tones.append((0.55 + 0.45 * face) * (0.80 + 0.20 * own + wear))
                self.hues.append(0.65 * hashed(block, row, 10) + 0.35 * stains[k])

    def colour(self):
        def pixel_at(x, y):
            k = y * self.size + x
            return _srgb([c * self.tones[k] for c in _mix((0.76, 0.585, 0.395), (0.75, 0.64, 0.495), self.hues[k])])
        return _picture(self.size, self.size, 3, pixel_at)

    def normals(self):
        return normal_map(self.heights, self.size, self.size, 0.9)


class MarbleFloor:
    """Two by two slabs, cream and brown in turn, a dark cabochon where their corners meet. Colour, normals and
    roughness."""

    def __init__(self, size):
        self.size = size
        soft, veins = field(size, size, 4, 4, 4, 11), field(size, size, 5, 5, 5, 12)
        self.heights, self.colours, self.roughness = [], [], []
        for y in range(size):
            for x in range(size):
                k = y * size + x
                u, v = 2 * x / size, 2 * y / size
                i, j = int(u), int(v)
                u, v = u - i, v - j
                corner = min(u, 1 - u) + min(v, 1 - v)  # the cabochon is a square on its tip
                cabochon = corner < 0.17
                edge = min(min(u, 1 - u, v, 1 - v) if not cabochon else 1.0, abs(corner - 0.17))
                face = _smooth(0.002, 0.010, edge)
                vein = 1 - _smooth(0.0, 0.035, abs(veins[k] - 0.5))
                if cabochon:
                    colour = _mix((0.055, 0.045, 0.04), (0.12, 0.10, 0.085), soft[k])
                elif (i + j) % 2:
                    colour = _mix((0.30, 0.165, 0.095), (0.40, 0.25, 0.155), soft[k])
                    colour = _mix(colour, (0.52, 0.40, 0.29), 0.5 * vein)
                else:
                    colour = _mix((0.60, 0.52, 0.41), (0.70, 0.63, 0.52), soft[k])
                    colour = _mix(colour, (0.42, 0.33, 0.24), 0.55 * vein)
                self.colours.append([c * (0.45 + 0.55 * face) for c in colour])
                self.heights.append(2.0 * face)
                self.roughness.append(0.85 + (0.24 + 0.28 * soft[k] - 0.85) * face)

    def colour(self):
        return _picture(self.size, self.size, 3, lambda x, y: _srgb(self.colours[y * self.size + x]))

    def normals(self):
        return normal_map(self.heights, self.size, self.size, 0.5)

    def surface(self):
        """Roughness in green, metalness (none) in blue, as glTF packs them."""
        return _picture(self.size, self.size, 3, lambda x, y: (0, to_byte(self.roughness[y * self.size + x]), 0))


def terracotta(size):
    """Six by six fired tiles."""
    stains = field(size, size, 6, 6, 4, 21)

    def pixel_at(x, y):
        u, v = 6 * x / size, 6 * y / size
        i, j = int(u), int(v)
        edge = min(u - i, 1 - u + i, v - j, 1 - v + j)
        tone = (0.5 + 0.5 * _smooth(0.01, 0.06, edge)) * (0.75 + 0.35 * hashed(i, j,
                22) + 0.3 * (stains[y * size + x] - 0.5))
        return _srgb([c * tone for c in _mix((0.42, 0.185, 0.095), (0.46, 0.25, 0.14), hashed(i, j, 23))])
    return _picture(size, size, 3, pixel_at)


def wood(size):
    """Four boards that run along the picture's width."""
    grain, slow = field(size, size, 3, 48, 3, 31), field(size, size, 2, 8, 2, 32)

    def pixel_at(x, y):
        board, place = divmod(4 * y / size, 1.0)
        gap = _smooth(0.0, 0.03, min(place, 1 - place))
        tone = (0.35 + 0.65 * gap) * (0.70 + 0.5 * grain[y * size + x] + 0.2 * hashed(int(board), 0, 33))
        return _srgb([c * tone for c in _mix((0.31, 0.17, 0.085), (0.40, 0.25, 0.14), slow[y * size + x])])
    return _picture(size, size, 3, pixel_at)


def damask(size):
    """A woven pattern in greys, to be dyed by the material's colour: an ogee net with a ring and a seed in each eye."""
    def pixel_at(x, y):
        s = abs(math.cos(2 * math.pi * x / size) + math.cos(2 * math.pi * y / size))
        net = 1 - _smooth(0.10, 0.16, s)
        ring = 1 - _smooth(0.12, 0.17, abs(s - 0.95))
        seed = _smooth(1.70, 1.76, s)
        weave = ((x + y) % 4 < 2) * 0.05 + ((x - y) % 4 < 2) * 0.03
        return (_SRGB[int(4096 * (0.62 + 0.30 * max(net, ring, seed) + weave))],)
    return _picture(size, size, 1, pixel_at)


def frond(width, height):
    """A feathered leaf with alpha: the stem stands in the middle, its foot at the bottom. Does not repeat."""
    grain = field(width, height, 8, 24, 2, 41)

    def pixel_at(x, y):
        across, up = 2 * (x + 0.5) / width - 1, 1 - (y + 0.5) / height
        reach = 0.97 * min(1.0, 3.2 * up + 0.05) * (1 - up ** 3)  # how far leaflets stretch at this height
        side = abs(across)
        leaflet = (up - 0.16 * side) * 17 + (0.5 if across > 0 else 0.0)
        middle = abs(leaflet - math.floor(leaflet) - 0.5)
        solid = side < reach and middle < 0.44 * (1 - (side / max(reach, 0.01)) ** 3) or side < 0.035 * (1.1 - up)
        tone = 0.75 + 0.5 * grain[y * width + x] - 0.5 * (middle < 0.05) * 0.5
        colour = _srgb([c * tone for c in _mix((0.075, 0.17, 0.035), (0.16, 0.27, 0.06), up)])
        return colour + [255 if solid and up < 0.985 else 0]
    return _picture(width, height, 4, pixel_at)


def lattice(size):
    """Wrought iron with alpha: crossing bars, a ring where they meet."""
    def pixel_at(x, y):
        u, v = (x + 0.5) / size, (y + 0.5) / size
        crossing = min(abs((u + v) % 1.0 - 0.5), abs((u - v) % 1.0 - 0.5))  # bars through the sides' middles
        ring = abs(math.hypot(u - 0.5, v - 0.5) - 0.21)
        corner = abs(math.hypot(min(u, 1 - u), min(v, 1 - v)) - 0.21)
        bars = min(u, 1 - u)
        solid = crossing < 0.030 or ring < 0.034 or corner < 0.034 or bars < 0.028
        return _srgb((0.055, 0.05, 0.047)) + [255 if solid else 0]
    return _picture(size, size, 4, pixel_at)


class Bronze:
    """Cast bronze that has gone green in places. Colour, and roughness with metalness."""

    def __init__(self, size):
        self.size = size
        self.patina = [_smooth(0.52, 0.66, value) for value in field(size, size, 5, 5, 5, 51)]
        self.wear = field(size, size, 24, 24, 3, 52)

    def colour(self):
        def pixel_at(x, y):
            k = y * self.size + x
            return _srgb(_mix((0.70, 0.42, 0.17), (0.16, 0.30, 0.235), 0.85 * self.patina[k]))
        return _picture(self.size, self.size, 3, pixel_at)

    def surface(self):
        """Roughness in green, metalness in blue, as glTF packs them."""
        def pixel_at(x, y):
            k = y * self.size + x
            return (0, to_byte(0.22 + 0.16 * self.wear[k] + 0.45 * self.patina[k]), to_byte(1 - 0.9 * self.patina[k]))
        return _picture(self.size, self.size, 3, pixel_at)


def canvas(width, height):
    """An abstract painting: hills of colour under a pale sky. Does not repeat."""
    ridges, strokes = field(width, height, 4, 3, 3, 61), field(width, height, 24, 6, 3, 62)
    layers = ((0.62, 0.70, 0.74), (0.74, 0.55, 0.30), (0.60, 0.22, 0.10), (0.20, 0.24, 0.30), (0.05, 0.09, 0.16))

    def pixel_at(x, y):
        k = y * width + x
        place = y / height * 5.2 + 2.2 * (ridges[k] - 0.5) + 0.5 * (strokes[k] - 0.5)
        index = max(0, min(4, int(place)))
        return _srgb([c * (0.8 + 0.4 * strokes[k]) for c in layers[index]])
    return _picture(width, height, 3, pixel_at)


def stained_glass(width, height):
    """Panes of coloured light between dark leads, brighter toward the middle. Does not repeat."""
    cell = 32
    glass = ((1.0, 0.16, 0.05), (0.08, 0.30, 1.0), (1.0, 0.66, 0.12), (0.10, 0.75, 0.30), (0.85, 0.80, 0.70),
             (0.55, 0.08, 0.75))

    def pixel_at(x, y):
        near = []
        for j in range(y // cell - 1, y // cell + 2):
            for i in range(x // cell - 1, x // cell + 2):
                dx = (i + 0.15 + 0.7 * hashed(i + 64, j + 64, 71)) * cell - x
                dy = (j + 0.15 + 0.7 * hashed(i + 64, j + 64, 72)) * cell - y
                near.append((dx * dx + dy * dy, i, j))
        near.sort()
        lead = math.sqrt(near[1][0]) - math.sqrt(near[0][0]) < 2.6
        colour = glass[int(6 * hashed(near[0][1] + 64, near[0][2] + 64, 73))]
        return (0, 0, 0) if lead else _srgb([c * (0.65 + 0.35 * hashed(near[0][1] + 64, near[0][2] + 64,
                74)) for c in colour])
    return _picture(width, height, 3, pixel_at)
