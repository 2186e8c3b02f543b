"""Includes go one way: app -> techniques -> {voxel, surface} -> graph -> gpu_scene -> {gpu, scene} -> core, and
reference -> {scene, core}."""

import pathlib
import re
import tempfile
import unittest

import tree

BELOW_TECHNIQUES = {
    "core": set(),
    "gpu": {"core"},
    "scene": {"core"},
    "reference": {"core", "scene"},
    "gpu_scene": {"core", "gpu", "scene"},
    "graph": {"core", "gpu", "scene", "gpu_scene"},
    "surface": {"core", "gpu", "scene", "gpu_scene", "graph"},
    "voxel": {"core", "gpu", "scene", "gpu_scene", "graph"},
}
# Any other folder of passes/ is a technique.
TECHNIQUE = {"core", "gpu", "scene", "gpu_scene", "graph", "surface", "voxel"}

# Folders of app/ that one another build on, lowest first: none includes what stands after it.
WINDOW = ("app/ui", "app/panels", "app/viewer")

# Who may include the headers that start so.
ONLY_IN = {
    "GLFW/": re.compile(r"app/hosts/window[^/]*\.cpp"),
    "EGL/": re.compile(r"app/hosts/headless[^/]*\.cpp"),
    "glad/egl": re.compile(r"app/hosts/headless[^/]*\.cpp"),
    "imgui": re.compile(r"app/.*"),
    "regex": re.compile(r"tests/.*"),  # the standard library's goes as deep as its text is long
}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def layer_of(path):
    """The layer of a path relative to the root, or None."""
    if path.parts[0] == "app":
        return "app"
    return path.parts[1] if path.parts[0] == "passes" and len(path.parts) > 2 else None


def resolve(root, source, name):
    """The file of the tree that `#include "name"` in `source` means, or None when it is none of ours."""
    for folder in (source.parent, pathlib.Path("passes"), pathlib.Path("."), pathlib.Path("app")):
        if (root / folder / name).is_file():
            return (root / folder / name).resolve().relative_to(root.resolve())
    return None


def violations(root, sources):
    found = []
    for source in sources:
        layer = layer_of(source)
        if layer is None or source.suffix not in (".cpp", ".h"):
            continue
        allowed = BELOW_TECHNIQUES.get(layer, TECHNIQUE) | {layer}
        for name in INCLUDE.findall((root / source).read_text(encoding="utf-8")):
            for prefix, places in ONLY_IN.items():
                if name.startswith(prefix) and not places.fullmatch(source.as_posix()):
                    found.append(f"{source} includes {name}, which only {places.pattern} may")
            target = resolve(root, source, name)
            places = [str(file.parent) for file in (source, target) if file]
            if all(place in WINDOW for place in places) and [WINDOW.index(place) for place in places] != sorted(
                    (WINDOW.index(place) for place in places), reverse=True):
                found.append(f"{source} includes {name}: {places[0]} stands below {places[1]}")
            target_layer = layer_of(target) if target else None
            if target_layer and layer != "app" and target_layer not in allowed:
                found.append(f"{source} includes {name}: {layer} may use only {', '.join(sorted(allowed))}")
    return found


class Layers(unittest.TestCase):
    def test_includes_of_the_tree_go_one_way(self):
        found = violations(tree.ROOT, tree.files())
        self.assertFalse(found, "\n" + "\n".join(found))

    def test_techniques_leave_barriers_to_the_graph(self):
        """A pass says c.barrier(), so that one place knows what waits for what."""
        raw = [str(path) for path in tree.files() if path.suffix == ".cpp" and path.parts[0] == "passes"
               and layer_of(path) not in (None, *BELOW_TECHNIQUES) and "glMemoryBarrier" in (tree.ROOT / path).read_text()]
        self.assertFalse(raw, "use PassContext::barrier()")

    def check(self, source, name, ok):
        """Whether an include of `name` in `source` is found fault with, in a small tree of its own."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for path in ("passes/core/a.h", "passes/gpu/a.h", "passes/scene/a.h", "passes/graph/a.h", "passes/voxel/a.h",
                         "passes/surface/a.h", "passes/lrsm/a.h", "passes/dvs/a.h", "passes/reference/a.h", "app/a.h", "app/ui/a.h",
                         "app/panels/a.h", "app/viewer/a.h"):
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text("#pragma once\n")
            path = pathlib.Path(source)
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(f'// a comment\n  # include "{name}"\n')
            with self.subTest(source=source, name=name):
                self.assertEqual(not violations(root, [path]), ok)

    def test_the_checker_finds_what_points_up_or_sideways(self):
        for source, name in (("passes/core/b.h", "gpu/a.h"), ("passes/core/b.cpp", "../gpu/a.h"),
                             ("passes/gpu/b.cpp", "scene/a.h"), ("passes/scene/b.cpp", "gpu/a.h"),
                             ("passes/graph/b.cpp", "surface/a.h"), ("passes/surface/b.cpp", "voxel/a.h"),
                             ("passes/voxel/b.cpp", "lrsm/a.h"), ("passes/lrsm/b.cpp", "dvs/a.h"),
                             ("passes/lrsm/b.cpp", "passes/dvs/a.h"), ("passes/lrsm/b.cpp", "reference/a.h"),
                             ("passes/reference/b.cpp", "gpu/a.h"), ("passes/lrsm/b.cpp", "app/a.h"),
                             ("passes/gpu/b.cpp", "EGL/egl.h"), ("app/hosts/window.cpp", "EGL/egl.h"),
                             ("app/hosts/headless.cpp", "GLFW/glfw3.h"), ("app/panels/b.cpp", "GLFW/glfw3.h"),
                             ("passes/graph/b.cpp", "imgui.h"), ("app/ui/b.cpp", "app/panels/a.h"),
                             ("app/panels/b.cpp", "app/viewer/a.h"), ("app/ui/b.h", "app/viewer/a.h")):
            self.check(source, name, ok=False)

    def test_the_checker_lets_pass_what_points_down(self):
        for source, name in (("passes/core/b.cpp", "a.h"), ("passes/core/b.cpp", "core/a.h"), ("passes/core/b.cpp", "vector"),
                             ("passes/graph/b.cpp", "scene/a.h"), ("passes/lrsm/b.cpp", "voxel/a.h"),
                             ("passes/lrsm/deep/b.cpp", "lrsm/a.h"), ("passes/reference/b.cpp", "scene/a.h"),
                             ("app/panels/b.cpp", "app/ui/a.h"),
                             ("app/viewer/b.cpp", "app/panels/a.h"), ("app/viewer/b.cpp", "app/ui/a.h"),
                             ("app/b.cpp", "lrsm/a.h"), ("app/b.cpp", "reference/a.h"), ("app/panels/b.cpp", "imgui.h"),
                             ("app/hosts/window_keys.cpp", "GLFW/glfw3.h"), ("app/hosts/headless.cpp", "EGL/egl.h")):
            self.check(source, name, ok=True)


if __name__ == "__main__":
    unittest.main()
