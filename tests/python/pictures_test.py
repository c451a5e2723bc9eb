"""With matplotlib: a diagram on its axis, and the example that draws before and after."""
import os
import subprocess
import sys
import tempfile
import unittest

from matplotlib import image, pyplot

import tetstream

SOURCE = os.environ["TETSTREAM_SOURCE"]
BRACKET = os.path.join(SOURCE, "tests", "data", "bracket", "bracket.vtu")
EXAMPLE = os.path.join(SOURCE, "bindings", "python", "examples", "before_after.py")


class Pictures(unittest.TestCase):
    def test_a_diagram_is_drawn_on_an_axis(self):
        drawn = tetstream.diagram(tetstream.Reader.generate("fluid", 20000))
        figure, axes = pyplot.subplots()
        self.assertIs(drawn.plot(axes), axes)
        shown = axes.get_images()[0]
        self.assertEqual(tuple(shown.get_extent()), (0, drawn.cell_count, drawn.vertex_count, 0))
        self.assertIsNot(drawn.plot(), axes)
        with tempfile.TemporaryFile() as file:
            figure.savefig(file, format="png")
        pyplot.close("all")

    def test_the_example_draws_before_and_after(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "bracket.png")
            done = subprocess.run(
                [sys.executable, EXAMPLE, BRACKET, path, "--field", "von_mises", "--ratio", "0.05"],
                stdout=subprocess.PIPE, text=True, check=True)
            self.assertIn("75232 -> 37", done.stdout)
            picture = image.imread(path)
        # Two panels, each with colours of the field beside white and black.
        height, width, _ = picture.shape
        for panel in (picture[:, :width * 45 // 100], picture[:, width // 2:width * 9 // 10]):
            coloured = (panel[..., :3].max(axis=2) - panel[..., :3].min(axis=2) > 0.2).mean()
            self.assertGreater(coloured, 0.1)

    def test_a_field_that_is_not_there_is_named(self):
        done = subprocess.run([sys.executable, EXAMPLE, BRACKET, "x.png", "--field", "nonsense"],
                              stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no field nonsense; there are", done.stderr)


if __name__ == "__main__":
    unittest.main()
