"""The direct graph's picture is the reference's direct component: their means agree within 0.5 % away from edges."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from program import PROGRAM, ROOT

TOLERANCE = 0.005
SCENES = pathlib.Path(os.environ.get("BOUNCE_SCENES") or ROOT.parent / "shared" / "scenes")


class DirectAgainstReference(unittest.TestCase):
    """At the graph's own defaults. The reference covers a pixel by samples and the graph takes its centre: at 640×360 and
    an RMSE near 40 % of the mean (shadow edges), that alone scatters the mean of 10⁵ pixels by some 0.1 %."""

    def compare(self, shot, size, scene=None):
        if scene and not (SCENES / scene).exists():
            self.skipTest(f"the scene {scene} is not there")
        with tempfile.TemporaryDirectory(prefix="bounce_test_") as folder:
            def run(*arguments):
                environment = dict(os.environ, XDG_CACHE_HOME=folder)
                result = subprocess.run([PROGRAM, *arguments], env=environment, cwd=folder, capture_output=True, text=True,
                                        timeout=250)
                self.assertEqual(result.returncode, 0, result.stderr)
                return result.stdout
            run("render", shot, "--graph", "direct", "--size", size, "-o", "image.exr")
            run("reference", shot, "--bounces", "0", "--spp", "16", "--size", size, "-o", "truth.exr")
            json_text = run("compare", "image.exr", "truth.exr", "--json", "--resource", "out.direct")
        comparison = json.loads(json_text)
        direct = comparison["parts"]["out.direct"]
        print(f"{shot}: bias {100 * direct['bias']:+.2f} % over {direct['pixels']} pixels")
        self.assertTrue(comparison["edges_masked"])
        self.assertGreater(comparison["kept_pixels"], 0.4)
        self.assertGreater(direct["reference_mean"], 0)
        self.assertLess(abs(direct["bias"]), TOLERANCE)

    def test_cornell(self):
        self.compare("cornell", "256x256")

    def test_atrium(self):
        self.compare("atrium", "640x360")

    def test_sponza(self):
        self.compare("sponza", "640x360", "sponza/Sponza.gltf")

    def test_sibenik(self):
        self.compare("sibenik", "640x360", "sibenik/Sibenik.gltf")


if __name__ == "__main__":
    unittest.main()
