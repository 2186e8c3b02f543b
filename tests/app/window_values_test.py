"""Values take effect when a person is done with them; one that the graph cannot run with leaves picture and number."""

import json
import unittest

from program import SMALL, png_pixel
from window_driver import PICTURE, WindowTest

GRID = """layout(local_size_x = 8, local_size_y = 8) in;
layout(FORMAT_out_radiance) uniform image2D out_radiance;  //! ordered: each has its own texel
layout(FORMAT_grid_cells) writeonly uniform image2D grid_cells;
uniform int cells = 32;  //! {32, 64, 128} cells along a side
void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(texel, imageSize(grid_cells)))) imageStore(grid_cells, texel, vec4(1.0));
    imageStore(out_radiance, texel, imageLoad(out_radiance, texel) + vec4(float(cells) / 1000.0));
}
"""


class WindowValues(WindowTest):
    def open_grid(self):
        (self.root / "glsl/user").mkdir()
        (self.root / "glsl/user/grid.comp").write_text(GRID)
        (self.root / "assets/graphs/grid.json").write_text(json.dumps({
            "version": 1, "extends": "direct",
            "parameters": {"divisor": {"default": 2, "range": [0, 8]}},
            "resources": {"grid.cells": {"format": "r32f", "size": ["64 / divisor", "64 / divisor"]}},
            "passes": [{"before": "tonemap", "id": "grid", "type": "compute", "shader": "user/grid.comp",
                        "dispatch": "out.radiance"}]}))
        self.open(self.shot, *SMALL, "--graph", "grid", "--size", "%dx%d" % PICTURE)

    def parameters(self):
        return self.state()["parameters"]

    def type_into(self, widget, text):
        """Ctrl and a click make a slider a text field, whose text is chosen."""
        self.move(*self.place(widget))
        self.input("keydown", "ctrl")
        self.input("mousedown", 1)
        self.input("mouseup", 1)
        self.input("keyup", "ctrl")
        for key in text:
            self.input("key", {".": "period", "-": "minus"}.get(key, key))

    def test_what_is_typed_takes_effect_at_its_end(self):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE)
        self.place("tonemap.exposure")
        self.type_into("tonemap.exposure", "1.5")
        self.assertNotIn("tonemap.exposure", self.parameters())
        self.input("key", "Return")
        self.wait(lambda state: state["parameters"].get("tonemap.exposure") == "1.5", "the value")
        self.type_into("tonemap.exposure", "12")
        self.assertEqual(self.parameters()["tonemap.exposure"], "1.5")
        self.input("key", "Escape")
        self.input("key", "ctrl+z")  # the one step that there was
        self.wait(lambda state: "tonemap.exposure" not in state["parameters"] and not state["undo"], "undo")
        # A click elsewhere ends it, too.
        self.type_into("tonemap.exposure", "3")
        self.assertNotIn("tonemap.exposure", self.parameters())
        self.click("tab.Scene")
        self.wait(lambda state: state["parameters"].get("tonemap.exposure") == "3", "the value")
        # Lights are no parameters, and no other.
        before = self.state()["lights"]
        self.type_into("light.0.outer_cone", "25")
        self.assertEqual(self.state()["lights"], before)
        self.input("key", "Escape")
        self.assertEqual(self.state()["lights"], before)
        self.type_into("light.0.outer_cone", "25")
        self.input("key", "Return")
        self.wait(lambda state: abs(state["lights"][0]["outer_cone"] - 0.43633) < 1e-3, "the cone")
        self.input("key", "ctrl+z")
        self.wait(lambda state: state["lights"] == before, "undo")

    def test_steps_are_choices(self):
        self.open_grid()
        dark = self.middle(self.capture())
        self.click("grid.cells")
        state = self.wait(lambda state: "grid.cells.128" in state["widgets"], "the choices")
        self.assertEqual({name for name in state["widgets"] if name.startswith("grid.cells.") and name.split(".")[2].isdigit()},
                         {"grid.cells.32", "grid.cells.64", "grid.cells.128"})
        # Escape closes them, and nothing else happens.
        self.input("key", "Escape")
        self.wait(lambda state: "grid.cells.128" not in state["widgets"], "the end of the choices")
        self.assertNotIn("grid.cells", self.parameters())
        self.click("grid.cells")
        self.click("grid.cells.128")
        self.wait(lambda state: state["parameters"].get("grid.cells") == "128", "the choice")
        self.assertGreater(sum(self.middle(self.capture())), sum(dark))
        # Elsewhere a number that is none of them is refused.
        self.assert_refused(self.run_program("render", self.shot, "--graph", "grid", "--set", "grid.cells=100", "-o", "x.png"),
                            "'100' is out of range for parameter 'cells': it takes one of {32, 64, 128}",
                            leaves=[path.name for path in self.out.iterdir()])

    def test_a_value_that_the_graph_cannot_run_with(self):
        self.open_grid()
        good = self.capture()
        for attempt in range(2):
            self.type_into("graph.divisor", "0")
            self.input("key", "Return")
            state = self.wait(lambda state: state["notice_is_error"], "the refusal")
            self.assertIn("graph.divisor stays 2", state["notice"])
            self.assertEqual(self.said().count("graph.divisor stays 2"), attempt + 1, "told once a time")
            self.assertNotIn("graph.divisor", state["parameters"])
            self.assertEqual(state["problems"], [])
            self.assertEqual(state["undo"], "")
            after = self.capture()  # its notice takes the place of the refusal
            for x, y in ((10, 10), (48, 32), (70, 50)):
                self.assertEqual(png_pixel(after, x, y), png_pixel(good, x, y))
        # By the mouse: nothing is planned until it is let go of, and then it is refused likewise.
        plans = self.state()["plans"]
        self.drag("graph.divisor", 0.3, 0.01)
        self.wait(lambda state: state["notice_is_error"], "the refusal")
        self.assertNotIn("graph.divisor", self.parameters())
        self.drag("graph.divisor", 0.3, 0.9)
        self.wait(lambda state: float(state["parameters"].get("graph.divisor", 0)) > 5, "a value that is good")
        self.assertLessEqual(self.state()["plans"], plans + 2)
        self.assertEqual(self.state()["undo"], "graph.divisor")
        self.input("key", "ctrl+z")
        self.wait(lambda state: "graph.divisor" not in state["parameters"], "undo")


if __name__ == "__main__":
    unittest.main()
