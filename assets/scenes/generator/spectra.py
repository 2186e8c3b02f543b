"""From measured spectra to linear sRGB: CIE 1931 2-degree colour matching functions and illuminant D65, every 10 nm.

Source of both tables: CIE 15, Colorimetry. Spectra run from 400 to 700 nm, as those of the Cornell box do.
"""

_FIRST_NM, _STEP_NM = 400, 10

_X_BAR = (0.01431, 0.04351, 0.13438, 0.2839, 0.34828, 0.3362, 0.2908, 0.19536, 0.09564, 0.03201, 0.0049, 0.0093,
          0.06327,
          0.1655, 0.2904, 0.43345, 0.5945, 0.7621, 0.9163, 1.0263, 1.0622, 1.0026, 0.85445, 0.6424, 0.4479, 0.2835,
          0.1649, 0.0874, 0.04677, 0.0227, 0.011359)
_Y_BAR = (0.000396, 0.00121, 0.004, 0.0116, 0.023, 0.038, 0.06, 0.09098, 0.13902, 0.20802, 0.323, 0.503, 0.71, 0.862,
          0.954, 0.99495, 0.995, 0.952, 0.87, 0.757, 0.631, 0.503, 0.381, 0.265, 0.175, 0.107, 0.061, 0.032, 0.017,
          0.00821, 0.004102)
_Z_BAR = (0.06785, 0.2074, 0.6456, 1.3856, 1.74706, 1.77211, 1.6692, 1.28764, 0.81295, 0.46518, 0.272, 0.1582, 0.07825,
          0.04216, 0.0203, 0.00875, 0.0039, 0.0021, 0.00165, 0.0011, 0.0008, 0.00034, 0.00019, 0.00005, 0.00002, 0.0,
          0.0, 0.0, 0.0, 0.0, 0.0)
_D65 = (82.7549, 91.486, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923, 108.811, 109.354, 107.802,
        104.79,
        107.689, 104.405, 104.046, 100.0, 96.3342, 95.788, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992,
        80.0268,
        80.2146, 82.2778, 78.2842, 69.7213, 71.6091)

# IEC 61966-2-1, XYZ (white D65, Y = 1) to linear sRGB
_TO_SRGB = ((3.2404542, -1.5371385, -0.4985314), (-0.9692660, 1.8760108, 0.0415560), (0.0556434, -0.2040259, 1.0572252))


def _at(table, nm):
    place = (nm - _FIRST_NM) / _STEP_NM
    index = min(int(place), len(table) - 2)
    return table[index] + (table[index + 1] - table[index]) * (place - index)


def interpolated(samples, nm):
    """A spectrum given as rising (nm, value) pairs, linear between them."""
    for (x0, y0), (x1, y1) in zip(samples, samples[1:]):
        if x0 <= nm <= x1:
            return y0 + (y1 - y0) * (nm - x0) / (x1 - x0)
    raise ValueError("%g nm is outside the spectrum" % nm)


def _integrate(spectrum):
    """XYZ of spectrum(nm), trapezoids of 4 nm (the Cornell box's own spacing); Y of an equal-energy spectrum of 1
    is 1."""
    total, luminous = [0.0, 0.0, 0.0], 0.0
    for nm in range(400, 701, 4):
        weight = 0.5 if nm in (400, 700) else 1.0
        value = spectrum(nm) * weight
        for i, bar in enumerate((_X_BAR, _Y_BAR, _Z_BAR)):
            total[i] += value * _at(bar, nm)
        luminous += weight * _at(_Y_BAR, nm)
    return [component / luminous for component in total]


def _linear_srgb(xyz):
    return [sum(m * c for m, c in zip(row, xyz)) for row in _TO_SRGB]


def albedo(samples):
    """Linear sRGB of a reflectance under D65; a perfect reflector gives exactly (1, 1, 1). Negative parts are cut."""
    seen = _linear_srgb(_integrate(lambda nm: interpolated(samples, nm) * _at(_D65, nm)))
    white = _linear_srgb(_integrate(lambda nm: _at(_D65, nm)))
    return tuple(max(0.0, s / w) for s, w in zip(seen, white))


def radiance(samples):
    """Linear sRGB of an emission spectrum, scaled so that an equal-energy spectrum of 1 has luminance 1. Negative
    parts are cut."""
    return tuple(max(0.0, c) for c in _linear_srgb(_integrate(lambda nm: interpolated(samples, nm))))
