"""Pages as the program writes them, of every kind, and files to make them from."""

import base64
import hashlib
import json
import re
import shutil
import struct
import zlib

from exr import write_exr
from methods_chart_test import suite
from program import ROOT, ProgramTest

EVIL = "<img src=x onerror=alert(1)>"
CASE = """{"about": "%s", "quantity": "mean", "most": 0.5, "ladder": {"h": [0.5, 1, 2]}, "resource": "out.direct", "expected": "h",
 "size": [16, 16], "shot": {"camera": {"position": [0, 1, 2], "target": [0, 0, 0]},
 "lights": [{"type": "point", "position": [0, "=h", 1], "intensity": 1}]},
 "scenes": {"floor": [{"quad": [[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]]}]}}"""


def png(width, height, colour):
    """A plain picture as base64."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    rows = (b"\0" + bytes(colour) * width) * height
    data = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
    return base64.b64encode(data).decode()


def point(i, graph="direct", shot="cornell", ms=10.0, error=0.2, **changes):
    figures = {"bias": -0.01 * i, "rmse": error, "relative_rmse": error, "relative_rmse_denoised": error, "relative_mse": error, "p99": 3,
               "smape": 0.1, "flip": 0.1, "ssim": 0.9, "reference_noise": 0.01, "mean": 1, "reference_mean": 1}
    return {"key": f"{i:016x}", "shot": shot, "graph": graph, "values": {"shadow_maps.resolution": str(64 << i)}, "size": [64, 36],
            "warm_up": 0, "frames": 1, "reference_goal": {"noise": 0.01, "samples": 4}, "command": "", "total_ms": ms, "bytes": 1 << 20,
            "passes": [{"id": "gbuffer", "median_ms": 1, "p10_ms": 1, "p90_ms": 1, "bytes": 8},
                       {"id": "direct", "median_ms": ms - 1, "p10_ms": 1, "p90_ms": 1, "bytes": 8}], "skipped": [],
            "transport_bounces": 0, "parts": ["out.direct"], "same_transport": figures, "full": figures, "kept_share": 1,
            "renderer": "r", "thumbnail_png": png(64, 36, (40 * i % 256, 90, 200)), "error_png": png(64, 36, (200, 40 * i % 256, 0)),
            **changes}


# Times rise as errors fall, but for the last of `direct`, which the one before beats in both.
POINTS = [point(0, ms=5, error=0.4), point(1, ms=10, error=0.2), point(2, ms=20, error=0.1), point(3, ms=100, error=0.15),
          point(4, EVIL, ms=7, error=0.9), point(5, shot="atrium", ms=9, error=0.3)]


def digest(text):
    """As a content security policy names a script or style that stands in the page."""
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"


def assembled(body, scripts):
    """A page of this body as the program would write it."""
    asset = lambda name: (ROOT / "assets/pages" / name).read_text()
    style, script = asset("page.css"), "".join(asset(name + ".js") for name in scripts)
    values = {"title": "a page", "style": style, "style_source": digest(style), "body": body, "data": "null", "script": script,
              "script_source": digest(script)}
    return re.sub(r"\{\{(\w+)\}\}", lambda name: values[name.group(1)], asset("page.html"))


class PageTest(ProgramTest):
    def environment(self):
        return dict(super().environment(), XDG_CACHE_HOME=str(self.folder / "cache"))

    def written(self, path, *arguments):
        self.assert_good(self.run_program(*arguments))
        self.assertTrue((self.out / path).is_file(), path)
        return self.out / path

    def chart(self, points=None, *more):
        folder = self.folder / "in" / "points"
        folder.mkdir(parents=True, exist_ok=True)
        for one in POINTS if points is None else points:
            (folder / (one["key"] + ".json")).write_text(json.dumps(one))
        return self.written("chart/chart.html", "chart", "--merge", self.folder / "in", *more, "-o", "chart")

    def stability(self):
        if not (self.root / "assets" / "stability").exists():
            shutil.copytree(ROOT / "assets" / "stability", self.root / "assets" / "stability")
        for name in ("low", "other"):
            (self.folder / f"{name}.json").write_text(CASE % (EVIL if name == "low" else "the same"))
        return self.written("s/stability.html", "stability", "--graphs", "direct,direct_off", "--cases",
                            f"{self.folder}/low.json,{self.folder}/other.json", "-o", "s")

    def ablation(self):
        return self.written("a/ablation.html", "ablate", self.shot, "--graph", "hbao_tuned", "--size", "24x24", "--spp", "8",
                            "--frames", "1", "-o", "a")

    def tuning(self):
        return self.written("t.html", "tune", self.shot, "--graph", "hbao", "--over", "hbao.*,blur.*", "--size", "32x32", "--spp", "8",
                            "--frames", "1", "--tries", "6", "-o", self.out / "t.json")

    def comparison(self):
        names = EVIL + ".exr", "b.exr"
        for name, value in zip(names, (1.1, 1.0)):
            parts = {f"{part}.{c}": [value] * (64 * 36) for part in ("out.direct", "out.radiance") for c in "RGB"}
            write_exr(self.out / name, 64, 36, parts)
        return self.written("c.html", "compare", *names, "--html", "c.html")

    def methods(self):
        (self.folder / "suite.json").write_text(json.dumps(suite(self.shot)))
        if not (self.root / "assets" / "sweeps").exists():
            (self.root / "assets" / "sweeps").symlink_to(ROOT / "assets" / "sweeps")
        return self.written("m/methods.html", "chart", "--all", "--sweep", self.folder / "suite.json", "--spp", "4", "-o", "m")

    def setUp(self):
        super().setUp()
        (self.root / "assets/graphs/direct_off.json").write_text(
            '{"version": 1, "extends": "direct", "passes": [{"id": "direct", "params": {"shadows": false}}]}')
