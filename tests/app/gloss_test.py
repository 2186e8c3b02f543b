"""Glossy reflections of the tuned graphs, whose cones are drawn from the lobe: even light comes back as the reference has it, and
a lit wall comes out of a glossy floor with less than half of the error that one cone makes. (What is nearly a mirror shows voxels.)"""

import json
import unittest

from program import ROOT, ProgramTest

WALLS = [[[-1, -1, 1], [1, -1, 1], [1, -1, -1], [-1, -1, -1]], [[-1, 1, -1], [1, 1, -1], [1, 1, 1], [-1, 1, 1]],
         [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1]], [[1, -1, 1], [-1, -1, 1], [-1, 1, 1], [1, 1, 1]],
         [[-1, -1, 1], [-1, -1, -1], [-1, 1, -1], [-1, 1, 1]], [[1, -1, -1], [1, -1, 1], [1, 1, 1], [1, 1, -1]]]
# Metal has no diffuse lobe, so that the first scattering is all there is behind diffuse secondary surfaces.
EVEN = {"about": "A closed box of metal that emits evenly.", "quantity": "error", "most": 0.05, "unit": "roughness",
        "ladder": {"roughness": [0.2, 0.5, 0.8]}, "resource": "out.emitted+out.indirect_specular", "size": [32, 32],
        "samples": 256, "diffuse_only": False, "set": {"voxelization.resolution": 64, "shadow_maps.resolution": 64},
        "shot": {"material_model": "plain", "lights": [],
                 "camera": {"position": [-0.4, 0, 0.5], "target": [1, -0.3, -1], "vfov_deg": 70}},
        "scenes": {"box": [{"quad": wall, "colour": 1, "metallic": 1, "roughness": "=roughness", "emission": 0.5}
                           for wall in WALLS]}}


class Gloss(ProgramTest):
    def curves(self, case, *graphs):
        (self.out / "own.json").write_text(json.dumps(case))
        self.run_program("stability", "--graphs", ",".join(graphs), "--cases", "own.json", "-o", "found")
        (told,) = json.loads((self.out / "found/stability.json").read_text())["cases"]
        curves = {graph: told["graphs"][graph]["curve"] for graph in graphs}
        print("   ", curves)
        return curves

    def test_even_light_is_reflected_evenly(self):
        # The voxels' normals are off by a few per cent.
        self.assertLess(max(self.curves(EVEN, "vct_tuned")["vct_tuned"]), 0.05)

    def test_the_lobe_is_more_than_one_cone(self):
        case = json.loads((ROOT / "assets/stability/gloss.json").read_text())
        case.update(ladder={"roughness": [0.3, 0.6]}, size=[32, 32], samples=256)
        curves = self.curves(case, "lrsm", "lrsm_tuned", "vct", "vct_tuned")
        for published, tuned in (("lrsm", "lrsm_tuned"), ("vct", "vct_tuned")):
            self.assertLess(max(curves[tuned]), 0.5 * max(curves[published]), tuned)


if __name__ == "__main__":
    unittest.main()
