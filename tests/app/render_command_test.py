"""The command line: what it writes, and how it refuses."""

import json
import os
import pathlib
import resource
import subprocess
import unittest

from program import PROGRAM, SMALL, TINY_SHOT, ProgramTest, exr_header, png_pixel


class Refusals(ProgramTest):
    def render(self, *arguments, shot=None, output="x.png", **options):
        return self.run_program("render", shot or self.shot, *SMALL, *arguments, "-o", output, **options)

    def test_names_that_are_not_there(self):
        self.assert_refused(self.render(shot="cornel"), "cornel", "did you mean 'cornell'?")
        self.assert_refused(self.render("--graph", "driect"), "there is no graph 'driect' (did you mean 'direct'?)")
        self.assert_refused(self.render("--set", "tonemap.exposre=1"), "tonemap.exposre", "did you mean 'tonemap.exposure'?")
        self.assert_refused(self.render("--set", "tonmap.exposure=1"), "did you mean 'tonemap.exposure'?")
        self.assert_refused(self.render("--set", "exposure=1"), "did you mean 'tonemap.exposure'?")
        self.assert_refused(self.render("--resource", "gbuffer.nromal"), "gbuffer.nromal", "did you mean 'gbuffer.normal'?")
        self.assert_refused(self.render("--resource", "gbuffer.emission"), "gbuffer.emission")

        self.assert_refused(self.render("--enable", "emision"), "emision", "did you mean 'emission'?")
        self.assert_refused(self.render("--disable", "tonemapp"), "did you mean 'tonemap'?")

    def test_values_that_cannot_be(self):
        self.assert_refused(self.render("--set", "tonemap.exposure=17"), "[-16, 16]")
        self.assert_refused(self.render("--set", "tonemap.exposure=bright"), "'bright'", "a number")
        self.assert_refused(self.render("--set", "tonemap.curve=acse"), "acse", "aces_like")
        self.assert_refused(self.render("--set", "tonemap.exposure"), "pass.parameter=value")
        for size in ("12", "0x10", "10x0", "ax10", "20000x10", "-5x5", "10x10x10"):
            self.assert_refused(self.render("--size=" + size), "--size")
        for frames in ("0", "-1", "two", "99999999"):
            self.assert_refused(self.render("--frames=" + frames), "--frames")
        self.assert_refused(self.render("--device", "99"), "device 99")

    def test_options_that_are_not_there(self):
        self.assert_refused(self.render("--grahp", "direct"), "'bounce render' has no option '--grahp' (did you mean '--graph'?)")
        self.assert_refused(self.render("--nonsense=1"), "no option '--nonsense'", "bounce render --help")
        self.assert_refused(self.run_program("redner", "cornell"), "there is no command 'redner' (did you mean 'render'?)")
        self.assert_refused(self.render("one_more"), "no further argument", "'one_more'")
        self.assert_refused(self.run_program("render"), "shot")
        self.assert_refused(self.run_program("render", self.shot), "--output")

    def test_outputs_that_cannot_be_written(self):
        self.assert_refused(self.render(output="x.jpg"), "x.jpg", ".exr or .png")
        self.assert_refused(self.render(output="x"), ".exr or .png")
        self.assert_refused(self.render(output="none/x.png"), "none")
        self.assert_refused(self.render("--frames", "2", output="x_%q.png"), "%04d")
        self.assert_refused(self.render("--timings", "none/t.json"), "none")
        os.mkdir(self.out / "taken.png")
        self.assert_refused(self.render(output="taken.png"), "taken.png", leaves=["taken.png"])

    def test_a_folder_without_permission(self):
        if os.geteuid() == 0:
            target = pathlib.Path("/proc/self/x.png")  # which not even root may write to
        else:
            locked = self.folder / "locked"
            locked.mkdir(mode=0o555)
            target = locked / "x.png"
        self.assert_refused(self.render(output=target), "x.png")

    def test_a_full_disk_leaves_the_old_file_whole(self):
        for name, size in (("x.png", 200), ("x.exr", 4096)):
            (self.out / name).write_bytes(b"what was there before")

            def limit():
                resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

            # Without its signal, the limit acts as a full disk does: a write fails.
            result = self.render(output=name, preexec_fn=limit, restore_signals=False)
            self.assert_refused(result, name, leaves=[name])
            self.assertEqual((self.out / name).read_bytes(), b"what was there before")
            (self.out / name).unlink()

    def test_a_table_that_cannot_be_written(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "info", str(self.shot)], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60,
                                    env=self.environment())
        self.assertEqual(result.returncode, 2)
        self.assertIn("No space left", result.stderr)

    def test_shots_and_graphs_that_are_broken(self):
        self.shot.write_text("{")
        self.assert_refused(self.render(), "tiny.json")
        self.shot.write_text('{"scene": "nowhere.gltf", "widht": 3}')
        self.assert_refused(self.render(), "nowhere.gltf", "widht")
        (self.root / "assets/graphs/direct.json").write_text('{"version": 1, "passes": [{"type": "gbufer"}, {"type": "compute"}]}')
        self.setUp_shot()
        self.assert_refused(self.render(), "gbufer", "did you mean 'gbuffer'?", "'shader' is missing")

    def setUp_shot(self):
        self.shot.write_text(TINY_SHOT)

    def test_a_broken_shader_writes_nothing(self):
        self.edit("glsl/surface/tonemap.comp", "void main() {", "void main() { oops();")
        self.assert_refused(self.render(), "surface/tonemap.comp:", "oops", "nothing was written")
        self.assert_refused(self.render("--frames", "2", output="x_%02d.png"), "oops")
        (self.root / "glsl/surface/tonemap.comp").unlink()
        self.assert_refused(self.render(), "tonemap.comp")


