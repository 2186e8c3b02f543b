"""The completion script for zsh, held to the same as that for bash."""

import shutil
import unittest

import completion_test


@unittest.skipUnless(shutil.which("zsh"), "zsh is not installed, so its completion script is not run")
class Zsh(completion_test.Bash):
    shell = "zsh"


if __name__ == "__main__":
    unittest.main(defaultTest="Zsh")
