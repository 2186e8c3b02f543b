"""A person at work in the real window: edits, shaders, files, captures, the reference, GPU resets."""

import json
import os
import re
import subprocess
import unittest

from program import PROGRAM, SMALL, exr_header, png_pixel
from window_driver import PICTURE, WindowTest


class Window(WindowTest):
    def test_a_person_at_work(self):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE)
        first = self.capture()
        self.assertEqual(self.wait(lambda state: True, "")["size"], list(PICTURE))
        dark = self.middle(first)

        # A slider is dragged, and the picture changes; undone, it is as before.
        self.drag("tonemap.exposure", 0.5, 0.7)
        state = self.wait(lambda state: "tonemap.exposure" in state["parameters"], "the slider's value")
        self.assertGreater(float(state["parameters"]["tonemap.exposure"]), 2)
        bright = self.middle(self.capture())
        self.assertGreater(sum(bright), sum(dark))
        self.input("key", "ctrl+z")
        self.wait(lambda state: "tonemap.exposure" not in state["parameters"], "undo")
        self.assertEqual(self.middle(self.capture()), dark)

        # The linear parts, as an EXR.
        channels, texts = exr_header(self.capture("shift+F12"))
        self.assertIn("out.direct.R", channels)
        self.assertIn("bounce", texts)

        # The camera turns about the surface under the pointer; Home brings it back.
        camera = self.state()["camera"]
        self.drag("viewport", 0.5, 0.55)
        turned = self.wait(lambda state: state["camera"] != camera, "another camera")["camera"]
        self.input("key", "b")

        # What is seen is saved as a shot, which gives the same picture without the window.
        self.input("key", "ctrl+e")
        self.wait(lambda state: state["notice"].startswith("saved"), "the saved shot")
        shot = next(self.out.glob("*_view_*.json"))
        seen = self.capture()
        self.assert_good(self.run_program("render", shot.name, *SMALL, "-q", "-o", "again.png"))
        for x, y in ((10, 10), (48, 32), (70, 50)):
            self.assertEqual(png_pixel(self.out / "again.png", x, y), png_pixel(seen, x, y))

        self.input("key", "Home")
        self.wait(lambda state: state["camera"] == camera, "the shot's camera")
        self.input("key", "1")
        back = self.wait(lambda state: state["camera"] != camera, "the bookmark")["camera"]
        self.assertEqual(back, turned)
        self.input("key", "ctrl+q")
        self.wait_for_exit()
        self.assertNotIn("[error]", self.said())

    def test_a_shader_breaks_and_is_mended(self):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE)
        self.input("mousemove", *self.place("viewport"))
        self.input("key", "c")  # continuously
        good = (self.root / "glsl/surface/tonemap.comp").read_text()
        for _ in range(2):
            self.edit("glsl/surface/tonemap.comp", "void main() {", "void main() { int broken = undeclared_name;")
            # A file that is being written may be seen half.
            state = self.wait(lambda state: any("undeclared_name" in row for row in state["problems"]), "the error row")
            self.assertRegex(" ".join(state["problems"]), r"tonemap\.comp.*undeclared_name")
            self.assertTrue(state["notice_is_error"])
            self.wait(lambda later: later["rendered"] > state["rendered"] + 3, "frames that go on")
            self.click("status.problems")
            self.wait(lambda state: any(name.startswith("shaders.error.") for name in state["widgets"]), "the row in the Shaders panel")
            (self.root / "glsl/surface/tonemap.comp").write_text(good)
            state = self.wait(lambda state: not state["problems"], "the error to go")
            self.wait(lambda later: later["rendered"] > state["rendered"] + 3, "frames that go on")
            self.assertNotIn("status.problems", self.state()["widgets"])

    def test_files_are_opened_and_presets_saved(self):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE)
        self.type("scene.path", "/nowhere/x.gltf")
        self.input("key", "Return")
        state = self.wait(lambda state: state["notice_is_error"], "the refusal of a file that is not there")
        self.assertIn("/nowhere/x.gltf", state["notice"])
        self.assertEqual(state["shot"], str(self.shot))
        self.click("scene.shot")
        self.click("scene.shot.cornell_lamp")
        self.wait(lambda state: state["shot"] == "cornell_lamp", "the chosen shot")
        self.click("scene.shot")
        self.click("scene.shot.cornell")
        self.wait(lambda state: state["shot"] == "cornell", "the chosen shot")

        # A light is turned at, and taken back; from press to release is one step.
        self.drag("light.0.outer_cone", 0.5, 0.3)
        self.wait(lambda state: state["undo"].endswith("cone"), "the edit of the light")
        self.input("key", "ctrl+z")
        self.wait(lambda state: not state["undo"], "undo")

        self.drag("tonemap.exposure", 0.5, 0.6)
        value = float(self.wait(lambda state: "tonemap.exposure" in state["parameters"], "the value")["parameters"]["tonemap.exposure"])
        self.click("tab.Capture")
        self.type("capture.preset", "bright")
        self.click("capture.save_preset")
        self.wait(lambda state: state["notice"].startswith("saved"), "the preset")
        preset = json.loads((self.root / "assets/graphs/bright.json").read_text())
        params = {entry["id"]: entry.get("params", {}) for entry in preset["passes"]}
        self.assertEqual(preset["extends"], "direct")
        self.assertAlmostEqual(params["tonemap"]["exposure"], value, 5)
        self.click("capture.save_preset")
        self.wait(lambda state: state["notice_is_error"] and "overwrite" in state["notice"], "the refusal to overwrite")
        self.assert_good(self.run_program("render", self.shot, "--graph", "bright", "-q", "-o", "bright.png"))

    def test_whatever_goes_wrong_the_picture_stays(self):
        """What is thrown by the file system, the JSON library and others is told as the program's own errors are."""
        state_file = self.folder / "state/bounce/window.json"
        state_file.parent.mkdir(parents=True)
        state_file.write_text(json.dumps({"version": 1, "shot": "x" * 5000, "graph": "y" * 5000}))
        self.open(*SMALL, "--size", "%dx%d" % PICTURE)
        state = self.wait(lambda state: state["notice_is_error"], "what became of the last run's shot")
        self.assertIn("cannot be opened again", state["notice"])
        shown = state["shot"]
        x0, y0, x1, y1 = map(round, state["widgets"]["viewport"])
        before = self.display.pixels(x0, y0, x1, y1)
        deep = self.folder / "deep.json"
        deep.write_text("[" * 100000)
        twice = self.folder / "twice.json"
        twice.write_text('{"scene": "a.gltf", "scene": "b.gltf"}')
        odd = self.folder / "odd.json"
        odd.write_text('{"scene": 5, "objects": 7}')
        # Ctrl is pressed in one frame, and released in that in which A is pressed.
        select_all = ("keydown", "ctrl", "sleep", "0.5", "key", "a", "keyup", "ctrl")
        for path, words in (("/" + "x" * 300 + ".gltf", "no scene at"), (deep, "nested more than 64 levels"), (twice, "twice"), (odd, "scene")):
            self.click("scene.path")
            self.input(*select_all)
            subprocess.run(["xdotool", "type", "--delay", "5", str(path)], env=self.environment(), check=True, timeout=60)
            self.input("key", "Return")
            state = self.wait(lambda state: words in state["notice"], words)
            self.assertTrue(state["notice_is_error"])
            self.assertEqual(state["shot"], shown)
        self.assertEqual(self.display.pixels(x0, y0, x1, y1), before)
        self.input("key", "ctrl+q")
        self.wait_for_exit()

    def test_the_picture_against_the_reference(self):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE, "--set", "direct.shadows=false")
        self.click("tab.Compare")
        self.click("compare.start")
        state = self.wait(lambda state: state["comparison"]["samples"] >= 8 and not state["comparison"]["running"], "the reference")
        unshadowed = state["comparison"]["relative_rmse"]
        self.assertGreater(unshadowed, 0.1)  # it lacks the shadows

        # The border is dragged: what it passes turns from the reference into the picture, and nothing else changes.
        self.click("compare.view.split")
        self.drag("compare.split", 0.5, 0.3)
        x0, y0, x1, y1 = map(round, self.state()["widgets"]["viewport"])
        left = self.state()["comparison"]["split"]
        before = self.display.pixels(x0, y0, x1, y1)
        self.drag("compare.split", 0.3, 0.7)
        right = self.wait(lambda state: state["comparison"]["split"] > left + 0.2, "the border at another place")["comparison"]["split"]
        after = self.display.pixels(x0, y0, x1, y1)
        changed = [x / (x1 - x0) for row, later in zip(before, after) for x in range(x1 - x0) if row[x] != later[x]]
        self.assertGreater(len(changed), 100)
        one = 2 / PICTURE[0]  # texels are smoothed on the screen
        self.assertGreater(min(changed), left - one)
        self.assertLess(max(changed), right + one)

        # The figures follow an edit, and a kept point stays.
        self.click("compare.keep")
        self.wait(lambda state: state["comparison"]["points"] == 1, "the kept point")
        self.click("direct.shadows")
        self.wait(lambda state: state["comparison"]["relative_rmse"] < 0.5 * unshadowed, "less error with shadows")
        for view in ("flicker", "error", "reference", "off"):
            self.click("compare.view." + view)
        self.assertEqual(self.state()["comparison"]["view"], 0)
        self.assertFalse(self.state()["notice_is_error"], self.state()["notice"])

    def test_what_is_kept_between_runs(self):
        self.open(self.shot, *SMALL)
        self.click("tab.Camera")
        self.wait(lambda state: "camera.play" in state["widgets"], "the camera's panel")
        self.input("key", "ctrl+q")
        self.wait_for_exit()

        self.open(*SMALL)
        state = self.wait(lambda state: "camera.play" in state["widgets"], "the same panel")
        self.assertEqual(state["shot"], str(self.shot))
        self.window.terminate()  # closes as the button does
        self.wait_for_exit()

        kept = self.folder / "state/bounce/window.json"
        kept.write_text(kept.read_text()[:40])
        self.open(self.shot, *SMALL, "--frames", "3")
        self.wait_for_exit()
        self.assertEqual(len(re.findall("state is ignored", self.said())), 1, self.said())

    def test_hazards_are_looked_for_in_a_running_window(self):
        """A person's own pass reads what its other invocations write: said once somebody asks, and on the next run no more."""
        (self.root / "glsl/user").mkdir()
        (self.root / "glsl/user/smear.comp").write_text(
            "layout(local_size_x = 8, local_size_y = 8) in;\nlayout(FORMAT_out_radiance) uniform image2D out_radiance;\nvoid main() {\n"
            "    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);\n"
            "    imageStore(out_radiance, texel, imageLoad(out_radiance, max(texel - 1, ivec2(0))));\n}\n")
        (self.root / "assets/graphs/smeared.json").write_text(json.dumps({"version": 1, "extends": "direct", "passes": [
            {"before": "tonemap", "id": "smear", "type": "compute", "shader": "user/smear.comp"}]}))
        self.open(self.shot, "--graph", "smeared", "--size", "%dx%d" % PICTURE)
        self.assertNotIn("graph.hazards", self.state()["widgets"])
        self.click("graph.check_hazards")
        state = self.wait(lambda state: "graph.order_problem" in state["widgets"], "what the pass is told")
        self.assertIn("graph.hazards", state["widgets"])
        self.assertRegex(self.said(), r"order: .*smear\.comp:2: 'out_radiance' is read and written by invocations that nothing orders")
        self.assertNotIn("hazard: ", self.said())
        rendered = state["rendered"]
        self.click("graph.check_hazards")
        self.wait(lambda state: "graph.hazards" not in state["widgets"] and state["rendered"] > rendered, "the end of it")
        self.assertNotIn("[error]", self.said())

    def test_a_gpu_reset(self):
        """The window, and all that was on the GPU, is made again; an edited value survives."""
        self.open(self.shot, *SMALL, "--set", "tonemap.exposure=1", "--size", "%dx%d" % PICTURE, "--simulate-reset", "4", "--frames", "9",
                  "--capture-on-exit", "last.png")
        self.wait_for_exit()
        self.assertEqual(self.said().count("the window and everything on the GPU are made again"), 1)
        self.assertNotIn("[error]", self.said())
        self.assertEqual(self.state()["parameters"]["tonemap.exposure"], "1")
        self.assertTrue(png_pixel(self.out / "last.png", 5, 5))

    def test_a_gpu_reset_while_a_person_works(self):
        """Camera, edited light, values, switches and the picture are there again; the edited program is disabled, and says why."""
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE, "--disable", "shadow_maps", "--simulate-reset", "120")
        self.drag("tonemap.exposure", 0.5, 0.6)
        self.drag("light.0.outer_cone", 0.5, 0.3)
        camera = self.state()["camera"]
        self.drag("viewport", 0.5, 0.55)
        self.wait(lambda state: state["camera"] != camera and state["undo"] == "camera", "another camera, once the mouse is up")
        before = self.capture()
        self.edit("glsl/surface/tonemap.comp", "void main()", "// edited\nvoid main()")
        self.wait(lambda state: "compiled" in self.said(), "the edited program")
        kept = self.state()
        self.assertIsNone(self.window.poll())
        self.assertNotIn("reset", self.said(), "it came too early for this test")

        self.input("key", "c")  # continuously
        state = self.wait(lambda state: state["problems"], "the reset")
        self.input("key", "c")
        self.assertIn("the GPU was reset because of what this program did", self.said())
        self.assertRegex(state["problems"][0], r"pass tonemap: .*tonemap\.comp: disabled: the GPU was reset, and it was compiled last")
        for name in ("camera", "parameters", "undo", "shot", "graph", "size", "frame"):
            self.assertEqual(state[name], kept[name], name)
        self.edit("glsl/surface/tonemap.comp", "// edited", "// again")
        self.wait(lambda state: not state["problems"], "the edit that tries it again")
        after = self.capture()
        for x, y in ((10, 10), (48, 32), (70, 50)):
            self.assertEqual(png_pixel(after, x, y), png_pixel(before, x, y))
        self.input("key", "ctrl+z")  # what was done before can be undone
        self.wait(lambda state: state["undo"] != kept["undo"] or state["camera"] != kept["camera"], "undo")
        self.input("key", "ctrl+q")
        self.wait_for_exit()
        self.assertNotIn("[error]", self.said())

    def test_without_a_display(self):
        environment = self.environment()
        del environment["DISPLAY"]
        result = subprocess.run([PROGRAM, "view", str(self.shot)], env=environment, cwd=self.out, capture_output=True, text=True, timeout=60)
        self.assert_refused(result, "no window can be opened", "bounce render")

    def test_bad_input_before_the_window(self):
        for arguments, words in ((("cornel",), "did you mean 'cornell'?"), ((self.shot, "--size", "12"), "--size"),
                                 ((self.shot, "--set", "tonemap.exposre=1"), "did you mean"), ((self.shot, "--window", "big"), "--window"),
                                 ((self.shot, "--capture-on-exit", "x.jpg"), ".exr or .png")):
            self.assert_refused(self.run_program("view", *arguments), words)


if __name__ == "__main__":
    unittest.main()
