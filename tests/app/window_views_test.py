"""The graph as boxes and wires, views of what is inside it, plots over time, snapshots: by real events."""

import json
import pathlib
import unittest

from program import SMALL, png_pixel
from window_driver import PICTURE, SIZE, WindowTest

VIEW = """// How far the surfaces are, as a ramp.
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D gbuffer_depth;
layout(FORMAT_debug_ramp) writeonly uniform image2D debug_ramp;
void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(texel, imageSize(debug_ramp)))) imageStore(debug_ramp, texel, vec4(float(texel.x) + texelFetch(gbuffer_depth, texel, 0).x * 1e-6));
}
"""


class WindowViews(WindowTest):
    def open_small(self, *arguments):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE, *arguments)
        self.move(*self.place("viewport"))

    def open_with_view(self):
        (self.root / "glsl/user").mkdir()
        (self.root / "glsl/user/view_ramp.comp").write_text(VIEW)
        (self.root / "assets/graphs/viewed.json").write_text(json.dumps({
            "version": 1, "extends": "direct", "resources": {"debug.ramp": {"format": "r32f", "size": ["width", "height"], "clear": False}},
            "passes": [{"before": "tonemap", "id": "view_ramp", "type": "compute", "shader": "user/view_ramp.comp",
                        "dispatch": "debug.ramp", "enabled": False}]}))
        self.open_small("--graph", "viewed")

    def test_pinned_rays_stay_in_the_scene(self):
        self.open_small("--graph", "ldm_ao", "--set", "ldm.maps=16", "--set", "ldm.resolution=32")
        self.click("tab.Cones")
        self.click("cones.on")
        self.move(*self.place("viewport"))
        self.click("tab.Cones")
        self.click("cones.draw")
        self.wait(lambda state: state["pinned"] == "debug.rays_view" and "views.pin_rays" in state["widgets"], "the view of the rays")
        self.click("views.pin_rays")
        state = self.wait(lambda state: state["pinned_rays"] == 1 and "views.unpin_rays" in state["widgets"], "the pinned rays")
        self.assertRegex(state["notice"], r"^pinned \d+ rays$")
        self.move(*self.place("viewport"))
        self.input("key", "Escape")  # the final picture, and the rays over it
        self.wait(lambda state: state["pinned"] == "", "the final picture")

        def orange():
            """Pixels of the screen with the colour of rays that hit."""
            x0, y0, x1, y1 = (round(v) for v in self.state()["widgets"]["viewport"])
            self.wait(lambda state: not state["mid_frame"], "rest")
            rows = self.display.pixels(x0, y0, x1, y1)
            return {(x, y) for y, row in enumerate(rows) for x, (b, g, r) in enumerate(row) if r > 150 and r > g + 60 and g > b + 40}
        before = orange()
        self.assertGreater(len(before), 20)
        camera = self.state()["camera"]
        self.drag("viewport", 0.5, 0.6)
        self.wait(lambda state: state["camera"] != camera, "another camera")
        self.assertEqual(self.state()["pinned_rays"], 1)
        after = orange()
        self.assertGreater(len(after), 20)
        self.assertNotEqual(before, after)
        self.click("views.unpin_rays")
        self.wait(lambda state: state["pinned_rays"] == 0, "no pinned rays")

    def test_tabs_and_columns_move(self):
        """And are there again in the next run."""
        self.open_small()
        state = self.state()
        self.assertLess(state["widgets"]["tab.Scene"][2], state["widgets"]["viewport"][0])
        self.assertGreater(state["widgets"]["tab.Graph"][0], state["widgets"]["viewport"][2])
        self.input("key", "F4")
        state = self.wait(lambda state: state["widgets"]["tab.Scene"][0] > state["widgets"]["viewport"][2], "swapped columns")
        self.assertLess(state["widgets"]["tab.Graph"][2], state["widgets"]["viewport"][0])
        # The bar beside a column follows the pointer on either side.
        x, y = SIZE[0] - 290 - 2, 300
        left = state["widgets"]["tab.Scene"][0]
        self.move(x, y)
        self.input("mousedown", 1)
        self.move(x - 40, y)
        self.input("mouseup", 1)
        self.wait(lambda state: abs(state["widgets"]["tab.Scene"][0] - (left - 40)) <= 4, "a wider column")

        self.move(*self.place("tab.Pixel"))
        self.input("click", 3)
        self.click("tab.Pixel.to_left")
        state = self.wait(lambda state: state["widgets"]["tab.Pixel"][0] > state["widgets"]["viewport"][2], "the tab in the other column")
        self.move(*self.place("tab.Camera"))
        self.input("click", 3)
        self.click("tab.Camera.to_bottom")
        self.wait(lambda state: state["widgets"]["tab.Camera"][1] > state["widgets"]["viewport"][3] and "camera.position" in state["widgets"],
                  "the tab below the picture, and in front")
        self.move(*self.place("viewport"))
        self.input("key", "ctrl+q")
        self.wait_for_exit()

        self.open_small()
        state = self.state()
        self.assertGreater(state["widgets"]["tab.Scene"][0], state["widgets"]["viewport"][2])
        self.assertGreater(state["widgets"]["tab.Pixel"][0], state["widgets"]["viewport"][2])
        self.assertGreater(state["widgets"]["tab.Camera"][1], state["widgets"]["viewport"][3])

    def test_the_graph_as_boxes_and_wires(self):
        self.open_small()
        self.input("key", "n")
        state = self.wait(lambda state: state["bottom"] == "Nodes" and "nodes.pass.direct" in state["widgets"], "the boxes")
        passes = set(state["times"]["ms"])
        drawn = {name.split(".", 2)[2]: rect for name, rect in state["widgets"].items() if name.startswith("nodes.pass.")}
        self.assertLessEqual(passes, set(drawn))
        self.assertLess(drawn["gbuffer"][2], drawn["direct"][0])
        self.assertLess(drawn["compose"][2], drawn["tonemap"][0])
        # A click keeps a pass's output in view; another lets go of it.
        self.click("nodes.pass.direct")
        self.wait(lambda state: state["pinned"] == "out.direct", "the pinned output")
        self.click("nodes.pass.direct")
        self.wait(lambda state: state["pinned"] == "", "the final picture")
        # The wheel zooms about the pointer, a drag moves; neither clicks.
        self.move(*self.place("nodes.pass.direct"))
        before = self.state()["widgets"]["nodes.pass.direct"]
        self.input("click", 4)
        state = self.wait(lambda state: state["widgets"]["nodes.pass.direct"][2] - state["widgets"]["nodes.pass.direct"][0] >
                          1.1 * (before[2] - before[0]), "a larger box")
        x, y = self.place("nodes.pass.direct")
        self.input("mousedown", 1)
        self.move(x + 30, y + 10)
        self.move(x + 60, y + 10)
        self.input("mouseup", 1)
        self.wait(lambda later: abs(later["widgets"]["nodes.pass.direct"][0] - state["widgets"]["nodes.pass.direct"][0] - 60) < 8, "the moved graph")
        self.assertEqual(self.state()["pinned"], "")
        self.click("nodes.whole")
        # A tick switches, and can be undone.
        self.click("nodes.tick.direct")
        self.wait(lambda state: "direct" not in state["times"]["ms"] and state["undo"] == "switch off direct", "the pass that is off")
        self.input("key", "ctrl+z")
        self.wait(lambda state: "direct" in state["times"]["ms"], "undo")
        # A resource is seen small where the pointer is, and kept by a click.
        self.move(*self.place("nodes.resource.gbuffer.gbuffer.normal"))
        self.wait(lambda state: "nodes.thumbnail" in state["widgets"], "the thumbnail")
        self.click("nodes.resource.gbuffer.gbuffer.normal")
        self.wait(lambda state: state["pinned"] == "gbuffer.normal", "the pinned resource")
        self.input("key", "n")
        self.wait(lambda state: state["bottom"] == "", "the end of the row")

    def test_views_are_one_click_away(self):
        self.open_with_view()
        self.assertNotIn("view_ramp", self.state()["times"]["ms"])
        self.click("views.open")
        self.click("views.debug.ramp")
        state = self.wait(lambda state: state["pinned"] == "debug.ramp" and state["viewed"]["resource"] == "debug.ramp", "the view")
        self.assertIn("view_ramp", state["times"]["ms"])
        self.assertIn("legend", state["widgets"])
        self.assertAlmostEqual(state["viewed"]["range"][0], 0, 3)
        self.assertAlmostEqual(state["viewed"]["range"][1], PICTURE[0] - 1, 3)
        self.click("tab.Resources")
        state = self.wait(lambda state: sum(state["viewed"]["histogram"]) > 0, "the histogram")
        self.assertEqual(sum(state["viewed"]["histogram"]), PICTURE[0] * PICTURE[1])
        grey = self.display.pixels(*self.picture_point(0.5), *self.picture_point(0.5, 1))[0][0]
        self.assertEqual(len(set(grey[:3])), 1)
        self.click("views.false_colour")
        self.wait(lambda state: state["viewed"]["false_colour"], "false colour")
        self.wait(lambda state: len(set(self.display.pixels(*self.picture_point(0.5), *self.picture_point(0.5, 1))[0][0][:3])) > 1, "a colour")
        # What it switched on goes off again.
        self.click("views.open")
        self.click("views.final")
        self.wait(lambda state: state["pinned"] == "" and "view_ramp" not in state["times"]["ms"], "the final picture")

    def picture_point(self, share, further=0):
        x0, y0, x1, y1 = self.state()["widgets"]["viewport"]
        return round(x0 + share * (x1 - x0)) + further, round((y0 + y1) / 2) + further

    def test_what_happened_over_time(self):
        self.open_small("--set", "graph.rebuild=every_frame")
        self.input("key", "t")
        self.wait(lambda state: state["bottom"] == "Over time" and "time.plots" in state["widgets"], "the plots")
        self.move(*self.place("viewport"))
        self.input("key", "c")  # continuously
        self.wait(lambda state: state["timeline"]["frames"] >= 12 and state["timeline"]["change"] >= 0, "frames")
        self.input("key", "c")
        state = self.state()
        self.assertEqual(state["timeline"]["change"], 0, "nothing moves")
        self.assertGreater(state["timeline"]["passes_ms"], 0)
        x0, y0, x1, y1 = state["widgets"]["time.plots"]
        self.move(round(x1) - 12, round(y0) + 20)
        self.input("mousedown", 1)
        self.input("mouseup", 1)
        pinned = self.wait(lambda state: state["timeline"]["pinned"] > 0, "the pinned frame")["timeline"]["pinned"]
        self.input("key", "c")
        self.wait(lambda later: later["rendered"] > state["rendered"] + 5, "more frames")
        self.assertEqual(self.state()["timeline"]["number"], pinned)

    def test_snapshots_are_told_apart(self):
        self.open_small()
        self.input("key", "p")
        self.wait(lambda state: len(state["snapshots"]) == 1, "a snapshot")
        self.drag("tonemap.exposure", 0.5, 0.8)
        value = self.wait(lambda state: "tonemap.exposure" in state["parameters"], "the value")["parameters"]["tonemap.exposure"]
        self.move(*self.place("viewport"))
        self.input("key", "p")
        self.wait(lambda state: len(state["snapshots"]) == 2, "another")
        self.click("tab.Snapshots")
        self.click("snapshots.left.0")
        self.click("snapshots.right.1")
        self.click("snapshots.view.wipe")
        self.move(5, SIZE[1] - 5)
        dark, bright = (lambda: self.display.pixels(*self.picture_point(0.45), *self.picture_point(0.45, 1))[0][0],
                        lambda: self.display.pixels(*self.picture_point(0.55), *self.picture_point(0.55, 1))[0][0])
        self.wait(lambda state: sum(bright()[:3]) > sum(dark()[:3]), "two pictures side by side")
        self.click("snapshots.page")
        path = self.wait(lambda state: state["last_capture"].endswith(".html"), "the page")["last_capture"]
        page = pathlib.Path(path).read_text(encoding="utf-8")
        self.assertEqual(page.count('src="data:image/png;base64,'), 2)
        self.assertIn('exposure&quot;: ' + value, page.replace('"', "&quot;"))
        self.assertEqual(page.count("<script"), 2, "the data and the page's own")
        self.click("snapshots.remove.0")
        self.wait(lambda state: len(state["snapshots"]) == 1, "one fewer")


if __name__ == "__main__":
    unittest.main()
