"""Lights and objects that are dragged in the picture, cameras that can be undone and follow a path, parameters over their range."""

import json
import pathlib
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
        return self.kept("lights") or []

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

    def drag_by(self, widget, dx, dy):
        """By pixels, in two steps."""
        x, y = self.place(widget)
        self.move(x, y)
        self.input("mousedown", 1)
        self.move(x + dx // 2, y + dy // 2)
        self.move(x + dx, y + dy)
        self.input("mouseup", 1)

    def same_as_saved(self, *options):
        """What is shown, and the shot that Ctrl+S makes of it, rendered without the window: the same file."""
        self.input("key", "ctrl+s")
        # A key that is pressed while a slow frame is rendered is answered at its end.
        state = self.wait(lambda state: state["notice"].startswith("saved") and state["notice"].endswith(".json"), "the saved shot")
        saved = self.out / pathlib.Path(state["notice"].split(" ", 1)[1]).name
        shown = self.capture("F12")
        self.assert_good(self.run_program("render", saved, *SMALL, "--size", "%dx%d" % PICTURE, *options, "-o", "again.png"))
        self.assertEqual(shown.read_bytes(), (self.out / "again.png").read_bytes())
        return json.loads(saved.read_text())

    def write_objects(self):
        shot = json.loads(self.shot.read_text())
        block = {"scene": "cornell_lamp.gltf", "scale": 0.25}
        self.shot.write_text(json.dumps(dict(shot, scene="cornell.gltf", objects=[
            dict(block, name="block", position=[2, 1.5, -1]),
            dict(block, path=[{"t": 0, "position": [4, 1, 0]}, {"t": 1, "position": [4, 3, 0]}])])))

    def test_objects_are_dragged_and_turned(self):
        self.write_objects()
        self.open_small()
        first = self.state()["objects"]
        self.assertEqual(first[0]["position"], [2, 1.5, -1])
        camera = self.state()["camera"]
        self.click("object.0.handles")
        self.wait(lambda state: "gizmo.direction" in state["widgets"], "its handles")
        self.drag_by("gizmo.axis.1", 0, -16)
        state = self.wait(lambda state: state["objects"][0]["position"] != first[0]["position"], "the dragged object")
        moved = state["objects"][0]
        self.assertGreater(moved["position"][1], 1.6)
        for axis in (0, 2):
            self.assertAlmostEqual(moved["position"][axis], first[0]["position"][axis], 4)
        self.assertEqual((state["camera"], state["objects"][1], state["undo"]), (camera, first[1], "block: place"))
        self.drag_by("gizmo.direction", 14, 10)
        turned = self.wait(lambda state: state["objects"][0]["rotation"] != first[0]["rotation"], "the turned object")["objects"][0]
        self.assertEqual(turned["position"], moved["position"])
        self.assertAlmostEqual(sum(part ** 2 for part in turned["rotation"]), 1, 9)
        saved = self.same_as_saved()
        self.assertEqual(saved["objects"][0]["position"], moved["position"])
        self.assertEqual(saved["objects"][0]["scale"], 0.25)
        self.assertNotIn("position", saved["objects"][1])
        # Each drag is one step.
        self.input("key", "ctrl+z")
        self.wait(lambda state: state["objects"][0] == moved, "the turn is undone")
        self.input("key", "ctrl+z")
        self.wait(lambda state: state["objects"] == first and not state["undo"], "the move is undone")
        self.input("key", "ctrl+y")
        self.wait(lambda state: state["objects"][0] == moved, "redo")
        # It outlives the process, and F5 takes it back.
        self.wait(lambda _: self.kept("objects"), "the state file")
        self.kill()
        self.open(*SMALL)
        self.assertEqual(self.state()["objects"][0], moved)
        self.assertIn("1 object", self.state()["notice"])
        self.input("key", "F5")
        self.wait(lambda state: "discard.yes" in state["widgets"], "the question")
        self.input("key", "Return")
        self.wait(lambda state: state["objects"] == first, "the shot as it is in its file")

    def test_objects_by_numbers(self):
        self.write_objects()
        self.open_small()
        first = self.state()["objects"]
        # Typed into the field of Y, in the middle of the row.
        for widget, text, key, wanted in (("object.0.turn", "90", "rotation", [0, 0.5 ** 0.5, 0, 0.5 ** 0.5]),
                                          ("object.0.position", "2.5", "position", [2, 2.5, -1]),
                                          ("object.0.scale", "0.5", "scale", [0.5, 0.5, 0.5])):
            self.type_into(widget, text)
            state = self.wait(lambda state: state["objects"][0][key] != first[0][key], widget)
            for got, want in zip(state["objects"][0][key], wanted):
                self.assertAlmostEqual(got, want, 6)
        saved = self.same_as_saved()
        self.assertEqual(saved["objects"][0]["rotation"], [0, 90, 0])
        self.assertEqual(saved["objects"][0]["scale"], 0.5)
        # Its path has the second one.
        self.type_into("object.1.position", "9")
        self.assertEqual(self.state()["objects"][1], first[1])

    def test_a_moved_object_leaves_nothing_behind(self):
        """Neither in voxels, maps and visibility that the graph keeps, nor in what "auto" was measured for."""
        self.write_objects()
        for graph in ("dvs_tuned", "traced"):
            with self.subTest(graph):
                self.open_small("--graph", graph)
                before = self.capture("F12").read_bytes()
                self.type_into("object.0.position", "3.5")
                self.wait(lambda state: state["objects"][0]["position"] == [2, 3.5, -1], "the moved object")
                self.same_as_saved("--graph", graph)
                self.assertNotEqual(self.capture("F12").read_bytes(), before)
                self.kill()
                shutil.rmtree(self.folder / "state")

    def type_into(self, widget, text):
        for _ in range(20):
            if widget in self.state()["widgets"]:
                break
            x, y = self.place("tab.Scene")
            self.move(x + 40, y + 300)
            self.input("click", 5)
        x, y = self.place(widget, 0.37)
        self.move(x, y)
        self.input("keydown", "ctrl", "mousedown", 1)
        self.input("mouseup", 1, "keyup", "ctrl")
        self.events("key", "ctrl+a", "type", "--delay", 20, text)
        self.input("key", "Return")

    def test_a_cone_is_opened_by_its_rim(self):
        shot = json.loads(self.shot.read_text())
        self.shot.write_text(json.dumps(dict(shot, lights=[{
            "type": "spot", "position": [2.78, 4, 1], "direction": [0, -1, 0.2], "inner_cone_deg": 20, "outer_cone_deg": 40,
            "intensity": 20}])))
        self.open_small()
        before = self.state()["lights"]
        self.click("light.0.handles")
        self.wait(lambda state: "gizmo.cone" in state["widgets"], "its rim")
        x0, _, x1, _ = self.state()["widgets"]["gizmo.middle"]
        right = self.place("gizmo.cone")[0] > (x0 + x1) / 2
        self.drag_by("gizmo.cone", -12 if right else 12, 0)
        state = self.wait(lambda state: state["lights"] != before, "another cone")
        light = state["lights"][0]
        self.assertLess(light["outer_cone"], before[0]["outer_cone"] - 0.02)
        self.assertGreater(light["outer_cone"], 0.1)
        self.assertAlmostEqual(light["inner_cone"] / light["outer_cone"], 0.5, 5)
        self.assertEqual((light["position"], light["direction"]), (before[0]["position"], before[0]["direction"]))
        self.assertTrue(state["undo"].endswith("cone"))
        self.assertLess(self.same_as_saved()["lights"][0]["outer_cone_deg"], 39)
        self.input("key", "ctrl+z")
        self.wait(lambda state: state["lights"] == before and not state["undo"], "undo")

    def test_bookmarks_become_a_path(self):
        self.open_small()
        own = self.state()["camera"]
        self.input("key", "b")
        self.drag("viewport", 0.5, 0.55)
        self.wait(lambda state: state["undo"] == "camera", "another camera")
        second = self.state()["camera"]
        self.input("key", "b")
        self.click("tab.Camera")
        self.click("camera.path")
        state = self.wait(lambda state: state["undo"] in ("camera path", "camera") and state["camera"] == own, "the path's first frame")
        self.assertEqual(state["frame"], 0)
        # At 60 frames a second the second bookmark comes after two seconds.
        self.input("key", "period")
        self.wait(lambda state: state["frame"] == 1, "a step")
        on_its_way = self.state()["camera"]
        self.assertNotIn(on_its_way, (own, second))
        saved = self.same_as_saved()
        self.assertEqual(saved["camera_path"][0]["position"], own["position"])
        self.assertEqual(saved["camera_path"][-1]["position"], second["position"])
        self.assertEqual(saved["camera_path"][-1]["t"], 2)
        # Recorded frames are those of the saved shot.
        self.input("key", "0")
        self.wait(lambda state: state["frame"] == 0, "the first frame")
        before = self.state()["notice"]
        self.input("key", "ctrl+s")
        notice = self.wait(lambda state: state["notice"] != before and state["notice"].startswith("saved"), "the saved shot")["notice"]
        self.input("key", "ctrl+r")
        self.wait(lambda state: state["frame"] >= 4, "frames")
        self.input("key", "ctrl+r")
        self.wait(lambda state: state["notice"].startswith("recorded"), "the end")
        frames = sorted(self.out.glob("*_take1_*.png"))
        self.assertGreaterEqual(len(frames), 4)
        self.assert_good(self.run_program("render", self.out / pathlib.Path(notice.split(" ", 1)[1]).name, *SMALL, "--size",
                                          "%dx%d" % PICTURE, "--frames", 4, "-o", "again_%04d.png"))
        for frame in range(4):
            self.assertEqual(frames[frame].read_bytes(), (self.out / f"again_{frame:04}.png").read_bytes(), frame)
        self.input("key", "Home")
        self.wait(lambda state: state["camera"] == own and state["undo"] == "drop the camera path", "the shot's camera")
        self.input("key", "ctrl+z")
        self.wait(lambda state: state["camera"] != own, "the path again")

    def kept(self, key):
        try:
            kept = json.loads((self.folder / "state/bounce/window.json").read_text())
        except FileNotFoundError:
            return None
        return next((work[key] for work in kept["work"]["shots"].values() if key in work), None)

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
