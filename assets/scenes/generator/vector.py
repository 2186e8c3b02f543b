"""Three-component vectors as tuples, and rotations as glTF writes them (quaternions x, y, z, w)."""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def normalised(a):
    return scale(a, 1.0 / length(a))


def about_axis(axis, degrees):
    """The quaternion of a turn by `degrees` about `axis` (counter-clockwise when the axis points at the viewer)."""
    half = math.radians(degrees) / 2
    x, y, z = scale(normalised(axis), math.sin(half))
    return (x, y, z, math.cos(half))


def rotate(q, v):
    """`v` turned by the quaternion `q`."""
    axis = (q[0], q[1], q[2])
    t = scale(cross(axis, v), 2.0)
    return add(add(v, scale(t, q[3])), cross(axis, t))


def looking_along(direction, up=(0.0, 1.0, 0.0)):
    """The quaternion that turns -Z (the way glTF's cameras and lights look) into `direction`, with +Y toward `up`."""
    back = normalised(scale(direction, -1.0))
    if abs(dot(back, normalised(up))) > 0.999:
        up = (0.0, 0.0, 1.0)
    right = normalised(cross(up, back))
    top = cross(back, right)
    trace = right[0] + top[1] + back[2]
    if trace > 0:
        s = math.sqrt(trace + 1.0) * 2
        q = ((top[2] - back[1]) / s, (back[0] - right[2]) / s, (right[1] - top[0]) / s, s / 4)
    elif right[0] > top[1] and right[0] > back[2]:
        s = math.sqrt(1.0 + right[0] - top[1] - back[2]) * 2
        q = (s / 4, (top[0] + right[1]) / s, (back[0] + right[2]) / s, (top[2] - back[1]) / s)
    elif top[1] > back[2]:
        s = math.sqrt(1.0 + top[1] - right[0] - back[2]) * 2
        q = ((top[0] + right[1]) / s, s / 4, (back[1] + top[2]) / s, (back[0] - right[2]) / s)
    else:
        s = math.sqrt(1.0 + back[2] - right[0] - top[1]) * 2
        q = ((back[0] + right[2]) / s, (back[1] + top[2]) / s, s / 4, (right[1] - top[0]) / s)
    return q
