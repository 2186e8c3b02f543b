"""A few mutants of each kind; tests/README.md says how to run a thousand."""

import collections
import os
import pathlib
import shutil
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))
import shader_mutants  # noqa: E402
from program import ROOT  # noqa: E402

FEW = 4 if os.environ.get("BOUNCE_SANITIZE") == "ON" else 6


class ShaderMutants(unittest.TestCase):
    def test_a_mutant_is_a_function_of_seed_and_number(self):
        files = sorted((ROOT / "glsl/surface").iterdir())
        made = [shader_mutants.mutant("1", number, files) for number in range(200)]
        self.assertEqual(made, [shader_mutants.mutant("1", number, files) for number in range(200)])
        self.assertNotEqual(made, [shader_mutants.mutant("2", number, files) for number in range(200)])
        changed = sum(data != path.read_bytes() for path, _, data in made)
        self.assertGreater(changed, 180)
        kinds = collections.Counter(kind for _, how, _ in made for kind in how.split("+"))
        self.assertEqual(len(kinds), len(set(shader_mutants.KINDS)))

    def test_headless(self):
        self.assertEqual(shader_mutants.run(shader_mutants.Headless, 0, FEW, "1", "direct"), [])

    def test_in_the_window(self):
        if not shutil.which("Xvfb"):
            self.skipTest("Xvfb is not installed")
        self.assertEqual(shader_mutants.run(shader_mutants.Window, 1000, FEW // 3, "1", "direct"), [])


if __name__ == "__main__":
    unittest.main()
