#!/usr/bin/env python3
"""Makes every built-in scene again, byte for byte.

    make_scenes.py [--check] [NAME ...]

Without names: all of them. --check makes them in memory, compares them with the files beside this script, and ends
with 1 and a list when any differs. Python's standard library is all it needs.
"""

import argparse
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True

from generator import animated, atrium, cornell, gallery, hairball, strip  # noqa: E402  (the path must be set first)

SCENES = {
    "cornell": cornell.cornell,
    "cornell_lamp": cornell.cornell_lamp,
    "atrium": atrium.atrium,
    "gallery": gallery.gallery,
    "animated": animated.animated,
    "hairball": hairball.hairball,
    "strip_room": strip.strip_room,
    "strip": strip.strip,
}


def write(path, data):
    """Aside first, then renamed: a reader never sees half a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    aside = path.with_name(path.name + ".part")
    aside.write_bytes(data)
    aside.replace(path)


def main():
    parser = argparse.ArgumentParser(description="Makes every built-in scene again, byte for byte.")
    parser.add_argument("--check", action="store_true", help="compare instead of writing; 1 when any file differs")
    parser.add_argument("names", nargs="*", metavar="NAME", help="of: " + ", ".join(SCENES))
    arguments = parser.parse_args()
    unknown = [name for name in arguments.names if name not in SCENES]
    if unknown:
        print("make_scenes: no scene named %s; there are: %s" % (", ".join(unknown), ", ".join(SCENES)),
              file=sys.stderr)
        return 2

    different = []
    for name in arguments.names or SCENES:
        for relative, data in SCENES[name]().files().items():
            path = HERE / relative
            if path.is_file() and path.read_bytes() == data:
                continue
            different.append(relative)
            if not arguments.check:
                write(path, data)
                print("wrote %s (%d bytes)" % (relative, len(data)))
    if arguments.check and different:
        print("differ from what make_scenes.py makes: " + ", ".join(different), file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
