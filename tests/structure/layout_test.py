"""The top level stays as it is, and files stay short: a file holds one idea."""

import collections
import re
import unittest

import tree

TOP_LEVEL = {"CMakeLists.txt", "CMakePresets.json", "README.md", "LICENSE", "app", "passes", "glsl", "third_party", "assets",
             "tests"}
LONGEST = 450  # lines
CODE = {".cpp", ".h", ".glsl", ".comp", ".vert", ".frag", ".geom", ".py", ".sh", ".cmake", ".txt", ""}


class Layout(unittest.TestCase):
    def test_the_top_level_is_fixed(self):
        extra = {path.parts[0] for path in tree.files() if not path.parts[0].startswith(".")} - TOP_LEVEL
        self.assertFalse(extra, "these do not belong at the top level")

    def test_files_are_short(self):
        long = []
        for path in tree.files():
            if path.parts[0] in ("app", "passes", "glsl", "tests") and path.suffix in CODE:
                lines = (tree.ROOT / path).read_bytes().count(b"\n")
                if lines > LONGEST:
                    long.append(f"{path}: {lines} lines, more than {LONGEST}: is it one idea?")
        self.assertFalse(long, "\n" + "\n".join(long))

    def test_barriers_are_placed_by_one_function(self):
        calls = [path.as_posix() for path in tree.files() if path.parts[0] in ("app", "passes") and path.suffix in CODE
                 and re.search(r"\bglMemoryBarrier(ByRegion)?\(", (tree.ROOT / path).read_text(encoding="utf-8"))]
        self.assertEqual(calls, ["passes/gpu/barrier.cpp"])

    def test_a_type_is_defined_in_one_header(self):
        """Two types of one name in one program break the one-definition rule: the linker keeps one destructor for both, and says nothing."""
        places = collections.defaultdict(set)
        for path in tree.files():
            if path.parts[0] in ("app", "passes") and path.suffix == ".h":
                text = (tree.ROOT / path).read_text()
                for name in re.findall(r"^(?:class|struct|enum class) (\w+)(?: final)?(?: : [^;{]*)? \{", text, re.MULTILINE):
                    places[name].add(str(path))
        self.assertIn("GraphModel", places)
        twice = [f"{name}: {', '.join(sorted(found))}" for name, found in places.items() if len(found) > 1]
        self.assertFalse(twice, "\n" + "\n".join(twice))


if __name__ == "__main__":
    unittest.main()
