"""Films by ffmpeg: by a fake of it, by one that fails, without one, and by the real one where it is installed."""

import json
import shutil
import signal
import subprocess
import time
import unittest

from program import SMALL, ProgramTest, png_pixel
from window_driver import PICTURE, WindowTest

FAKE = """#!%(python)s
import json, os, sys
out = sys.argv[-1].removeprefix("file:")
open(out, "w").close()
count, first = 0, sys.stdin.buffer.read(3)
count = len(first)
while block := sys.stdin.buffer.read(1 << 16):
    count += len(block)
open(out, "w").write("a film")
json.dump({"arguments": sys.argv[1:], "bytes": count, "first": list(first)}, open(os.environ["FILM_LOG"], "w"))
"""
FAILS = """#!%(python)s
import sys
open(sys.argv[-1].removeprefix("file:"), "w").write("half a film")
sys.stdin.buffer.read(1000)
sys.stderr.write("Unknown encoder 'libx264'\\n")
sys.exit(1)
"""
FAILS_AT_THE_END = """#!%(python)s
import sys
while sys.stdin.buffer.read(1 << 16): pass
sys.stderr.write("no space left\\n")
sys.exit(1)
"""


class FilmFixture:
    def fake(self, text):
        """Programs on PATH are this ffmpeg, and those that the tests themselves need."""
        folder = self.folder / "bin"
        folder.mkdir(exist_ok=True)
        if text:
            program = folder / "ffmpeg"
            program.write_text(text % {"python": shutil.which("python3")})
            program.chmod(0o755)
        for tool in ("xdotool", "xwininfo", "xsel", "xclip"):
            if shutil.which(tool) and not (folder / tool).exists():
                (folder / tool).symlink_to(shutil.which(tool))
        self.path = str(folder)

    def environment(self):
        environment = dict(super().environment(), FILM_LOG=str(self.folder / "film.json"))
        if hasattr(self, "path"):
            environment["PATH"] = self.path
        return environment

    def film_log(self):
        return json.loads((self.folder / "film.json").read_text())

    def names(self):
        return sorted(path.name for path in self.out.iterdir())


