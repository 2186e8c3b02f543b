"""Completion of command lines, by running the shells: what is offered is what the program has, and it is accepted."""

import os
import re
import shutil
import subprocess
import unittest

from program import PROGRAM, ROOT, ProgramTest

BASH = """source <("$BOUNCE" completion bash) || exit 1
COMP_WORDS=("$@")
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_bounce
((${#COMPREPLY[@]})) && printf '%s\\n' "${COMPREPLY[@]}"
exit 0
"""
# zsh's completion runs in its line editor only: what the function offers is caught where it hands it over.
ZSH = """compdef() { :; }
compadd() { shift; (($#)) && print -l -- "$@"; :; }
compset() { :; }
_files() { :; }
source <("$BOUNCE" completion zsh) || exit 1
words=("$@")
CURRENT=$#words
_bounce
"""


class Completion(ProgramTest):
    def setUp(self):
        super().setUp()
        for kind in ("sweeps", "tables"):
            (self.root / "assets" / kind).symlink_to(ROOT / "assets" / kind)

    def names(self, kind):
        result = self.run_program("list", kind)
        self.assert_good(result)
        return result.stdout.split()

    def complete(self, *words, shell="bash"):
        script = {"bash": ["bash", "--norc", "-c", BASH, "bash"], "zsh": ["zsh", "-f", "-c", ZSH, "zsh"]}[shell]
        result = subprocess.run([*script, PROGRAM, *words[1:]], env=dict(self.environment(), BOUNCE=PROGRAM), cwd=self.out,
                                capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        return result.stdout.splitlines()

    def help_of(self, *command):
        return self.run_program(*command, "--help").stdout


class Lists(Completion):
    def test_names_are_those_of_the_files(self):
        for kind in ("shots", "graphs", "sweeps", "tables"):
            folder = self.root / "assets" / kind
            files = sorted(str(path.relative_to(folder).with_suffix("")) for path in folder.rglob("*.json") if "base" not in path.parts)
            self.assertTrue(files)
            self.assertEqual(self.names(kind), files)
        self.assertIn("atrium", self.names("scenes"))
        self.assertIn("relative_rmse", self.names("metrics"))
        self.assertIn("presets/traced_best", self.names("graphs"))
        self.assertIn("presets/traced_best", self.names("presets"))
        for preset in self.names("presets"):
            self.assertIn('"extends"', (self.root / f"assets/graphs/{preset}.json").read_text())
        (self.root / "assets/graphs/mine.json").write_text('{"version": 1, "extends": "direct"}')
        self.assertIn("mine", self.names("presets"))

    def test_other_kinds_are_refused(self):
        self.assert_refused(self.run_program("list", "shot"), "did you mean 'shots'")
        self.assert_refused(self.run_program("list"), "kind")


class Bash(Completion):
    shell = "bash"

    def test_subcommands(self):
        commands = re.findall(r"(?m)^  ([a-z]+) ", self.help_of().split("Subcommands:")[1])
        self.assertGreater(len(commands), 10)
        self.assertEqual(sorted(self.complete("bounce", "", shell=self.shell)), sorted(commands))
        self.assertIn("pass", self.complete("bounce", "new", "", shell=self.shell))

    def test_options_are_those_of_the_help_text(self):
        for command in (["render"], ["chart"], ["compare"], ["new", "pass"]):
            told = set(re.findall(r"(?<![\w-])(--[a-z-]+)", self.help_of(*command).split("Options:")[1]))
            own = {option for option in told if re.search(r"(?m)^\s+(-\w,)?[^ ]*" + option + r"\b", self.help_of(*command))}
            offered = set(self.complete("bounce", *command, "--", shell=self.shell))
            self.assertTrue(own <= offered, own - offered)

    def test_names(self):
        self.assertEqual(set(self.complete("bounce", "render", "", shell=self.shell)),
                         set(self.names("shots") + self.names("scenes")))
        for words, kind in ((["render", "cornell", "--graph", ""], "graphs"), (["render", "cornell", "-g", ""], "graphs"),
                            (["params", ""], "graphs"), (["chart", "cornell", "--sweep", ""], "sweeps"),
                            (["table", ""], "tables"), (["chart", "--metric", ""], "metrics"),
                            (["new", "pass", "x", "--graph", ""], "graphs")):
            self.assertEqual(self.complete("bounce", *words, shell=self.shell), self.names(kind), words)
        self.assertIn("shots", self.complete("bounce", "list", "", shell=self.shell))
        self.assertEqual(self.complete("bounce", "completion", "", shell=self.shell), ["bash", "zsh"])
        # A number or a text of one's own has no names.
        self.assertEqual(self.complete("bounce", "render", "cornell", "--size", "", shell=self.shell), [])


class BashWords(Completion):
    def test_what_was_begun(self):
        offered = self.complete("bounce", "render", "cornell", "--graph", "ld")
        self.assertTrue(offered)
        self.assertEqual(offered, [name for name in self.names("graphs") if name.startswith("ld")])
        self.assertEqual(self.complete("bounce", "rend"), ["render"])
        # As bash splits --graph=di, and in a list.
        self.assertEqual(self.complete("bounce", "render", "cornell", "--graph", "=", "di"), ["direct"])
        self.assertIn("lrsm,direct", self.complete("bounce", "chart", "cornell", "--graphs", "lrsm,di"))

    def test_file_names_are_no_commands(self):
        (self.root / "assets/graphs/$(touch pwned).json").write_text("{}")
        self.assertIn("$(touch pwned)", self.complete("bounce", "params", "$"))
        self.assertFalse((self.out / "pwned").exists())

    def test_what_is_offered_is_accepted(self):
        for graph in self.complete("bounce", "params", "h"):
            self.assert_good(self.run_program("params", graph))


if __name__ == "__main__":
    unittest.main()
