"""Shaders of the program, damaged at random, in the running program: it must live on, answer within ten seconds of its own
processor time, and show its picture again when the file is whole again.

    python3 tests/fuzz/shader_mutants.py [--headless N] [--window M] [--seconds T] [--seed S] [--graph GRAPH]

Each mutant is a function of the seed and its number alone: --first K --headless 1 runs the Kth again. The window needs Xvfb."""

import argparse
import collections
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))
from program import PROGRAM, ROOT, TINY_SHOT  # noqa: E402

MAX_SECONDS = 10  # of processor time, for one mutant
PATIENCE = 300  # seconds of a clock: a machine may be busy with other things
TOKEN = re.compile(r"\w+|[^\w\s]")
HUGE = ["1000000", "100000000", "2147483647", "4294967295u", "-1", "0", "1e38", "0x7fffffff", "65536", "1000"]


# --- mutants ----------------------------------------------------------------------------------------------------------

def swap_tokens(r, text):
    spans = [m.span() for m in TOKEN.finditer(text)]
    (a, b), (c, d) = sorted(r.sample(spans, 2))
    return text[:a] + text[c:d] + text[b:c] + text[a:b] + text[d:]


def delete_tokens(r, text):
    spans = [m.span() for m in TOKEN.finditer(text)]
    first = r.randrange(len(spans))
    last = min(first + r.choice([0, 0, 0, 1, 3, 10]), len(spans) - 1)
    return text[:spans[first][0]] + text[spans[last][1]:]


def copy_lines(r, text):
    lines = text.splitlines(True)
    first = r.randrange(len(lines))
    piece = lines[first:first + r.choice([1, 1, 2, 5])]
    at = r.randrange(len(lines) + 1)
    return "".join(lines[:at] + piece * r.choice([1, 1, 2, 300]) + lines[at:])


def delete_lines(r, text):
    lines = text.splitlines(True)
    first = r.randrange(len(lines))
    return "".join(lines[:first] + lines[first + r.choice([1, 1, 2, 5]):])


def change_number(r, text):
    spans = [m.span() for m in re.finditer(r"\b\d+(\.\d*)?\b", text)]
    if not spans:
        return delete_tokens(r, text)
    a, b = r.choice(spans)
    return text[:a] + r.choice(HUGE) + text[b:]


def change_word(r, text):
    words = [m for m in re.finditer(r"\b[a-z_]\w*\b", text)]
    a, b = r.sample(words, 2)
    return text[:a.start()] + b.group() + text[a.end():]


def change_operator(r, text):
    spans = [m.span() for m in re.finditer(r"[-+*/<>=!&|;,(){}\[\]]", text)]
    a, b = r.choice(spans)
    return text[:a] + r.choice(list("-+*/<>=!&|;,(){}[]") + ["", "++", "<<", "=="]) + text[b:]


def unbalance(r, text):
    at = r.randrange(len(text) + 1)
    return text[:at] + r.choice("(){}[]") * r.choice([1, 1, 2, 5000]) + text[at:]


def insert_line(r, text):
    lines = text.splitlines(True)
    at = r.randrange(len(lines) + 1)
    bomb = "#define a0 x\n" + "".join(f"#define a{i} a{i - 1} a{i - 1}\n" for i in range(1, 40)) + "a39\n"
    return "".join(lines[:at]) + r.choice([
        "float huge[1000000];\n", "shared float huge[1000000];\n", "for (int i = 0; i < 2147483647; ++i) {}\n", "while (true) {}\n",
        "/*\n", "*/\n", "#if 1\n", "#else\n", "#endif\n", "#if\n", "#include \"lib/frame.glsl\"\n", "#include \"none.glsl\"\n", "#define main other\n",
        "#define float int\n", "#define x x x\n", "#define " + "y" * 40000 + "\n", "#error stop\n", "#extension all : require\n", "#version 110\n",
        "layout(local_size_x = 100000) in;\n", "uniform sampler2D a_b[100000];\n", "uniform float p = 1.0; //! [0, 2] p\n", "uniform float p; //! [2, 0]\n",
        "uniform sampler2D nogroup;\n", "float f(float x) { return f(x); }\n", "\\\n", "// \\\n", "\0\n", "\xe4\xff\n", bomb, "(" * 20000 + "\n",
        "x = " + "1.0 + " * 20000 + "1.0;\n", "if (true) " * 3000 + ";\n", "struct S { S s; };\n", "buffer b_c { float a[4][1000000][1000]; };\n"]) + "".join(lines[at:])


def cut_off(r, text):
    return text[:r.randrange(len(text))]


def change_line_ends(r, text):
    return r.choice(["\ufeff" + text, text.replace("\n", "\r\n"), text.replace("\n", "\r"), text.replace("\n", "\\\n"), text.replace("\n", " "), ""])


