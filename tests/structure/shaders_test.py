"""Every shader compiles with glslangValidator too: drivers are laxer or stricter, each in other places.

`bounce shaders --expand DIR` writes the stages of every program of every graph, as a driver would get them, to files
named GRAPH.PASS.FOLDER.NAME.STAGE.
"""

import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import tree

STAGES = {".comp": "comp", ".vert": "vert", ".frag": "frag", ".geom": "geom"}


def validate(validator, path):
    """What glslangValidator finds wrong with a file, with the lines it means; empty when it compiles."""
    result = subprocess.run([validator, "-S", STAGES[path.suffix], path], capture_output=True, text=True)
    if result.returncode == 0:
        return ""
    text = path.read_text(encoding="utf-8").splitlines()
    report = []
    for line in result.stdout.splitlines():
        place = re.match(r"ERROR: .*?:(\d+): ", line)
        if place and 0 < int(place[1]) <= len(text):
            line += f"\n    {text[int(place[1]) - 1].strip()}"
        if line.startswith("ERROR"):
            report.append(line)
    return "\n".join(report)


class Shaders(unittest.TestCase):
    def setUp(self):
        self.validator = shutil.which("glslangValidator")
        self.program = os.environ.get("BOUNCE_PROGRAM", "")
        if not self.validator:
            self.skipTest("glslangValidator is not installed")
        if not pathlib.Path(self.program).is_file():
            self.skipTest("BOUNCE_PROGRAM is not set to a built program (ctest does that)")

    def test_every_shader_compiles(self):
        with tempfile.TemporaryDirectory() as folder:
            expand = subprocess.run([self.program, "shaders", "--expand", folder], capture_output=True, text=True)
            self.assertEqual(expand.returncode, 0, expand.stderr)
            expanded = sorted(path for path in pathlib.Path(folder).rglob("*") if path.suffix in STAGES)
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                reports = list(pool.map(lambda path: validate(self.validator, path), expanded))
            wrong = [f"{path.relative_to(folder)}\n{report}" for path, report in zip(expanded, reports) if report]
            self.assertFalse(wrong, "\n" + "\n".join(wrong))

            written = {path.name for path in expanded}
            for source in tree.files():
                if source.parts[0] != "glsl" or source.suffix not in STAGES:
                    continue
                name = "." + source.relative_to("glsl").as_posix().replace("/", ".")
                with self.subTest(source=str(source)):
                    self.assertTrue(any(path.endswith(name) for path in written), "no graph uses it")

    def test_the_validator_finds_mistakes(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "broken.comp"
            path.write_text("#version 460 core\nlayout(local_size_x = 1) in;\nvoid main() { int a = 1.5; }\n")
            self.assertIn("int a = 1.5", validate(self.validator, path))
            path.write_text("#version 460 core\nlayout(local_size_x = 1) in;\nuniform float b;\nvoid main() {}\n")
            self.assertEqual(validate(self.validator, path), "")


if __name__ == "__main__":
    unittest.main()
