"""`app/run bundle DIR`: all that the program needs is in the folder, but for the C library and OpenGL."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import tree

LARGEST = 60 * 2**20
OF_THE_MACHINE = re.compile(r"(linux-vdso|ld-linux-x86-64|lib(c|m|dl|pthread|rt|resolv|util|EGL|GL|GLX|GLdispatch|OpenGL))\.so")

PROGRAM = pathlib.Path(os.environ.get("BOUNCE_PROGRAM", ""))


def bundle(folder):
    """What `app/run bundle` does once everything is built."""
    script = 'source "$0/app/setup.sh"; source "$0/app/bundle.sh"; bundle "$1" "$2"'
    return subprocess.run(["bash", "-euo", "pipefail", "-c", script, tree.ROOT, PROGRAM.parent, folder], capture_output=True,
                          text=True)


@unittest.skipUnless(PROGRAM.is_file(), "BOUNCE_PROGRAM is not set to a built program (ctest does that)")
@unittest.skipIf(os.environ.get("BOUNCE_SANITIZE") == "ON", "a program with sanitizers is not for other machines")
class Bundle(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name) / "a bundle"
        cls.made = bundle(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        self.assertEqual(self.made.returncode, 0, self.made.stderr)

    def test_it_is_small(self):
        size = sum(path.stat().st_size for path in self.folder.rglob("*")
                   if path.is_file() and not path.is_symlink())
        self.assertLess(size, LARGEST)

    def test_it_holds_every_library(self):
        shared = sorted((self.folder / "lib" / "shared").iterdir())
        environment = {"LD_LIBRARY_PATH": ":".join(str(path) for path in shared)}
        files = [self.folder / "bounce-x86_64", *(path for path in (self.folder / "lib").rglob("*") if path.is_file())]
        found = subprocess.run(["ldd", *files], capture_output=True, text=True, env={**os.environ, **environment}).stdout
        # `ldd` looks at libraries by themselves, without the program whose RPATH finds their neighbours.
        own = {path.name for path in files}
        for name, place in re.findall(r"^\s+(\S+) => (.*?)(?: \(0x\w+\))?$", found, re.MULTILINE):
            with self.subTest(library=name):
                self.assertTrue(name in own or OF_THE_MACHINE.match(name), f"taken from {place}")
        program = subprocess.run(["ldd", files[0]], capture_output=True, text=True, env={**os.environ, **environment}).stdout
        self.assertNotIn("not found", program)

    def test_it_runs_from_elsewhere(self):
        with tempfile.TemporaryDirectory() as elsewhere:
            kept = {name: os.environ[name] for name in ("MESA_SHADER_CACHE_DIR",) if name in os.environ}
            result = subprocess.run([self.folder / "bounce", "render", "cornell", "--graph", "direct", "--size", "32x32", "-o",
                                     "x.png"], cwd=elsewhere, env={"HOME": elsewhere, **kept}, capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertTrue((pathlib.Path(elsewhere) / "x.png").is_file())

    def test_it_has_the_licences(self):
        names = {path.name.removesuffix(".txt.gz") for path in (self.folder / "licenses").iterdir()}
        for part in ("embree", "glfw", "imgui", "openexr", "glm", "stdc++"):
            self.assertTrue(any(part in name for name in names), part)
        self.assertTrue((self.folder / "LICENSE").is_file())

    def test_it_replaces_a_bundle_but_nothing_else(self):
        again = bundle(self.folder)
        self.assertEqual(again.returncode, 0, again.stderr)
        with tempfile.TemporaryDirectory() as other:
            (pathlib.Path(other) / "mine").write_text("")
            refused = bundle(other)
            self.assertEqual(refused.returncode, 2)
            self.assertIn("nothing was changed", refused.stderr)
            self.assertEqual([path.name for path in pathlib.Path(other).iterdir()], ["mine"])


if __name__ == "__main__":
    unittest.main()
