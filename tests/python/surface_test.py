"""With meshio and matplotlib: the example that reads with the one and draws with the other."""
import os
import subprocess
import sys
import tempfile
import unittest

import meshio
from matplotlib import image

SOURCE = os.environ["TETSTREAM_SOURCE"]
BRACKET = os.path.join(SOURCE, "tests", "data", "bracket", "bracket.vtu")
EXAMPLE = os.path.join(SOURCE, "bindings", "python", "examples", "meshio_surface.py")


class Surface(unittest.TestCase):
    def test_the_surface_is_drawn_before_and_after_and_what_changed(self):
        with tempfile.TemporaryDirectory() as folder:
            path, small = os.path.join(folder, "bracket.png"), os.path.join(folder, "small.vtk")
            done = subprocess.run(
                [sys.executable, EXAMPLE, BRACKET, path, "--field", "von_mises", "--ratio", "0.05",
                 "--out", small], stdout=subprocess.PIPE, text=True, check=True)
            self.assertIn("75232 -> 37", done.stdout)
            picture = image.imread(path)[..., :3]
            cells = sum(len(block) for block in meshio.read(small).cells)
        self.assertAlmostEqual(cells, 0.05 * 75232, delta=10)
        # Two panels show the bracket, bluish, and its yellow places; the third is pale, with red ones.
        width = picture.shape[1]
        panels = [picture[:, width * first // 100:width * last // 100]
                  for first, last in ((1, 28), (30, 57), (66, 94))]
        for panel in panels[:2]:
            self.assertGreater((panel[..., 2] > panel[..., 0] + 0.1).mean(), 0.1)
            yellow = (panel[..., 0] > 0.7) & (panel[..., 1] > 0.6) & (panel[..., 2] < 0.3)
            self.assertGreater(yellow.mean(), 0.001)
        red = panels[2][..., 0] > panels[2][..., 1] + 0.4
        self.assertTrue(0.001 < red.mean() < 0.1)

    def test_a_field_that_is_not_there_is_named(self):
        done = subprocess.run([sys.executable, EXAMPLE, BRACKET, "x.png", "--field", "nonsense"],
                              stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no field nonsense", done.stderr)


if __name__ == "__main__":
    unittest.main()
