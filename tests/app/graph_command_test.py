"""`bounce graph`: the plan as a picture, with every pass and resource in it."""

import re
import unittest
import xml.etree.ElementTree

from program import ProgramTest

SVG = "{http://www.w3.org/2000/svg}"


class GraphCommand(ProgramTest):
    def picture(self, *arguments):
        result = self.run_program("graph", *arguments, "--svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        return xml.etree.ElementTree.fromstring(result.stdout), result.stdout

    def test_svg_holds_the_plan(self):
        root, text = self.picture("direct", "--shot", "cornell")
        plan = self.run_program("graph", "direct", "--shot", "cornell").stdout
        passes = re.findall(r"^ *\d+\. (\w+)", plan, re.M)
        self.assertGreater(len(passes), 3)
        boxes = [group for group in root.iter(SVG + "g") if group.get("class", "").startswith("pass")]
        shown = {box.find(SVG + "text").text: box for box in boxes}
        self.assertLessEqual(set(passes), set(shown))
        for name in passes:
            self.assertEqual(shown[name].get("class"), "pass")
        skipped = re.findall(r"^    (\w+): (.+)$", plan[plan.find("\nskipped"):plan.find("\nresources:")], re.M) if "\nskipped" in plan else []
        for name, reason in skipped:
            self.assertEqual(shown[name].get("class"), "pass skipped")
            self.assertIn(reason, shown[name].find(SVG + "title").text)
        self.assertEqual(len(shown), len(passes) + len(skipped))
        titles = [path.find(SVG + "title").text for path in root.iter(SVG + "path")]
        self.assertIn("gbuffer.normal: gbuffer → direct", titles)
        self.assertIn("out.radiance: compose → tonemap", titles)
        width, height = float(root.get("width")), float(root.get("height"))
        for rect in (rect for box in boxes for rect in box.iter(SVG + "rect")):
            x, y, w, h = (float(rect.get(key)) for key in ("x", "y", "width", "height"))
            self.assertTrue(0 <= x and x + w <= width and 0 <= y and y + h <= height)

    def test_svg_goes_into_a_file(self):
        _, text = self.picture("direct")
        result = self.run_program("graph", "direct", "--svg", "-o", "plan.svg")
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
        self.assertEqual((self.out / "plan.svg").read_text(), text)
        self.assert_refused(self.run_program("graph", "direct", "-o", "other.svg"), "--svg", leaves=["plan.svg"])
        self.assert_refused(self.run_program("graph", "direct", "--svg", "-o", "no/folder.svg"), "no/folder.svg", leaves=["plan.svg"])

    def test_switches_show(self):
        root, _ = self.picture("lrsm", "--shot", "cornell")
        reasons = {group.find(SVG + "title").text for group in root.iter(SVG + "g") if group.get("class") == "pass skipped"}
        self.assertTrue(any("switched off" in reason for reason in reasons), reasons)


if __name__ == "__main__":
    unittest.main()
