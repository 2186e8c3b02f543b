"""What arithmetic the drivers agree on to the bit, so that a difference of pictures has few possible reasons."""

import pathlib
import tempfile
import unittest

import arithmetic
from drivers import PROGRAM, Picture


@unittest.skipUnless(pathlib.Path(PROGRAM).is_file(), "BOUNCE_PROGRAM is not set to a built program (ctest does that)")
class Arithmetic(unittest.TestCase):
    def values(self, driver):
        try:
            renderer = Picture(driver, "cornell", "direct", (8, 8)).renderer
        except RuntimeError as error:
            self.skipTest(f"{driver} does not start here: {error}")
        if driver == "zink" and "zink" not in renderer:
            self.skipTest("zink is not there (package mesa-vulkan-drivers)")
        with tempfile.TemporaryDirectory(prefix="bounce_driver_") as folder:
            return arithmetic.values(driver, pathlib.Path(folder), arithmetic.EXPRESSIONS)

    def different(self, driver):
        a, b = self.values("llvmpipe"), self.values(driver)
        self.assertGreater(len(set(a.values())), len(arithmetic.EXPRESSIONS) - 3)  # it has computed them
        return {text for text in arithmetic.EXPRESSIONS if a[text] != b[text]}

    def test_vectors_of_another_width(self):
        self.assertEqual(self.different("narrow"), set())

    def test_another_front_end(self):
        different = self.different("zink")
        self.assertLessEqual(different, set(arithmetic.SUMS))
        print(f"    in the last bits: {', '.join(sorted(different))}")


if __name__ == "__main__":
    unittest.main()
