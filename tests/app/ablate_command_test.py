"""bounce ablate: what it writes, and that its minimal graph is one."""

import csv
import unittest

from program import ProgramTest


class AblateCommand(ProgramTest):
    def test_parts_of_a_tuned_graph(self):
        result = self.run_program("ablate", self.shot, "--graph", "hbao_tuned", "--size", "24x24", "--spp", "16", "--frames", "1",
                                  "-o", "parts")
        self.assert_good(result)
        self.assertEqual(sorted(path.name for path in (self.out / "parts").iterdir()),
                         ["ablation.csv", "ablation.html", "ablation.md", "minimal.json"])
        with open(self.out / "parts" / "ablation.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(rows[0]["without"], "")
        self.assertGreater(len(rows), 3)
        self.assertTrue(any("→" in row["without"] for row in rows), "no departure is among the parts")
        # The minimal graph is a graph that extends the one it came from.
        self.assertIn('"extends": ', (self.out / "parts" / "minimal.json").read_text())
        self.assert_good(self.run_program("render", self.shot, "--graph", "parts/minimal.json", "--size", "16x16", "-o", "minimal.exr"))

    def test_bad_input(self):
        self.assert_refused(self.run_program("ablate", self.shot, "--graph", "hbao_tnd", "-o", "x"), "hbao_tnd", "hbao_tuned")
        self.assert_refused(self.run_program("ablate", self.shot, "--graph", "hbao", "--against", "hboa", "-o", "x"), "hboa", "hbao")
        self.assert_refused(self.run_program("ablate", self.shot, "--worth", "x", "-o", "x"), "--worth 'x'")


if __name__ == "__main__":
    unittest.main()
