#!/usr/bin/env python3
"""Pictures of the window for app/README.md, as it opens: tests/app/make_screens.py [--program build/bounce] [NAME…]

Each is of a display of its own. `double` is what a person sees on a screen with twice the pixels."""

import argparse
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import window_driver

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCREENS = {"small": ((1280, 720), 1), "large": ((1600, 1000), 1), "double": ((1600, 1000), 2)}


def write_png(path, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    width, height = len(rows[0]), len(rows)
    lines = [b"".join(pixel[2::-1] for pixel in row) for row in rows]  # the screen has blue first
    # Each byte less the one above it: flat areas and columns become zeros.
    above = [bytes(3 * width), *lines[:-1]]
    data = b"".join(b"\2" + bytes((a - b) & 255 for a, b in zip(line, over)) for line, over in zip(lines, above))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b""))


def take(program, name, folder):
    size, scale = SCREENS[name]
    window_driver.SIZE = size
    display = window_driver.Display()
    try:
        state = folder / "state/bounce/window.json"
        state.parent.mkdir(parents=True)
        state.write_text(json.dumps({"version": 1, "interface_scale": scale}))
        dump = folder / "dump.json"
        environment = dict(os.environ, DISPLAY=display.name, XDG_STATE_HOME=str(folder / "state"), BOUNCE_ROOT=str(ROOT))
        environment.pop("WAYLAND_DISPLAY", None)
        window = subprocess.Popen([program, "view", "atrium", "--graph", "lrsm_tuned", "--window", "%dx%d" % size, "--dump-ui", str(dump)],
                                  env=environment, cwd=folder)
        try:
            end, still = time.monotonic() + 1800, 0
            while time.monotonic() < end:  # until all that is shown is measured
                if window.poll() is not None:
                    sys.exit(f"the program ended with {window.returncode}")
                try:
                    told = json.loads(dump.read_text())
                    rests = told["times"]["current"] and told["rendered"] >= 2 and not told["mid_frame"]
                    still = still + 1 if rests else 0
                    if still > 6:
                        break
                except (FileNotFoundError, json.JSONDecodeError):
                    pass
                time.sleep(0.5)
            write_png(ROOT / f"assets/readme/window_{name}.png", display.pixels(0, 0, *size))
        finally:
            window.terminate()
            window.wait(60)
    finally:
        display.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=str(ROOT / "build/bounce"))
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(SCREENS)}; all without")
    options = parser.parse_args()
    for name in options.names or SCREENS:
        if name not in SCREENS:
            parser.error(f"invalid name '{name}': expected one of {', '.join(SCREENS)}")
        with tempfile.TemporaryDirectory(prefix="bounce_screens_") as folder:
            take(str(pathlib.Path(options.program).resolve()), name, pathlib.Path(folder))


if __name__ == "__main__":
    main()
