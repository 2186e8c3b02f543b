"""The real program, as tests run it: its own root where files are edited, and what it says."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(os.environ.get("BOUNCE_ROOT") or pathlib.Path(__file__).resolve().parents[2])
PROGRAM = os.environ.get("BOUNCE_PROGRAM", str(ROOT / "build" / "bounce"))
LIMIT = 600 if os.environ.get("BOUNCE_SANITIZE") == "ON" else 120  # seconds of a command, also on a machine that is busy

TINY_SHOT = """{"scene": "cornell.gltf", "width": 48, "height": 48,
 "camera": {"position": [2.78, 2.73, -8], "target": [2.78, 2.73, 0], "vfov_deg": 39.3}}"""
SMALL = ["--set", "shadow_maps.resolution=64"]


class ProgramTest(unittest.TestCase):
    """Each test has a folder, and in `root` copies of the shaders and graphs."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="bounce_test_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.root = self.folder / "root"
        shutil.copytree(ROOT / "glsl", self.root / "glsl")
        shutil.copytree(ROOT / "assets" / "graphs", self.root / "assets" / "graphs")
        (self.root / "assets" / "scenes").symlink_to(ROOT / "assets" / "scenes")
        (self.root / "assets" / "shots").symlink_to(ROOT / "assets" / "shots")
        (self.root / "assets" / "pages").symlink_to(ROOT / "assets" / "pages")
        self.shot = self.folder / "tiny.json"
        self.shot.write_text(TINY_SHOT)
        self.out = self.folder / "out"
        self.out.mkdir()

    def environment(self):
        return dict(os.environ, BOUNCE_ROOT=str(self.root))

    def run_program(self, *arguments, stdout_file=subprocess.PIPE, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], env=self.environment(), cwd=self.out,
                              stdout=stdout_file, stderr=subprocess.PIPE, text=True, timeout=LIMIT, **options)

    def start_program(self, *arguments):
        """Starts it and goes on; what it says goes to the file `said`."""
        with open(self.folder / "said", "w") as said:
            process = subprocess.Popen([PROGRAM, *map(str, arguments)], env=self.environment(), cwd=self.out,
                                       stdout=said, stderr=said)
        self.addCleanup(self.stop, process)
        return process

    @staticmethod
    def stop(process):
        if process.poll() is None:
            process.kill()
        process.wait()

    def assert_refused(self, result, *words, leaves=()):
        """Exit code 2, one message with these words on stderr, and nothing written but `leaves`."""
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertEqual(len(re.findall(r"^error: ", result.stderr, re.MULTILINE)), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(sorted(path.name for path in self.out.iterdir()), sorted(leaves), "files were left behind")

    def assert_good(self, result):
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def edit(self, name, old, new):
        """Replaces text in a file of the root, in place."""
        path = self.root / name
        text = path.read_text()
        self.assertIn(old, text)
        path.write_text(text.replace(old, new, 1))


def png_pixel(path, x, y):
    """The 8-bit RGB of one pixel of a PNG."""
    import struct
    import zlib
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, _, colour = struct.unpack(">IIBB", body[:10])
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    channels = {2: 3, 6: 4}[colour]
    raw = zlib.decompress(packed)
    stride = width * channels
    previous = bytearray(stride)
    for row in range(height):
        start = row * (stride + 1)
        kind, line = raw[start], bytearray(raw[start + 1:start + 1 + stride])
        for i in range(stride):
            left = line[i - channels] if i >= channels else 0
            up, corner = previous[i], previous[i - channels] if i >= channels else 0
            guess = left + up - corner
            paeth = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            line[i] = (line[i] + (0, left, up, (left + up) // 2, paeth)[kind]) & 255
        if row == y:
            return tuple(line[x * channels:x * channels + 3])
        previous = line
    raise IndexError(y)


def exr_header(path):
    """Channel names, and text attributes by name, of an OpenEXR file of one part."""
    import struct
    data = path.read_bytes()
    assert data[:4] == b"\x76\x2f\x31\x01"
    at, channels, texts = 8, [], {}
    while data[at] != 0:
        name, kind = [], []
        for part in (name, kind):
            end = data.index(b"\0", at)
            part.append(data[at:end].decode())
            at = end + 1
        size = struct.unpack("<i", data[at:at + 4])[0]
        body = data[at + 4:at + 4 + size]
        at += 4 + size
        if kind[0] == "chlist":
            start = 0
            while body[start] != 0:
                end = body.index(b"\0", start)
                channels.append(body[start:end].decode())
                start = end + 1 + 16
        elif kind[0] == "string":
            texts[name[0]] = body.decode()
    return channels, texts
