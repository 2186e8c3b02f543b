"""bounce chart --all: which points it measures, and that words, figures, page and gallery say what the points say."""

import base64
import csv
import json
import re
import unittest
import xml.etree.ElementTree as xml

from program import ROOT, ProgramTest


def suite(shot):
    return {
        "metric": "relative_rmse", "warm_up": 0, "frames": 1, "noise": 0.5, "quick_noise": 0.5,
        "scenes": [{"shot": str(shot), "size": [24, 24], "quick_size": [16, 16], "quick_rungs": 1, "quick_groups": ["shadows"]},
                   {"shot": "far", "requires": "nowhere/Nothing.gltf"}],
        "groups": [
            {"name": "shadows", "title": "direct light", "compare": ["out.direct"], "bounces": 0,
             "methods": [{"graph": "direct", "kind": "published",
                          "ladder": [{"shadow_maps.resolution": 16}, {"shadow_maps.resolution": 512}]}]},
            {"name": "bounce", "title": "one bounce <of> light", "compare": ["out.indirect_diffuse"], "bounces": 1,
             "diffuse_only": True,
             "methods": [{"graph": "rsm", "kind": "published", "ladder": [{"gather.samples": 16}]},
                         {"graph": "rsm_tuned", "kind": "tuned", "ladder": [{"gather.samples": 16}]}]}]}


class Methods(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.root / "assets" / "sweeps").symlink_to(ROOT / "assets" / "sweeps")
        self.suite = self.folder / "suite.json"
        self.suite.write_text(json.dumps(suite(self.shot)))

    def environment(self):
        return dict(super().environment(), XDG_CACHE_HOME=str(self.folder / "cache"))

    def arguments(self, output, *more):
        return ["chart", "--all", "--sweep", self.suite, "--spp", "4", *more, "-o", output]

    def chart(self, output, *more):
        result = self.run_program(*self.arguments(output, *more))
        self.assert_good(result)
        return result.stdout

    def rows(self, folder):
        with open(self.out / folder / "methods.csv", newline="") as file:
            return list(csv.DictReader(file))

    def data(self, folder):
        page = (self.out / folder / "methods.html").read_text()
        return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S).group(1))


