"""Software drivers that stand in for one another, and how far their pictures of a shot are apart.

`llvmpipe` compiles GLSL to machine code by NIR and Gallium's own back end, in vectors of 256 bits and by several threads;
`narrow` is the same with vectors of 128 bits and one thread, so with subgroups of another size and rasterization in
another order; `zink` compiles it to SPIR-V, which the Vulkan driver lavapipe compiles by a front end of its own. None
runs two dispatches at once: a missing barrier shows on none of them.
"""

import functools
import math
import os
import pathlib
import subprocess
import sys
import tempfile

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TESTS / "app"))
from exr import read_exr  # noqa: E402 (the folder of the program's tests)
from program import PROGRAM, ROOT  # noqa: E402

DRIVERS = {
    "llvmpipe": {"GALLIUM_DRIVER": "llvmpipe", "LIBGL_ALWAYS_SOFTWARE": "1"},
    "narrow": {"GALLIUM_DRIVER": "llvmpipe", "LIBGL_ALWAYS_SOFTWARE": "1", "LP_NATIVE_VECTOR_WIDTH": "128",
               "LP_NUM_THREADS": "1"},
    "zink": {"MESA_LOADER_DRIVER_OVERRIDE": "zink", "LIBGL_ALWAYS_SOFTWARE": "1"},
}
OF_A_DRIVER = {name for settings in DRIVERS.values() for name in settings}


@functools.cache
def runtime_folder():
    """lavapipe wants a private one; it is kept until this process ends."""
    return tempfile.TemporaryDirectory(prefix="bounce_driver_")


def environment(driver):
    """Of this process, as it is for the driver None; else with that driver whatever driver this process was told to use. Each has a shader cache of its own."""
    if driver is None:
        return dict(os.environ)
    kept = {name: value for name, value in os.environ.items() if name not in OF_A_DRIVER}
    cache = pathlib.Path(kept.get("MESA_SHADER_CACHE_DIR", runtime_folder().name))
    return {**kept, **DRIVERS[driver], "XDG_RUNTIME_DIR": runtime_folder().name,
            "MESA_SHADER_CACHE_DIR": str(cache if driver == "llvmpipe" else cache.parent / f"{cache.name}_{driver}")}


class Picture:
    """What a driver made: `channels` (arrays of floats by name) and the `renderer`."""

    def __init__(self, driver, shot, graph, size, *options, root=ROOT, timeout=600):
        with tempfile.TemporaryDirectory(prefix="bounce_driver_") as folder:
            path = pathlib.Path(folder) / "x.exr"
            result = subprocess.run([PROGRAM, "render", shot, "--graph", graph, "--size", f"{size[0]}x{size[1]}", "--quiet",
                                     "-o", path, *options], env={**environment(driver), "BOUNCE_ROOT": str(root)},
                                    capture_output=True, text=True, timeout=timeout)
            if result.returncode != 0:
                raise RuntimeError(f"{shot} by {graph} on {driver or 'this machine'}: {result.stderr.strip()[-2000:]}")
            _, _, self.channels, texts = read_exr(path)
        self.renderer = texts["bounce"].split('"renderer":"', 1)[1].split('"', 1)[0]

    def bytes_of(self):
        return {name: values.tobytes() for name, values in self.channels.items()}


def parts(picture):
    """Channel names by part: "out.direct" has three, occlusion one. The plain picture is one of the parts again."""
    found = {}
    for name in picture.channels:
        if "." in name:
            part = name.rsplit(".", 1)[0] if name.rsplit(".", 1)[1] in ("R", "G", "B", "A", "Y") else name
            found.setdefault(part, []).append(name)
    return found


def differences(a, b):
    """By part, the root of the mean square difference of b's values to a's, as a share of a's mean (of 1 where a is
    black)."""
    assert a.channels.keys() == b.channels.keys(), (sorted(a.channels), sorted(b.channels))
    out = {}
    for part, names in parts(a).items():
        pairs = [pair for name in names for pair in zip(a.channels[name], b.channels[name])]
        square = sum((x - y) ** 2 for x, y in pairs) / len(pairs)
        mean = sum(abs(x) for x, _ in pairs) / len(pairs)
        out[part] = math.sqrt(square) / (mean or 1)
    return out


def names(kind):
    result = subprocess.run([PROGRAM, "list", kind], capture_output=True, text=True, check=True,
                            env={**os.environ, "BOUNCE_ROOT": str(ROOT)})
    return result.stdout.split()


@functools.cache
def small(graph):
    """--set options that make a graph cheap: of what takes time without another kind of arithmetic."""
    wanted = {"shadow_maps.resolution": 128, "rsm.resolution": 64, "voxelization.resolution": 32,
              "occlusion_voxels.resolution": 32, "ldm.maps": 16, "ldm.resolution": 32, "vf_proxies.proxies": 4000,
              "visibility.marching_size": 16}
    result = subprocess.run([PROGRAM, "params", graph], capture_output=True, text=True, check=True,
                            env={**os.environ, "BOUNCE_ROOT": str(ROOT)})
    known = {line.split()[0] for line in result.stdout.splitlines() if line.startswith("  ")}
    return [word for name, value in wanted.items() if name in known for word in ("--set", f"{name}={value}")]
