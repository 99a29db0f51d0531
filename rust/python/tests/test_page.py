"""The page of the book names what the package has, with its arguments and their defaults, and its examples run."""

import ast
import inspect
import os
import re
import subprocess
import sys
import tempfile
import unittest
from dataclasses import fields, is_dataclass
from pathlib import Path

import numpy as np
from foam_files import store, two_cells, write_field, write_mesh

import msdd

CHECKOUT = Path(__file__).resolve().parents[3]
PAGE = (CHECKOUT / "docs/src/reference/python.md").read_text(encoding="utf-8")
CHAPTERS = {"Install", "Models", "Law of spheres", "Boxes of grains", "Databases", "Results of cases", "Failures"}


def sections() -> dict[str, str]:
    """The text below each heading of a name."""
    parts = re.split(r"^###? (.+)$", PAGE, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2]))


def first_column(text: str) -> set[str]:
    """Names in backticks that rows of a table begin with."""
    rows = re.findall(r"^\| (`.*?) \|", text, re.MULTILINE)
    return {name for row in rows for name in re.findall(r"`(\w+)`", row)}


def calls(text: str) -> dict[str, str]:
    """Arguments as written of `name(...)` or `object.name(...)`, where a paragraph or list item begins with it."""
    found = re.findall(r"^(?:- )?`(?:\w+\.)?(\w+)\((.*?)\)`", text, re.MULTILINE)
    return {name: arguments for name, arguments in found}


def arguments_of(function: object, drop: int = 0) -> str:
    """Arguments of a function, without their types, as `ast` writes them."""
    parameters = list(inspect.signature(function).parameters.values())[drop:]
    return str(inspect.Signature([p.replace(annotation=p.empty) for p in parameters]))[1:-1]


class Page(unittest.TestCase):
    def same_arguments(self, name: str, written: str, found: str) -> None:
        def plain(arguments: str) -> str:
            return ast.unparse(ast.parse(f"def f({arguments}): pass"))

        self.assertEqual(plain(written), plain(found), name)

    def test_names(self) -> None:
        listed = set(sections()) - CHAPTERS
        listed |= first_column(sections()["Install"]) | first_column(sections()["Failures"])
        self.assertEqual(listed - {"ValueError", "OSError", "RuntimeError"}, set(dir(msdd)))

    def test_functions(self) -> None:
        for name in dir(msdd):
            if inspect.isfunction(getattr(msdd, name)):
                written = calls(sections()[name])
                self.assertEqual(set(written), {name})
                self.same_arguments(name, written[name], arguments_of(getattr(msdd, name)))
                self.assertGreater(len(inspect.getdoc(getattr(msdd, name))), 60)

    def test_fields(self) -> None:
        for name in dir(msdd):
            kind = getattr(msdd, name)
            if is_dataclass(kind):
                self.assertEqual(first_column(sections()[name]), {field.name for field in fields(kind)}, name)
            elif hasattr(kind, "_fields") and name != "WallFriction":
                self.assertEqual(first_column(sections()[name]), set(kind._fields), name)
        for kind in (msdd.Material, msdd.SphereMaterial, msdd.Grains):
            self.same_arguments(kind.__name__, calls(sections()[kind.__name__])[kind.__name__], arguments_of(kind))

    def test_methods_and_attributes(self) -> None:
        for kind in (msdd.Model, msdd.Spheres, msdd.Rve):
            text = sections()[kind.__name__]
            members = {name: value for name, value in vars(kind).items() if not name.startswith("_")}
            methods = {name for name, value in members.items() if not isinstance(value, property)}
            written = {**calls(text), **dict(re.findall(r"`(?:box|Rve)\.(\w+)\((.*?)\)`", text))}
            self.assertEqual(set(written), methods)
            for name, arguments in written.items():
                drop = 0 if isinstance(members[name], staticmethod) else 1
                self.same_arguments(name, arguments, arguments_of(getattr(kind, name), drop))
            # Arguments of methods have tables, too, below those of the attributes.
            head = re.split("`(?:model|spheres)\\.", text)[0]
            attributes = first_column(head) if kind is not msdd.Rve else set()
            self.assertEqual(attributes, set(members) - methods)

    def test_failures(self) -> None:
        for name, bases in re.findall(r"^\| `(\w+)` \| (?:`(\w+)`)? ?\|", sections()["Failures"], re.MULTILINE):
            kind = getattr(msdd, name)
            also = [base.__name__ for base in kind.__bases__ if base is not msdd.MsddError and kind is not msdd.MsddError]
            self.assertEqual(also, [bases] if bases else [], name)

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