class Films(FilmFixture, ProgramTest):
    def render(self, *arguments, output):
        return self.run_program("render", self.shot, *SMALL, "--size", "33x18", *arguments, "-o", output)

    def test_frames_go_to_ffmpeg(self):
        self.fake(FAKE)
        self.assert_good(self.render("--frames", 3, output="x.mp4"))
        self.assertEqual(self.names(), ["x.mp4"])
        self.assertEqual((self.out / "x.mp4").read_text(), "a film")
        log = self.film_log()
        self.assertEqual(log["bytes"], 3 * 33 * 18 * 3)
        arguments = log["arguments"]
        for name, value in (("-video_size", "33x18"), ("-pixel_format", "rgb24"), ("-framerate", "60"), ("-c:v", "libx264"),
                            ("-i", "pipe:0"), ("-f", "rawvideo")):
            self.assertEqual(arguments[arguments.index(name) + 1], value)
        self.assertIn("yuv420p", arguments[arguments.index("-vf") + 1])
        self.assert_good(self.render(output="x.png"))
        self.assertEqual(tuple(log["first"]), png_pixel(self.out / "x.png", 0, 0), "the top left pixel comes first")

    def test_the_shots_pace_and_the_other_format(self):
        self.fake(FAKE)
        self.shot.write_text(json.dumps(dict(json.loads(self.shot.read_text()), fps=23.976)))
        self.assert_good(self.render("--frames", 2, output="-odd 'name'.WebM"))
        self.assertEqual(self.names(), ["-odd 'name'.WebM"])
        arguments = self.film_log()["arguments"]
        self.assertEqual(arguments[arguments.index("-framerate") + 1], "23.976")
        self.assertEqual(arguments[arguments.index("-c:v") + 1], "libvpx-vp9")

    def test_without_ffmpeg(self):
        self.fake("")
        self.assert_refused(self.render("--frames", 2, output="x.mp4"), "ffmpeg is not installed", "apt-get install ffmpeg", "%04d.png")
        self.assert_good(self.render("--frames", 2, output="x_%04d.png"))

    def test_an_ffmpeg_that_fails(self):
        for text, words in ((FAILS, "Unknown encoder 'libx264'"), (FAILS_AT_THE_END, "no space left"), ("#!/bin/sh\nexit 3\n", "ffmpeg")):
            with self.subTest(words):
                self.fake(text)
                (self.out / "x.mp4").write_text("an older film")
                result = self.render("--frames", 4, output="x.mp4")
                self.assert_refused(result, words, "the package ffmpeg", "%04d.png", leaves=["x.mp4"])
                self.assertEqual((self.out / "x.mp4").read_text(), "an older film")

    def test_an_interrupt_leaves_no_half_film(self):
        self.fake(FAKE)
        process = self.start_program("render", self.shot, *SMALL, "--size", "33x18", "--frames", 100000, "-o", self.out / "x.mp4")
        while process.poll() is None and not any(name.startswith(".bounce-film") for name in self.names()):
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 2)
        self.assertIn("interrupted", (self.folder / "said").read_text())
        self.assertEqual(self.names(), [])

    def test_names_that_cannot_be(self):
        self.fake(FAKE)
        self.assert_refused(self.render(output="none/x.mp4"), "none")
        self.assert_refused(self.render(output="x.avi"), ".mp4 or .webm")

    def test_the_real_one(self):
        if not shutil.which("ffmpeg") or not shutil.which("ffprobe"):
            self.skipTest("not installed: ffmpeg")
        for name, codec in (("x.mp4", "h264"), ("x.webm", "vp9")):
            self.assert_good(self.render("--frames", 5, output=name))
            told = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-of", "json", "-show_streams", name], cwd=self.out,
                                  capture_output=True, text=True, check=True, timeout=60)
            stream = json.loads(told.stdout)["streams"][0]
            self.assertEqual((stream["codec_name"], stream["width"], stream["height"], stream["pix_fmt"], stream["nb_read_frames"],
                              stream["r_frame_rate"], stream["color_space"]), (codec, 34, 18, "yuv420p", "5", "60/1", "bt709"))
            # Its first picture is the frame, as far as a lossy format with a quarter of the colours keeps it.
            raw = subprocess.run(["ffmpeg", "-v", "error", "-i", name, "-frames:v", "1", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                                 cwd=self.out, capture_output=True, check=True, timeout=60).stdout
            self.assert_good(self.render(output="x.png"))
            for x, y in ((5, 5), (16, 9), (26, 13)):
                at = 3 * (34 * y + x)
                for got, want in zip(raw[at:at + 3], png_pixel(self.out / "x.png", x, y)):
                    self.assertLess(abs(got - want), 24, (name, x, y))
            again = (self.out / name).read_bytes()
            self.assert_good(self.render("--frames", 5, output=name))
            self.assertEqual((self.out / name).read_bytes(), again, "the same frames give the same bytes")


class FilmsOfTheWindow(FilmFixture, WindowTest):
    def open_films(self, text):
        self.fake(text)
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE)
        self.click("tab.Capture")
        self.click("capture.kind")
        self.click("capture.kind.MP4")

    def test_a_film_of_what_is_seen(self):
        self.open_films(FAKE)
        self.click("capture.record")
        self.wait(lambda state: state["frame"] >= 3, "frames")
        self.input("key", "ctrl+r")
        state = self.wait(lambda state: state["notice"].startswith("recorded"), "the film")
        count = int(state["notice"].split()[1])
        self.assertEqual(self.film_log()["bytes"], count * PICTURE[0] * PICTURE[1] * 3)
        self.assertEqual(self.names(), ["tiny_direct_001.mp4"])
        self.assertEqual(state["last_capture"], str(self.out / "tiny_direct_001.mp4"))
        # A window that is closed meanwhile finishes its film.
        self.click("capture.record")
        self.wait(lambda state: state["frame"] >= 5, "more frames")
        self.input("key", "ctrl+q")
        self.wait_for_exit()
        self.assertEqual(self.names(), ["tiny_direct_001.mp4", "tiny_direct_002.mp4"])

    def test_without_ffmpeg_the_window_says_so(self):
        self.open_films("")
        before = self.state()["frame"]
        self.click("capture.record")
        state = self.wait(lambda state: state["notice_is_error"], "the message")
        self.assertIn("apt-get install ffmpeg", state["notice"])
        self.assertEqual((state["frame"], self.names()), (before, []))
        self.click("capture.kind")
        self.click("capture.kind.numbered PNG")
        self.click("capture.record")
        self.wait(lambda state: state["frame"] >= 2, "numbered frames")
        self.input("key", "ctrl+r")
        self.wait(lambda state: state["notice"].startswith("recorded"), "the end")
        self.assertGreater(len(self.names()), 1)

    def test_an_ffmpeg_that_fails_ends_the_recording_alone(self):
        self.open_films(FAILS)
        self.click("capture.record")
        state = self.wait(lambda state: state["notice_is_error"], "the message")
        self.assertIn("Unknown encoder 'libx264'", state["notice"])
        self.assertEqual(self.names(), [])
        drawn = state["drawn"]
        self.input("key", "n")
        self.wait(lambda state: state["drawn"] > drawn, "the window lives on")


if __name__ == "__main__":
    unittest.main()
