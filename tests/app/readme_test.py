"""Runs the README's tutorial word for word, in a copy of the shaders and assets, and checks what it promises."""

import os
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("BOUNCE_ROOT", Path(__file__).resolve().parents[2]))
PROGRAM = os.environ.get("BOUNCE_PROGRAM", str(ROOT / "build" / "bounce"))


def blocks(language):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return re.findall(r"^```" + re.escape(language) + r"\n(.*?)^```", text, re.M | re.S)


class Readme(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="bounce_readme_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.root = self.folder / "root"
        for part in ("glsl", "assets"):
            shutil.copytree(ROOT / part, self.root / part)
        self.environment = dict(os.environ, BOUNCE_ROOT=str(self.root))

    def bounce(self, arguments):
        return subprocess.run([PROGRAM] + arguments, cwd=self.folder, env=self.environment, text=True,
                              capture_output=True, timeout=240)

    def test_tutorial(self):
        (tutorial,) = blocks("sh tutorial")
        outputs = []
        for line in tutorial.strip().splitlines():
            words = shlex.split(line, comments=True)
            self.assertEqual(words[0], "bounce", line)
            run = self.bounce(words[1:])
            self.assertEqual(run.returncode, 0, line + "\n" + run.stdout + run.stderr)
            outputs.append(run.stdout)
        self.assertIn("glow", outputs[1])
        self.assertEqual((self.folder / "glow.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        # The parameter line that the README shows is in the shader that was written.
        (shown,) = [block.strip() for block in blocks("glsl")]
        self.assertIn(re.sub(r"\s+", " ", shown),
                      re.sub(r"[ \t]+", " ", (self.root / "glsl/user/glow.comp").read_text()))

    def test_commands_without_a_window(self):
        (block,) = [block for block in blocks("sh") if "app/run params" in block]
        lines = block.strip().splitlines()
        self.assertGreater(len(lines), 5)
        for line in lines:
            words = shlex.split(line, comments=True)
            self.assertEqual(words[0], "app/run", line)
            run = self.bounce(words[1:])
            self.assertEqual(run.returncode, 0, line + "\n" + run.stdout + run.stderr)
        made = {path.name for path in self.folder.iterdir() if path.is_file()}
        self.assertEqual(made, {"cornell.png", "cornell.exr", "normal.exr", "truth.exr", *(f"frame_{i:04}.png" for i in range(24))})

    def test_commands_exist(self):
        # Every subcommand that the README names is one that the program has.
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        named = set(re.findall(r"(?:app/run|bounce) ([a-z]+)\b", text)) - {"bundle"}
        helped = self.bounce(["--help"]).stdout
        for command in sorted(named):
            self.assertRegex(helped, r"(?m)^\s+" + command + r"\b")


if __name__ == "__main__":
    unittest.main()
