"""A minimal OpenEXR writer (one part, scan lines, floats, uncompressed) for files that the program would not write, and a reader of
those that it does."""

import array
import itertools
import struct
import zlib


def write_exr(path, width, height, channels, texts=None, data_at=(0, 0), display=None):
    """`channels`: values in row order by channel name. `texts`: string attributes. The data window begins at `data_at`; `display`: the
    first and last pixel of the display window (x0, y0, x1, y1), else the data window."""
    def attribute(name, kind, body):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(body)) + body

    names = sorted(channels)
    listed = b"".join(name.encode() + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for name in names) + b"\0"
    x0, y0 = data_at
    box = struct.pack("<4i", x0, y0, x0 + width - 1, y0 + height - 1)
    shown = struct.pack("<4i", *display) if display else box
    header = struct.pack("<ii", 20000630, 2)
    header += attribute("channels", "chlist", listed) + attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", shown)
    header += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    for name, text in (texts or {}).items():
        header += attribute(name, "string", text.encode())
    header += b"\0"
    rows = []
    for y in range(height):
        row = b"".join(struct.pack(f"<{width}f", *channels[name][y * width:(y + 1) * width]) for name in names)
        rows.append(struct.pack("<ii", y0 + y, len(row)) + row)
    first = len(header) + 8 * height
    offsets = b"".join(struct.pack("<Q", first + y * len(rows[0])) for y in range(height))
    path.write_bytes(header + offsets + b"".join(rows))


def read_exr(path):
    """Width, height, values in row order by channel name, and text attributes by name, of a file that Bounce wrote: one part,
    scan lines, floats, ZIP."""
    data = path.read_bytes()
    assert data[:4] == b"\x76\x2f\x31\x01", f"{path} is not OpenEXR"
    at, names, texts = 8, [], {}
    while data[at] != 0:
        end = data.index(b"\0", at)
        kind_end = data.index(b"\0", end + 1)
        name, kind = data[at:end].decode(), data[end + 1:kind_end].decode()
        size, = struct.unpack_from("<i", data, kind_end + 1)
        body = data[kind_end + 5:kind_end + 5 + size]
        at = kind_end + 5 + size
        if kind == "chlist":
            names = _channels(body)
        elif kind == "string":
            texts[name] = body.decode()
        elif name == "dataWindow":
            x0, y0, x1, y1 = struct.unpack("<4i", body)
        elif name == "compression":
            assert body in (b"\0", b"\3"), f"{path}: compression {body[0]}"
            lines_of_a_chunk = 16 if body == b"\3" else 1
    width, height = x1 - x0 + 1, y1 - y0 + 1
    channels = {name: array.array("f", bytes(4 * width * height)) for name in names}
    chunks = -(-height // lines_of_a_chunk)
    for start in struct.unpack_from(f"<{chunks}Q", data, at + 1):
        first, size = struct.unpack_from("<ii", data, start)
        rows = min(lines_of_a_chunk, height - (first - y0))
        values = array.array("f", _unpacked(data[start + 8:start + 8 + size], 4 * width * rows * len(names)))
        for row in range(rows):
            for i, name in enumerate(names):
                begin = (row * len(names) + i) * width
                to = (first - y0 + row) * width
                channels[name][to:to + width] = values[begin:begin + width]
    return width, height, channels, texts


def _channels(body):
    names, at = [], 0
    while body[at] != 0:
        end = body.index(b"\0", at)
        assert struct.unpack_from("<i", body, end + 1)[0] == 2, "a channel that is not of floats"
        names.append(body[at:end].decode())
        at = end + 17
    return names


def _unpacked(chunk, size):
    """ZIP of OpenEXR: differences of bytes, of which the even ones come first. A chunk that would not shrink is as it is."""
    if len(chunk) == size:
        return chunk
    delta = zlib.decompress(chunk)
    mixed = bytes(itertools.accumulate(delta, lambda a, b: (a + b - 128) & 255))
    out = bytearray(size)
    half = (size + 1) // 2
    out[0::2], out[1::2] = mixed[:half], mixed[half:]
    return bytes(out)
