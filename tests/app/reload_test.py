"""The real program, without a window, while its files are edited: `bounce render --watch`."""

import re
import time
import unittest

from program import SMALL, ProgramTest, png_pixel


class Watching(ProgramTest):
    def start(self, *more):
        """Renders numbered frames for long; each test stops it when it has seen enough."""
        self.process = self.start_program("render", self.shot, *SMALL, "--size", "16x16", "--watch", "--quiet", "--frames", "1000000",
                                          "-o", "f_%d.png", *more)

    def newest(self):
        numbers = [int(re.fullmatch(r"f_(\d+)\.png", path.name)[1]) for path in self.out.glob("f_*.png")]
        return max(numbers, default=-1)

    def centre_when(self, what, seconds=60):
        """Waits until a new frame's centre pixel satisfies `what`; returns the pixel."""
        end, pixel = time.monotonic() + seconds, None
        while time.monotonic() < end:
            number = self.newest()
            if number > 0:
                pixel = png_pixel(self.out / f"f_{number - 1}.png", 8, 8)
                if what(pixel):
                    return pixel
                for path in self.out.glob("f_*.png"):  # thousands of frames are not kept
                    if int(path.stem[2:]) < number - 1:
                        path.unlink()
            if self.process.poll() is not None:
                self.fail("the program ended: " + self.said())
            time.sleep(0.05)
        self.fail(f"no such frame within {seconds} s; the newest pixel is {pixel}")

    def frames_go_on(self):
        start, end = self.newest(), time.monotonic() + 60
        while self.newest() < start + 5:
            self.assertLess(time.monotonic(), end, "no frames any more")
            self.assertIsNone(self.process.poll(), "the program ended")
            time.sleep(0.05)

    def said(self):
        return (self.folder / "said").read_text()

    def end(self):
        self.stop(self.process)
        return self.said()

    def paint(self, colour, rename=False, extra=""):
        """The tone map shows one colour."""
        path = self.root / "glsl/surface/tonemap.comp"
        text = re.sub(r"imageStore\(out_display, pixel, .*", f"imageStore(out_display, pixel, vec4({colour}, 1.0)); {extra}", path.read_text())
        if rename:
            path.with_suffix(".new").write_text(text)
            path.with_suffix(".new").rename(path)
        else:
            path.write_text(text)

    def test_broken_fixed_broken_fixed(self):
        self.start()
        self.centre_when(lambda p: True)
        self.paint("1.0, 0.0, 0.0")
        self.centre_when(lambda p: p == (255, 0, 0))
        self.paint("0.0, 1.0, 0.0", extra="oops();")
        self.frames_go_on()
        self.assertEqual(self.centre_when(lambda p: True), (255, 0, 0))
        self.paint("0.0, 1.0, 0.0", rename=True)
        self.centre_when(lambda p: p == (0, 255, 0))
        self.paint("undeclared", rename=True)
        self.frames_go_on()
        self.assertEqual(self.centre_when(lambda p: True), (0, 255, 0))
        self.paint("0.0, 0.0, 1.0")
        self.centre_when(lambda p: p == (0, 0, 255))
        said = self.end()
        self.assertRegex(said, r"surface/tonemap\.comp:\d+: .*oops")
        self.assertRegex(said, r"surface/tonemap\.comp:\d+: .*undeclared")

    def test_a_broken_include_shared_by_two_programs(self):
        (self.root / "glsl/lib/shade.glsl").write_text("vec3 shade() { return vec3(1, 0, 0); }\n")
        for name in ("compose", "tonemap"):
            self.edit(f"glsl/surface/{name}.comp", "layout(local_size_x", '#include "lib/shade.glsl"\nlayout(local_size_x')
        self.paint("shade()")
        self.start()
        self.centre_when(lambda p: p == (255, 0, 0))
        (self.root / "glsl/lib/shade.glsl").write_text("\nvec3 shade() { return oops; }\n")
        self.frames_go_on()
        (self.root / "glsl/lib/shade.glsl").unlink()
        self.frames_go_on()
        self.assertEqual(self.centre_when(lambda p: True), (255, 0, 0))
        (self.root / "glsl/lib/shade.glsl").write_text("vec3 shade() { return vec3(0, 1, 0); }\n")
        self.centre_when(lambda p: p == (0, 255, 0))
        said = self.end()
        self.assertIn("lib/shade.glsl:2:", said)
        for name in ("compose", "tonemap"):
            self.assertRegex(said, rf"surface/{name}\.comp:\d+: .*shade\.glsl", "both programs tell that it is gone")

    def test_broken_at_start_up(self):
        self.paint("oops")
        self.start()
        self.centre_when(lambda p: p == (255, 0, 255))
        self.paint("0.0, 1.0, 0.0")
        self.centre_when(lambda p: p == (0, 255, 0))

    def test_ending_while_broken_is_an_error(self):
        self.paint("oops")
        result = self.run_program("render", self.shot, *SMALL, "--watch", "--frames", "2", "-o", "x.png")
        self.assert_refused(result, "tonemap.comp")

    def test_a_graph_file_edited_and_a_compute_pass_dropped_in(self):
        graph = self.root / "assets/graphs/direct.json"
        graph.write_text(self.run_program("graph", "direct", "--expanded").stdout)
        self.start()
        self.centre_when(lambda p: True)
        (self.root / "glsl/user").mkdir(exist_ok=True)
        (self.root / "glsl/user/tint.comp").write_text(
            "layout(local_size_x = 8, local_size_y = 8) in;\nlayout(FORMAT_out_display) writeonly uniform image2D out_display;\n"
            "uniform vec3 tint = vec3(0, 1, 0); //! the colour\n"
            "void main() { imageStore(out_display, ivec2(gl_GlobalInvocationID.xy), vec4(tint, 1.0)); }\n")
        good = graph.read_text()
        tail = good.rindex("]")
        entry = ',\n    { "id": "tint", "type": "compute", "shader": "user/tint.comp" }\n  '
        graph.write_text(good[:tail].rstrip() + entry + good[tail:])
        self.centre_when(lambda p: p == (0, 255, 0))
        for bad in ("{", good.replace("gbuffer", "gbufer", 1), good[:tail].rstrip() + entry.replace("tint.comp", "none.comp").replace("tint", "two") +
                    good[tail:].replace("]", ", 3]", 1)):
            graph.write_text(bad)
            self.frames_go_on()
            self.assertEqual(self.centre_when(lambda p: True), (0, 255, 0), "the last good graph stays")
        graph.write_text(good[:tail].rstrip() + entry.replace("}", ', "params": {"tint": [0, 0, 1]} }') + good[tail:])
        self.centre_when(lambda p: p == (0, 0, 255))
        graph.write_text(good)
        self.centre_when(lambda p: p not in ((0, 0, 255), (0, 255, 0)))
        self.assertIn("did you mean 'gbuffer'?", self.end())


if __name__ == "__main__":
    unittest.main()
