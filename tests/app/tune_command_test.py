"""bounce tune: the preset that it writes, going on from what was measured, and what it refuses."""

import json
import unittest

from program import ProgramTest


class TuneCommand(ProgramTest):
    ARGUMENTS = ["--graph", "hbao", "--size", "32x32", "--spp", "16", "--frames", "1", "--tries", "6", "-o"]

    def test_a_preset_and_its_points(self):
        preset = self.out / "fast.json"
        result = self.run_program("tune", self.shot, "--over", "hbao.*,blur.*", *self.ARGUMENTS, preset)
        self.assert_good(result)
        text = preset.read_text()
        self.assertIn('"extends": ', text)
        self.assertIn("Found by tune", text)
        self.assert_good(self.run_program("render", self.shot, "--graph", preset, "--size", "16x16", "-o", "picture.exr"))
        points = json.loads((self.out / "fast.points.json").read_text())["points"]
        self.assertGreaterEqual(len(points), 6)
        self.assertIn("found: ", (self.out / "fast.md").read_text())
        # The same command measures nothing again.
        again = self.run_program("tune", self.shot, "--over", "hbao.*,blur.*", *self.ARGUMENTS, preset)
        self.assert_good(again)
        self.assertIn("points were measured before", again.stdout)
        self.assertEqual(json.loads((self.out / "fast.points.json").read_text())["points"], points)

    def test_bad_input(self):
        self.assert_refused(self.run_program("tune", self.shot, "--over", "hboa.*", *self.ARGUMENTS, "x.json"), "hboa")
        self.assert_refused(self.run_program("tune", "corneli", *self.ARGUMENTS, "x.json"), "corneli")
        self.assert_refused(self.run_program("tune", self.shot, "--error", "0", *self.ARGUMENTS, "x.json"), "--error '0'")
        self.assert_refused(self.run_program("tune", self.shot, *self.ARGUMENTS, "none/x.json"), "none")


if __name__ == "__main__":
    unittest.main()
