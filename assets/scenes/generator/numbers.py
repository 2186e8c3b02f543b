"""Rounding that gives the same digits on every machine.

Sines and powers may differ in the last bit from one C library to the next. Everything that reaches a file is therefore
rounded, and the rounding point is put off the tie (0.4863 instead of 0.5), where neat numbers never lie.
"""

import math

_OFF_TIE = 0.4863


def rounded(value, digits=6):
    """`value` rounded to `digits` decimals; never -0."""
    scale = 10 ** digits
    return math.floor(value * scale + _OFF_TIE) / scale + 0.0


def to_byte(value):
    """A share in [0, 1] as an integer in [0, 255], clamped."""
    return max(0, min(255, math.floor(value * 255.0 + _OFF_TIE)))


def tidy(value):
    """`value` for JSON: floats rounded to seven decimals, whole ones as integers; lists and dictionaries in depth."""
    if isinstance(value, float):
        short = rounded(value, 7)
        return int(short) if short == int(short) else short
    if isinstance(value, (list, tuple)):
        return [tidy(item) for item in value]
    if isinstance(value, dict):
        return {key: tidy(item) for key, item in value.items()}
    return value
