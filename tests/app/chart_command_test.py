"""bounce chart: what it writes, that it goes on where it stopped, and that its parts join to the whole."""

import csv
import html
import json
import re
import resource
import time
import unittest
import xml.etree.ElementTree as xml

from program import ROOT, ProgramTest

SWEEP = {"base": {"direct.depth_bias": 0.1},
         "lists": {"shadow_maps.resolution": [32, 64], "direct.normal_offset": [0, 1]}}
VALUES = {("32", "0"), ("32", "1"), ("64", "0"), ("64", "1")}


class Chart(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.root / "assets" / "sweeps").symlink_to(ROOT / "assets" / "sweeps")
        self.sweep = self.folder / "sweep.json"
        self.sweep.write_text(json.dumps(SWEEP))

    def environment(self):
        return dict(super().environment(), XDG_CACHE_HOME=str(self.folder / "cache"))

    def arguments(self, output, *more):
        return ["chart", self.shot, "--sweep", self.sweep, "--size", "32x24", "--warmup", "1", "--frames", "3", "--spp",
                "4", *more, "-o", output]

    def rows(self, folder):
        with open(self.out / folder / "chart.csv", newline="") as file:
            return list(csv.DictReader(file))

    def values(self, folder):
        rows = [(row["shadow_maps.resolution"], row["direct.normal_offset"]) for row in self.rows(folder)]
        self.assertEqual(len(rows), len(set(rows)), "each point once")
        return set(rows)

    def point_files(self, folder):
        return {path.name: path.read_bytes() for path in (self.out / folder / "points").glob("*.json")}


