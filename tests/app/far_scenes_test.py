"""Scenes far from the origin, of extreme sizes, and outside of what can be traced: the commands from end to end."""

import base64
import json
import math
import os
import pathlib
import struct
import unittest

from program import ROOT, ProgramTest

CASES = pathlib.Path(os.environ.get("BOUNCE_CASES") or ROOT.parent / "shared" / "cases")
TRUTH = 0.5 / math.pi  # a floor of ½ one metre below a lamp of 1 W/sr


def floor_scene(at, size=1.0, place="vertices", stray=None):
    """A floor of 8 × 8 sizes with a lamp one size above it. `place`: what holds the distance, the vertices, or the node
    (which glTF tells in doubles). `stray`: a third triangle, at the floor's edge, reaches so far up."""
    x, y, z = at if place == "vertices" else (0, 0, 0)
    corners = [(x - 4 * size, y, z - 4 * size), (x - 4 * size, y, z + 4 * size), (x + 4 * size, y, z + 4 * size),
               (x + 4 * size, y, z - 4 * size)]
    indices = [0, 1, 2, 0, 2, 3]
    if stray:
        corners += [(x + 3 * size, y, z), (x + 3 * size, y, z + 0.1 * size), (x + 3 * size, y + stray, z)]
        indices += [4, 5, 6]
    count, end = len(corners), 24 * len(corners)
    data = b"".join(struct.pack("<3f", *corner) for corner in corners) + struct.pack("<3f", 0, 1, 0) * count
    data += struct.pack(f"<{len(indices)}I", *indices)
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "translation": [0, 0, 0] if place == "vertices" else list(at)},
                  {"extensions": {"KHR_lights_punctual": {"light": 0}},
                   "translation": [at[0], at[1] + size, at[2]]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5126, "count": count, "type": "VEC3"},
                      {"bufferView": 2, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": end // 2},
                        {"buffer": 0, "byteOffset": end // 2, "byteLength": end // 2},
                        {"buffer": 0, "byteOffset": end, "byteLength": 4 * len(indices)}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": size * size}]}},
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}


def microfacet_at_45_degrees():
    """The lobe of a dielectric of roughness 1, lit along the normal by 1 W/m² and seen at 45°: D·V·F with α = 1 (glTF 2.0,
    appendix B), where D = 1/π, V = ½ / (n·v + n·l) and F = .04 + .96·(1 − cos 22.5°)⁵."""
    fresnel = 0.04 + 0.96 * (1 - math.cos(math.pi / 8)) ** 5
    return 1 / math.pi * 0.5 / (math.cos(math.pi / 4) + 1) * fresnel


class FarScenes(ProgramTest):
    def environment(self):
        return dict(super().environment(), XDG_CACHE_HOME=str(self.folder / "cache"))

    def write(self, scene, at, size=1.0):
        (self.folder / "floor.gltf").write_text(json.dumps(scene))
        shot = {"scene": "floor.gltf", "diffuse_only": True, "width": 3, "height": 3,
                "camera": {"position": [at[0], at[1] + 2 * size, at[2] + 2 * size], "target": list(at), "vfov_deg": 0.5}}
        (self.folder / "shot.json").write_text(json.dumps(shot))
        return self.folder / "shot.json"

    def mean(self, name):
        self.assert_good(self.run_program("compare", name, name, "--json"))
        told = json.loads(self.run_program("compare", name, name, "--json", "--resource", "out.direct").stdout)
        return told["parts"]["out.direct"]["reference_mean"]

    def check(self, shot, what, truth=TRUTH):
        self.assert_good(self.run_program("render", shot, "--graph", "direct", "--set", "shadow_maps.resolution=64",
                                          "--material-model", "plain",
                                          "-o", "raster.exr"))
        self.assert_good(self.run_program("reference", shot, "--spp", "16", "--bounces", "0", "--material-model", "plain", "-o", "traced.exr"))
        for name in ("raster.exr", "traced.exr"):
            self.assertAlmostEqual(self.mean(name) / truth, 1, delta=0.005, msg=f"{what}: {name}")

    def test_a_floor_at_any_distance(self):
        for far in (1e3, 1e5):
            self.check(self.write(floor_scene((far, 0, far)), (far, 0, far)), f"vertices at {far}")
        # A million sizes away, by the nodes' own doubles: nothing is lost at all.
        at = (8e6 + 0.3, -8e6, 1234567.891)
        self.check(self.write(floor_scene(at, place="node"), at), "a node far away")

    def test_a_floor_of_any_size(self):
        for size in (1e-18, 1e-3, 1e3, 1e16):
            self.check(self.write(floor_scene((0, 0, 0), size), (0, 0, 0), size), f"size {size}")

    def test_people_read_the_coordinates_of_the_file(self):
        at = (1e6, 0, 2e6)
        told = self.run_program("info", self.write(floor_scene(at), at))
        self.assert_good(told)
        self.assertIn("from (999996, 0, 1999996) to (1000004, 0, 2000004)", told.stdout)
        self.assertIn("relative to (1000000, 0, 2000000)", told.stdout)

    def test_shots_that_cannot_be(self):
        floor = floor_scene((0, 0, 0))
        shot = self.write(floor, (0, 0, 0))
        right = json.loads(shot.read_text())
        for position in ([1e30, 0, 0], [0, -1e19, 0]):
            shot.write_text(json.dumps(dict(right, camera={"position": position, "target": [0, 0, 0]})))
            for command in (("reference", "--spp", "2"), ("render",)):
                self.assert_refused(self.run_program(command[0], shot, *command[1:], "-o", "x.exr"),
                                    "the shot's camera", "expected coordinates within")
        shot.write_text(json.dumps(right))
        floor["nodes"][1]["translation"] = [0, 1e25, 0]
        self.write(floor, (0, 0, 0))
        self.assert_refused(self.run_program("reference", shot, "--spp", "2", "-o", "x.exr"), "node 1",
                            "expected coordinates within")
        floor["nodes"][1]["translation"] = [0, 1, 0]
        floor["nodes"][0]["scale"] = [1e30, 1e30, 1e30]
        floor["nodes"][0]["matrix"] = None
        del floor["nodes"][0]["matrix"], floor["nodes"][0]["translation"]
        self.write(floor, (0, 0, 0))
        self.run_program("reference", shot, "--spp", "2", "-o", "x.exr")  # refused or rescaled, never aborted
        self.assertIn(self.run_program("reference", shot, "--spp", "2", "-o", "x.exr").returncode, (0, 2))

    def case(self, name):
        path = CASES / name
        if not path.exists():
            self.skipTest(f"the case {name} is not there")
        return path

    def test_cases_that_ended_the_program(self):
        for name in ("hostile/cam3.json", "hostile/far.gltf", "hostile/bb_reference_rc-6_0075.gltf"):
            result = self.run_program("reference", self.case(name), "--spp", "2", "--size", "8x8", "-o", "x.exr")
            self.assert_refused(result, "expected")

    def test_a_stray_vertex_beyond_what_rays_reach_is_refused(self):
        result = self.run_program("reference", self.case("stray/stray_1e19.gltf"), "--spp", "2", "--size", "8x8", "-o", "x.exr")
        self.assert_refused(result, "invalid vertex", "1e+19", "expected coordinates within 1e+18")

    def test_a_stray_vertex_costs_the_rest_nothing(self):
        """Among three triangles: one of them must not say how large the scene is."""
        for far in (1e3, 1e9, 1e17):
            self.check(self.write(floor_scene((0, 0, 0), stray=far), (0, 0, 0)), f"a stray vertex at {far}")

    def test_the_cases_far_from_the_origin(self):
        for name in ("far_from_origin/far_0.json", "far_from_origin/far_10000.json"):
            self.check(self.case(name), name, TRUTH + microfacet_at_45_degrees())


if __name__ == "__main__":
    unittest.main()
