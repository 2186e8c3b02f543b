"""A triangle surface under construction: positions, normals, texture coordinates, indices.

Counter-clockwise is the side its normals point to: `triangle` turns the corners when they are given the other way
round, and leaves out triangles without area (the poles of a turned shape).
"""

from .vector import add, cross, dot, length, normalised, rotate, sub


class Surface:
    def __init__(self, has_uv=True):
        self.has_uv = has_uv
        self.positions, self.normals, self.uvs, self.indices = [], [], [], []

    def vertex(self, position, normal, uv=(0.0, 0.0)):
        self.positions.append(position)
        self.normals.append(normal)
        self.uvs.append(uv)
        return len(self.positions) - 1

    def triangle(self, a, b, c):
        p, q, r = (self.positions[i] for i in (a, b, c))
        across = cross(sub(q, p), sub(r, p))
        if length(across) < 1e-9:
            return
        facing = sum(dot(across, self.normals[i]) for i in (a, b, c))
        self.indices += (a, b, c) if facing > 0 else (a, c, b)

    def flat_triangle(self, corners, uvs=((0, 0), (1, 0), (1, 1))):
        """A triangle with its own geometric normal."""
        normal = normalised(cross(sub(corners[1], corners[0]), sub(corners[2], corners[0])))
        self.triangle(*(self.vertex(corner, normal, uv) for corner, uv in zip(corners, uvs)))

    def quad(self, corners, normal, uvs=((0, 1), (1, 1), (1, 0), (0, 0))):
        a, b, c, d = (self.vertex(corner, normal, uv) for corner, uv in zip(corners, uvs))
        self.triangle(a, b, c)
        self.triangle(a, c, d)

    def grid(self, columns, rows, vertex_at):
        """A sheet of columns x rows cells; vertex_at(i, j) gives (position, normal, uv)."""
        first = len(self.positions)
        for j in range(rows + 1):
            for i in range(columns + 1):
                self.vertex(*vertex_at(i, j))
        for j in range(rows):
            for i in range(columns):
                a = first + j * (columns + 1) + i
                d = a + columns + 1
                self.triangle(a, a + 1, d + 1)
                self.triangle(a, d + 1, d)

    def append(self, other, offset=(0.0, 0.0, 0.0), rotation=(0.0, 0.0, 0.0, 1.0)):
        """A copy of `other`, turned and then moved."""
        first = len(self.positions)
        self.positions += [add(rotate(rotation, p), offset) for p in other.positions]
        self.normals += [rotate(rotation, n) for n in other.normals]
        self.uvs += other.uvs
        self.indices += [first + i for i in other.indices]
        return self

    def triangle_count(self):
        return len(self.indices) // 3
