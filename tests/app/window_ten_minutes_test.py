"""A person's first ten minutes, by real events: open, orbit, switch the method, find the voxels' resolution, look at the
voxels, compare with the reference, break and mend a shader, save, reopen. At the machine's own pace, and at a second a frame."""

import json
import unittest

from program import LIMIT, SMALL
from window_driver import PICTURE, WindowTest
from window_input_test import SLOW

VOXELS = ["--set", "voxelization.resolution=32", "--set", "occlusion_voxels.resolution=32"]


class TenMinutes(WindowTest):
    def graph(self, name, extends, rounds):
        """That graph, with a pass that takes its time."""
        passes = [{"before": "tonemap", "id": "slow", "type": "compute", "shader": "user/slow.comp", "params": {"rounds": rounds}}]
        (self.root / f"assets/graphs/{name}.json").write_text(json.dumps({"version": 1, "extends": extends, "passes": passes}))

    def ten_minutes(self, rounds):
        (self.root / "glsl/user").mkdir()
        (self.root / "glsl/user/slow.comp").write_text(SLOW)
        self.graph("aaa_first", "direct", rounds)
        self.graph("aaa_second", "dvs", rounds)

        # Open, and orbit.
        self.open(self.shot, *SMALL, "--graph", "aaa_first", "--size", "%dx%d" % PICTURE)
        camera = self.state()["camera"]
        self.drag("viewport", 0.5, 0.55)
        turned = self.wait(lambda state: state["camera"] != camera and state["undo"] == "camera", "another camera")["camera"]

        # Another method, by the list of graphs.
        self.click("graph.choose")
        self.click("graph.choose.aaa_second")
        state = self.wait(lambda state: state["graph"] == "aaa_second" and state["notice"].startswith("opened"), "the method", 300)
        self.assertEqual(state["problems"], [])
        self.assertEqual(state["camera"], turned)

        # What is the resolution of its voxels, and what does another one do?
        self.type("parameters.filter", "resolution")
        self.wait(lambda state: "voxelization.resolution" in state["widgets"], "the parameter")
        self.click("voxelization.resolution")
        self.click("voxelization.resolution.32")
        self.wait(lambda state: state["parameters"].get("voxelization.resolution") == "32", "32 voxels along a side", 300)

        # The voxels, one click away; Escape goes back.
        self.click("views.open")
        self.click("views.debug.voxels")
        state = self.wait(lambda state: state["pinned"] == "debug.voxels", "the voxels", 300)
        self.assertFalse(state["notice_is_error"], state["notice"])
        self.move(*self.place("viewport"))
        self.input("key", "Escape")
        self.wait(lambda state: state["pinned"] == "", "the final picture")

        # How far is it from the truth?
        self.click("tab.Compare")
        self.click("compare.start")
        state = self.wait(lambda state: state["comparison"]["samples"] >= 8 and not state["comparison"]["running"], "the reference",
                          2.5 * LIMIT)
        self.assertGreater(state["comparison"]["relative_rmse"], 0)
        self.assertLess(state["comparison"]["relative_rmse"], 2)
        self.click("compare.view.split")
        self.click("compare.view.off")

        # A shader breaks, the picture stays, and it is mended.
        self.edit("glsl/surface/tonemap.comp", "void main() {", "void main() { int broken = undeclared_name;")
        self.wait(lambda state: any("undeclared_name" in row for row in state["problems"]), "the error row", 300)
        self.edit("glsl/surface/tonemap.comp", " int broken = undeclared_name;", "")
        self.wait(lambda state: not state["problems"], "the error to go", 300)

        # Saved, closed, and opened again: the same view.
        self.move(*self.place("viewport"))
        self.input("key", "ctrl+s")
        self.wait(lambda state: state["notice"].startswith("saved"), "the saved shot")
        shot = next(self.out.glob("*_view_*.json"))
        self.input("key", "ctrl+q")
        self.wait_for_exit()
        self.assertEqual([line for line in self.said().splitlines() if "[error]" in line and "undeclared_name" not in line], [])
        self.open(shot, *SMALL, "--graph", "aaa_second", *VOXELS[:2], "--size", "%dx%d" % PICTURE)
        again = self.state()["camera"]
        for name in ("position", "target"):
            for axis in range(3):
                self.assertAlmostEqual(again[name][axis], turned[name][axis], 4)

    def test_at_the_pace_of_the_machine(self):
        self.ten_minutes(0)

    def test_at_a_second_a_frame(self):
        self.ten_minutes(40000)


if __name__ == "__main__":
    unittest.main()