class Pictures(ProgramTest):
    def render(self, output, *arguments):
        result = self.run_program("render", self.shot, *SMALL, *arguments, "-o", output)
        self.assert_good(result)
        return result

    def test_the_same_command_gives_the_same_bytes(self):
        for extension in ("png", "exr"):
            for name in ("a", "b"):
                self.render(f"{name}.{extension}", "--frames", "2")
            self.assertEqual((self.out / f"a.{extension}").read_bytes(), (self.out / f"b.{extension}").read_bytes())

    def test_layers_and_metadata_of_an_exr(self):
        self.render("x.exr", "--set", "tonemap.exposure=1.5")
        channels, texts = exr_header(self.out / "x.exr")
        for part in ("out.direct", "out.radiance"):
            for c in "RGB":
                self.assertIn(f"{part}.{c}", channels)
        self.assertFalse([c for c in channels if c.startswith(("out.display", "gbuffer"))])
        metadata = json.loads(texts["bounce"])
        self.assertEqual(metadata["graph"], "direct")
        self.assertEqual(metadata["shot"], str(self.shot))
        self.assertEqual(metadata["parameters"], {"shadow_maps.resolution": "64", "tonemap.exposure": "1.5"})
        for key in ("renderer", "commit", "size", "camera", "frame"):
            self.assertIn(key, metadata)
        self.render("n.exr", "--resource", "gbuffer.normal")
        self.assertLessEqual(set(exr_header(self.out / "n.exr")[0]), set("RGBA"))
        self.render("s.exr", "--resource", "shadow.depth")
        self.render("n.png", "--resource", "gbuffer.normal")

    def test_numbered_frames_and_sizes(self):
        self.render("f_%04d.png", "--frames", "3", "--size", "20x10")
        self.assertEqual(sorted(p.name for p in self.out.iterdir()), ["f_0000.png", "f_0001.png", "f_0002.png"])
        self.assertEqual((self.out / "f_0000.png").read_bytes()[16:24], b"\0\0\0\x14\0\0\0\x0a")
        folder = self.out / "100%"
        folder.mkdir()
        self.render(folder / "x.png")
        self.assertTrue((folder / "x.png").exists(), "a % in a folder's name numbers nothing")

    def test_a_resource_of_a_pass_that_is_off_switches_it_on(self):
        small = ("--graph", "lrsm_tuned", "--set", "occlusion_voxels.resolution=32", "--set", "rsm.resolution=64", "--set", "gather.max_steps=32")
        self.render("x.png", *small, "--set", "inspect.pixel=0.5,0.9", "--resource", "debug.cones_view")
        self.render("y.png", *small, "--set", "inspect.pixel=0.5,0.9", "--resource", "debug.cones_view", "--enable", "view_cones")
        self.assertEqual((self.out / "x.png").read_bytes(), (self.out / "y.png").read_bytes())
        result = self.render("z.png", *small, "--enable", "view_cubes", "--disable", "emission")
        self.assertIn("view_cubes", result.stdout)
        self.assertIn("inspect: skipped: switched off", result.stdout)
        self.assertIn("emission: skipped: switched off", result.stdout)

    def test_timings(self):
        result = self.render("x.png", "--timings", "t.json", "--frames", "3")
        self.assertIn("gbuffer", result.stdout)
        self.assertIn("x.png", result.stdout)
        timings = json.loads((self.out / "t.json").read_text())
        self.assertEqual([p["id"] for p in timings["passes"]], ["gbuffer", "shadow_maps", "direct", "compose", "tonemap"])
        self.assertEqual(timings["passes"][0]["frames"], 3)
        self.assertEqual(timings["skipped"][0]["id"], "emission")
        self.assertEqual(sum(timings["resources"].values()), timings["total_bytes"])
        self.assertEqual(self.render("y.png", "--quiet").stdout, "")

    def test_what_the_display_shows(self):
        self.render("x.png")
        red, green = png_pixel(self.out / "x.png", 4, 30), png_pixel(self.out / "x.png", 43, 30)
        self.assertGreater(red[0], 2 * red[1] + 1, "the red wall is on the left")
        self.assertGreater(green[1], 2 * green[0] + 1, "the green one on the right")

    def test_a_device_file_is_not_replaced(self):
        target = self.out / "full.png"
        target.symlink_to("/dev/full")
        result = self.run_program("render", self.shot, *SMALL, "-o", target)
        self.assertIn(result.returncode, (0, 2))
        self.assertTrue(pathlib.Path("/dev/full").is_char_device())


