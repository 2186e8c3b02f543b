"""Files and command lines that mean harm, or that are wrong in every way: one message, exit code 2, soon, in little
memory, and nothing written."""

import base64
import json
import os
import pathlib
import resource
import struct
import subprocess
import unittest
import zlib

from program import PROGRAM, SMALL, ProgramTest

GIB = 1 << 30


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def black_png(side):
    """A real picture of side × side grey pixels of one bit, which deflate packs a thousandfold."""
    row = bytes(1 + side // 8)
    packer = zlib.compressobj(9)
    packed = b"".join(packer.compress(row) for _ in range(side)) + packer.flush()
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 1, 0, 0, 0, 0)) +
            chunk(b"IDAT", packed) + chunk(b"IEND", b""))


def triangle_gltf(**more):
    corners = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [{"byteLength": 36, "uri": "data:;base64," + base64.b64encode(corners).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]}],
    }
    document.update(more)
    return json.dumps(document)


class Hostile(ProgramTest):
    def run_bounded(self, *arguments, gib=2, seconds=30, **options):
        """Runs it with so much address space; returns the result. (A fraction of the time is what it should take.)"""
        def limit():
            if not os.environ.get("BOUNCE_SANITIZE") == "ON":  # shadow memory takes more than any limit
                resource.setrlimit(resource.RLIMIT_AS, (int(gib * GIB), int(gib * GIB)))
        return subprocess.run([PROGRAM, *map(str, arguments)], env=self.environment(), cwd=self.out,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=seconds,
                              preexec_fn=limit, **options)

    def write(self, name, text):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def refused(self, result, *words):
        self.assert_refused(result, *words)
        self.assertNotIn("json.exception", result.stderr)
        self.assertLess(len(result.stderr), 4000)


class Images(Hostile):
    def test_a_truncated_hdr(self):
        self.write("min.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n\x02\x02\x00\x08")
        shot = self.write("s.json", '{"scene": "cornell", "environment": {"map": "min.hdr"}}')
        for command in (("info", shot), ("render", shot, "-o", "x.png"), ("reference", shot, "-o", "x.exr")):
            self.refused(self.run_bounded(*command), "min.hdr", "the .hdr image is damaged", "it ends in row 0 of 1")
        self.refused(self.run_bounded("compare", self.folder / "min.hdr", self.folder / "min.hdr"), "min.hdr")

    def test_image_bombs(self):
        bomb = black_png(16384)  # 33 kB; 1 GiB when decoded
        uri = "data:image/png;base64," + base64.b64encode(bomb).decode()
        def materials(count):
            return dict(materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}} for i in range(count)],
                        textures=[{"source": i} for i in range(count)])
        scene = self.write("bomb.gltf", triangle_gltf(images=[{"uri": uri}] * 6, **materials(6)))
        self.refused(self.run_bounded("info", scene, gib=1), "6 textures: 1,610,612,736 pixels",
                     "expected at most 268,435,456 in all", "--max-texture")
        scene = self.write("budget.gltf", triangle_gltf(images=[{"uri": uri}], **materials(1)))
        self.refused(self.run_bounded("info", scene, "--max-texture", "4096x4096", gib=1), "1 textures: 268,435,456 pixels",
                     "expected at most 16,777,216")
        lie = bomb[:33] + bomb[-12:]
        scene = self.write("lie.gltf", triangle_gltf(
            images=[{"uri": "data:image/png;base64," + base64.b64encode(lie).decode()}], **materials(1)))
        self.refused(self.run_bounded("info", scene, gib=1), "images[0]", "invalid size 16384x16384", "do not fit in")
        picture = self.write("bomb.png", bomb)
        self.refused(self.run_bounded("compare", picture, picture, "--max-texture", "1024x1024", gib=1), "bomb.png")

    def test_a_window_of_an_exr_that_its_bytes_cannot_hold(self):
        def attribute(name, kind, value):
            return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value
        for side in (16384, 1 << 20, 1 << 30):
            window = struct.pack("<4i", 0, 0, side - 1, side - 1)
            header = (b"\x76\x2f\x31\x01" + struct.pack("<i", 2) +
                      attribute(b"channels", b"chlist", b"R\0" + struct.pack("<iB3xii", 2, 0, 1, 1) + b"\0") +
                      attribute(b"compression", b"compression", b"\0") + attribute(b"dataWindow", b"box2i", window) +
                      attribute(b"displayWindow", b"box2i", window) + attribute(b"lineOrder", b"lineOrder", b"\0") +
                      attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) +
                      attribute(b"screenWindowCenter", b"v2f", bytes(8)) +
                      attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0")
            file = self.write("bomb.exr", header)
            self.refused(self.run_bounded("compare", file, file, gib=1), "bomb.exr")


