"""Emissive surfaces light others as the reference has it, in graphs that sample them: no light lost, and no blotches."""

import json
import os
import subprocess
import tempfile
import unittest

from program import PROGRAM

SIZE, TWICE = "32x32", "64x64"
VOXELS = {"dvs_tuned": "voxelization", "vct_tuned": "voxelization", "lrsm_tuned": "occlusion_voxels"}


class Emitters(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="bounce_test_")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def run_program(self, *arguments):
        result = subprocess.run([PROGRAM, *arguments], env=dict(os.environ, XDG_CACHE_HOME=self.folder), cwd=self.folder,
                                capture_output=True, text=True, timeout=250)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def error(self, graph, bounces, part, *sets):
        """Of means over 3 × 3 pixels, off edges, as bias and RMSE of the mean."""
        truth = f"truth_{bounces}.exr"
        if not os.path.exists(os.path.join(self.folder, truth)):
            self.run_program("reference", "cornell_lamp", "--bounces", str(bounces), "--spp", "256", "--size", SIZE, "-q", "-o", truth)
        voxels = VOXELS.get(graph)
        coarse = ["--set", f"{voxels}.resolution=64"] if voxels else []
        self.run_program("render", "cornell_lamp", "--graph", graph, "--size", TWICE, *coarse, *sets, "-q", "-o", "x.exr")
        told = json.loads(self.run_program("compare", "x.exr", truth, "--resource", part, "--window", "3", "--json"))
        windowed = told["parts"][part]["windowed"]
        print(f"    {graph} {' '.join(sets)}: {part} {100 * windowed['bias']:+.1f} %, {100 * windowed['relative_rmse']:.1f} %")
        return windowed["bias"], windowed["relative_rmse"]

    def test_first_scattering(self):
        for graph, sets in (("dvs_tuned", []), ("lrsm_tuned", []), ("dvs_tuned", ["--set", "emitted.visibility=triangles"])):
            bias, error = self.error(graph, 1, "out.emitted", *sets)
            self.assertLess(abs(bias), 0.08, graph)
            self.assertLess(error, 0.18, graph)

    def test_light_that_bounces_on(self):
        for graph, bounces in (("vct_tuned", 1), ("dvs_tuned", 2), ("dvs_traced", 2)):
            bias, error = self.error(graph, bounces, "out.indirect_diffuse")
            self.assertLess(abs(bias), 0.12, graph)
            self.assertLess(error, 0.28, graph)


if __name__ == "__main__":
    unittest.main()
