"""The stages of tests/gpu/run. Each writes a section of the report and has a share of the time; what it had no time for is
said."""

import json
import os
import pathlib
import re
import subprocess
import time

import expected
from drivers import PROGRAM, ROOT

PAPERS = ("lrsm", "vf", "twins", "ldm", "dvs")  # in this order while there is time
# --tiny: the same tables in sizes for software drivers, a column each.
TINY = {"occlusion_voxels.resolution": 32, "rsm.resolution": 64, "voxelization.resolution": 32, "ldm.maps": 4, "ldm.resolution": 16,
        "visibility.marching_size": 16, "vf_proxies.proxies": 2000, "vf_proxies.cells": 4}
ALSO_TINY = {"ldm": ("ldm.maps", "ldm.resolution"), "vf": ("vf_proxies.proxies",), "twins": ("ldm.resolution",)}


class Run:
    def __init__(self, into, tiny, programs, bundled):
        self.into, self.tiny, self.programs, self.bundled = into, tiny, programs, bundled
        self.sections, self.failures, self.left_out, self.spent = [], [], [], {}

    def stage(self, name, stage, until):
        print(f"{name} …", flush=True)
        start = time.monotonic()
        try:
            if until - start < 1:
                self.left_out.append(f"{name}: the time was over")
            else:
                stage(self, until)
        except Exception as error:  # the other stages still have something to say
            self.failures.append(f"{name}: {error}")
        self.spent[name] = time.monotonic() - start

    def command(self, until, *command, **environment):
        """Its result; None when the time was over."""
        settings = {**os.environ, **environment}
        if self.bundled:  # test programs find the bundle's libraries; `bounce` finds them by itself
            settings["LD_LIBRARY_PATH"] = ":".join(filter(None, [str(ROOT / "lib"), settings.get("LD_LIBRARY_PATH")]))
        try:
            return subprocess.run([str(word) for word in command], env=settings, capture_output=True, text=True, cwd=self.into,
                                  timeout=max(0.1, until - time.monotonic()))
        except subprocess.TimeoutExpired:
            return None

    def tests(self, until, program, filter_text="*", **environment):
        """Runs tests of one program; returns their JSON entries, and notes what failed."""
        path = self.programs / f"bounce_test_{program}"
        if not path.is_file():
            self.left_out.append(f"tests of {program}: {path} is not built")
            return []
        report = self.into / f"tests_{program}.json"
        report.unlink(missing_ok=True)
        result = self.command(until, path, f"--gtest_filter={filter_text}", f"--gtest_output=json:{report}", **environment)
        if result is None:
            self.left_out.append(f"tests of {program} ({filter_text}): the time was over")
            return []
        (self.into / f"tests_{program}.log").write_text(result.stdout + result.stderr)
        if not report.is_file():
            self.failures.append(f"tests of {program}: ended with {result.returncode}: {result.stderr.strip()[-300:]}")
            return []
        entries = [test for suite in json.loads(report.read_text())["testsuites"] for test in suite["testsuite"]]
        self.failures += [f"{program}.{test['classname']}.{test['name']}: {test['failures'][0]['failure'].splitlines()[0]}"
                          for test in entries if test.get("failures")]
        return entries

    def section(self, title, text):
        self.sections.append(f"## {title}\n\n{text.strip()}\n")

    def write_report(self, name):
        head = f"# {name}\n\nWritten by `tests/gpu/run {name}{' --tiny' if self.tiny else ''}`"
        head += f", {time.strftime('%Y-%m-%d', time.gmtime())}, in {sum(self.spent.values()):.0f} s.\n"
        if self.tiny:
            head += "\nIn tiny sizes: the times say nothing of any GPU.\n"
        ends = ["", "## Failures", "", *(f"- {line}" for line in self.failures or ["none"]),
                "", "## Left out", "", *(f"- {line}" for line in self.left_out or ["nothing"])]
        (self.into / "report.md").write_text("\n".join([head, *self.sections, *ends]) + "\n")


def capabilities(run, until):
    result = run.command(until, PROGRAM, "-v", "render", "cornell", "--graph", "direct", "--size", "16x16", "-o", "x.png")
    if result is None or result.returncode != 0:
        raise RuntimeError(result.stderr.strip()[-500:] if result else "the first picture took all of its time")
    lines = [re.sub(r"^\[.*?\] (\[\w+\] )?", "", line) for line in result.stderr.splitlines()]
    told = [line for line in lines if re.match(r"(renderer|OpenGL|missing|absent):", line)]
    devices = run.command(until, PROGRAM, "--list-devices")
    run.section("Driver", "```\n" + "\n".join(told) + f"\n{devices.stdout if devices else ''}```")


def unit_tests(run, until):
    wanted = {"gpu": "*-Copies.*", "voxel": "*", "ldm": "*-*ManyInsertAtOnce", "image": "*Hazards*"}
    if run.tiny:
        wanted = {"gpu": "Objects.*", "voxel": "*Bits*", "ldm": "*Directions*", "image": "*Hazards*direct*"}
    rows = ["| tests of | passed | skipped |", "| --- | ---: | ---: |"]
    for program, filter_text in wanted.items():
        entries = run.tests(until, program, filter_text)
        skipped = sum(test["result"] == "SKIPPED" for test in entries)
        passed = sum(not test.get("failures") for test in entries) - skipped
        rows.append(f"| {program} ({filter_text}) | {passed} | {skipped} |")
    run.section("Tests", "\n".join(rows))