class References(Hostile):
    def test_only_relative_paths_to_regular_files(self):
        os.mkfifo(self.folder / "pipe")
        (self.folder / "zero").symlink_to("/dev/zero")
        for uri, word in (("/dev/zero", "absolute"), ("file:///etc/hostname", "scheme"), ("http://localhost/x", "scheme"),
                          ("pipe", "a pipe"), ("zero", "a device"), (".", "a folder"), ("..%2f..%2fdev%00", "NUL")):
            scene = self.write("x.gltf", triangle_gltf(buffers=[{"byteLength": 36, "uri": uri}]))
            self.refused(self.run_bounded("info", scene, gib=1, seconds=10), "buffers[0]", word, "expected")
            shot = self.write("s.json", json.dumps({"scene": "cornell", "environment": uri}))
            if "%" not in uri:
                self.refused(self.run_bounded("info", shot, gib=1, seconds=10), "environment", word, "expected")
        for argument in (self.folder / "pipe", "/dev/zero", self.folder / "zero"):
            self.refused(self.run_bounded("info", argument, gib=1, seconds=10), "expected a regular file")
            self.refused(self.run_bounded("compare", argument, argument, gib=1, seconds=10), "expected a regular file")
        os.rename(self.folder / "pipe", self.folder / "pipe.json")
        for command in (("render", "cornell", "--graph"), ("chart", "cornell", "-o", "c", "--sweep"), ("table",)):
            more = ("-o", "x.png") if command[0] == "render" else ()
            self.refused(self.run_bounded(*command, self.folder / "pipe.json", *more, seconds=10))

    def test_without_a_home(self):
        environment = {k: v for k, v in self.environment().items()
                       if k not in ("HOME", "XDG_CACHE_HOME", "XDG_STATE_HOME")}
        before = set(pathlib.Path("/tmp").glob("**/bounce"))
        result = subprocess.run([PROGRAM, "reference", str(self.shot), "--size", "8x8", "--spp", "2", "-o", "x.exr"],
                                env=environment, cwd=self.out, capture_output=True, text=True, timeout=120)
        self.assert_good(result)
        self.assertIn("neither XDG_CACHE_HOME nor HOME is set", result.stderr)
        self.assertTrue((self.out / "x.exr").exists())
        self.assertEqual(set(pathlib.Path("/tmp").glob("**/bounce")) - before, set())


class Streams(Hostile):
    """What is printed, and who reads it, never costs the picture."""

    def good_picture(self, code=0, **options):
        target = self.out / "x.png"
        result = subprocess.run([PROGRAM, "render", str(self.shot), *SMALL, "--size", "16x16", "-o", str(target)],
                                env=self.environment(), cwd=self.out, timeout=120, **options)
        self.assertEqual(result.returncode, code)
        self.assertEqual(target.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        target.unlink()

    def test_full_and_closed_streams(self):
        with open("/dev/full", "w") as full:
            self.good_picture(stderr=full)
            self.good_picture(stdout=full, stderr=full, code=2)  # the table is lost, and told by the code
        for closed in ((0,), (1,), (2,), (0, 1, 2)):
            self.good_picture(preexec_fn=lambda: [os.close(descriptor) for descriptor in closed])
        reader, writer = os.pipe()
        os.close(reader)
        self.good_picture(stdout=writer, stderr=writer)
        os.close(writer)

    def test_a_warning_to_a_full_stderr(self):
        environment = {k: v for k, v in self.environment().items()
                       if k not in ("HOME", "XDG_CACHE_HOME", "XDG_STATE_HOME")}  # so that there is one
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "reference", str(self.shot), "--size", "8x8", "--spp", "2", "-o", "x.exr"],
                                    env=environment, cwd=self.out, stdout=subprocess.DEVNULL, stderr=full, timeout=120)
        self.assertEqual(result.returncode, 0)
        self.assertTrue((self.out / "x.exr").exists())

    def test_a_refusal_to_a_full_stderr_keeps_its_code(self):
        with open("/dev/full", "w") as full:
            for arguments in (("info", "corneli"), ("render", "cornell", "--size", "x"), ("nonsense",)):
                result = subprocess.run([PROGRAM, *arguments], env=self.environment(), stderr=full, timeout=60)
                self.assertEqual(result.returncode, 2)

    def test_a_file_above_the_limit_on_sizes(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (200, 200))
        (self.out / "x.exr").write_bytes(b"old")
        result = self.run_program("render", self.shot, *SMALL, "-o", "x.exr", preexec_fn=limit)  # its signal ends programs
        self.assert_refused(result, "x.exr", "File too large", leaves=["x.exr"])
        self.assertEqual((self.out / "x.exr").read_bytes(), b"old")


