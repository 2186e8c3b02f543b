"""Noise that is the same everywhere: an integer hash, and fields of it that repeat at their edges."""


def hashed(x, y=0, seed=0):
    """A share in [0, 1) from two integers."""
    h = (x * 0x9E3779B1 ^ y * 0x85EBCA77 ^ seed * 0xC2B2AE3D) & 0xFFFFFFFF
    h = ((h ^ (h >> 16)) * 0x7FEB352D) & 0xFFFFFFFF
    h = ((h ^ (h >> 15)) * 0x846CA68B) & 0xFFFFFFFF
    return (h ^ (h >> 16)) / 4294967296.0


def _weights(size, cells):
    """For each pixel along one side: the two lattice columns around it and how far it is to the second."""
    result = []
    for pixel in range(size):
        place = (pixel + 0.5) * cells / size
        cell = int(place)
        t = place - cell
        result.append((cell % cells, (cell + 1) % cells, t * t * (3 - 2 * t)))
    return result


def field(width, height, cells_x, cells_y, octaves=4, seed=0):
    """width x height values in [0, 1], row by row: `octaves` layers of value noise, each twice as fine and half as
    strong."""
    total = [0.0] * (width * height)
    strength, sum_of_strengths = 1.0, 0.0
    for octave in range(octaves):
        lattice = [[hashed(i, j, seed * 31 + octave) for i in range(cells_x)] for j in range(cells_y)]
        columns = _weights(width, cells_x)
        place = 0
        for j0, j1, t in _weights(height, cells_y):
            row = [a + (b - a) * t for a, b in zip(lattice[j0], lattice[j1])]
            for i0, i1, s in columns:
                total[place] += strength * (row[i0] + (row[i1] - row[i0]) * s)
                place += 1
        sum_of_strengths += strength
        strength *= 0.5
        cells_x, cells_y = min(cells_x * 2, width), min(cells_y * 2, height)
    return [value / sum_of_strengths for value in total]
