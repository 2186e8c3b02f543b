"""Runs the commands of every README word for word, as a newcomer has them: a copy of shaders and assets with no scenes beside it.

Blocks of code say what they are: `sh` and `sh tutorial` are run; `sh window` opens a window, so its shot alone is opened;
`sh slow` takes minutes, so that its options alone are checked by the tests of those commands; `sh install` is this test's own
set-up.
"""

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
KINDS = {"sh", "sh tutorial", "sh window", "sh slow", "sh install"}


def readmes():
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*README.md"], cwd=ROOT,
                            text=True, capture_output=True).stdout.split()
    return [Path(path) for path in listed if not path.startswith("third_party/")] or [Path("README.md")]


def blocks(path, kind):
    """Each block of that kind as its lines; continued lines are joined."""
    text = (ROOT / path).read_text(encoding="utf-8")
    found = re.findall(r"^```" + re.escape(kind) + r"\n(.*?)^```", text, re.M | re.S)
    return [block.replace("\\\n", " ").strip().splitlines() for block in found]


def words(line):
    split = shlex.split(line, comments=True)
    return split[1:] if split and split[0] in ("app/run", "bounce") else None


class Readme(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="bounce_readme_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.root = self.folder / "tree" / "root"  # nothing lies beside it
        for part in ("glsl", "assets"):
            shutil.copytree(ROOT / part, self.root / part)
        self.environment = dict(os.environ, BOUNCE_ROOT=str(self.root), BOUNCE_SCENES="")

    def bounce(self, arguments):
        return subprocess.run([PROGRAM] + arguments, cwd=self.folder, env=self.environment, text=True,
                              capture_output=True, timeout=280)

    def passes(self, line, where):
        arguments = words(line)
        self.assertIsNotNone(arguments, f"{where}: not a command of this program: {line}")
        run = self.bounce(arguments)
        self.assertEqual(run.returncode, 0, f"{where}: {line}\n{run.stdout}{run.stderr}")
        return run.stdout

    def commands_of(self, path):
        for block in blocks(path, "sh"):
            for line in block:
                self.passes(line, path)

    def test_tutorial(self):
        (tutorial,) = blocks(Path("README.md"), "sh tutorial")
        outputs = [self.passes(line, "README.md") for line in tutorial]
        self.assertIn("glow", outputs[1])
        self.assertEqual((self.folder / "glow.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        # The parameter line that the README shows is in the shader that was written.
        (shown,) = re.findall(r"^```glsl\n(.*?)^```", (ROOT / "README.md").read_text(encoding="utf-8"), re.M | re.S)
        self.assertIn(re.sub(r"\s+", " ", shown.strip()),
                      re.sub(r"[ \t]+", " ", (self.root / "glsl/user/glow.comp").read_text()))

    def test_windows_open_what_is_in_the_tree(self):
        checked = 0
        for path in readmes():
            for block in blocks(path, "sh window"):
                for line in block:
                    arguments = words(line)
                    self.assertEqual(arguments[0], "view", f"{path}: {line}")
                    self.passes(f"bounce info {arguments[1]}", path)
                    checked += 1
        self.assertGreater(checked, 0)

    def test_blocks_say_what_they_are(self):
        for path in readmes():
            for kind in re.findall(r"^```(sh.*)$", (ROOT / path).read_text(encoding="utf-8"), re.M):
                self.assertIn(kind, KINDS, path)

    def test_the_front_page_is_short(self):
        self.assertLessEqual(len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()), 150)

    def test_links_lead_somewhere(self):
        for path in readmes():
            text = (ROOT / path).read_text(encoding="utf-8")
            for link in re.findall(r"\]\(([^)#:]+)\)", text):
                self.assertTrue((ROOT / path.parent / link).exists(), f"{path}: {link}")

    def test_commands_exist(self):
        # Every subcommand that a README names is one that the program has.
        helped = self.bounce(["--help"]).stdout
        for path in readmes():
            text = (ROOT / path).read_text(encoding="utf-8")
            for command in sorted(set(re.findall(r"(?:app/run|`bounce) ([a-z]+)\b", text)) - {"bundle"}):
                self.assertRegex(helped, r"(?m)^\s+" + command + r"\b", path)


def test_of(path):
    return lambda self: self.commands_of(path)


for readme in readmes():
    setattr(Readme, "test_commands_of_" + re.sub(r"\W", "_", str(readme)), test_of(readme))

if __name__ == "__main__":
    unittest.main()
