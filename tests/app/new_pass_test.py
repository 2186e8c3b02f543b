"""`bounce new pass NAME`: what it writes works at once."""

import json
import unittest

from program import SMALL, ProgramTest, exr_header, png_pixel


class NewPass(ProgramTest):
    def test_writes_a_pass_that_renders(self):
        made = self.run_program("new", "pass", "edges")
        self.assert_good(made)
        self.assertIn("user/edges.comp", made.stdout)
        result = self.run_program("render", self.shot, *SMALL, "--resource", "edges.result", "-o", "edges.exr")
        self.assert_good(result)
        self.assertEqual(sorted(exr_header(self.out / "edges.exr")[0]), ["A", "B", "G", "R"])
        listed = self.run_program("params", "direct")
        self.assertRegex(listed.stdout, r"edges\.strength +1 +\[0, 2\]")
        for name, strength in (("off", "0"), ("on", "1")):
            self.assert_good(self.run_program("render", self.shot, *SMALL, "--resource", "edges.result", "--set", f"edges.strength={strength}",
                                              "--set", "edges.tint=0,1,0", "-o", f"{name}.png"))
        off, on = (png_pixel(self.out / f"{name}.png", 24, 46) for name in ("off", "on"))
        self.assertGreater(off[0], 0)
        self.assertEqual(on, (0, off[1], 0))

    def test_the_order_and_the_rest_of_the_graph_stay(self):
        before = json.loads((self.root / "assets/graphs/direct.json").read_text())
        self.assert_good(self.run_program("new", "pass", "edges"))
        after = json.loads((self.root / "assets/graphs/direct.json").read_text())
        self.assertEqual([p for p in after["passes"] if p.get("id") != "edges"], before["passes"])
        self.assertEqual(after["about"], before["about"])

    def test_names_that_cannot_be(self):
        graph = (self.root / "assets/graphs/direct.json").read_text()
        for name in ("Edges", "two_words", "9th", "", "a.b", "../x", "graph", "scene", "material", "gl"):
            self.assert_refused(self.run_program("new", "pass", name), name)
        self.assert_refused(self.run_program("new", "pass", "gbuffer"), "gbuffer")
        self.assert_refused(self.run_program("new", "pass", "edges", "--graph", "direkt"), "did you mean 'direct'?")
        self.assertEqual((self.root / "assets/graphs/direct.json").read_text(), graph)
        self.assertFalse((self.root / "glsl/user").exists() and list((self.root / "glsl/user").iterdir()))
        self.assert_good(self.run_program("new", "pass", "edges"))
        self.assert_refused(self.run_program("new", "pass", "edges"), "edges")

    def test_with_a_class(self):
        (self.root / "passes/surface").mkdir(parents=True)
        self.assert_good(self.run_program("new", "pass", "edges", "--cpp"))
        text = (self.root / "passes/surface/edges.cpp").read_text()
        self.assertIn('BOUNCE_REGISTER_PASS("edges", EdgesPass,', text)
        self.assertNotIn("@", text)


if __name__ == "__main__":
    unittest.main()
