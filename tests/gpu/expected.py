"""Pictures that a machine's are held against: means of each part, over all and over 4 × 4 blocks, and what passes counted.

Rasterizers differ in which pixels an edge covers, and texture units in the bits they filter with; so a part's mean may be
1 % away, and that of a block 5 % of the whole part's. Counts of lists and voxels follow edges too: 2 %. Integer arithmetic
has to be the same to the bit: its hash.
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import tempfile
import time

from drivers import Picture, names, parts, small

FILE = pathlib.Path(__file__).resolve().parent / "expected.json"
SIZE, BLOCKS = 64, 4
MEAN, BLOCK, COUNT = 0.01, 0.05, 0.02
# What rests on a few rays, photons or samples a pixel is decided by last bits in places.
NOISY = {"ldm_indirect": 0.05, "ldm_indirect_tuned": 0.05, "ldm_environment": 0.05}
SHOTS = ("cornell", "atrium")


def graphs():
    """Presets are the same shaders with other numbers."""
    return [name for name in names("graphs") if not name.startswith("presets/")]


def blocks_of(values):
    side = SIZE // BLOCKS
    return [sum(sum(values[(by * side + y) * SIZE + bx * side:(by * side + y) * SIZE + (bx + 1) * side]) for y in range(side))
            / side**2 for by in range(BLOCKS) for bx in range(BLOCKS)]


def figures(shot, graph, timeout):
    """Means by channel, and counts by label."""
    with tempfile.TemporaryDirectory() as folder:
        timings = pathlib.Path(folder) / "t.json"
        picture = Picture(None, shot, graph, (SIZE, SIZE), "--timings", timings, *small(graph), timeout=timeout)
        counters = json.loads(timings.read_text())["counters"]
    means = {name: [round(block, 6) for block in blocks_of(picture.channels[name])]
             for names_of_part in parts(picture).values() for name in names_of_part}
    return {"blocks": means, "counts": {f"{c['id']}: {c['label']}": c["value"] for c in counters}}


def wrong(graph, here, there):
    """What is too far away, a line each. `there`: what was expected."""
    lines = []
    scale = NOISY.get(graph, MEAN) / MEAN
    if here["blocks"].keys() != there["blocks"].keys():
        return [f"other parts: {sorted(here['blocks'])}"]
    for name, blocks in there["blocks"].items():
        mean = sum(blocks) / len(blocks)
        got = sum(here["blocks"][name]) / len(blocks)
        if not abs(got - mean) <= scale * MEAN * abs(mean) + 1e-5:
            lines.append(f"{name}: mean {got:.5g}, expected {mean:.5g}")
        for i, (a, b) in enumerate(zip(here["blocks"][name], blocks)):
            if not abs(a - b) <= scale * BLOCK * abs(mean) + 1e-5:
                lines.append(f"{name}, block {i % BLOCKS}, {i // BLOCKS}: {a:.5g}, expected {b:.5g}")
                break
    for label, count in there["counts"].items():
        got = here["counts"].get(label)
        if got is None or abs(got - count) > COUNT * count + 2:
            lines.append(f"{label}: {got}, expected {count}")
    return lines


def integer_hash():
    """Of words that integer arithmetic made (drivers/arithmetic.py)."""
    import arithmetic
    with tempfile.TemporaryDirectory(prefix="bounce_gpu_") as folder:
        values = arithmetic.values(None, pathlib.Path(folder), arithmetic.INTEGER)
    return hashlib.sha256(b"".join(values[text] for text in arithmetic.INTEGER)).hexdigest()


def all_graphs(shots, graphs, until, report):
    """Calls report(shot, graph, figures, or the error) for each, on several processes: most of the time is compilation."""
    def one(task):
        left = until - time.monotonic()
        if left <= 0:
            return task, None
        try:
            return task, figures(*task, timeout=min(left, 3600))
        except Exception as error:  # a failure of one graph is a line of the report
            return task, error

    with concurrent.futures.ThreadPoolExecutor(min(8, os.cpu_count())) as pool:
        for (shot, graph), found in pool.map(one, [(shot, graph) for shot in shots for graph in graphs]):
            report(shot, graph, found)


def write():
    pictures, failed = {}, []

    def report(shot, graph, found):
        if isinstance(found, dict):
            pictures.setdefault(shot, {})[graph] = found
        else:
            failed.append(f"{graph} on {shot}: {found}")

    all_graphs(SHOTS, graphs(), float("inf"), report)
    if failed:
        raise SystemExit("error: nothing was written:\n" + "\n".join(failed))
    text = json.dumps({"renderer": Picture(None, "cornell", "direct", (8, 8)).renderer, "integer": integer_hash(),
                       "pictures": pictures}, separators=(",", ":"))
    FILE.write_text(text.replace('},"', '},\n"') + "\n")
    print(f"{FILE}: {sum(len(graphs) for graphs in pictures.values())} pictures")
