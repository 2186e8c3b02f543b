"""What light of a shot a graph leaves out is told: once on the log, and by `bounce info` for all graphs."""

import unittest

from program import SMALL, ProgramTest

LAMP = """{"scene": "cornell_lamp.gltf", "width": 16, "height": 16,
 "camera": {"position": [2.78, 2.73, -8], "target": [2.78, 2.73, 0], "vfov_deg": 39.3}}"""
EMITTERS = "leaves out light of emissive surfaces on others"


class OmittedLight(ProgramTest):
    def said_by(self, graph, shot):
        result = self.run_program("render", shot, "--graph", graph, "--size", "16x16", *SMALL, "-o", "x.exr")
        self.assert_good(result)
        return result.stderr

    def test_a_render_tells_it_once(self):
        lamp = self.folder / "lamp.json"
        lamp.write_text(LAMP)
        self.assertEqual(self.said_by("rsm", lamp).count(EMITTERS), 1)
        self.assertNotIn("leaves out", self.said_by("rsm", self.shot))
        # It is what the graph's transport states, whatever the graph is called.
        self.edit("assets/graphs/rsm.json", '"out.indirect_diffuse"]', '"out.emitted", "out.indirect_diffuse"]')
        self.assertNotIn("leaves out", self.said_by("rsm", lamp))

    def test_info_names_the_graphs(self):
        lamp = self.folder / "lamp.json"
        lamp.write_text(LAMP.replace('"width"', '"environment": [1, 1, 1], "width"'))
        told = self.run_program("info", lamp)
        self.assert_good(told)
        lines = {line[14:].split(" is left out by ")[0]: line.split(" is left out by ")[1].split(", ")
                 for line in told.stdout.splitlines() if " is left out by " in line}
        self.assertEqual(sorted(lines), ["light of emissive surfaces on others", "light of the environment"])
        for light, graphs in lines.items():
            self.assertIn("rsm", graphs, light)
            for whole in ("traced", "path_traced", "dvs_tuned"):
                self.assertNotIn(whole, graphs, light)
        self.assertNotIn("left out", self.run_program("info", self.shot).stdout)


if __name__ == "__main__":
    unittest.main()
