"""What a person does while a slow frame is rendered is seen in its order, each event with the pointer and the keys as they
were at it; and what was done is kept when the process is killed."""

import json
import time
import unittest

from program import SMALL
from window_driver import PICTURE, WindowTest

SLOW = """layout(local_size_x = 8, local_size_y = 8) in;
layout(FORMAT_out_radiance) uniform image2D out_radiance;  //! ordered: each has its own texel
uniform int rounds = 40000;  //! [0, 60000] how much it works
void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    vec4 value = imageLoad(out_radiance, texel);
    float x = value.x;
    for (int i = 0; i < rounds; ++i) x = fract(sin(x * 12.9898) * 437.585);
    imageStore(out_radiance, texel, value + vec4(1e-9 * x));
}
"""


class WindowInput(WindowTest):
    def open_slow(self):
        """Frames of about a second, one after another."""
        (self.root / "glsl/user").mkdir()
        (self.root / "glsl/user/slow.comp").write_text(SLOW)
        (self.root / "assets/graphs/slow.json").write_text(json.dumps({"version": 1, "extends": "direct", "passes": [
            {"before": "tonemap", "id": "slow", "type": "compute", "shader": "user/slow.comp"}]}))
        self.open(self.shot, *SMALL, "--graph", "slow", "--size", "%dx%d" % PICTURE, "--set", "graph.rebuild=every_frame")
        self.move(*self.place("viewport"))
        self.input("key", "c")  # continuously
        start, state = time.monotonic(), self.state()
        self.wait(lambda later: later["rendered"] >= state["rendered"] + 3, "slow frames")
        self.frame = (time.monotonic() - start) / 3

    def wait_until_kept(self, what):
        """Until the state file holds the work that `what` is content with."""
        def holds(_):
            try:
                return what(json.loads((self.folder / "state/bounce/window.json").read_text()))
            except FileNotFoundError:
                return False
        self.wait(holds, "the state file")

    def rest(self, frames=3):
        before = self.state()["rendered"]
        return self.wait(lambda state: state["rendered"] >= before + frames, "frames that go on")

    def test_a_click_lands_where_the_pointer_was(self):
        self.open_slow()
        camera = self.state()["camera"]
        self.place("direct.shadows", 0.05)
        # Pressed on a checkbox; when the frame ends, the pointer is on the picture.
        self.events("mousemove", "[direct.shadows@0.05]", "mousedown", 1, "mouseup", 1, "mousemove", "[viewport]")
        self.wait(lambda state: state["parameters"].get("direct.shadows") == "false", "the switch that was clicked")
        self.assertEqual(self.rest()["camera"], camera)
        # A click on the picture, between two places of the panels, turns nothing.
        self.events("mousemove", "[direct.shadows@0.05]", "mousemove", "[viewport]", "mousedown", 1, "mouseup", 1, "mousemove",
                    "[tab.Scene]")
        self.assertEqual(self.rest()["camera"], camera)
        # Two clicks in one frame are two.
        self.events("mousemove", "[direct.shadows@0.05]", "click", 1, "mousemove", "[tab.Camera]", "click", 1)
        self.wait(lambda state: "direct.shadows" not in state["parameters"], "the switch that was clicked again")
        self.wait(lambda state: "camera.play" in state["widgets"], "the tab that was clicked after it")
        # A drag goes from where it began to where it ended, and no further.
        self.events("mousemove", "[viewport@0.5]", "mousedown", 1, "mousemove", "[viewport@0.55]", "mouseup", 1, "mousemove",
                    "[tab.Scene]")
        turned = self.wait(lambda state: state["camera"] != camera, "the camera that was turned")["camera"]
        self.assertEqual(self.rest()["camera"], turned)
        self.input("key", "Home")
        self.wait(lambda state: state["camera"] == camera, "the shot's camera")
        self.events("mousemove", "[viewport@0.5]")
        self.drag("viewport", 0.5, 0.55)
        slowly = self.wait(lambda state: state["camera"] != camera, "the camera that was turned")["camera"]
        for axis in range(3):
            self.assertAlmostEqual(slowly["position"][axis], turned["position"][axis], 4)

    def test_the_panels_answer_while_a_frame_is_rendered(self):
        """A frame of several slow passes is cut between them: what is asked meanwhile is seen before it ends, and what changes
        the graph takes effect at its end."""
        (self.root / "glsl/user").mkdir()
        (self.root / "glsl/user/slow.comp").write_text(SLOW)
        (self.root / "assets/graphs/slow.json").write_text(json.dumps({"version": 1, "extends": "direct", "passes": [
            {"before": "tonemap", "id": f"slow{i}", "type": "compute", "shader": "user/slow.comp"} for i in range(6)]}))
        self.open(self.shot, *SMALL, "--graph", "slow", "--size", "%dx%d" % PICTURE, "--set", "graph.rebuild=every_frame")
        places = {widget: self.place(widget) for widget in ("tab.Camera", "graph.enabled.slow0")}
        self.move(*self.place("tab.Scene"))

        def begin():
            """A frame that has begun, with its number."""
            self.wait(lambda state: not state["mid_frame"], "the end of a frame")
            rendered = self.state()["rendered"]
            self.input("key", "period")
            self.wait(lambda state: state["mid_frame"] and "status.frame_share" in state["widgets"], "a frame on its way")
            return rendered

        def click(widget):
            self.events("mousemove", *places[widget], "click", 1)

        rendered = begin()
        click("tab.Camera")
        state = self.wait(lambda state: "camera.play" in state["widgets"], "the tab")
        self.assertTrue(state["mid_frame"])
        self.assertLessEqual(state["rendered"], rendered + 1)
        # A pass that is switched off in the midst of a frame runs to its end, and not in the next.
        self.wait(lambda state: not state["mid_frame"] and state["rendered"] > rendered, "the end of the frame")
        begin()
        click("graph.enabled.slow0")
        self.wait(lambda state: "slow0" not in state["times"]["ms"] and state["undo"] == "switch off slow0", "the pass that is off")
        self.assertNotIn("[error]", self.said())
        # Two clicks are two, whatever the frame does.
        begin()
        click("graph.enabled.slow0")
        click("graph.enabled.slow0")
        self.wait(lambda state: not state["mid_frame"], "the end of the frame")
        self.wait(lambda state: "slow0" not in state["times"]["ms"] and state["undo"] == "switch off slow0", "off again")
        # A window that is closed does not wait for the frame.
        begin()
        self.input("key", "ctrl+q")
        self.wait_for_exit()
        self.assertNotIn("[error]", self.said())

    def test_what_is_typed_while_a_frame_is_slow(self):
        self.open_slow()
        camera = self.state()["camera"]
        # F frames the scene, but not in a text; Ctrl+A takes all of the text.
        self.events("mousemove", "[parameters.filter]", "click", 1, "key", "f", "key", "shift+a", "key", "ctrl+a", "key", "shift+b",
                    "key", "c")
        self.wait(lambda state: state["filter"] == "Bc", "the text")
        for _ in range(4):  # whichever event a frame ends with
            self.events("keydown", "shift", "key", "a", "keyup", "shift", "keydown", "ctrl", "key", "a", "keyup", "ctrl", "key", "x")
            self.wait(lambda state: state["filter"] == "x", "the text")
            self.events("key", "BackSpace", "key", "shift+d", "key", "e")
            self.wait(lambda state: state["filter"] == "De", "the text")
        self.events("key", "ctrl+a", "key", "BackSpace", "key", "Return")
        self.wait(lambda state: state["filter"] == "", "no text")
        self.assertEqual(self.rest()["camera"], camera)
        # Ctrl is held over the click, and over nothing after it.
        self.place("tonemap.exposure")
        self.events("mousemove", "[tonemap.exposure]", "keydown", "ctrl", "click", 1, "keyup", "ctrl", "key", "2", "key", "Return")
        self.wait(lambda state: state["parameters"].get("tonemap.exposure") == "2", "the value that was typed")
        self.assertEqual(self.rest()["camera"], camera)
        self.input("key", "ctrl+q")
        self.wait_for_exit()

    def test_a_killed_process_loses_nothing(self):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE)
        self.drag("tonemap.exposure", 0.5, 0.6)
        self.drag("light.0.outer_cone", 0.5, 0.3)
        camera = self.state()["camera"]
        self.drag("viewport", 0.5, 0.55)
        self.wait(lambda state: state["camera"] != camera, "another camera")
        self.input("key", "b")
        self.wait_until_kept(lambda kept: kept["bookmarks"] and kept["work"]["graphs"] and
                             all({"camera", "lights"} <= set(work) for work in kept["work"]["shots"].values()))
        left = self.state()
        self.kill()
        state_file = self.folder / "state/bounce/window.json"
        self.assertEqual(list(state_file.parent.glob("*.tmp*")), [])

        self.open(*SMALL)  # on what was open
        self.assertIn("your edits of last time are here again: the camera, 1 light; tonemap.exposure=", self.state()["notice"])
        for name in ("shot", "graph", "camera", "lights"):
            self.assertEqual(self.state()[name], left[name], name)
        self.assertEqual(self.state()["parameters"]["tonemap.exposure"], left["parameters"]["tonemap.exposure"])
        self.input("key", "Home")
        self.input("key", "1")
        self.wait(lambda state: state["camera"] == left["camera"], "the bookmark")

        # What was taken back does not come again.
        self.input("key", "F5")
        self.wait(lambda state: "discard.yes" in state["widgets"], "the question")
        self.input("key", "Return")
        self.wait(lambda state: state["notice"].startswith("opened"), "the shot as it is in its file")
        self.assertNotEqual(self.state()["lights"], left["lights"])
        self.assertEqual(self.state()["camera"], camera)
        self.click("parameters.reset_all")
        self.wait_until_kept(lambda kept: not kept["work"]["graphs"] and not kept["work"]["shots"])
        self.kill()
        self.open(*SMALL)
        self.assertNotIn("your edits", self.state()["notice"])
        self.assertEqual(self.state()["camera"], camera)

        # A window that runs by itself is what its command says; so is what the command gives.
        self.drag("tonemap.exposure", 0.5, 0.6)
        self.wait_until_kept(lambda kept: kept["work"]["graphs"])
        self.kill()
        self.open(*SMALL, "--set", "tonemap.exposure=-1")
        self.assertEqual(self.state()["parameters"]["tonemap.exposure"], "-1")
        self.kill()
        self.open(*SMALL, "--frames", "3")
        self.wait_for_exit()
        self.assertNotIn("tonemap.exposure", self.state()["parameters"])

    def test_work_that_fits_no_more_is_told_once(self):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE)
        self.drag("light.0.outer_cone", 0.5, 0.3)
        self.wait_until_kept(lambda kept: kept["work"]["shots"])
        self.kill()
        text = self.shot.read_text()
        self.shot.write_text(text.replace('"cornell.gltf"', '"cornell.gltf", "lights": [{"type": "point", "position": [2, 2, 2]}]'))
        self.open(self.shot, *SMALL)
        state = self.wait(lambda state: state["notice_is_error"], "what became of the edits")
        self.assertIn("does not fit it any more: its lights are others", state["notice"])
        self.wait_until_kept(lambda kept: not kept["work"]["shots"])
        self.kill()
        self.open(self.shot, *SMALL)
        self.assertEqual(self.state()["notice"], "")


if __name__ == "__main__":
    unittest.main()
