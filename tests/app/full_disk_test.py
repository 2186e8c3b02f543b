"""Mesa's shader cache on a disk that is full, or becomes so: the program goes on. A small disk in memory is mounted in a
namespace of its own, where the system allows that."""

import os
import shlex
import subprocess
import unittest

from program import PROGRAM, SMALL, ProgramTest


class FullDisk(ProgramTest):
    def render(self, size, fill, again=False):
        """Renders with the cache on a disk of `size`, filled with a file but for `fill` bytes."""
        disk = self.folder / "disk"
        disk.mkdir(exist_ok=True)
        command = shlex.join([PROGRAM, "render", str(self.shot), "--graph", "direct", "--size", "16x16", *SMALL, "-o", "x.png"])
        script = f"mount -t tmpfs -o size={size} tmpfs {disk} || exit 77\n"
        if again:  # an index that Mesa made while there was space
            script += f"{command} 2>&1 || exit 78\n"
            script += f"[ $(( $(stat -c %b {disk}/mesa_shader_cache/index) * 512 )) -ge $(stat -c %s {disk}/mesa_shader_cache/index) ] || exit 79\n"
        script += f"head -c $(( $(df --output=avail -B1 {disk} | tail -1) - {fill} )) /dev/zero > {disk}/full\n{command}"
        environment = dict(self.environment(), MESA_SHADER_CACHE_DIR=str(disk))
        environment.pop("MESA_SHADER_CACHE_DISABLE", None)
        result = subprocess.run(["unshare", "--map-root-user", "--mount", "sh", "-c", script], env=environment, cwd=self.out,
                                capture_output=True, text=True, timeout=240)
        if result.returncode == 77 or (result.returncode == 1 and "unshare" in result.stderr):
            self.skipTest("no disk can be mounted here: " + result.stderr.strip())
        return result

    def test_a_full_disk(self):
        result = self.render("2m", 0)
        self.assert_good(result)
        self.assertIn("Mesa's shader cache is off", result.stdout + result.stderr)
        self.assertTrue((self.out / "x.png").exists())

    def test_a_disk_with_space(self):
        result = self.render("64m", 40 << 20)
        self.assert_good(result)
        self.assertNotIn("shader cache", result.stdout + result.stderr)

    def test_a_disk_that_fills_up_later(self):
        """The whole index has its place from the first run on, so that no later write to it can fail."""
        result = self.render("32m", 0, again=True)
        self.assert_good(result)


if __name__ == "__main__":
    unittest.main()
