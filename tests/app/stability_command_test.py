"""bounce stability: cases by graphs, what it writes, and what it refuses."""

import json
import shutil
import unittest

from program import ROOT, ProgramTest

CASE = """{"about": "The same frame twice.", "quantity": "difference", "most": 0, "ladder": {"run": [1, 2]}, "resource": "out.direct",
 "size": [16, 16], "shot": {"camera": {"position": [0, 1, 2], "target": [0, 0, 0]}, "lights": [{"type": "point", "position": [0, 1, 1]}]},
 "scenes": {"floor": [{"quad": [[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]]}]}}"""


class StabilityCommand(ProgramTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(ROOT / "assets" / "stability", self.root / "assets" / "stability")
        self.case = self.folder / "twice.json"
        self.case.write_text(CASE)

    def test_cases_by_graphs(self):
        self.case.with_name("gloss.json").write_text(CASE.replace("out.direct", "out.indirect_specular"))
        result = self.run_program("stability", "--graphs", "direct,traced", "--cases",
                                  "%s,%s" % (self.case, self.case.with_name("gloss.json")), "-o", "suite")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("twice, direct: 0 % ✓", result.stdout)
        self.assertIn("gloss, direct: not measured", result.stdout)
        suite = self.out / "suite"
        self.assertEqual(sorted(path.name for path in suite.iterdir()),
                         ["stability.csv", "stability.html", "stability.json", "stability.md"])
        measured = json.loads((suite / "stability.json").read_text())["cases"]
        self.assertEqual([case["case"] for case in measured], ["twice", "gloss"])
        self.assertEqual(measured[0]["graphs"]["direct"]["curve"], [0, 0])
        self.assertIn("failure", measured[1]["graphs"]["direct"])
        self.assertIn("| twice | worst difference | ≤ 0 % | 0 % ✓ | 0 % ✓ |", (suite / "stability.md").read_text())

    def test_what_is_measured_is_kept(self):
        arguments = ["stability", "--graphs", "direct", "--cases", self.case, "-o", "suite", "--resume"]
        first = self.run_program(*arguments)
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertNotIn("measured before", first.stdout)
        written = json.loads((self.out / "suite" / "stability.json").read_text())["cases"]
        self.assertIn("twice, direct: 0 % ✓ (measured before)", self.run_program(*arguments).stdout)
        again = json.loads((self.out / "suite" / "stability.json").read_text())["cases"]
        self.assertEqual(written, again)
        other = self.run_program(*arguments, "--set", "shadow_maps.resolution=64")
        self.assertNotIn("measured before", other.stdout, "other settings are another cell")
        self.case.write_text(CASE.replace("[1, 2]", "[1, 2, 3]"))
        changed = self.run_program(*arguments)
        self.assertNotIn("measured before", changed.stdout, "so is another ladder")

    def test_settings_hold_for_the_cases(self):
        wrong = self.run_program("stability", "--graphs", "direct", "--cases", self.case, "--set", "direct.visiblity=none")
        self.assertIn("not measured", wrong.stdout)
        self.assertIn("visibility", wrong.stdout)
        disabled = self.run_program("stability", "--graphs", "direct", "--cases", self.case, "--disable", "gbufer")
        self.assertIn("gbuffer", disabled.stdout)

    def test_flip_over_time(self):
        self.case.write_text(CASE.replace('"difference"', '"flip"'))
        still = self.run_program("stability", "--graphs", "direct", "--cases", self.case)
        self.assertIn("twice, direct: 0 ✓", still.stdout)
        path = '"path": [{"t": 0, "position": [-1, 1, 1]}, {"t": 0.1, "position": [1, 1, 1]}, {"t": 0.2, "position": [-1, 1, 1]}], '
        self.case.write_text(CASE.replace('"difference"', '"flip"').replace('{"type"', "{" + path + '"type"'))
        self.assertRegex(self.run_program("stability", "--graphs", "direct", "--cases", self.case).stdout,
                         r"twice, direct: 0\.\d+ ✗")

    def test_bad_input(self):
        self.assert_refused(self.run_program("stability", "--cases", self.case, "--resume"), "--resume", "folder")
        self.assert_refused(self.run_program("stability", "--cases", "sealed_rom"), "sealed_rom", "sealed_room")
        self.assert_refused(self.run_program("stability", "--graphs", "lrms", "--cases", self.case), "lrms", "lrsm")
        self.case.write_text(CASE.replace('"most"', '"mots"'))
        self.assert_refused(self.run_program("stability", "--cases", self.case), "mots", "'most' must be a number")
        self.assert_refused(self.run_program("stability", "cornell", "--cases", "sealed_room"), "either a shot")
        self.case.write_text(CASE)
        (self.out / "taken").write_text("")
        self.assert_refused(self.run_program("stability", "--cases", self.case, "-o", "taken"), "taken", leaves=["taken"])


if __name__ == "__main__":
    unittest.main()