def contention(run, until):
    inserts = 20000 if run.tiny else 10_000_000
    entries = run.tests(until, "ldm", "*ManyInsertAtOnce", BOUNCE_INSERTS=str(inserts))
    if entries:
        run.section("Contended lists", f"{inserts} inserts, three times, compared with the lists that a CPU makes: "
                    + ("as they should be" if not entries[0].get("failures") else "**different**"))


def copies(run, until):
    entries = run.tests(until, "gpu", "Copies.*", BOUNCE_COPY_MIB=str(4 if run.tiny else 1024))
    for test in entries:
        run.section("Copy", f"A copy between buffers reads and writes {float(test['read_and_written_gb_per_s']):.1f} GB/s in all, which "
                            "the tables' GB/s are to be held against.")


def pictures(run, until):
    if not expected.FILE.is_file():
        raise RuntimeError(f"{expected.FILE} is not there: --write-expected writes it")
    known = json.loads(expected.FILE.read_text())
    right, rows, late = 0, [], []
    if expected.integer_hash() != known["integer"]:
        run.failures.append("integer arithmetic differs from that of the machine that the pictures are from")

    def report(shot, graph, found):
        nonlocal right
        if found is None or isinstance(found, subprocess.TimeoutExpired):
            late.append(f"{graph} on {shot}")
        elif not isinstance(found, dict):
            run.failures.append(f"{graph} on {shot}: {str(found)[-300:]}")
        elif graph not in known["pictures"].get(shot, {}):
            run.failures.append(f"{graph} on {shot}: nothing is expected of it: --write-expected writes it")
        else:
            lines = expected.wrong(graph, found, known["pictures"][shot][graph])
            right += not lines
            rows.extend(f"- {graph} on {shot}: {line}" for line in lines)
            if lines:
                run.failures.append(f"{graph} on {shot}: {lines[0]}" + (f", and {len(lines) - 1} more" if lines[1:] else ""))

    expected.all_graphs(expected.SHOTS[:1] if run.tiny else expected.SHOTS, expected.graphs(), until, report)
    if late:
        run.left_out.append(f"{len(late)} pictures: {', '.join(late)}")
    run.section("Pictures", f"{right} pictures of {expected.SIZE}² are those of {known['renderer']}: integers to the bit, means to "
                f"{100 * expected.MEAN:g} %, means of {expected.BLOCKS}² blocks to {100 * expected.BLOCK:g} % of the whole, counts to "
                f"{100 * expected.COUNT:g} %.\n" + "\n".join(rows))


def is_there(column):
    shot = json.loads((ROOT / "assets/shots" / f"{column['shot']}.json").read_text())
    folders = [ROOT / "assets/scenes", ROOT.parent / "shared/scenes", *map(pathlib.Path, os.environ.get("BOUNCE_SCENES", "").split(":"))]
    return all(any((folder / scene).is_file() for folder in folders)
               for scene in (shot["scene"], *(o["scene"] for o in shot.get("objects", []))))


def table_here(run, name):
    """The table without errors (their reference takes minutes), and without columns whose scenes are not there."""
    table = json.loads((ROOT / "assets/tables" / f"{name}.json").read_text())
    table.pop("errors", None)
    if run.tiny:
        column = table["columns"][0]
        settings = {key: TINY.get(key, value) for key, value in column.get("set", {}).items()}
        settings.update((key, TINY[key]) for key in ALSO_TINY.get(name, ()))
        return {**table, "columns": [{**column, "shot": "cornell", "size": [32, 32], "set": settings}]}
    absent = [column["name"] for column in table["columns"] if not is_there(column)]
    if absent:
        run.left_out.append(f"table {name}: {'; '.join(absent)}: their scenes are not there (BOUNCE_SCENES)")
    return {**table, "columns": [column for column in table["columns"] if is_there(column)]}


def tables(run, until):
    for i, name in enumerate(PAPERS):
        left = until - time.monotonic()
        if left < 2:
            run.left_out.append(f"tables {', '.join(PAPERS[i:])}: the time was over")
            return
        share = left / (len(PAPERS) - i)
        table = table_here(run, name)
        if not table["columns"]:
            continue
        path = run.into / f"table_{name}.json"  # not NAME.json, which would be taken for the graph of that name
        path.write_text(json.dumps(table, indent=1))
        frames = 1 if run.tiny else 9
        result = run.command(min(until, time.monotonic() + 2 * share), PROGRAM, "table", path, "--seconds", max(1, int(share)),
                             "--warmup", 1 if run.tiny else 3, "--frames", frames)
        if result is None:
            run.left_out.append(f"table {name}: a column took longer than {2 * share:.0f} s")
        elif result.returncode != 0:
            run.failures.append(f"table {name}: {result.stderr.strip()[-300:]}")
        else:
            run.section(f"Table {name}", result.stdout)
            run.left_out += re.findall(r"^Left out after .*$", result.stdout, re.MULTILINE)


# Name, share of the time, and what it does.
STAGES = [("driver", 0.04, capabilities), ("copy", 0.04, copies), ("contended lists", 0.06, contention), ("tests", 0.2, unit_tests),
          ("pictures", 0.28, pictures), ("tables", 0.36, tables)]
