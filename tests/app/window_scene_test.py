"""Lights that come and go and are dragged in the picture, cameras that can be undone, parameters over their range."""

import json
import shutil
import unittest

from program import ROOT, SMALL
from window_driver import PICTURE, WindowTest


SLOW = """layout(local_size_x = 8, local_size_y = 8) in;
layout(FORMAT_out_radiance) uniform image2D out_radiance;  //! ordered: each has its own texel
void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(out_radiance)))) return;
    vec4 value = imageLoad(out_radiance, texel);
    float x = value.x;
    for (int i = 0; i < 3000; ++i) x = fract(sin(x * 12.9898) * 437.585);
    imageStore(out_radiance, texel, value + vec4(1e-9 * x));
}
"""


class WindowScene(WindowTest):
    def open_small(self, *arguments):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE, *arguments)

    def test_lights_come_and_go(self):
        self.open_small()
        before = self.state()["lights"]
        self.click("lights.add.point")
        added = self.wait(lambda state: len(state["lights"]) == len(before) + 1, "another light")
        self.assertEqual(added["undo"], "add a light")
        self.assertEqual(added["lights"][:-1], before)
        self.wait(lambda state: "gizmo.middle" in state["widgets"], "its handles")
        # By its axis it moves along it, by its middle with the pointer.
        number = len(before)
        where = added["lights"][-1]["position"]
        x0, y0, x1, y1 = self.state()["widgets"]["gizmo.axis.1"]
        x, y = round((x0 + x1) / 2), round((y0 + y1) / 2)
        camera = self.state()["camera"]
        self.move(x, y)
        self.input("mousedown", 1)
        self.move(x, y - 8)
        self.move(x, y - 16)
        self.input("mouseup", 1)
        state = self.wait(lambda state: state["lights"][-1]["position"] != where, "the dragged light")
        after = state["lights"][-1]["position"]
        self.assertGreater(after[1], where[1])
        self.assertAlmostEqual(after[0], where[0], 4)
        self.assertAlmostEqual(after[2], where[2], 4)
        self.assertEqual(state["camera"], camera, "the camera stays")
        self.assertTrue(state["undo"].endswith("place"))
        self.input("key", "ctrl+z")
        self.wait(lambda state: state["lights"][-1]["position"] == where, "undo")
        # What was added outlives the process.
        self.wait(lambda _: len(self.kept_lights()) == number + 1 and
                  abs(self.kept_lights()[-1]["translation"][1] - where[1]) < 1e-6, "the state file")
        self.kill()
        self.open(*SMALL)
        self.assertEqual(len(self.state()["lights"]), number + 1)
        self.assertEqual(self.state()["lights"][-1]["position"], where)
        self.click("tab.Capture")
        self.click("tab.Scene")
        self.place(f"light.{number}.enabled")
        self.input("key", "ctrl+s")
        self.wait(lambda state: state["notice"].startswith("saved"), "the saved shot")
        saved = json.loads((self.out / "tiny_view_001.json").read_text())
        self.assertEqual(len(saved["lights"]), number + 1)

    def kept_lights(self):
        try:
            kept = json.loads((self.folder / "state/bounce/window.json").read_text())
        except FileNotFoundError:
            return []
        return next((work["lights"] for work in kept["work"]["shots"].values() if "lights" in work), [])

    def test_a_light_is_deleted_and_offered(self):
        self.open_small()
        count = len(self.state()["lights"])
        self.click("light.0.delete")
        self.wait(lambda state: len(state["lights"]) == count - 1, "one fewer")
        self.assertEqual(count, 1, "this test counts on one light")
        self.wait(lambda state: "banner.headlight" in state["widgets"], "the offer of light")
        self.click("banner.headlight")
        self.wait(lambda state: len(state["lights"]) == 1 and "banner.headlight" not in state["widgets"], "light")
        self.input("key", "ctrl+z")
        self.wait(lambda state: len(state["lights"]) == 0, "undo")
        self.input("key", "ctrl+z")
        self.wait(lambda state: len(state["lights"]) == 1, "the light of the file")

    def test_moves_of_the_camera_are_undone(self):
        self.open_small()
        camera = self.state()["camera"]
        self.drag("viewport", 0.5, 0.55)
        moved = self.wait(lambda state: state["undo"] == "camera", "the step")["camera"]
        self.assertNotEqual(moved, camera)
        self.input("key", "ctrl+z")
        self.wait(lambda state: state["camera"] == camera and not state["undo"], "undo")
        self.input("key", "ctrl+y")
        self.wait(lambda state: state["camera"] == moved, "redo")

    def test_a_slow_picture_is_coarse_while_it_moves(self):
        (self.root / "glsl/user").mkdir()
        (self.root / "glsl/user/slow.comp").write_text(SLOW)
        (self.root / "assets/graphs/slow.json").write_text(json.dumps({"version": 1, "extends": "direct", "passes": [
            {"before": "tonemap", "id": "slow", "type": "compute", "shader": "user/slow.comp"}]}))
        self.open(self.shot, *SMALL, "--graph", "slow")
        state = self.wait(lambda state: state["times"]["timed"] and state["times"]["current"], "a frame that is measured")
        whole = state["size"]
        x, y = self.place("viewport")
        self.move(x, y)
        self.input("mousedown", 1)
        for step in range(1, 5):
            self.input("mousemove", x + 9 * step, y)
        coarse = self.wait(lambda state: state["size"][0] < 0.8 * whole[0], "fewer pixels")["size"]
        self.assertAlmostEqual(coarse[0] / coarse[1], whole[0] / whole[1], 1)
        self.input("mouseup", 1)
        self.wait(lambda state: state["size"] == whole, "all pixels")
        # What is kept has all pixels at any time.
        self.input("key", "F12")
        self.wait(lambda state: state["last_capture"], "a capture")

    def test_a_parameter_over_its_range(self):
        self.open_small()
        self.place("tonemap.curve")
        self.click("tonemap.curve.mark")
        self.click("tonemap.curve.sweep")
        state = self.wait(lambda state: state["notice"].startswith("tonemap.curve was taken over"), "the sweep")
        self.assertNotIn("tonemap.curve", state["parameters"])
        self.assertIn("sweep.ms", state["widgets"])
        self.click("sweep.close")
        self.wait(lambda state: "sweep.title" not in state["widgets"], "the end of it")

    def test_passes_stay_closed(self):
        self.open_small()
        self.place("tonemap.exposure")
        name = "parameters.pass.tonemap"
        self.click(name)
        self.wait(lambda state: "tonemap.exposure.mark" not in state["widgets"], "the closed pass")
        self.wait(lambda _: "tonemap" in self.kept_passes(), "the state file")
        self.kill()
        self.open_small()
        self.assertNotIn("tonemap.exposure.mark", self.state()["widgets"])

    def kept_passes(self):
        try:
            return json.loads((self.folder / "state/bounce/window.json").read_text()).get("closed_passes", [])
        except FileNotFoundError:
            return []

    def test_a_shot_goes_into_the_list(self):
        (self.root / "assets/shots").unlink()  # that of the tree stays as it is
        shutil.copytree(ROOT / "assets/shots", self.root / "assets/shots")
        self.open_small()
        self.click("tab.Capture")
        self.type("capture.shot_name", "mine")
        self.click("capture.shot_in_list")
        self.wait(lambda state: state["notice"].startswith("saved"), "the saved shot")
        self.assertTrue((self.root / "assets/shots/mine.json").exists())
        self.click("capture.shot_in_list")
        self.wait(lambda state: state["notice_is_error"] and "already" in state["notice"], "the refusal")


if __name__ == "__main__":
    unittest.main()