class Lists(ProgramTest):
    def test_params(self):
        text = self.run_program("params", "direct")
        self.assert_good(text)
        self.assertRegex(text.stdout, r"tonemap\.exposure +0 +\[-16, 16\] stops +radiance is multiplied")
        markdown = self.run_program("params", "--markdown")
        self.assert_good(markdown)
        rows = [line for line in markdown.stdout.splitlines() if line.startswith("|")]
        self.assertTrue(any("| `shadow_maps.resolution` | 2048 | [16, 8192] texels |" in row for row in rows))
        self.assertTrue(all(row.replace("\\|", "").count("|") == 5 for row in rows), "four columns in every row")
        self.assert_refused(self.run_program("params", "direkt"), "did you mean 'direct'?")

    def test_graph(self):
        text = self.run_program("graph", "direct", "--shot", self.shot, "--set", "shadow_maps.resolution=128")
        self.assert_good(text)
        self.assertIn("65536 bytes", text.stdout)
        self.assertIn("emission: ", text.stdout)
        order = [text.stdout.index(f". {name}") for name in ("gbuffer", "shadow_maps", "direct", "compose", "tonemap")]
        self.assertEqual(order, sorted(order))
        dot = self.run_program("graph", "direct", "--shot", self.shot, "--graphviz").stdout
        self.assertTrue(dot.startswith("digraph") and dot.count("{") == dot.count("}"))
        try:
            drawn = subprocess.run(["dot", "-Tplain"], input=dot, capture_output=True, text=True, timeout=60)
            self.assertEqual(drawn.returncode, 0, drawn.stderr)
        except FileNotFoundError:
            for line in dot.splitlines()[1:-1]:
                self.assertRegex(line, r'^  (rankdir=LR|node \[.*\]|"[^"]+" (\[.*\]|-> "[^"]+"( \[.*\])?));$')
        self.assert_refused(self.run_program("graph", "direct", "--shot", self.shot, "--set", "shadow_maps.resolution=1"), "[16, 8192]")


if __name__ == "__main__":
    unittest.main()
