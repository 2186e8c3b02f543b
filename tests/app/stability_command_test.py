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

    def test_bad_input(self):
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