class Reports(Methods):
    def test_words_figures_page_and_gallery_say_the_same(self):
        said = self.chart("c", "--results", "r")
        self.assertIn("far: skipped: nowhere/Nothing.gltf is not on the scene search path", said)
        self.assertTrue((self.out / "c/chart.html").is_file())
        rows = self.rows("r")
        self.assertEqual(sorted(row["graph"] for row in rows), ["direct", "direct", "rsm", "rsm_tuned"])
        for row in rows:
            self.assertGreater(float(row["first_ms"]), 0)
            self.assertLess(float(row["on_change_ms"]), float(row["total_ms"]), "nothing moves: nothing is computed again")
            self.assertEqual(float(row["flicker"]), 0, "nothing moves")
        coarse, fine = sorted((row for row in rows if row["graph"] == "direct"),
                              key=lambda row: int(row["shadow_maps.resolution"]))
        self.assertGreater(float(coarse["shadow_edge_rmse"]), float(fine["shadow_edge_rmse"]), "larger maps, better edges")
        self.assertLess(float(fine["direct_rmse"]), float(fine["shadow_edge_rmse"]), "elsewhere the light is right")

        words = (self.out / "r/methods.md").read_text()
        self.assertIn("Not measured: far.", words)
        bounce = words[words.index("**one bounce"):].split("\n\n")[0]
        light = {row["graph"]: row for row in rows if row["graph"] != "direct"}
        better = {name: all(float(light[name][key]) < float(light[other][key]) for key in ("total_ms", "relative_rmse"))
                  for name, other in (("rsm", "rsm_tuned"), ("rsm_tuned", "rsm"))}
        for name, other in (("rsm", "rsm_tuned"), ("rsm_tuned", "rsm")):
            self.assertEqual(bool(re.search(rf"Beaten everywhere.*by `{name}` \(.*`{other}` \(", bounce)), better[name], bounce)
        self.assertEqual("Nobody is beaten everywhere" in bounce, not any(better.values()), bounce)

        data = self.data("r")
        self.assertEqual(sorted(f"{p['numbers']['relative_rmse']:.6g}" for p in data["points"]),
                         sorted(row["relative_rmse"] for row in rows))
        for picture in data["pictures"]:
            self.assertTrue(base64.b64decode(picture).startswith(b"\x89PNG"))
        self.assertEqual({i for p in data["points"] for i, _ in p["pictures"]}, set(range(len(data["pictures"]))))
        references = {(p["light"], p["pictures"][2][0]) for p in data["points"]}
        self.assertEqual(len(references), 2, "the reference of a group is kept once")
        for name in ("methods/shadows.svg", "methods/bounce.svg", "gallery/" + str(self.shot).replace("/", "_") + ".svg"):
            xml.parse(self.out / "r" / name)
        gallery = xml.parse(self.out / "r/gallery" / (str(self.shot).replace("/", "_") + ".svg")).getroot()
        texts = [text.text for text in gallery.iter("{http://www.w3.org/2000/svg}text")]
        within = [row["graph"] for row in rows if float(row["total_ms"]) <= 1000]
        self.assertEqual({name for name in texts if name in light or name == "direct"}, set(within))
        self.assertIn("reference", texts)
        self.assertIn("gallery/", (self.out / "r/gallery.md").read_text())

    def test_a_quick_chart_is_a_part(self):
        self.chart("c", "--quick")
        (row,) = self.rows("c")
        self.assertEqual((row["shadow_maps.resolution"], row["width"]), ("16", "16"))

    def test_shards_join_to_the_same_points(self):
        for i in range(2):
            self.chart(f"part{i}", "--shard", f"{i}/2")
        joined = self.run_program("chart", "--all", "--sweep", self.suite, "--merge", "part0", "part1", "-o", "whole")
        self.assert_good(joined)
        self.assertEqual(len(self.rows("whole")), 4)
        said = self.chart("whole")
        self.assertEqual(len(re.findall("there already", said)), 4, "what was joined need not be measured again")

    def test_requests_that_cannot_be(self):
        self.assert_refused(self.run_program("chart", "cornell", "--quick", "-o", "c"), "--all")
        self.assert_refused(self.run_program("chart", "cornell", "--results", "r", "-o", "c"), "--all")
        self.assert_refused(self.run_program(*self.arguments("c", "--set", "a.b=1")), "its sweep says")
        self.assert_refused(self.run_program("chart", "cornel", "--all", "-o", "c"), "did you mean 'cornell'")
        self.assert_refused(self.run_program("chart", "cornell", "--sweep", "all_methods", "-o", "c"), "--all")
        self.suite.write_text(json.dumps({"scenes": [{"shot": "cornell", "size": [0, 4], "skye": True}], "groups": [
            {"name": "a", "title": "b", "compare": ["c"], "methods": [{"graph": "d", "kind": "new", "ladder": []}]}]}))
        self.assert_refused(self.run_program(*self.arguments("c")), "invalid 'size'", "did you mean 'sky'", "invalid kind 'new'",
                            "invalid 'ladder'")


class Sweep(unittest.TestCase):
    def setUp(self):
        self.suite = json.loads((ROOT / "assets/sweeps/all_methods.json").read_text())

    def test_every_graph_is_in_it(self):
        graphs = {method["graph"] for group in self.suite["groups"] for method in group["methods"]}
        self.assertEqual(graphs, {path.stem for path in (ROOT / "assets/graphs").glob("*.json")})

    def test_names_tell_tuned_from_published(self):
        for group in self.suite["groups"]:
            for method in group["methods"]:
                if method["graph"].endswith("_tuned"):
                    self.assertEqual(method["kind"], "tuned", method["graph"])
                if "traced" in method["graph"]:
                    self.assertEqual(method["kind"], "traced", method["graph"])


if __name__ == "__main__":
    unittest.main()
