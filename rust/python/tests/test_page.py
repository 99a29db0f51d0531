"""The examples of the book's page run; the rest of the page is printed from docstrings, which all public functions have."""

import inspect
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from foam_files import store, two_cells, write_field, write_mesh

import msdd

CHECKOUT = Path(__file__).resolve().parents[3]
PAGE = (CHECKOUT / "docs/src/reference/python.md").read_text(encoding="utf-8")


class Page(unittest.TestCase):
    def test_functions(self) -> None:
        for name in dir(msdd):
            if inspect.isfunction(getattr(msdd, name)):
                self.assertGreater(len(inspect.getdoc(getattr(msdd, name)) or ""), 60, name)

    def test_examples(self) -> None:
        blocks = re.findall(r"^```python\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
        self.assertEqual(len(blocks), 5)
        with tempfile.TemporaryDirectory() as folder:
            # What the page finds in the checkout after scripts/run.
            case = Path(folder) / "cases/H"
            write_mesh(case, *two_cells())
            write_field(case / "20/T", np.array([60.0, 80.0]))
            store(case / "postProcessing/msddFoam/summary.json", b'{"final": {"porosity": 0.1}}')
            store(case / "postProcessing/probes/0/T", b"# Probe 0 (0 0 0)\n#  Time\n 0.5 51\n 20 93\n")
            (Path(folder) / "cases/database").symlink_to(CHECKOUT / "cases/database")
            run = subprocess.run(
                [sys.executable, "-c", "\n".join(blocks)], cwd=folder, capture_output=True, text=True, env=os.environ
            )
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("\n20.0 [93.]\n70.0", run.stdout)


class Examples(unittest.TestCase):
    """The scripts in examples/."""

    def run_one(self, name: str, *arguments: str) -> list[list[float]]:
        script = CHECKOUT / "rust/python/examples" / name
        run = subprocess.run([sys.executable, script, *arguments], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return [[float(number) for number in line.split()] for line in run.stdout.splitlines()[1:]]

    def test_conductivity(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            picture = Path(folder) / "curve.svg"
            rows = np.array(self.run_one("conductivity.py", str(picture)))
            self.assertIn("porosity 0.12 at the start", picture.read_text())
        self.assertEqual(rows[[0, -1], 0].tolist(), [-2, 2])
        self.assertTrue((np.diff(rows, axis=0) > 0).all() and (np.diff(rows[:, 1:]) < 0).all())

    def test_box(self) -> None:
        rows = np.array(self.run_one("box.py", "200"))
        self.assertEqual(rows.shape, (6, 7))
        # The model is a mean of many boxes; README of the surrogate: a single one is off by a few percent.
        np.testing.assert_allclose(rows[:, 2::2], rows[:, 1::2], rtol=0.05)
        self.assertTrue((np.diff(rows, axis=0) > 0).all())


if __name__ == "__main__":
    unittest.main()