def odd_bytes(r, text):
    at = r.randrange(len(text))
    return text[:at] + "".join(chr(r.randrange(256)) for _ in range(r.choice([1, 5, 100]))) + text[at:]


KINDS = [swap_tokens, delete_tokens, copy_lines, delete_lines, change_number, change_number, change_word, change_operator, unbalance, insert_line,
         insert_line, cut_off, change_line_ends, odd_bytes]


def mutant(seed, number, files):
    """The file that is damaged, how, and its new bytes: by one to three mutations."""
    r = random.Random(f"{seed}:{number}")
    path = r.choice(files)
    text, kinds = path.read_text(), []
    for _ in range(r.choice([1, 1, 1, 2, 3])):
        kind = r.choice(KINDS)
        try:
            text = kind(r, text)
        except (ValueError, IndexError):  # too little is left to choose from
            continue
        kinds.append(kind.__name__)
    return path, "+".join(kinds), text.encode(*r.choice([("utf-8", "replace"), ("latin-1", "replace")]))


# --- the program ------------------------------------------------------------------------------------------------------

class Died(Exception):
    pass


class Host:
    """A running program on copies of the shaders, and how far it is."""

    def __init__(self, graph):
        self.holder = tempfile.TemporaryDirectory(prefix="bounce_mutants_")
        self.folder = pathlib.Path(self.holder.name)
        self.root = self.folder / "root"
        shutil.copytree(ROOT / "glsl", self.root / "glsl")
        shutil.copytree(ROOT / "assets/graphs", self.root / "assets/graphs")
        for name in ("scenes", "shots"):
            (self.root / "assets" / name).symlink_to(ROOT / "assets" / name)
        self.shot = self.folder / "tiny.json"
        self.shot.write_text(TINY_SHOT)
        self.environment = dict(os.environ, BOUNCE_ROOT=str(self.root), HOME=str(self.folder), XDG_STATE_HOME=str(self.folder / "state"),
                                XDG_CACHE_HOME=str(self.folder / "cache"))
        self.environment.setdefault("MESA_SHADER_CACHE_DIR", str(self.folder / "shaders"))
        self.graph = graph
        self.log = self.folder / "said"

    def start(self, *arguments):
        with open(self.log, "ab") as log:
            self.process = subprocess.Popen([PROGRAM, *map(str, arguments)], env=self.environment, cwd=self.folder, stdout=log,
                                            stderr=subprocess.STDOUT)

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.holder.cleanup()

    def shaders(self):
        """The files that the graph's programs are made of."""
        out = self.folder / "expanded"
        subprocess.run([PROGRAM, "shaders", "--expand", out], env=self.environment, check=True, stdout=subprocess.DEVNULL)
        stages = {str(path.relative_to(self.root / "glsl")).replace("/", "."): path for path in (self.root / "glsl").rglob("*.*")}
        names = [path.name for path in out.iterdir() if path.name.startswith(self.graph + ".")]
        left = [stages[known] for known in stages for name in names if name.endswith("." + known) and name.count(".") == known.count(".") + 2]
        found = set()
        while left:
            path = left.pop()
            if path in found:
                continue
            found.add(path)
            for name in re.findall(r'^#include "([^"]+)"', path.read_text(), re.MULTILINE):
                left.append(path.parent / name if (path.parent / name).exists() else self.root / "glsl" / name)
        return sorted(found)

    def processor_seconds(self):
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def memory(self):
        return int(pathlib.Path(f"/proc/{self.process.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def wait(self, what):
        """Until `what` gives something; returns it and the processor seconds that the program took."""
        end, start = time.monotonic() + PATIENCE, self.processor_seconds()
        while time.monotonic() < end:
            if self.process.poll() is not None:
                raise Died(f"the program ended with {self.process.returncode}: " + self.log.read_text(errors="replace")[-2000:])
            found = what()
            if found is not None:
                return found, self.processor_seconds() - start
            time.sleep(0.02)
        raise Died(f"no answer within {PATIENCE} s; it took {self.processor_seconds() - start:.1f} s of processor time")


class Headless(Host):
    def open(self):
        self.start("render", self.shot, "--graph", self.graph, "--size", "16x16", "--set", "shadow_maps.resolution=64", "--watch", "--quiet",
                   "--frames", "1000000", "-o", "f_%d.png")
        self.seen = -1
        self.picture = self.next_picture()[0]

    def newest(self):
        return max((int(name[2:-4]) for name in os.listdir(self.folder) if name.startswith("f_") and name.endswith(".png")), default=-1)

    def next_picture(self):
        """A frame that was begun after this call, and what it took."""
        start = max(self.newest(), self.seen)

        def done():
            newest = self.newest()
            if newest < start + 3:
                return None
            self.seen = newest
            data = (self.folder / f"f_{newest}.png").read_bytes()
            for name in os.listdir(self.folder):
                if name.startswith("f_") and int(name[2:-4]) < newest:
                    (self.folder / name).unlink()
            return data
        return self.wait(done)

    def restored(self):
        picture, seconds = self.next_picture()
        end = time.monotonic() + 60
        while picture != self.picture and time.monotonic() < end:
            picture, more = self.next_picture()
            seconds += more
        return picture == self.picture, seconds


class Window(Host):
    def __init__(self, graph):
        super().__init__(graph)
        from window_driver import Display
        self.display = Display()
        self.environment["DISPLAY"] = self.display.name
        self.environment.pop("WAYLAND_DISPLAY", None)
        self.environment.pop("XAUTHORITY", None)

    def close(self):
        super().close()
        self.display.close()

    def state(self):
        path = self.folder / "dump.json"
        return json.loads(path.read_text()) if path.exists() else None

    def open(self):
        self.start("view", self.shot, "--graph", self.graph, "--size", "32x32", "--set", "shadow_maps.resolution=64", "--window", "900x600",
                   "--dump-ui", self.folder / "dump.json")
        # It draws only what changes: a few frames, and then it waits.
        self.wait(lambda: (self.state() or {"rendered": 0})["rendered"] > 0 or None)
        time.sleep(2)
        self.picture = self.pixels()

    def pixels(self):
        x0, y0, x1, y1 = map(round, self.state()["widgets"]["viewport"])
        return self.display.pixels(x0 + 4, y0 + 40, x1 - 4, y1 - 4)

    def next_picture(self):
        """The file is noticed within a fifth of a second, and drawn; an unused file changes nothing."""
        before = self.state()["rendered"]
        asked = time.monotonic()
        _, seconds = self.wait(lambda: True if self.state()["rendered"] > before or time.monotonic() > asked + 3 else None)
        time.sleep(0.3)
        return None, seconds

    def restored(self):
        self.next_picture()
        end = time.monotonic() + 60
        while time.monotonic() < end:
            state, _ = self.wait(self.state)
            if not state["problems"] and self.pixels() == self.picture:
                return True, 0
            time.sleep(0.2)
        return False, 0


def run(host_class, first, count, seed, graph, keep=None, seconds=None):
    """`count` mutants, or those for which there is time in so many seconds. Returns the failures, as texts."""
    end = time.monotonic() + seconds if seconds else None
    done = 0
    failures, kinds, slowest = [], collections.Counter(), (0.0, None)
    host, memory = None, []
    try:
        for number in range(first, first + count):
            if end and time.monotonic() > end:
                break
            done += 1
            if host is None:
                host = host_class(graph)
                files = host.shaders()
                originals = {path: path.read_bytes() for path in files}
                host.open()
            path, how, data = mutant(seed, number, files)
            name = f"mutant {number} ({path.relative_to(host.root)}, {how})"
            try:
                path.write_bytes(data)
                _, seconds = host.next_picture()
                path.write_bytes(originals[path])
                good, more = host.restored()
                seconds = max(seconds, more)
                if not good:
                    failures.append(f"{name}: the picture did not come back")
                if seconds > MAX_SECONDS:
                    failures.append(f"{name}: {seconds:.1f} s")
                slowest = max(slowest, (seconds, name), key=lambda pair: pair[0])
                memory.append(host.memory())
            except Died as problem:
                failures.append(f"{name}: {problem}")
            if failures and failures[-1].startswith(name):
                if keep:
                    (pathlib.Path(keep) / f"{number}_{path.name}").write_bytes(data)
                host.close()
                host = None
            kinds.update(how.split("+"))
    finally:
        if host:
            host.close()
    grown = (memory[-1] - memory[len(memory) // 4]) / 2**20 if memory else 0
    print(f"{host_class.__name__.lower()}: {done} mutants of {graph}, {len(failures)} failures; slowest {slowest[0]:.1f} s of processor time "
          f"({slowest[1]}); memory {grown:+.0f} MiB over the last three quarters", flush=True)
    print("  " + ", ".join(f"{kind} {times}" for kind, times in sorted(kinds.items())))
    for failure in failures:
        print("  " + failure)
    return failures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--headless", type=int, default=0)
    parser.add_argument("--window", type=int, default=0)
    parser.add_argument("--seconds", type=float, help="stop after so long, divided among the two")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--graph", default="lrsm_tuned")
    parser.add_argument("--keep", help="write mutants that fail to this folder")
    a = parser.parse_args()
    failures = []
    hosts = [(host, count) for host, count in ((Headless, a.headless), (Window, a.window)) if count]
    for host, count in hosts:
        failures += run(host, a.first, count, a.seed, a.graph, a.keep, a.seconds and a.seconds / len(hosts))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
