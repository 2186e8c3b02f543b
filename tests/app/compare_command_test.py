"""bounce compare: figures of good files, and one clear message for bad ones."""

import json
import pathlib
import unittest

from exr import write_exr
from program import ROOT, SMALL, ProgramTest

NAN = float("nan")


class Compare(ProgramTest):
    def write(self, name, width=4, height=3, value=1.0, part="out.direct", at=None):
        channels = {f"{part}.{c}": [value] * (width * height) for c in "RGB"}
        if at is not None:
            channels[f"{part}.G"][at[0]] = at[1]
        write_exr(self.out / name, width, height, channels)
        return name

    def refused(self, *arguments, words, leaves):
        result = self.run_program("compare", *arguments)
        self.assert_refused(result, *words, leaves=leaves)
        self.assertEqual(result.stdout, "", "no figures of a comparison that was refused")

    def test_a_picture_against_itself_and_against_a_brighter_one(self):
        a, b = self.write("a.exr", value=1.1), self.write("b.exr")
        same = json.loads(self.run_program("compare", a, a, "--json").stdout)["parts"]["out.direct"]
        self.assertEqual((same["bias"], same["rmse"], same["flip"]), (0, 0, 0))
        other = json.loads(self.run_program("compare", a, b, "--json").stdout)["parts"]["out.direct"]
        self.assertAlmostEqual(other["bias"], 0.1, places=6)
        self.assertAlmostEqual(other["relative_rmse"], 0.1, places=6)

    def figures(self, *arguments, part=""):
        result = self.run_program("compare", *arguments, "--json")
        self.assert_good(result)
        return json.loads(result.stdout)["parts"][part]

    def test_only_red_green_and_blue_are_radiance(self):
        def write(name, value, **others):
            write_exr(self.out / name, 4, 3, {"R": [value] * 12, "G": [value] * 12, "B": [value] * 12, **{k: [v] * 12 for k, v in others.items()}})
        write("a.exr", 2.0, A=1.0, Z=1e10, u=3.0, v=NAN)
        write("b.exr", 1.0, A=0.5, Z=5.0, u=9.0, v=1.0)
        write("c.exr", 1.0)
        for other in ("b.exr", "c.exr"):
            self.assertAlmostEqual(self.figures("a.exr", other)["bias"], 1, places=6)
            self.assertAlmostEqual(self.figures("a.exr", other)["relative_rmse"], 1, places=6)

    def test_the_shared_pairs_of_other_programs(self):
        cases = ROOT.parent / "shared/cases/exr"
        if not cases.is_dir():
            self.skipTest("there is no ../shared/cases")
        for a, b in (("rgba_a", "rgba_b"), ("pbrt_a", "pbrt_b")):
            self.assertAlmostEqual(self.figures(cases / f"{a}.exr", cases / f"{b}.exr")["bias"], 1, places=3)
        figures = self.figures(cases / "rgb_a.exr", cases / "neg.exr")
        self.assertAlmostEqual(figures["relative_rmse"], 3, places=3)
        self.assertGreater(figures["bias"], 0)

    def test_windows(self):
        """Pixels of the display window for which a file has no data are black, and told; those outside of it do not count."""
        def write(name, value, width, height, **windows):
            write_exr(self.out / name, width, height, {c: [value] * (width * height) for c in "RGB"}, **windows)
        write("whole.exr", 1.0, 4, 4)
        write("crop.exr", 1.0, 2, 2, data_at=(1, 1), display=(0, 0, 3, 3))
        write("over.exr", 1.0, 8, 9, data_at=(-2, -3), display=(0, 0, 3, 3))
        write("moved.exr", 1.0, 4, 4, data_at=(-4, 7))
        self.assertAlmostEqual(self.figures("crop.exr", "whole.exr")["mean"], 0.25, places=6)
        self.assertIn("75.0 % of 'crop.exr' lies outside of its data window", self.run_program("compare", "crop.exr", "whole.exr").stdout)
        self.assertEqual(self.figures("over.exr", "whole.exr")["rmse"], 0)
        self.assertEqual(self.figures("moved.exr", "moved.exr")["rmse"], 0)
        self.refused("moved.exr", "whole.exr", words=["(-4, 7)", "(0, 0)", "expected the same display window"],
                     leaves=["crop.exr", "moved.exr", "over.exr", "whole.exr"])

    def test_occlusion_is_told_in_its_own_units(self):
        a = self.write("a.exr", value=0.3, part="out.ambient_occlusion")
        b = self.write("b.exr", value=0.25, part="out.ambient_occlusion")
        figures = json.loads(self.run_program("compare", a, b, "--json").stdout)["parts"]["out.ambient_occlusion"]
        for name in ("mean_difference", "rmse", "rmse_denoised"):
            self.assertAlmostEqual(figures[name], 0.05, places=6)
        self.assertIn("AO units: bias +0.0500, RMSE 0.0500", self.run_program("compare", a, b).stdout)

    def test_a_value_that_is_not_finite(self):
        good = self.write("good.exr")
        for name, value in (("nan.exr", NAN), ("inf.exr", float("inf"))):
            bad = self.write(name, at=(5, value))
            self.refused(bad, good, words=["out.direct of the image", "(1, 1)"], leaves=["good.exr", name])
            self.refused(good, bad, words=["out.direct of the reference", "(1, 1)"], leaves=["good.exr", name])
            (self.out / name).unlink()

    def test_sizes_that_differ(self):
        a, b = self.write("a.exr"), self.write("b.exr", width=3, height=4)
        self.refused(a, b, words=["4x3", "3x4"], leaves=["a.exr", "b.exr"])

    def test_files_that_are_missing_or_broken(self):
        a = self.write("a.exr")
        self.refused(a, "truth.exr", words=["truth.exr", "No such file"], leaves=["a.exr"])
        self.refused("none.exr", a, words=["none.exr"], leaves=["a.exr"])
        bytes_of_a = (self.out / a).read_bytes()
        for length in (0, 7, 100, len(bytes_of_a) - 1):
            (self.out / "cut.exr").write_bytes(bytes_of_a[:length])
            self.refused(a, "cut.exr", words=["cut.exr"], leaves=["a.exr", "cut.exr"])

    def test_parts_that_are_not_there(self):
        a, b = self.write("a.exr"), self.write("b.exr", part="out.emitted")
        self.refused(a, b, words=["no part in common", "out.direct", "out.emitted"], leaves=["a.exr", "b.exr"])
        self.refused(a, a, "--resource", "out.dircet", words=["did you mean 'out.direct'"], leaves=["a.exr", "b.exr"])

    def test_linear_and_display_values_are_not_mixed(self):
        a = self.write("a.exr")
        self.assert_good(self.run_program("render", self.shot, *SMALL, "--size", "4x3", "-o", "a.png"))
        self.refused(a, "a.png", words=["display values", "linear"], leaves=["a.exr", "a.png"])

    def test_a_heat_map_that_cannot_be_written_costs_no_figures(self):
        a, b = self.write("a.exr", value=1.1), self.write("b.exr")
        self.refused(a, b, "--heatmap", "none/h.png", words=["none"], leaves=["a.exr", "b.exr"])
        if pathlib.Path("/dev/full").exists():
            (self.out / "full.png").symlink_to("/dev/full")
            result = self.run_program("compare", a, b, "--json", "--heatmap", "full.png")
            self.assert_refused(result, "full.png", "No space left", leaves=["a.exr", "b.exr", "full.png"])
            self.assertAlmostEqual(json.loads(result.stdout)["parts"]["out.direct"]["bias"], 0.1, places=6)
        self.assert_good(self.run_program("compare", a, b, "--heatmap", "h.png"))
        self.assertEqual((self.out / "h.png").read_bytes()[16:24], b"\0\0\0\x04\0\0\0\x03")

    def test_figures_that_cannot_be_printed_are_an_error(self):
        if not pathlib.Path("/dev/full").exists():
            self.skipTest("there is no /dev/full")
        a = self.write("a.exr")
        with open("/dev/full", "w") as full:
            result = self.run_program("compare", a, a, "--json", stdout_file=full)
        self.assertEqual(result.returncode, 2)
        self.assertIn("No space left", result.stderr)


if __name__ == "__main__":
    unittest.main()
