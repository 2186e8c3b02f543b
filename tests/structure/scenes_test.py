"""Generated scenes are what their generator makes, byte for byte."""

import subprocess
import sys
import unittest

import tree


class Scenes(unittest.TestCase):
    def test_the_hairball_is_what_its_generator_makes(self):
        made = subprocess.run([sys.executable, "-B", tree.ROOT / "assets/scenes/make_scenes.py", "--check", "hairball"],
                              capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)

    def test_the_hairball_is_small_to_commit(self):
        size = sum((tree.ROOT / "assets/scenes" / name).stat().st_size for name in ("hairball.gltf", "hairball.bin"))
        self.assertLess(size, 1_500_000)


if __name__ == "__main__":
    unittest.main()
