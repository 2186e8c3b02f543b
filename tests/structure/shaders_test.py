"""Every shader compiles with glslangValidator too, without a warning, and its SPIR-V is valid before and after optimization:
drivers are laxer or stricter, each in other places.

`bounce shaders --expand DIR` writes the stages of every program of every graph, as a driver would get them, to files
named GRAPH.PASS.FOLDER.NAME.STAGE: with the static values of each graph, and with and without each optional slot that
the text asks for.
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


# Without Vulkan, no front end makes locations and bindings up by itself; the values do not matter here.
TO_SPIRV = ["-G", "--aml", "--amb"]
TARGET = "opengl4.5"
TOOLS = ("glslangValidator", "spirv-val", "spirv-opt", "spirv-dis")


def without_bool_uniforms(text):
    """SPIR-V has no bool that an application can set, and glslang writes one nevertheless: an int stands in for it."""
    return re.sub(r"^([ \t]*)uniform bool (\w+)[^;]*;", r"\1uniform int set_\2; bool \2 = set_\2 != 0;", text, flags=re.MULTILINE)


def run(*command):
    return subprocess.run(command, capture_output=True, text=True)


def judged_by_glslang(path, spirv):
    """Its errors and warnings with the lines that they mean; "" when there are none, and `spirv` is written."""
    result = run("glslangValidator", *TO_SPIRV, "-S", STAGES[path.suffix], "-o", spirv, path)
    text = path.read_text(encoding="utf-8").splitlines()
    report = []
    for line in result.stdout.splitlines():
        if not line.startswith(("ERROR", "WARNING")):
            continue
        place = re.match(r"\w+: .*?:(\d+): ", line)
        if place and 0 < int(place[1]) <= len(text):
            line += f"\n    {text[int(place[1]) - 1].strip()}"
        report.append(line)
    return "\n".join(report) or ("" if result.returncode == 0 else f"glslangValidator ended with {result.returncode}")


# What they share declares more than they need. The block comes behind the one whose length is asked for, which is right then
# (drivers/drivers_test.py compares what the drivers make of it).
DECLARE_MORE = {"dvs.mark.comp": "voxels_sums", "dvs.triangle_bounds.comp": "scene_materials"}


def names_in(spirv):
    return set(re.findall(r'OpName %\w+ "(\w+)"', spirv))


def unused_blocks(text, plain, optimized):
    """Storage blocks that are declared and not left after optimization, in a shader that asks for the length of another:
    zink (of Mesa 22.3) then counts the blocks in two ways, and tells the length of a wrong one."""
    declared = set(re.findall(r"\bbuffer\s+(\w+)\s*\{", text))
    if not declared or ".length()" not in text:
        return []
    before, after = (run("spirv-dis", "--raw-id", path).stdout for path in (plain, optimized))
    return sorted((declared & names_in(before)) - names_in(after)) if "OpArrayLength" in after else []


def validate(path):
    """What is wrong with a file; "" when its SPIR-V is valid before and after optimization, without a warning."""
    with tempfile.TemporaryDirectory() as folder:
        source, plain, optimized = (pathlib.Path(folder) / name for name in (path.name, "a.spv", "b.spv"))
        source.write_text(without_bool_uniforms(path.read_text(encoding="utf-8")), encoding="utf-8")
        report = judged_by_glslang(source, plain)
        if report:
            return report
        for command in (["spirv-val", "--target-env", TARGET, plain],
                        ["spirv-opt", f"--target-env={TARGET}", "-O", plain, "-o", optimized],
                        ["spirv-val", "--target-env", TARGET, optimized]):
            result = run(*command)
            if result.returncode != 0 or result.stdout or result.stderr:
                return f"{command[0]}: {result.stdout}{result.stderr}".strip()
        unused = [name for name in unused_blocks(path.read_text(encoding="utf-8"), plain, optimized)
                  if not any(path.name.endswith(f".{stage}") and name == block for stage, block in DECLARE_MORE.items())]
        return f"asks for a length, and declares storage blocks that it does not use: {', '.join(unused)}" if unused else ""


class Shaders(unittest.TestCase):
    def setUp(self):
        self.program = os.environ.get("BOUNCE_PROGRAM", "")
        for tool in TOOLS:
            if not shutil.which(tool):
                self.skipTest(f"{tool} is not installed")
        if not pathlib.Path(self.program).is_file():
            self.skipTest("BOUNCE_PROGRAM is not set to a built program (ctest does that)")

    def test_every_shader_compiles(self):
        with tempfile.TemporaryDirectory() as folder:
            expand = subprocess.run([self.program, "shaders", "--expand", folder], capture_output=True, text=True)
            self.assertEqual(expand.returncode, 0, expand.stderr)
            expanded = sorted(path for path in pathlib.Path(folder).iterdir() if path.suffix in STAGES)
            texts = {path.read_bytes(): path for path in reversed(expanded)}  # most are those of several graphs
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                reports = list(pool.map(validate, texts.values()))
            wrong = [f"{path.name}\n{report}" for path, report in zip(texts.values(), reports) if report]
            self.assertFalse(wrong, "\n" + "\n".join(wrong))

            written = {path.name for path in expanded}
            for source in tree.files():
                if source.parts[0] != "glsl" or source.suffix not in STAGES:
                    continue
                name = "." + source.relative_to("glsl").as_posix().replace("/", ".")
                with self.subTest(source=str(source)):
                    self.assertTrue(any(path.endswith(name) for path in written), "no graph uses it")

    def test_mistakes_are_found(self):
        def found(body, before=""):
            path = pathlib.Path(folder) / "x.comp"
            path.write_text(f"#version 460 core\nlayout(local_size_x = 1) in;\n{before}\nvoid main() {{ {body} }}\n")
            return validate(path)

        block = "layout(std430) buffer a_b { uint words[]; };"
        with tempfile.TemporaryDirectory() as folder:
            self.assertIn("int a = 1.5", found("int a = 1.5;"))
            self.assertEqual(found("", "uniform float b;\nuniform bool c = true;"), "")
            self.assertEqual(found("if (c) words[0] = 1u;", f"{block}\nuniform bool c = true;"), "")
            both = block + "layout(std430) buffer c_d { uint more[]; };"
            self.assertEqual(found("words[0] = 1u;", both), "")
            self.assertIn("does not use: c_d", found("words[0] = uint(words.length());", both))
            self.assertIn("does not use: c_d", found("if (words.length() < 0) words[0] = 1u; if (false) more[0] = 2u;", both))
            self.assertIn("WARNING", found("", "#extension GL_nothing_of_this_kind : enable"))


if __name__ == "__main__":
    unittest.main()
