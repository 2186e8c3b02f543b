"""Every C++ file is formatted as .clang-format says."""

import re
import shutil
import subprocess
import unittest

import tree

VERSION = 14  # others break some lines elsewhere


class Format(unittest.TestCase):
    def test_sources_are_formatted(self):
        program = shutil.which(f"clang-format-{VERSION}") or shutil.which("clang-format")
        if not program:
            self.skipTest("clang-format is not installed")
        version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
        if not re.search(rf"version {VERSION}\.", version):
            self.skipTest(f"needs clang-format {VERSION}, found {version.strip()}")
        sources = [path for path in tree.files() if path.suffix in (".cpp", ".h")]
        self.assertTrue(sources)
        result = subprocess.run([program, "--dry-run", "-Werror", "--ferror-limit=1", *sources], cwd=tree.ROOT,
                                capture_output=True, text=True)
        files = sorted(set(re.findall(r"^(\S+?):\d+:\d+: error", result.stderr, re.MULTILINE)))
        self.assertEqual(result.returncode, 0, "\nto put right: clang-format -i " + " ".join(files) + "\n" + result.stderr)


if __name__ == "__main__":
    unittest.main()
