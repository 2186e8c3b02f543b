"""bounce reference: its files, its cache, interruption, and what a bad request or a full disk leaves."""

import json
import pathlib
import re
import shutil
import signal
import time
import unittest

from program import ProgramTest, exr_header

PARTS = ["direct", "emitted", "environment", "indirect_diffuse", "indirect_specular", "emission", "radiance"]


class ReferenceTest(ProgramTest):
    def environment(self):
        (self.folder / "tmp").mkdir(exist_ok=True)
        return dict(super().environment(), XDG_CACHE_HOME=str(self.folder / "cache"), TMPDIR=str(self.folder / "tmp"))

    def reference(self, output, *arguments, **options):
        return self.run_program("reference", self.shot, *arguments, "-o", output, **options)

    def metadata(self, name):
        return json.loads(exr_header(self.out / name)[1]["bounce"])


class Files(ReferenceTest):
    def test_every_part_is_a_layer_with_its_noise(self):
        self.assert_good(self.reference("x.exr", "--bounces", "1", "--spp", "4"))
        channels, _ = exr_header(self.out / "x.exr")
        for part in PARTS:
            self.assertIn(f"out.{part}.R", channels)
        for channel in ("out.ambient_occlusion.Y", "out.ambient_occlusion_dmax.Y", "irradiance.indirect.G"):
            self.assertIn(channel, channels)
        metadata = self.metadata("x.exr")
        self.assertEqual((metadata["samples"], metadata["bounces"], metadata["complete"]), (4, 1, True))
        self.assertGreater(metadata["noise"]["out.indirect_diffuse"]["relative_off_edges"], 0)
        self.assertEqual(metadata["noise"]["out.emission"]["rms"], 0)

    def test_one_part_alone(self):
        self.assert_good(self.reference("x.exr", "--spp", "2", "--resource", "out.indirect_diffuse"))
        self.assertEqual(sorted(exr_header(self.out / "x.exr")[0]), ["B", "G", "R"])

    def test_a_png_looks_as_the_graphs_pictures_do(self):
        self.assert_good(self.reference("truth.png", "--spp", "32", "--bounces", "0"))
        self.assert_good(self.run_program("render", self.shot, "--graph", "direct", "-o", "image.png"))
        figures = json.loads(self.run_program("compare", "image.png", "truth.png", "--json").stdout)["parts"][""]
        # Display values: edges count here, of which one picture has samples and the other centres.
        self.assertLess(abs(figures["bias"]), 0.02)
        self.assertGreater(figures["ssim"], 0.9)

    def test_the_number_of_threads_does_not_show(self):
        for threads in (1, 2, 3):
            self.assert_good(self.reference(f"{threads}.exr", "--spp", "6", "--no-cache", "--threads", threads))
        self.assertEqual((self.out / "1.exr").read_bytes(), (self.out / "2.exr").read_bytes())
        self.assertEqual((self.out / "1.exr").read_bytes(), (self.out / "3.exr").read_bytes())
        self.assertFalse((self.folder / "cache").exists(), "--no-cache leaves nothing behind")

    def test_noise_goal_and_cache(self):
        first = self.reference("a.exr", "--noise", "0.2")
        self.assert_good(first)
        self.assertLessEqual(self.metadata("a.exr")["noise"]["out.radiance"]["relative_off_edges"], 0.2)
        again = self.reference("b.exr", "--noise", "0.2")
        self.assertIn("(from the cache)", again.stdout)
        self.assertEqual((self.out / "a.exr").read_bytes(), (self.out / "b.exr").read_bytes())


class Interruption(ReferenceTest):
    def interrupted(self, *arguments):
        process = self.start_program("reference", self.shot, "--spp", "1000000", *arguments, "-o", "x.exr")
        time.sleep(2)
        self.assertIsNone(process.poll(), "it is at work")
        process.send_signal(signal.SIGINT)
        code = process.wait(timeout=60)
        return code, (self.folder / "said").read_text()

    def test_what_is_done_is_written_and_goes_on(self):
        code, said = self.interrupted()
        self.assertEqual(code, 130, said)
        self.assertIn("the same command goes on from here", said)
        metadata = self.metadata("x.exr")
        self.assertFalse(metadata["complete"])
        self.assertGreaterEqual(metadata["samples"], 1)
        goal = 2 * metadata["samples"]
        finished = self.reference("y.exr", "--spp", goal)
        self.assert_good(finished)
        self.assertIn(f"resumed from {metadata['samples']} samples", finished.stdout)
        self.assert_good(self.reference("z.exr", "--spp", goal, "--no-cache"))
        self.assertEqual((self.out / "y.exr").read_bytes(), (self.out / "z.exr").read_bytes())

    def test_without_a_cache_the_picture_is_still_written(self):
        code, said = self.interrupted("--no-cache")
        self.assertEqual(code, 130, said)
        self.assertIn("nothing was kept", said)
        self.assertGreaterEqual(self.metadata("x.exr")["samples"], 1)


class Refusals(ReferenceTest):
    def refused(self, *arguments, words, output="x.exr", leaves=()):
        self.assert_refused(self.reference(output, *arguments), *words, leaves=leaves)

    def test_requests_that_cannot_be(self):
        self.refused("--bounces", "-1", words=["--bounces", "unlimited"])
        self.refused("--bounces", "many", words=["invalid --bounces 'many'", "unlimited"])
        self.refused("--spp", "1", words=["--spp"])
        self.refused("--noise", "0", words=["--noise"])
        self.refused("--spp", "4", "--noise", "0.1", words=["--spp", "--noise"])
        self.refused("--resource", "out.indirect_difuse", words=["did you mean 'out.indirect_diffuse'"])
        self.refused("--size", "0x8", words=["0x8"])
        self.refused(words=["x.jpg", ".exr or .png"], output="x.jpg")
        self.refused(words=["none"], output="none/x.exr")
        self.assert_refused(self.run_program("reference", "cornel", "-o", "x.exr"), "did you mean 'cornell'?")

    def test_a_full_disk_costs_nothing_that_was_computed(self):
        if not pathlib.Path("/dev/full").exists():
            self.skipTest("there is no /dev/full")
        (self.out / "full.exr").symlink_to("/dev/full")
        self.refused("--spp", "8", words=["full.exr", "No space left", "goes on"], output="full.exr", leaves=["full.exr"])
        after = self.reference("x.exr", "--spp", "8")
        self.assertIn("(from the cache)", after.stdout)
        # Without the cache the picture itself takes refuge.
        result = self.reference("full.exr", "--spp", "8", "--no-cache")
        self.assertEqual(result.returncode, 2)
        refuge = pathlib.Path(re.search(r"saved in '([^']+)'", result.stderr).group(1))
        self.assertEqual(refuge.parent.parent, self.folder / "tmp")
        self.assertEqual(refuge.parent.stat().st_mode & 0o077, 0, "nobody else may put a link there")
        shutil.copy(refuge, self.out / "saved.exr")
        same = json.loads(self.run_program("compare", "saved.exr", "x.exr", "--json").stdout)
        self.assertEqual(same["parts"]["out.radiance"]["rmse"], 0)

    def test_a_cache_that_cannot_be_written_costs_no_picture(self):
        (self.folder / "cache").write_text("a file where the folder should be")
        result = self.reference("x.exr", "--spp", "4")
        self.assert_good(result)
        self.assertIn("warning: the samples could not be kept", result.stderr)
        self.assertEqual(self.metadata("x.exr")["samples"], 4)


if __name__ == "__main__":
    unittest.main()
