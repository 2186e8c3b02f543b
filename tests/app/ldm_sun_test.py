"""Photons of a directional light: ldm_indirect's one bounce of parallel light is the reference's."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from program import PROGRAM

# Through the room's open front onto floor, back wall and boxes.
SHOT = """{"scene": "cornell.gltf", "width": 32, "height": 32, "diffuse_only": true, "lights_mode": "replace",
 "lights": [{"type": "directional", "direction": [0.25, -0.6, 0.75], "intensity": 5}],
 "camera": {"position": [2.78, 2.73, -8], "target": [2.78, 2.73, 0], "up": [0, 1, 0], "vfov_deg": 39.3077}}"""


class Sun(unittest.TestCase):
    def test_one_bounce_is_the_references(self):
        with tempfile.TemporaryDirectory(prefix="bounce_test_") as folder:
            def run(*arguments):
                result = subprocess.run([PROGRAM, *arguments], env=dict(os.environ, XDG_CACHE_HOME=folder), cwd=folder,
                                        capture_output=True, text=True, timeout=250)
                self.assertEqual(result.returncode, 0, result.stderr)
                return result.stdout
            (pathlib.Path(folder) / "sun.json").write_text(SHOT)
            run("reference", "sun.json", "--bounces", "1", "--diffuse-only", "--spp", "512", "-q", "-o", "truth.exr")
            run("render", "sun.json", "--graph", "ldm_indirect_tuned", "--set", "ldm.maps=64", "--size", "64x64", "-q", "-o", "x.exr")
            told = json.loads(run("compare", "x.exr", "truth.exr", "--resource", "out.indirect_diffuse", "--window", "3", "--json"))
            error = told["parts"]["out.indirect_diffuse"]["windowed"]
            print(f"    {100 * error['bias']:+.1f} %, {100 * error['relative_rmse']:.1f} %")
            self.assertLess(abs(error["bias"]), 0.06)
            self.assertLess(error["relative_rmse"], 0.15)


if __name__ == "__main__":
    unittest.main()
