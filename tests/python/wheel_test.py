"""pip makes a wheel of the checkout, and what it installs works; the installed tree does, too."""
import os
import subprocess
import sys
import tempfile
import unittest
import zipfile

SOURCE, BUILD = os.environ["TETSTREAM_SOURCE"], os.environ["TETSTREAM_BUILD"]
PROGRAM = ("import os, tetstream\n"
           "assert os.path.dirname(tetstream.__file__).startswith({!r}), tetstream.__file__\n"
           "mesh = tetstream.read(tetstream.Reader.generate('ball', 2000))\n"
           "assert len(mesh.simplify(ratio=0.1).cells) <= 0.1 * len(mesh.cells)\n")


class Installed(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="with blanks ")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def run_quietly(self, *words, **more):
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False, **more)
        self.assertEqual(done.returncode, 0, done.stdout)

    def works(self, folder):
        self.run_quietly(sys.executable, "-c", PROGRAM.format(folder), cwd=self.folder,
                         env={**os.environ, "PYTHONPATH": folder})

    def test_by_pip(self):
        target = os.path.join(self.folder, "packages")
        self.run_quietly(sys.executable, "-m", "pip", "install", "--no-build-isolation",
                         "--no-index", "--no-deps", "--target", target, "--config-settings",
                         f"build-dir={BUILD}", SOURCE)
        self.works(target)
        self.assertIn("METADATA", " ".join(
            name for _, _, names in os.walk(target) for name in names))

    def test_a_wheel_is_the_same_each_time(self):
        sys.path.insert(0, os.path.join(SOURCE, "bindings", "python"))
        import build_wheel
        wheels = []
        for name in ("a", "b"):
            os.mkdir(os.path.join(self.folder, name))
            path = os.path.join(self.folder, name, build_wheel.build_wheel(
                os.path.join(self.folder, name), {"build-dir": BUILD}))
            with zipfile.ZipFile(path) as wheel:
                self.assertIn("tetstream/py.typed", wheel.namelist())
                wheels.append({entry: wheel.read(entry) for entry in wheel.namelist()})
        self.assertEqual(*wheels)

    def test_by_cmake(self):
        self.run_quietly("cmake", "--install", BUILD, "--component", "python", "--prefix",
                         self.folder)
        found = [folder for folder, _, names in os.walk(self.folder) if "__init__.pyi" in names]
        self.assertEqual(len(found), 1)
        self.works(os.path.dirname(found[0]))


if __name__ == "__main__":
    unittest.main()
