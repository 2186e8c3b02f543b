"""Pages without a browser: they parse, fetch nothing, name their one script by its digest, and are no larger than their pictures."""

import html.parser
import json
import re
import unittest

from page_maker import EVIL, POINTS, ROOT, PageTest, digest, point

# Bytes of a page without points: the style, the script, the chart's axes.
MAX_FRAME = 48 * 1024
# Bytes of a point beside its pictures: a row of the table and its figures in the data block.
MAX_POINT = 3 * 1024
VOID = {"meta", "img", "br", "input"}


class Parsed(html.parser.HTMLParser):
    """What stands in a page; `problems` where tags are not balanced."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.problems, self.attributes, self.texts = [], [], [], {}
        self.feed(text)
        self.close()
        if self.open:
            self.problems.append(f"never closed: {self.open}")

    def handle_starttag(self, tag, attributes):
        self.attributes += [(tag, name, value or "") for name, value in attributes]
        if tag not in VOID:
            self.open.append(tag)
            self.texts.setdefault(tag, []).append("")

    def handle_startendtag(self, tag, attributes):
        self.attributes += [(tag, name, value or "") for name, value in attributes]

    def handle_endtag(self, tag):
        if not self.open or self.open[-1] != tag:
            self.problems.append(f"</{tag}> in {self.open[-3:]} at {self.getpos()}")
        else:
            self.open.pop()

    def handle_data(self, data):
        if self.open:
            self.texts[self.open[-1]][-1] += data


class Pages(PageTest):
    def check(self, path):
        """Returns the page and its data."""
        text = path.read_text()
        page = Parsed(text)
        self.assertEqual(page.problems, [])
        data, script = page.texts["script"]
        (style,) = page.texts["style"]
        (policy,) = [value for tag, name, value in page.attributes if tag == "meta" and name == "content" and "default-src" in value]
        self.assertEqual(policy, f"default-src 'none'; img-src data:; style-src {digest(style)}; script-src {digest(script)}; "
                                 "base-uri 'none'; form-action 'none'")
        for _, name, value in page.attributes:
            self.assertFalse(name.startswith("on") or name == "style", f"the policy forbids {name}={value}")
            if name in ("src", "href", "action", "data", "srcset"):
                self.assertTrue(value.startswith("data:image/png;base64,"), value[:60])
        self.assertNotIn("url(", text)
        self.assertNotIn("@import", text)
        self.assertEqual(set(re.findall(r"https?://[^'\" ]*", text)), {"http://www.w3.org/2000/svg"}, "a name, not an address")
        for word in ("innerHTML", "outerHTML", "insertAdjacentHTML", "document.write", "eval(", "fetch(", "XMLHttpRequest", "import("):
            self.assertNotIn(word, script)
        self.assertNotIn(EVIL, re.sub(r"<script type.*?</script>", "", text, flags=re.S), "names are text")
        return page, json.loads(data)

    def test_a_chart(self):
        page, data = self.check(self.chart())
        self.assertEqual(len(data["points"]), len(POINTS))
        self.assertIn(EVIL, [one["group"] for one in data["points"]])
        rows = {int(value) for tag, name, value in page.attributes if name == "data-point"}
        self.assertEqual(rows, set(range(len(POINTS))), "a row of the table for each point of the data")
        self.assertEqual(len([1 for tag, name, _ in page.attributes if (tag, name) == ("img", "src")]), 2 * len(POINTS), "each picture once")
        self.assertEqual(sum(title.count("ms,") for title in page.texts["title"]), len(POINTS), "the plain chart is there without script")
        self.assertEqual(sum("on the Pareto front" in title for title in page.texts["title"]), 4)

    def test_what_a_chart_weighs(self):
        for count in (1, 60):
            points = [point(i % 6, key=f"{i:016x}", ms=1 + i, error=1 / (1 + i)) for i in range(count)]
            for i, one in enumerate(points):
                one["values"]["direct.normal_offset"] = str(i)
            pictures = sum(len(one["thumbnail_png"]) + len(one["error_png"]) for one in points)
            own = self.chart(points).stat().st_size - pictures
            print(f"a chart of {count} points: {own} bytes beside its pictures")
            self.assertLess(own, MAX_FRAME + count * MAX_POINT)

    def test_a_chart_over_a_parameter(self):
        _, data = self.check(self.chart(None, "--against", "resolution", "--metric", "relative_mse"))
        self.assertEqual(data["costs"][0], {"key": "against", "title": "resolution"})
        self.assertEqual(data["points"][0]["numbers"]["against"], 2048)
        self.assertIn(data["error"], [one["key"] for one in data["errors"]])

    def test_stability(self):
        _, data = self.check(self.stability())
        self.assertEqual(data["graphs"], ["direct", "direct_off"])
        self.assertEqual([len(curve["values"]) for case in data["cases"] for curve in case["curves"]], [3] * 4)

    def test_ablation(self):
        page, data = self.check(self.ablation())
        self.assertIsNone(data)
        self.assertGreater(len(page.texts["tr"]), 4)

    def test_tuning(self):
        page, data = self.check(self.tuning())
        measured = json.loads((self.out / "t.points.json").read_text())["points"]
        self.assertEqual(len(data["points"]), len([one for one in measured if "ms" in one]), "all that worked")
        marks = [one.get("mark") for one in data["points"]]
        self.assertEqual(marks.count("start"), 2, "at both sizes")
        self.assertTrue(all("hbao.steps" in dict(one["settings"]) for one in data["points"]), "the graph's own values too")

    def test_comparison(self):
        page, data = self.check(self.comparison())
        self.assertIsNone(data)
        self.assertIn(EVIL + ".exr", page.texts["figcaption"])
        self.assertIn("out.direct", page.texts["td"])

    def test_a_comparison_that_cannot_be_written(self):
        self.comparison()
        kept = [path.name for path in self.out.iterdir()]
        self.assert_refused(self.run_program("compare", "b.exr", "b.exr", "--html", "none/c.html"), "none", leaves=sorted(kept))

    def test_all_methods(self):
        _, data = self.check(self.methods())
        self.assertEqual(len(data["points"]), 4)
        self.assertEqual({one["light"] for one in data["points"]}, {"shadows", "bounce"})

    def test_a_page_without_its_parts(self):
        (self.root / "assets/pages").unlink()
        with self.assertRaises(AssertionError) as caught:
            self.chart()
        self.assertIn("assets/pages", str(caught.exception))


class Assets(unittest.TestCase):
    def test_no_script_ends_early(self):
        for path in (ROOT / "assets/pages").glob("*.js"):
            text = path.read_text()
            self.assertNotIn("</script", text, path.name)
            self.assertNotIn("<!--", text, path.name)
            self.assertTrue(text.endswith("\n"), path.name)


if __name__ == "__main__":
    unittest.main()
