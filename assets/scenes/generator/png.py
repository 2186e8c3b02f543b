"""PNG, encoded here because the bytes that zlib makes depend on its version.

The whole picture takes the one filter of PNG's five that codes shortest, and is stored as one deflate block (RFC
1951) of literals under a Huffman code made for it.
"""

import math
import struct
import zlib  # for its checksums only

_COLOUR_TYPE = {1: 0, 3: 2, 4: 6}
_END_OF_BLOCK = 256


class Picture:
    """8 bits a channel; row 0 at the top; 1 (grey), 3 (RGB) or 4 (RGBA) channels."""

    def __init__(self, width, height, channels, pixels):
        assert len(pixels) == width * height * channels
        self.width, self.height, self.channels, self.pixels = width, height, channels, bytes(pixels)


def encode(picture):
    """The bytes of a PNG file."""
    best = min((_filtered(picture, kind) for kind in range(5)), key=_coded_size)
    stream = b"\x78\x01" + _deflate(best) + struct.pack(">I", zlib.adler32(best))
    header = struct.pack(">IIBBBBB", picture.width, picture.height, 8, _COLOUR_TYPE[picture.channels], 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) + _chunk(b"IDAT", stream) + _chunk(b"IEND", b"")


def _chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _filtered(picture, kind):
    """Rows led by their filter type, and as differences from: 0 nothing, 1 the pixel to the left, 2 the one above, 3 the mean of
    these, 4 whichever of left, above and above left is nearest to left + above - above left (Paeth)."""
    stride, step = picture.width * picture.channels, picture.channels
    above, result = bytes(stride), bytearray()
    for start in range(0, len(picture.pixels), stride):
        row = picture.pixels[start:start + stride]
        left, corner = bytes(step) + row[:-step], bytes(step) + above[:-step]
        before = {0: lambda: bytes(stride), 1: lambda: left, 2: lambda: above,
                  3: lambda: bytes((a + b) // 2 for a, b in zip(left, above)),
                  4: lambda: bytes(map(_paeth, left, above, corner))}[kind]()
        result.append(kind)
        result += bytes((a - b) & 255 for a, b in zip(row, before))
        above = row
    return bytes(result)


def _paeth(left, above, corner):
    guess = left + above - corner
    return min((abs(guess - left), 0, left), (abs(guess - above), 1, above), (abs(guess - corner), 2, corner))[2]


def _counts(data):
    return [data.count(value) for value in range(256)] + [1]


def _coded_size(data):
    return sum(-count * math.log2(count / len(data)) for count in _counts(data)[:256] if count)


def _code_lengths(counts, limit=15):
    """Lengths of the best prefix code with no length above `limit`, by package-merge (Larmore and Hirschberg 1990)."""
    leaves = sorted((count, (symbol,)) for symbol, count in enumerate(counts) if count)
    merged = []
    for _ in range(limit):
        row = sorted(leaves + merged)
        merged = [(a[0] + b[0], a[1] + b[1]) for a, b in zip(row[0::2], row[1::2])]
    lengths = [0] * len(counts)
    for _, symbols in merged[:len(leaves) - 1]:
        for symbol in symbols:
            lengths[symbol] += 1
    return lengths


def _codes(lengths):
    """Canonical codes with their bits reversed, as deflate packs them."""
    codes, code = [0] * len(lengths), 0
    for length in range(1, 16):
        code <<= 1
        for symbol, own in enumerate(lengths):
            if own == length:
                codes[symbol] = int(format(code, "0%db" % length)[::-1], 2)
                code += 1
    return codes


def _deflate(data):
    lengths = _code_lengths(_counts(data))
    codes = _codes(lengths)
    pieces = [(1, 1), (2, 2), (0, 5), (0, 5), (15, 4)]  # last block, dynamic code; 257 literals, 1 distance, 19 lengths
    # the code for code lengths: 0 … 15 take four bits each, the repeats 16 … 18 (which come first in its order) none
    pieces += [(0, 3)] * 3 + [(4, 3)] * 16
    nibbles = _codes([4] * 16)
    pieces += [(nibbles[length], 4) for length in lengths + [0]]
    pieces += [(codes[value], lengths[value]) for value in data]
    pieces.append((codes[_END_OF_BLOCK], lengths[_END_OF_BLOCK]))
    return _packed(pieces)


def _packed(pieces):
    result, register, filled = bytearray(), 0, 0
    for code, length in pieces:
        register |= code << filled
        filled += length
        while filled >= 8:
            result.append(register & 255)
            register >>= 8
            filled -= 8
    if filled:
        result.append(register)
    return bytes(result)