class Sizes(Hostile):
    def test_outputs_are_judged_before_anything_is_rendered(self):
        (self.out / "taken.png").mkdir()
        os.mkfifo(self.folder / "pipe.png")
        for output, words in (("none/x.png", ["none"]), ("taken.png", ["it is a folder"]), ("x" * 300 + ".png", ["name too long"]),
                              ("x.jpg", ["x.jpg", ".exr or .png"]), ("", ["invalid --output ''"]),
                              ("x.png/", ["expected one that ends in"]), ("x_%q.png", ["x_%q.png", "%04d"]),
                              ("x_%d_%d.png", ["once"]), ("x_%99d.png", ["%04d"]), ("x_%-4d.png", ["%04d"]), ("%%.png", ["%04d"])):
            # At this size a frame takes minutes: only a check beforehand is in time.
            result = self.run_program("render", "cornell", "--size", "4096x4096", "--set", "shadow_maps.resolution=8192",
                                      "--frames", "3", "-o", output)
            self.assert_refused(result, *words, leaves=["taken.png"])
        result = self.run_program("reference", "cornell", "--spp", "1000000", "-o", "taken.png")
        self.assert_refused(result, "it is a folder", leaves=["taken.png"])

    def test_more_than_there_is_memory_for(self):
        if os.environ.get("BOUNCE_SANITIZE") == "ON":
            self.skipTest("the sanitizer's memory cannot be limited")
        result = self.run_bounded("render", "cornell", "--size", "16384x16384", "-o", "x.exr", gib=8)
        self.refused(result, "16384x16384", "are free", "lower")
        lights = [{"type": "point", "position": [i % 10, 1, i // 10]} for i in range(1000)]
        shot = self.write("lights.json", json.dumps({"scene": "cornell", "lights": lights}))
        self.refused(self.run_program("render", shot, "-o", "x.png"), "shadow.depth", "6,000 layers", "fewer lights")
        self.refused(self.run_program("reference", "cornell", "--size", "16384x16384", "--spp", "2", "-o", "x.exr"),
                     "16384x16384")

    def many_triangles(self, count):
        """A scene of so many flat triangles, from a file with a hole."""
        corners = 12 * 1000
        with open(self.folder / "big.bin", "wb") as file:
            file.truncate(corners + 12 * count)
        document = json.loads(triangle_gltf())
        document["buffers"] = [{"byteLength": corners + 12 * count, "uri": "big.bin"}]
        document["bufferViews"] = [{"buffer": 0, "byteLength": corners},
                                   {"buffer": 0, "byteOffset": corners, "byteLength": 12 * count}]
        document["accessors"] = [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1000, "min": [0, 0, 0],
                                  "max": [0, 0, 0]},
                                 {"bufferView": 1, "componentType": 5125, "type": "SCALAR", "count": 3 * count}]
        document["meshes"] = [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}]
        return self.write("big.gltf", json.dumps(document))

    def test_twenty_million_triangles(self):
        scene = self.many_triangles(20_000_000)
        for command in (("info", scene), ("render", scene, "-o", "x.png"), ("reference", scene, "-o", "x.exr")):
            self.refused(self.run_bounded(*command), "big.gltf", "20,000,000 triangles unfold to 60,000,000 vertices",
                         "expected at most 33,554,432", "smaller scene", "normals")

    def test_a_large_scene_in_little_memory(self):
        if os.environ.get("BOUNCE_SANITIZE") == "ON":
            self.skipTest("the sanitizer's memory cannot be limited")
        scene = self.many_triangles(3_000_000)
        self.refused(self.run_bounded("info", scene, gib=1), "3,000,000 triangles", "of memory, but", "are free", "smaller scene")


class CommandLines(Hostile):
    """Every option of every command with values that it cannot have."""

    NUMBERS = {
        ("render", "cornell", "-o", "x.png"): ["--frames", "--device"],
        ("reference", "cornell", "-o", "x.exr"): ["--spp", "--noise", "--frame", "--occlusion-distance", "--exposure",
                                                  "--seed", "--threads", "--bounces"],
        ("compare", "a.exr", "b.exr"): ["--heatmap-top", "--exposure", "--ppd", "--window"],
        ("chart", "cornell", "-o", "c"): ["--warmup", "--frames", "--noise", "--spp", "--device"],
        ("table", "lrsm"): ["--warmup", "--frames", "--device"],
        ("stability", "cornell"): ["--frames", "--fps", "--device"],
        ("view", "cornell"): ["--frames", "--device"],
    }
    SIZES = [("render", "cornell", "-o", "x.png"), ("reference", "cornell", "-o", "x.exr"), ("chart", "cornell", "-o", "c"),
             ("table", "lrsm"), ("stability", "cornell"), ("graph", "direct"), ("view", "cornell")]
    TEXTS = {
        ("render", "cornell", "-o", "x.png"): ["--graph", "--set", "--enable", "--disable", "--resource", "--timings"],
        ("reference", "cornell", "-o", "x.exr"): ["--resource", "--occlusion-falloff"],
        ("compare", "a.exr", "b.exr"): ["--resource", "--heatmap"],
        ("chart", "cornell", "-o", "c"): ["--graphs", "--sweep", "--set", "--shard", "--against", "--merge"],
        ("table", "lrsm"): ["--output"],
        ("stability", "cornell"): ["--graph", "--set", "--resource"],
        ("graph", "direct"): ["--shot", "--set"],
        ("shaders",): ["--expand"],
    }

    CHOICES = {
        ("render", "cornell", "-o", "x.png"): ["--material-model", "--shader-limit", "--limits"],
        ("reference", "cornell", "-o", "x.exr"): ["--material-model", "--occlusion-falloff"],
        ("chart", "cornell", "-o", "c"): ["--material-model", "--shader-limit", "--metric"],
        ("stability", "cornell"): ["--material-model", "--shader-limit"],
        ("view", "cornell"): ["--material-model", "--shader-limit"],
    }

    def bad(self, command, option, value):
        result = self.run_program(*command, *((f"{option}={value}",) if value else (option, "")))
        with self.subTest(command=command[0], option=option, value=value):
            self.refused(result, option.lstrip("-"))
            self.assertRegex(result.stderr, f"invalid {option} '.*': expected ", result.stderr)

    def test_numbers(self):
        for command, options in self.NUMBERS.items():
            for option in options:
                for value in ("nan", "inf", "-inf", "1e400", "-5" if option != "--exposure" else "-1e9", "99999999999999999999", "", "x", "0x10", "1,2"):
                    self.bad(command, option, value)

    def test_sizes(self):
        for command in self.SIZES:
            for value in ("", "x", "0x0", "-1x5", "64", "64x", "x64", "64x64x64", "64X64", "1e2x64", "99999x1", "1x16385",
                          "99999999999x1", " 64x64", "nanxnan"):
                self.bad(command, "--size", value)

    def test_sizes_of_the_window(self):
        for value in ("", "x", "99x100", "100x99", "0x0", "-1366x768", "1366", "1366x768x1", "99999x100", "nanxnan"):
            self.bad(("view", "cornell"), "--window", value)
        for value in ("0", "2", "-1", "10000000001", "1.5"):
            self.bad(("compare", "a.exr", "b.exr"), "--window", value)

    def test_choices(self):
        for command, options in self.CHOICES.items():
            for option in options:
                for value in ("", "nonsense", "PLAIN", " plain", "=1", "private_bytes", "private_bytes=", "private_bytes=0",
                              "private_bytes=-1", "private_bytes=1e9", "private_bytes=99999999999999999999", "x" * 5000):
                    self.bad(command, option, value)
        self.refused(self.run_program("render", "cornell", "-o", "x.png", "--material-model", "gltv"), "did you mean 'gltf'?")
        self.refused(self.run_program("chart", "cornell", "-o", "c", "--metric", "relative_rmze"), "did you mean 'relative_rmse'?")
        self.refused(self.run_program("render", "cornell", "-o", "x.png", "--shader-limit", "privat_bytes=5"),
                     "did you mean 'private_bytes'?")
        self.refused(self.run_program("graph", "direct", "--limits", "GL_MAX_IMAGE_UNIT=5"), "did you mean 'GL_MAX_IMAGE_UNITS'?")
        for command, name in (("completion", "shell"), ("list", "kind")):
            for value in ("", "bsh", "graph\n", "\x1b[31m", "x" * 5000):
                with self.subTest(command=command, value=value):
                    result = self.run_program(command, value)
                    self.refused(result, f"invalid {name} '", "expected ")
                    self.assertNotIn("\x1b", result.stderr)

        for command, options in self.TEXTS.items():
            for option in options:
                for value in ((f"{option}=",), (option, ""), (option,)):
                    with self.subTest(command=command[0], value=value):
                        result = self.run_program(*command, *value)
                        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
                        self.assertEqual(result.stderr.count("error: "), 1, result.stderr)
                        self.assertEqual(list(self.out.iterdir()), [])

    def test_text_that_is_no_utf8(self):
        bad = os.fsdecode(b"\xff\xfe\x1b[31m")
        for arguments in (("render", bad, "-o", "x.png"), ("render", "cornell", "--graph", bad, "-o", "x.png"),
                          ("render", "cornell", "--set", bad + "=1", "-o", "x.png"), ("info", bad), ("graph", bad),
                          ("render", "cornell", "--size", bad, "-o", "x.png"), ("params", bad), ("table", bad), ("new", "pass", bad)):
            result = subprocess.run([PROGRAM, *arguments], env=self.environment(), cwd=self.out, capture_output=True, timeout=60)
            with self.subTest(arguments=arguments[0]):
                self.assertEqual(result.returncode, 2)
                self.assertEqual(result.stderr.count(b"error: "), 1, result.stderr)
                self.assertNotIn(b"\x1b", result.stderr)
                result.stderr.decode("utf-8")
        # A shot whose name is no UTF-8 is drawn all the same: its name goes into the metadata as far as it is text.
        shot = self.folder / os.fsdecode(b"caf\xe9.json")
        shot.write_text(self.shot.read_text())
        for name in ("x.exr", "x.png"):
            self.assert_good(self.run_program("render", shot, *SMALL, "--timings", "t.json", "--size", "16x16", "-o", name))
            self.assertTrue((self.out / name).exists())
        self.assert_good(self.run_program("reference", shot, "--size", "8x8", "--spp", "2", "-o", "r.exr"))

    def test_a_row_of_a_table_that_fails_costs_no_other(self):
        row = {"name": "good", "graph": "direct", "shot": str(self.shot), "resource": "out.direct", "size": [8, 8], "samples": 4,
               "bounces": 0}
        table = self.write("t.json", json.dumps({"rows": [dict(row, name="bad", resource="out.none"), row]}))
        result = self.run_program("table", table)
        self.assert_good(result)
        rows = [line for line in result.stdout.splitlines() if line.startswith("| ")]
        self.assertRegex(next(line for line in rows if "bad" in line), r"skipped: .*out\.none")
        self.assertRegex(next(line for line in rows if "good" in line), r" % \|")

    def test_the_first_word_is_told_first(self):
        for command in (("render", "corneli"), ("render", "corneli", "--graph", "nonsense", "-o", "none/x.jpg"),
                        ("reference", "corneli"), ("reference", "corneli", "-o", "none/x.jpg"), ("stability", "corneli"),
                        ("info", "corneli"), ("chart", "corneli", "-o", "c")):
            self.refused(self.run_program(*command), "no shot 'corneli'", "did you mean 'cornell'?")
        self.refused(self.run_program("render", "cornell"), "invalid --output ''", "expected a file")
        self.refused(self.run_program("render", "cornell", "--graph", "driect", "-o", "x.jpg"), "did you mean 'direct'?")
        self.refused(self.run_program("render", "cornell", "-o", "x.png", "--device", "-1"), "invalid --device '-1'")

    def test_coordinates(self):
        for camera, words in (({"position": [1e31, 0, 0], "target": [0, 0, 0]}, ["camera.position"]),
                              ({"position": [0, 0], "target": [0, 0, 0]}, ["camera.position", "3 numbers"]),
                              ({"position": [0, "a", 0], "target": [0, 0, 0]}, ["camera.position"])):
            shot = self.write("s.json", json.dumps({"scene": "cornell", "camera": camera}))
            result = self.run_program("info", shot)
            self.refused(result, *words)
            self.assertNotIn("an array of 3 numbers, but is an array of 3", result.stderr)

    def test_a_shader_error_is_told_once(self):
        self.edit("glsl/surface/tonemap.comp", "void main() {", "void main() { oops();")
        result = self.run_program("render", self.shot, *SMALL, "-o", "x.png")
        self.refused(result, "surface/tonemap.comp")
        lines = [line for line in result.stderr.splitlines() if "tonemap.comp:" in line]
        self.assertEqual(len(lines), len(set(lines)), result.stderr)
        self.assertEqual(result.stderr.count("oops();"), 1, result.stderr)


class Merges(Hostile):
    POINT = {"key": "0123456789abcdef", "shot": "s", "graph": "g", "values": {}, "size": [16, 16], "warm_up": 0, "frames": 1,
             "reference_goal": {"noise": 0.01, "samples": 4}, "command": "c", "total_ms": 80.3, "bytes": 1,
             "passes": [{"id": "gbuffer", "median_ms": 1, "p10_ms": 1, "p90_ms": 1, "bytes": 8}], "skipped": [],
             "transport_bounces": 0, "parts": ["out.direct"],
             "same_transport": {"bias": -0.8, "rmse": 0.1, "relative_rmse": 2.0, "relative_mse": 1, "p99": 7, "flip": 0.6,
                                "ssim": 0.1, "reference_noise": 0.001},
             "full": {"bias": None, "rmse": 0.1, "relative_rmse": None, "relative_mse": 1, "p99": 7, "flip": 0.6, "ssim": 0.1,
                      "reference_noise": 0.2},
             "kept_share": 0.875, "renderer": "r", "commit": "c", "thumbnail_png": "", "error_png": ""}
    SCRIPT = "\"'><script>alert(1)</script><img src=x onerror=alert(2)>"

    def merge(self, **changes):
        points = self.folder / "in" / "points"
        points.mkdir(parents=True, exist_ok=True)
        (points / "a.json").write_text(json.dumps({**self.POINT, **changes}))
        return self.run_program("chart", "--merge", self.folder / "in", "-o", "merged")

    def test_keys_are_keys(self):
        for key in ("../../../pwned", "/tmp/pwned", "", "a" * 300, "0123456789ABCDEF", "0123456789abcde/", "x\0y", self.SCRIPT):
            self.refused(self.merge(key=key), "a.json", "invalid key", "hexadecimal digits")
        self.assertEqual([p for p in self.folder.rglob("*pwned*")], [])

    def test_values_are_values(self):
        for name, value in (("size", [0, 16]), ("size", [16, 99999999]), ("frames", -1), ("total_ms", -1), ("total_ms", None),
                            ("total_ms", "fast"), ("thumbnail_png", self.SCRIPT), ("error_png", "AAAA"), ("passes", 7),
                            ("shot", 3), ("values", []), ("values", {"a": 1}), ("switches", ["a"]), ("switches", {"a": 1})):
            with self.subTest(name=name, value=value):
                self.refused(self.merge(**{name: value}), "a.json")
        (self.folder / "in/points/a.json").write_text("{" * 5)
        self.refused(self.run_program("chart", "--merge", self.folder / "in", "-o", "merged"), "a.json")

    def test_names_stay_names(self):
        result = self.merge(shot=self.SCRIPT, graph=self.SCRIPT, command=self.SCRIPT, renderer=self.SCRIPT, commit="\x01\x1b" + self.SCRIPT,
                            values={self.SCRIPT: self.SCRIPT, "a.b": "=cmd()"},
                            passes=[{"id": self.SCRIPT, "median_ms": 1, "p10_ms": 1, "p90_ms": 1, "bytes": 8}],
                            skipped=[{"id": self.SCRIPT, "reason": self.SCRIPT}])
        self.assert_good(result)
        page, picture, table = ((self.out / "merged" / name).read_text() for name in ("chart.html", "chart.svg", "chart.csv"))
        self.assertEqual(page.count("<script"), 2, "the data and the page's own")
        self.assertNotIn("<script", picture)
        for text in (page, picture):
            self.assertNotIn("<script>alert", text)
            self.assertNotIn("<img src=x", text)
            self.assertNotIn("\x01", text)
            self.assertNotIn("\x1b", text)
        import xml.dom.minidom
        xml.dom.minidom.parseString(picture)
        policy = page[:page.index("<style")]
        self.assertRegex(policy, "Content-Security-Policy\" content=\"default-src 'none'; .*script-src 'sha256-[^' ]*';")
        self.assertNotIn("unsafe", policy)
        import csv
        rows = list(csv.reader(table.splitlines()))
        self.assertEqual(len({len(row) for row in rows}), 1, "every row has every column")
        self.assertFalse([field for row in rows for field in row if field[:1] in "=@" and field], "a spreadsheet would run it")


if __name__ == "__main__":
    unittest.main()
