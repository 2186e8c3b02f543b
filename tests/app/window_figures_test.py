"""Every figure belongs to the settings that made it, and a comparison compares like with like."""

import json
import unittest

from program import SMALL
from window_driver import PICTURE, WindowTest
from window_input_test import SLOW

GLOW = """layout(local_size_x = 8, local_size_y = 8) in;
layout(FORMAT_out_radiance) uniform image2D out_radiance;  //! ordered: each has its own texel
void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    imageStore(out_radiance, texel, imageLoad(out_radiance, texel) + vec4(0.4));
}
"""


class WindowFigures(WindowTest):
    def open_with(self, name, shader, *more):
        (self.root / "glsl/user").mkdir()
        (self.root / f"glsl/user/{name}.comp").write_text(shader)
        (self.root / f"assets/graphs/{name}.json").write_text(json.dumps({"version": 1, "extends": "direct", "passes": [
            {"before": "tonemap", "id": name, "type": "compute", "shader": f"user/{name}.comp"}]}))
        self.open(self.shot, *SMALL, "--graph", name, "--size", "%dx%d" % PICTURE, *more)

    def measured(self, state):
        return state["times"]["current"] and state["times"]["runs"]["slow"] >= 1

    def set_rounds(self, text):
        self.place("slow.rounds")
        self.events("mousemove", "[slow.rounds]", "keydown", "ctrl", "click", 1, "keyup", "ctrl", "key", text, "key", "Return")
        self.wait(lambda state: state["parameters"].get("slow.rounds") == text, "the value")
        self.move(*self.place("viewport"))
        return self.wait(self.measured, "its times")

    def test_times_follow_edits(self):
        self.open_with("slow", SLOW, "--set", "slow.rounds=300", "--set", "graph.rebuild=every_frame")
        # Nothing moves and nothing plays: enough frames are rendered to have figures, and no more.
        state = self.wait(self.measured, "times of a window that is paused")
        dear = state["times"]["ms"]["slow"]
        rendered = state["rendered"] + 8
        for tab in ("Resources", "Shaders", "Graph"):
            self.click("tab." + tab)
        self.assertLessEqual(self.state()["rendered"], rendered)
        # A long history of the dear setting …
        self.move(*self.place("viewport"))
        self.input("key", "c")
        self.wait(lambda state: state["times"]["runs"]["slow"] >= 30, "a history", 180)
        self.input("key", "c")
        # … counts for nothing once the work is 300 times less.
        state = self.set_rounds("1")
        self.assertLess(state["times"]["ms"]["slow"], 0.5 * dear)
        self.assertLess(max(state["times"]["runs"].values()), 15)
        # The camera is a setting, too.
        self.drag("viewport", 0.5, 0.55)
        state = self.wait(self.measured, "times of the new view")
        self.assertLess(max(state["times"]["runs"].values()), 15)

    def test_the_point_is_of_what_is_shown(self):
        self.open_with("slow", SLOW, "--set", "slow.rounds=300")
        self.click("tab.Compare")
        self.click("compare.start")
        self.wait(lambda state: state["comparison"]["samples"] >= 8 and not state["comparison"]["running"], "the reference")
        state = self.wait(self.measured, "times")
        self.assertAlmostEqual(state["comparison"]["live_ms"], state["times"]["passes_ms"], 6)
        self.click("compare.keep")
        self.wait(lambda state: state["comparison"]["points"] == 1, "the kept point")
        state = self.set_rounds("1")
        self.assertAlmostEqual(state["comparison"]["live_ms"], sum(state["times"]["ms"].values()), 3)
        self.assertLess(max(state["times"]["runs"].values()), 15)

    def test_split_and_flicker_show_the_same_light(self):
        """A graph that shows more than it is compared by: a glow that is part of the picture, and of no part."""
        self.open_with("glow", GLOW)
        self.click("tab.Compare")
        self.click("compare.start")
        self.wait(lambda state: state["comparison"]["samples"] >= 8 and not state["comparison"]["running"], "the reference")
        x0, y0, x1, y1 = map(round, self.state()["widgets"]["viewport"])

        def mean():
            self.move(*self.place("tab.Compare"))
            pixels = self.display.pixels(x0, y0 + 40, x1, y1)  # under the caption
            return sum(sum(pixel[:3]) for row in pixels for pixel in row) / (len(pixels) * len(pixels[0]))

        def show(view, caption):
            self.click("compare.view." + view)
            self.wait(lambda state: state["comparison"]["caption"].startswith(caption), "the caption " + caption)
            return mean()

        show("split", "graph | reference: direct")
        self.assertIn("no curve", self.state()["comparison"]["caption"])
        self.drag("compare.split", 0.5, 1.2)  # all of it is the graph's
        self.wait(lambda state: state["comparison"]["split"] > 0.99, "the border at the edge")
        own = mean()
        truth = show("reference", "reference: direct")
        shown = show("off", "")
        self.assertAlmostEqual(own / truth, 1, delta=0.05)
        self.assertGreater(shown / truth, 1.2)  # which is why it matters
        self.input("key", "ctrl+q")
        self.wait_for_exit()

    def test_the_plot_of_frame_times_is_there(self):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE)
        self.click("tab.Camera")
        self.wait(lambda state: "camera.frame_times" in state["widgets"], "the plot")
        self.move(*self.place("viewport"))
        self.input("key", "c")
        start = self.state()["rendered"]
        self.wait(lambda state: state["rendered"] > start + 20, "frames")
        self.input("key", "c")
        x0, y0, x1, y1 = map(round, self.state()["widgets"]["camera.frame_times"])
        self.assertGreater(x1 - x0, 150)
        self.assertGreater(y1 - y0, 40)
        bottom = self.display.pixels(x0, y1 - 3, x1, y1 - 2)[0]
        self.assertGreater(len({tuple(pixel) for pixel in bottom}), 1, "no bar is drawn")


if __name__ == "__main__":
    unittest.main()
