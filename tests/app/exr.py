"""A minimal OpenEXR writer (one part, scan lines, floats, uncompressed): for files that the program would not write."""

import struct


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