class Reports(Chart):
    def test_the_four_reports_say_the_same(self):
        self.assert_good(self.run_program(*self.arguments("c")))
        rows = self.rows("c")
        self.assertEqual(self.values("c"), VALUES)
        for row in rows:
            self.assertGreater(float(row["total_ms"]), 0)
            self.assertLessEqual(float(row["direct_p10_ms"]), float(row["direct_ms"]))
            self.assertLessEqual(float(row["direct_ms"]), float(row["direct_p90_ms"]))
            self.assertGreater(float(row["mib"]), 0)
            self.assertEqual(row["bounces"], "0")
            # All light is more than direct light.
            self.assertLess(float(row["full_bias"]), float(row["bias"]))
        points = json.loads((self.out / "c/chart.json").read_text())
        by_error = {f"{p['same_transport']['relative_rmse']:.6g}" for p in points}
        self.assertEqual(by_error, {row["relative_rmse"] for row in rows})
        # The front: no point of it is beaten in both time and error by any other.
        front = [row for row in rows if row["pareto"] == "1"]
        self.assertTrue(front)
        for row in front:
            for other in rows:
                self.assertFalse(float(other["total_ms"]) < float(row["total_ms"]) and
                                 float(other["relative_rmse"]) < float(row["relative_rmse"]))
        svg = xml.parse(self.out / "c/chart.svg").getroot()
        titles = [title for title in svg.iter("{http://www.w3.org/2000/svg}title")]
        self.assertEqual(len(titles), 4)
        self.assertEqual(sum("on the Pareto front" in title.text for title in titles), len(front))

    def test_the_page_is_self_contained_and_its_commands_work(self):
        self.sweep.write_text(json.dumps({"lists": {"shadow_maps.resolution": [32]}}))
        self.assert_good(self.run_program(*self.arguments("c")))
        page = (self.out / "c/chart.html").read_text()
        for source in re.findall(r'(?:src|href)="([^"]*)"', page):
            self.assertTrue(source.startswith("data:"), source)
        self.assertEqual(page.count('src="data:image/png;base64,'), 2, "a picture and an error map")
        command = re.search(r"<code class=\"command\">bounce (render [^<]*)</code>", page).group(1).split()
        self.assert_good(self.run_program(*command))
        self.assertTrue((self.out / "x.exr").exists())


    def test_every_report_says_where_it_comes_from(self):
        self.sweep.write_text(json.dumps({"lists": {"shadow_maps.resolution": [32]}}))
        self.assert_good(self.run_program(*self.arguments("c")))
        (row,) = self.rows("c")
        self.assertRegex(row["measured"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        for name in ("chart.md", "chart.html", "chart.svg"):
            text = html.unescape((self.out / "c" / name).read_text())
            self.assertIn("Written by `bounce chart", text, name)
            for word in (row["commit"], row["machine"], row["renderer"], row["driver"], row["measured"]):
                self.assertIn(word, text, name)

    def test_another_metric_is_drawn(self):
        self.assert_good(self.run_program(*self.arguments("c", "--metric", "flip")))
        self.assertIn("FLIP, same transport", (self.out / "c/chart.svg").read_text())
        rows = self.rows("c")
        best = min(rows, key=lambda row: float(row["flip"]))
        self.assertEqual(best["pareto"], "1")
        self.assert_refused(self.run_program(*self.arguments("d", "--metric", "flop")), "did you mean 'flip'",
                            leaves=["c"])
        # A sweep may say it too; the command line counts.
        self.sweep.write_text(json.dumps(dict(SWEEP, metric="smape")))
        self.assert_good(self.run_program(*self.arguments("c")))
        self.assertIn("SMAPE, same transport", (self.out / "c/chart.svg").read_text())


class SessionOptions(Chart):
    def graph(self, name):
        return self.root / "assets/graphs" / (name + ".json")

    def test_passes_are_switched_as_render_switches_them(self):
        self.graph("dark").write_text('{"version": 1, "extends": "direct", "passes": [{"id": "emission", "enabled": false}]}')
        self.sweep.write_text(json.dumps({"lists": {"shadow_maps.resolution": [32]}}))
        common = ["--graphs", "dark"]
        self.assert_good(self.run_program(*self.arguments("off", *common)))
        self.assert_good(self.run_program(*self.arguments("on", *common, "--enable", "emission")))
        self.assert_good(self.run_program(*self.arguments("direct", "--graphs", "direct")))
        self.assert_good(self.run_program(*self.arguments("none", "--graphs", "direct", "--disable", "emission")))
        off, on, direct, none = (self.rows(name)[0] for name in ("off", "on", "direct", "none"))
        self.assertEqual(on["relative_rmse"], direct["relative_rmse"])
        self.assertEqual(off["relative_rmse"], none["relative_rmse"])
        self.assertIn("--enable emission", on["command"])
        self.assert_good(self.run_program(*on["command"].split()[1:]))
        self.sweep.write_text(json.dumps({"enable": ["emission"], "lists": {"shadow_maps.resolution": [32]}}))
        self.assert_good(self.run_program(*self.arguments("sweep", *common)))
        self.assertEqual(self.rows("sweep")[0]["relative_rmse"], on["relative_rmse"])
        self.assertEqual(self.run_program(*self.arguments("x", "--enable", "emision")).returncode, 2)


class Contents(Chart):
    """Points of another graph, other shaders or another shot are other points."""

    def setUp(self):
        super().setUp()
        self.sweep.write_text(json.dumps({"lists": {"shadow_maps.resolution": [32]}}))

    def chart(self, folder="c", *more):
        result = self.run_program(*self.arguments(folder, *more))
        self.assert_good(result)
        self.assertEqual(len(self.rows(folder)), 1, "one point, whatever else lies in the folder")
        return result.stdout

    def test_what_is_measured_again_and_why(self):
        self.chart()
        self.assertIn("there already", self.chart())
        self.edit("glsl/surface/direct.comp", "void main() {", "void main() { // another text")
        self.assertIn("measured again; changed since: the shaders of 'direct'", self.chart())
        self.assertIn("there already", self.chart())
        self.edit("assets/graphs/base/surface.json", '"out.direct": { "clear": false }', '"out.direct": { "format": "rgba32f", "clear": false }')
        self.assertIn("measured again; changed since: the graph", self.chart(), "a graph is all that it extends")
        self.shot.write_text(self.shot.read_text().replace("-8]", "-7.9]"))
        self.assertIn("measured again; changed since: the shot", self.chart())
        self.assertEqual(len(self.point_files("c")), 4, "earlier points stay, in case the change is taken back")
        self.assertIn("there already", self.chart("c", "--resume"))
        self.assertNotIn("there already", self.chart("c", "--no-resume"))

    def test_what_changes_nothing_is_not_measured_again(self):
        self.chart()
        graph = self.root / "assets/graphs/direct.json"
        graph.write_text(json.dumps(dict(json.loads(graph.read_text()), about="Said otherwise."), indent=4))
        self.assertIn("there already", self.chart())
        graph.write_text(self.run_program("graph", "direct", "--expanded").stdout)  # in one file rather than in two
        self.edit("glsl/lrsm/gather.comp", "void main() {", "void main() { // of another graph")
        self.assertIn("there already", self.chart())

    def test_merging_leaves_out_what_another_version_measured(self):
        self.chart("old")
        self.sweep.write_text(json.dumps({"lists": {"shadow_maps.resolution": [64]}}))
        self.chart("same")
        time.sleep(1.1)  # points tell their second
        self.edit("glsl/surface/direct.comp", "void main() {", "void main() { // another text")
        self.sweep.write_text(json.dumps({"lists": {"shadow_maps.resolution": [128]}}))
        self.chart("new")
        whole = self.run_program("chart", "--merge", "old", "same", "-o", "both")
        self.assert_good(whole)
        self.assertEqual(len(self.rows("both")), 2)
        self.assertNotIn("left out", whole.stdout)
        mixed = self.run_program("chart", "--merge", "old", "same", "new", "-o", "mixed")
        self.assert_good(mixed)
        self.assertEqual([row["shadow_maps.resolution"] for row in self.rows("mixed")], ["128"], "the newest version")
        self.assertEqual(len(re.findall("left out.*the shaders of 'direct'", mixed.stdout)), 2, mixed.stdout)

    def test_points_of_before_are_measured_again(self):
        self.chart()
        (path,) = (self.out / "c/points").glob("*.json")
        point = json.loads(path.read_text())
        del point["content"], point["measured"]
        point["key"] = "0123456789abcdef"
        path.unlink()
        (path.parent / "0123456789abcdef.json").write_text(json.dumps(point))
        self.assertIn("measured again", self.chart())


class Occlusion(Chart):
    def measure(self, output, *more):
        self.assert_good(self.run_program("chart", self.shot, "--graphs", "hbao", "--sweep", self.sweep, "--size", "32x24",
                                          "--warmup", "0", "--frames", "1", "--spp", "16", *more, "-o", output))
        return self.rows(output)

    def test_the_reference_takes_d_max_and_falloff_from_the_graph(self):
        self.sweep.write_text(json.dumps({"lists": {"hbao_dmax.falloff": ["none", "quadratic"],
                                                    "hbao_dmax.d_max": [0.05, 0.2, 0.8]}}))
        rows = self.measure("c", "--against", "d_max")
        truth = [float(row["reference_mean"]) for row in rows]
        for hard, fading in zip(truth[:3], truth[3:]):
            self.assertGreater(fading, hard + 0.001, "occluders that fade leave more open")
        for falloff in (truth[:3], truth[3:]):
            self.assertEqual(falloff, sorted(falloff, reverse=True))
            self.assertGreater(falloff[0], falloff[2] + 0.1, "more occluders within a larger d_max")
        for row in rows:
            self.assertEqual(row["parts"], "out.ambient_occlusion_dmax")
            mean, reference, rmse = (float(row[name]) for name in ("mean", "reference_mean", "rmse"))
            self.assertAlmostEqual(mean / reference - 1, float(row["bias"]), places=4)
            self.assertAlmostEqual(rmse / reference, float(row["relative_rmse"]), places=4)
            self.assertLessEqual(float(row["rmse_denoised"]), rmse)
            self.assertEqual(row["full_bias"], row["bias"], "occlusion has no bounces")
        drawn = (self.out / "c/chart.svg").read_text()
        self.assertIn("AO units", drawn)
        self.assertIn(">d_max</text>", drawn)
        self.assertNotIn("GPU time of a frame", drawn)

    def test_another_part_may_be_compared(self):
        self.sweep.write_text(json.dumps({"lists": {"hbao.steps": [8]}}))
        self.measure("c")
        rows = self.measure("c", "--resource", "out.ambient_occlusion")
        self.assertEqual([row["parts"] for row in rows], ["out.ambient_occlusion"], "a point of its own")
        self.assertEqual(len(self.point_files("c")), 2)


class Parts(Chart):
    def test_an_interrupted_chart_goes_on(self):
        process = self.start_program(*self.arguments("c"))
        deadline = time.monotonic() + 60
        while not self.out.joinpath("c/points").is_dir() or not self.point_files("c"):
            self.assertLess(time.monotonic(), deadline, (self.folder / "said").read_text())
            time.sleep(0.005)
        self.stop(process)
        before = self.point_files("c")
        result = self.run_program(*self.arguments("c"))
        self.assert_good(result)
        self.assertEqual(len(re.findall("there already", result.stdout)), len(before))
        after = self.point_files("c")
        self.assertEqual({name: after[name] for name in before}, before, "what was measured stays")
        self.assertEqual(self.values("c"), VALUES)

    def test_shards_merge_to_the_whole(self):
        for i in range(3):
            self.assert_good(self.run_program(*self.arguments(f"part{i}", "--shard", f"{i}/3")))
        parts = [self.values(f"part{i}") for i in range(3)]
        self.assertEqual([len(part) for part in parts], [2, 1, 1])
        self.assert_good(self.run_program("chart", "--merge", "part0", "part1", "part2", "-o", "whole"))
        self.assertEqual(self.values("whole"), VALUES)
        # A merged chart is a chart: measuring all of it finds every point there.
        result = self.run_program(*self.arguments("whole"))
        self.assertEqual(len(re.findall("there already", result.stdout)), 4)

    def test_a_shard_without_points_is_no_error(self):
        result = self.run_program(*self.arguments("part", "--shard", "7/8"))
        self.assert_good(result)
        self.assert_good(self.run_program(*self.arguments("all", "--shard", "0/1")))
        self.assert_good(self.run_program("chart", "--merge", "all", "part", "-o", "whole"))
        self.assertEqual(self.values("whole"), VALUES)


class Refusals(Chart):
    def test_requests_that_cannot_be(self):
        for shard in ("2/2", "-1/2", "1", "a/b", "0/0"):
            self.assert_refused(self.run_program(*self.arguments("c", f"--shard={shard}")), "--shard", "i/n")
        self.assert_refused(self.run_program("chart", "-o", "c"), "at least one shot")
        self.assert_refused(self.run_program("chart", self.shot, "--graphs", "driect", "-o", "c"), "did you mean 'direct'")
        self.assert_refused(self.run_program("chart", self.shot, "--sweep", "shadow_map", "-o", "c"),
                            "did you mean 'shadow_maps'")
        self.assert_refused(self.run_program("chart", "--merge", "nowhere", "-o", "c"), "nowhere")
        self.sweep.write_text('{"lists": {"shadow_maps.resolution": []}, "bse": {}}')
        self.assert_refused(self.run_program(*self.arguments("c")), "shadow_maps.resolution", "did you mean 'base'")

    def test_a_wrong_value_costs_its_own_point_only(self):
        self.sweep.write_text(json.dumps({"lists": {"shadow_maps.resolution": [32, 1]}}))
        result = self.run_program(*self.arguments("c"))
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("[16, 8192]", result.stderr)
        self.assertEqual([row["shadow_maps.resolution"] for row in self.rows("c")], ["32"])

    def test_a_full_disk_is_told_and_costs_no_point_that_was_measured(self):
        self.sweep.write_text(json.dumps({"lists": {"shadow_maps.resolution": [32]}}))
        self.assert_good(self.run_program(*self.arguments("c")))
        before = self.point_files("c")
        self.sweep.write_text(json.dumps({"lists": {"shadow_maps.resolution": [32, 64]}}))

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (200, 200))

        # Without its signal, the limit acts as a full disk does: a write fails.
        result = self.run_program(*self.arguments("c"), preexec_fn=limit, restore_signals=False)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("cannot write", result.stderr)
        self.assertEqual(self.point_files("c"), before)
        self.assertFalse(list((self.out / "c").rglob("*.tmp")))
        self.assert_good(self.run_program(*self.arguments("c")))
        self.assertEqual(len(self.rows("c")), 2)


class References(Chart):
    def test_the_device_renders_the_same_truth(self):
        rows = {}
        for by in ("cpu", "device"):
            self.assert_good(self.run_program("chart", self.shot, "--graphs", "direct", "--size", "24x18", "--warmup", "0",
                                              "--frames", "1", "--spp", "64", "--reference", by, "-o", by))
            rows[by], = self.rows(by)
        self.assertAlmostEqual(float(rows["cpu"]["bias"]), float(rows["device"]["bias"]), delta=0.01)
        self.assertAlmostEqual(float(rows["cpu"]["full_bias"]), float(rows["device"]["full_bias"]), delta=0.03)
        self.assertNotEqual(set(self.point_files("cpu")), set(self.point_files("device")), "points of either are told apart")

    def test_nobody_else_renders_references(self):
        self.assert_refused(self.run_program("chart", self.shot, "--reference", "gpu", "-o", "c"), "cpu, device")


if __name__ == "__main__":
    unittest.main()
