"""Every graph gives the same picture on drivers of another kind: the same bytes, or a difference with its reason.

Without anything set: every graph on one shot, in a few pixels. BOUNCE_DRIVERS=all (`tests/run --driver zink`): also presets, and
every shot whose scene is there.
"""

import concurrent.futures
import json
import os
import pathlib
import resource
import unittest

from drivers import PROGRAM, ROOT, Picture, differences, names, small

ALL = os.environ.get("BOUNCE_DRIVERS") == "all"
SIZE = (24, 24)

# zink's SPIR-V adds the products of dot() from the last to the first, which moves the last bits of dot(), length(),
# normalize() and of products with matrices; all else is the same to the bit (arithmetic_test.py).
LIMIT = 0.001  # root of the mean square difference, as a share of the mean
# What is decided by such bits: at a threshold, a photon or a ray counts on one driver alone. In pictures of so few pixels and
# maps each is a large share; the shares are those of all shots that come with the tree, rounded up.
DECIDED = {
    "ldm_indirect": (0.02, "photons at the limit of what the camera sees"),
    "ldm_indirect_tuned": (0.02, "photons at the limit of what the camera sees"),
    "ldm_environment": (0.02, "photons at the limit of what the camera sees"),
}


def limit_of(graph):
    return DECIDED.get(graph, (LIMIT, ""))[0]


def shots():
    """Those whose scenes come with the tree, all of them."""
    def is_there(name):
        shot = json.loads((ROOT / "assets/shots" / f"{name}.json").read_text())
        scenes = [shot["scene"], *(o["scene"] for o in shot.get("objects", []))]
        return all((ROOT / "assets/scenes" / scene).is_file() for scene in scenes)

    return [name for name in names("shots") if is_there(name)] if ALL else ["cornell"]


def graphs():
    return [name for name in names("graphs") if ALL or not name.startswith("presets/")]


@unittest.skipUnless(pathlib.Path(PROGRAM).is_file(), "BOUNCE_PROGRAM is not set to a built program (ctest does that)")
@unittest.skipIf(os.environ.get("BOUNCE_SANITIZE") == "ON", "the drivers are not ours to sanitize, and the program is elsewhere")
class Drivers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pictures = {}

    @classmethod
    def tearDownClass(cls):
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        print(f"{len(cls.pictures)} pictures took {used.ru_utime + used.ru_stime:.0f} s of processor time")

    def picture(self, driver, shot, graph):
        key = driver, shot, graph
        if key not in self.pictures:
            self.pictures[key] = Picture(driver, shot, graph, SIZE, *small(graph))
        return self.pictures[key]

    def compared(self, other, worst):
        """What is wrong, a line each; `worst`: which difference is too large, by graph."""
        def one(task):
            shot, graph = task
            a, b = self.picture("llvmpipe", shot, graph), self.picture(other, shot, graph)
            self.assertIn(other if other == "zink" else "llvmpipe", b.renderer)
            if a.bytes_of() == b.bytes_of():
                return ""
            part, share = max(differences(a, b).items(), key=lambda item: item[1])
            found.append((share, graph, shot, part))
            return f"{graph} on {shot}: {part} differs by {100 * share:.4f} %" if not share <= worst(graph) else ""

        found = []
        tasks = [(shot, graph) for shot in shots() for graph in graphs()]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count() if ALL else 1) as pool:
            wrong = [line for line in pool.map(one, tasks) if line]
        print(f"{other}: {len(tasks) - len(found)} of {len(tasks)} pictures are the same to the bit")
        for share, graph, shot, part in sorted(found, reverse=True)[:8]:
            print(f"    {100 * share:.4f} % {graph} on {shot}, {part} {DECIDED.get(graph, ('', ''))[1]}")
        return wrong

    def need(self, driver):
        try:
            found = self.picture(driver, "cornell", "direct").renderer
        except RuntimeError as error:
            self.skipTest(f"{driver} does not start here: {error}")
        if driver not in found:
            self.skipTest(f"asked for {driver}, the renderer is '{found}' (the package mesa-vulkan-drivers is needed)")

    def test_another_front_and_back_end(self):
        self.need("llvmpipe")
        self.need("zink")
        wrong = self.compared("zink", limit_of)
        self.assertFalse(wrong, "\n" + "\n".join(wrong))

    def test_another_width_and_order(self):
        self.need("llvmpipe")
        wrong = self.compared("narrow", lambda graph: 0)
        self.assertFalse(wrong, "\n" + "\n".join(wrong))


if __name__ == "__main__":
    unittest.main()
