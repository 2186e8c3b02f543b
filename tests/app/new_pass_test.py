"""`bounce new pass NAME`: what it writes works at once."""

import json
import unittest

from program import SMALL, ProgramTest, png_pixel


class NewPass(ProgramTest):
    def graph_text(self):
        return (self.root / "assets/graphs/direct.json").read_text()

    def test_writes_a_pass_that_changes_the_picture(self):
        self.assert_good(self.run_program("render", self.shot, *SMALL, "-o", "before.png"))
        made = self.run_program("new", "pass", "edge_glow")
        self.assert_good(made)
        self.assertIn("user/edge_glow.comp", made.stdout)
        listed = self.run_program("params", "direct")
        self.assertRegex(listed.stdout, r"edge_glow\.strength +1 +\[0, 2\]")
        for name, strength in (("off", "0"), ("on", "1")):
            self.assert_good(self.run_program("render", self.shot, *SMALL, "--set", f"edge_glow.strength={strength}",
                                              "--set", "edge_glow.tint=0,1,0", "-o", f"{name}.png"))
        before, off, on = (png_pixel(self.out / f"{name}.png", 24, 46) for name in ("before", "off", "on"))
        self.assertGreater(off[0], 0)
        self.assertEqual(off, before)
        self.assertEqual((on[0], on[2]), (0, 0))
        self.assertGreater(on[1], 0)

    def test_the_rest_of_the_graph_and_its_comments_stay(self):
        """In a graph that extends another, and in one that is whole; the pass stands before the tone map in both."""
        before = json.loads(self.graph_text())
        self.assert_good(self.run_program("new", "pass", "edges"))
        after = json.loads(self.graph_text())
        self.assertEqual(after.pop("passes"), before.pop("passes", []) + [
            {"before": "tonemap", "id": "edges", "type": "compute", "shader": "user/edges.comp"}])
        self.assertEqual(after, before)
        whole = self.run_program("graph", "base/surface", "--expanded").stdout
        text = "// Mine.\n" + whole.replace('    { "id": "tonemap"', '    // The last one.\n    { "id": "tonemap"')
        path = self.root / "assets/graphs/whole.json"
        path.write_text(text)
        self.assert_good(self.run_program("new", "pass", "haze", "--graph", "whole"))
        self.assertEqual(path.read_text(), text.replace(
            '{ "id": "tonemap"', '{ "id": "haze", "type": "compute", "shader": "user/haze.comp" },\n    { "id": "tonemap"'))
        plan = self.run_program("graph", "whole", "--shot", str(self.shot)).stdout
        self.assertLess(plan.index(". compose"), plan.index(". haze"))
        self.assertLess(plan.index(". haze"), plan.index(". tonemap"))

    def test_names_that_cannot_be(self):
        graph = (self.root / "assets/graphs/direct.json").read_text()
        for name in ("Edges", "two__words", "_edges", "edges_", "9th", "", "a.b", "../x", "graph"):
            self.assert_refused(self.run_program("new", "pass", name), name)
        self.assert_refused(self.run_program("new", "pass", "gbuffer"), "gbuffer")
        self.assert_refused(self.run_program("new", "pass", "edges", "--graph", "direkt"), "did you mean 'direct'?")
        self.assertEqual((self.root / "assets/graphs/direct.json").read_text(), graph)
        self.assertFalse((self.root / "glsl/user").exists() and list((self.root / "glsl/user").iterdir()))
        self.assert_good(self.run_program("new", "pass", "edges"))
        self.assert_refused(self.run_program("new", "pass", "edges"), "edges")

    def test_with_a_class(self):
        """Beside the shader's folder: passes/user for glsl/user."""
        self.assert_good(self.run_program("new", "pass", "edge_glow", "--cpp"))
        text = (self.root / "passes/user/edge_glow.cpp").read_text()
        self.assertIn('BOUNCE_REGISTER_PASS("edge_glow", EdgeGlowPass,', text)
        self.assertIn('{"user/edge_glow.comp"}', text)
        self.assertNotIn("@", text)
        self.assertIn('"type": "edge_glow"', self.graph_text())
        self.assert_refused(self.run_program("new", "pass", "rsm", "--cpp"), "there is a pass type of that name")


if __name__ == "__main__":
    unittest.main()
