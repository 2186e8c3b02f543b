"""Edits are told where they go along, are there again where they were left, and are saved by the key that people press."""

import json
import unittest

from program import SMALL
from window_driver import PICTURE, SIZE, WindowTest


class WindowWork(WindowTest):
    def choose(self, list_name, item):
        self.click(list_name)
        self.click(item)

    def test_edits_go_along_into_another_graph_and_it_is_told(self):
        (self.root / "assets/graphs/aaa_other.json").write_text(json.dumps({
            "version": 1, "extends": "direct", "remove": ["shadow_maps"], "passes": [{"id": "direct", "params": {"shadows": False}}]}))
        self.open(self.shot, "--graph", "direct", "--size", "%dx%d" % PICTURE)
        self.drag("tonemap.exposure", 0.5, 0.6)
        value = self.wait(lambda state: "tonemap.exposure" in state["parameters"], "the value")["parameters"]["tonemap.exposure"]
        self.drag("shadow_maps.resolution", 0.5, 0.3)
        resolution = self.wait(lambda state: "shadow_maps.resolution" in state["parameters"], "the value")["parameters"]["shadow_maps.resolution"]
        self.choose("graph.choose", "graph.choose.aaa_other")
        state = self.wait(lambda state: state["graph"] == "aaa_other" and state["notice"].startswith("opened"), "the other graph")
        self.assertIn(f"your edits went along: tonemap.exposure={value}", state["notice"])
        self.assertIn(f"kept for direct: shadow_maps.resolution={resolution}", state["notice"])
        self.assertEqual(state["parameters"], {"tonemap.exposure": value})
        # What was set last counts, and what the other graph had no place for is there again.
        self.drag("tonemap.exposure", 0.5, 0.4)
        self.wait(lambda state: state["parameters"].get("tonemap.exposure") != value, "another value")
        self.choose("graph.choose", "graph.choose.direct")
        state = self.wait(lambda state: state["graph"] == "direct" and state["notice"].startswith("opened"), "the first graph")
        self.assertIn(f"there again: shadow_maps.resolution={resolution}", state["notice"])
        self.assertEqual(state["parameters"]["shadow_maps.resolution"], resolution)
        self.assertNotEqual(state["parameters"]["tonemap.exposure"], value)

    def test_edits_of_a_shot_outlive_a_switch(self):
        self.open("cornell", *SMALL, "--size", "%dx%d" % PICTURE)
        self.drag("light.0.outer_cone", 0.5, 0.3)
        self.wait(lambda state: state["undo"].endswith("cone"), "the edit of the light")
        camera = self.state()["camera"]
        self.drag("viewport", 0.5, 0.55)
        left = self.wait(lambda state: state["camera"] != camera and state["undo"] == "camera", "the edits")
        self.choose("scene.shot", "scene.shot.cornell_lamp")
        state = self.wait(lambda state: state["shot"] == "cornell_lamp" and state["notice"].startswith("opened"), "another shot")
        self.assertIn("your edits of cornell are kept", state["notice"])
        self.choose("scene.shot", "scene.shot.cornell")
        state = self.wait(lambda state: state["shot"] == "cornell" and state["notice"].startswith("opened"), "the first shot")
        self.assertIn("with your edits: the camera, 1 light", state["notice"])
        self.assertEqual(state["lights"], left["lights"])
        self.assertEqual(state["camera"], left["camera"])
        self.input("key", "F5")
        self.wait(lambda state: "discard.yes" in state["widgets"], "the question")
        self.input("key", "Escape")
        self.wait(lambda state: "discard.yes" not in state["widgets"], "the end of the question")
        self.assertEqual(self.state()["lights"], left["lights"])
        self.input("key", "F5")
        self.wait(lambda state: "discard.yes" in state["widgets"], "the question again")
        self.input("key", "Return")
        self.wait(lambda state: state["lights"] != left["lights"] and state["camera"] == camera, "the shot as it is in its file")

    def test_files_are_opened_by_clicks(self):
        """Through folders, by a part of the name; what was opened is in the list of the next run."""
        folder = self.out / "mine" / "deeper"
        folder.mkdir(parents=True)
        for path in (self.out / "first.json", folder / "other.json"):
            path.write_text(self.shot.read_text())
        self.open(self.out / "first.json", *SMALL, "--size", "%dx%d" % PICTURE)
        self.input("key", "ctrl+o")
        self.click("open.entry.mine/")
        self.click("open.entry.deeper/")
        self.wait(lambda state: "open.entry.other.json" in state["widgets"], "the folder's files")
        self.type("open.filter", "nothing")
        self.wait(lambda state: "open.entry.other.json" not in state["widgets"], "no file of that name")
        for _ in "nothing":
            self.input("key", "BackSpace")
        self.click("open.entry.other.json")
        self.wait(lambda state: state["shot"] == str(folder / "other.json") and state["notice"].startswith("opened"), "the file")
        self.assertNotIn("open.filter", self.state()["widgets"])
        self.input("key", "ctrl+o")
        self.wait(lambda state: "open.filter" in state["widgets"], "the dialog again, where it was left")
        self.assertIn("open.entry.other.json", self.state()["widgets"])
        self.input("key", "Escape")
        self.wait(lambda state: "open.filter" not in state["widgets"], "the end of the dialog")
        self.input("key", "ctrl+q")
        self.wait_for_exit()
        self.open(self.out / "first.json", *SMALL, "--size", "%dx%d" % PICTURE)
        self.input("key", "ctrl+o")
        self.click("open.recent.other.json")
        self.wait(lambda state: state["shot"] == str(folder / "other.json") and state["notice"].startswith("opened"), "what was opened last")

    def test_escape_closes_what_is_open_and_nothing_else(self):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE)
        self.click("graph.pass.direct")
        self.wait(lambda state: state["pinned"] == "out.direct", "the pinned output")
        for dropdown, item in (("graph.choose", "graph.choose.direct"), ("scene.shot", "scene.shot.cornell"),
                               ("tonemap.curve", "tonemap.curve.none")):
            self.place(dropdown)
            self.click(dropdown)
            self.wait(lambda state: item in state["widgets"], "what can be chosen")
            self.input("key", "Escape")
            self.wait(lambda state: item not in state["widgets"], "the end of the list")
            self.assertEqual(self.state()["pinned"], "out.direct")
        self.input("key", "Escape")
        self.wait(lambda state: state["pinned"] == "", "the final picture")

    def test_control_s_saves_the_shot(self):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE)
        self.drag("light.0.outer_cone", 0.5, 0.3)
        self.input("key", "ctrl+s")
        self.wait(lambda state: state["notice"].startswith("saved"), "the saved shot")
        saved = json.loads((self.out / "tiny_view_001.json").read_text())
        self.assertEqual(saved["lights_mode"], "replace")
        self.assertEqual(list(self.out.glob("*.png")), [])
        self.capture("F12")
        self.assertEqual(len(list(self.out.glob("*.png"))), 1)
        self.input("key", "question")
        self.wait(lambda state: state["keys_shown"], "the keys")
        self.input("key", "Escape")
        self.wait(lambda state: not state["keys_shown"], "the end of the keys")

    def test_the_palette_finds_what_there_is(self):
        self.open(self.shot, *SMALL, "--size", "%dx%d" % PICTURE)
        camera = self.state()["camera"]
        for text, row, done in (("exposure", "tonemap.exposure", lambda state: state["filter"] == "tonemap.exposure"),
                                ("view gbuffer.normal", "gbuffer.normal", lambda state: state["pinned"] == "gbuffer.normal"),
                                ("final picture", "show the final picture again (unpin)", lambda state: state["pinned"] == "")):
            self.input("key", "ctrl+p")
            self.wait(lambda state: "palette.text" in state["widgets"], "the palette")
            self.events("type", "--delay", 20, text)
            self.wait(lambda state: "palette.row." + row in state["widgets"], "the row")
            self.input("key", "Return")
            self.wait(lambda state: done(state) and "palette.text" not in state["widgets"], "what was chosen")
        self.input("key", "ctrl+p")
        self.wait(lambda state: "palette.text" in state["widgets"], "the palette")
        self.input("key", "Escape")
        self.wait(lambda state: "palette.text" not in state["widgets"], "the end of the palette")
        self.assertEqual(self.state()["camera"], camera)

    def test_why_it_is_dark(self):
        """A shot under a sky through a graph that scatters none of it."""
        shot = json.loads(self.shot.read_text())
        self.shot.write_text(json.dumps(dict(shot, environment=[1, 1, 1])))
        (self.root / "assets/graphs/skyless.json").write_text(json.dumps({
            "version": 1, "extends": "direct", "transport": {"bounces": 1, "parts": ["out.direct"]}}))
        self.open(self.shot, *SMALL, "--graph", "skyless", "--size", "%dx%d" % PICTURE)
        self.wait(lambda state: {"banner.text", "banner.open"} <= set(state["widgets"]), "why it is dark")
        self.click("banner.hide")
        self.wait(lambda state: "banner.text" not in state["widgets"], "the end of it")

    def test_rows_stay_in_their_panel(self):
        """Why a pass is skipped is written over two columns: within the list, however it is scrolled."""
        (self.root / "glsl/user").mkdir()
        (self.root / "glsl/user/idle.comp").write_text(
            "layout(local_size_x = 8, local_size_y = 8) in;\nlayout(FORMAT_out_radiance) uniform image2D out_radiance;  //! ordered: one\n"
            "void main() { ivec2 p = ivec2(gl_GlobalInvocationID.xy); imageStore(out_radiance, p, imageLoad(out_radiance, p)); }\n")
        (self.root / "assets/graphs/idle.json").write_text(json.dumps({"version": 1, "extends": "direct", "passes": [
            {"before": "tonemap", "id": f"idle_{i}", "type": "compute", "shader": "user/idle.comp", "enabled": False} for i in range(40)]}))
        self.open(self.shot, *SMALL, "--graph", "idle", "--size", "%dx%d" % PICTURE)
        rect = {name: tuple(map(round, self.state()["widgets"][name])) for name in ("tab.Graph", "tab.Parameters", "parameters.filter")}
        right = SIZE[0] - 8
        above = (rect["tab.Graph"][0], rect["tab.Graph"][1], right, rect["tab.Graph"][3])
        below = (rect["tab.Parameters"][0], rect["tab.Parameters"][1], right, rect["parameters.filter"][3])
        # The pointer stays on the list's scroll bar, where no tooltip comes up.
        self.move(SIZE[0] - 13, rect["tab.Graph"][3] + 160)
        first = None
        for _ in range(12):
            now = self.display.pixels(*above), self.display.pixels(*below)
            first = first or now
            self.assertTrue(now == first, "something is written outside the list")
            self.input("click", 5)
        self.assertNotIn("graph.pass.gbuffer", self.state()["widgets"], "it was not scrolled")


if __name__ == "__main__":
    unittest.main()
