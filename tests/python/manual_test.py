"""The manual page and README.md against the package: every name is told of, every example runs."""
import os
import re
import shutil
import tempfile
import textwrap
import unittest

import tetstream

SOURCE = os.environ["TETSTREAM_SOURCE"]
DATA = os.path.join(SOURCE, "tests", "data", "bracket", "bracket.vtu")


def read(*path):
    with open(os.path.join(SOURCE, *path), encoding="utf-8") as file:
        return file.read()


class Manual(unittest.TestCase):
    def setUp(self):
        self.page = read("man", "man3", "tetstream-python.3")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        shutil.copy(DATA, "bracket.vtu")

    def test_every_name_is_told_of(self):
        for name in tetstream.__all__:
            self.assertRegex(self.page, rf"\b{name}\b", name)

    def test_every_example_of_the_page_runs(self):
        examples = self.page.split("\n.Sh EXAMPLES\n")[1].split("\n.Sh ")[0]
        blocks = re.findall(r"\n\.Bd -literal[^\n]*\n(.*?)\n\.Ed", examples, re.DOTALL)
        self.assertGreater(len(blocks), 3)
        for block in blocks:
            with self.subTest(block):
                exec(compile(block.replace("\\e", "\\"), "tetstream-python(3)", "exec"), {})

    def test_every_example_of_the_readme_runs(self):
        blocks = re.findall(r"\n```python\n(.*?)\n```", read("README.md"), re.DOTALL)
        self.assertTrue(blocks)
        for block in blocks:
            exec(compile(textwrap.dedent(block), "README.md", "exec"), {})


if __name__ == "__main__":
    unittest.main()
