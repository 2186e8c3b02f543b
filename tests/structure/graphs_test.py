"""Graph files read like a pipeline figure: no line is wide, and what is said once is not repeated."""

import json
import re
import unittest

import tree

COLUMNS = 140
GRAPHS = tree.ROOT / "assets/graphs"


def without_comments(text):
    return re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', lambda m: m[1] or "", text, flags=re.DOTALL)


class Graphs(unittest.TestCase):
    def files(self):
        files = sorted(GRAPHS.rglob("*.json"))
        self.assertGreaterEqual(len(files), 15)
        return files

    def read(self, file):
        return json.loads(without_comments(file.read_text(encoding="utf-8")))

    def test_lines_are_not_wide(self):
        wide = [f"{file.relative_to(tree.ROOT)}:{number}: {len(line)} columns"
                for file in self.files() for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1)
                if len(line) > COLUMNS]
        self.assertFalse(wide, "\n" + "\n".join(wide))

    def test_a_tuned_graph_is_a_list_of_departures(self):
        for file in self.files():
            graph = self.read(file)
            if file.stem.endswith("_tuned"):
                self.assertIn("extends", graph, file.name)
                # What it departs from is what its name says, or another tuned graph.
                self.assertIn(graph["extends"], (file.stem.removesuffix("_tuned"), graph["extends"].removesuffix("_tuned") + "_tuned"), file.name)

    def test_the_outputs_are_declared_once(self):
        makers = {}
        for file in self.files():
            for entry in self.read(file).get("passes", []):
                if entry.get("shader") in ("surface/compose.comp", "surface/tonemap.comp", "surface/direct.comp") or entry.get("type") == "gbuffer":
                    makers.setdefault(entry.get("shader", "gbuffer"), []).append(file.name)
        self.assertEqual(len(makers), 4)
        for what, files in makers.items():
            self.assertEqual(files, ["surface.json"], what)


if __name__ == "__main__":
    unittest.main()
