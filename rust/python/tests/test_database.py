"""Databases: made, stopped and gone on with, exported, opened as a data frame."""

import csv as csv_module
import gzip
import os
import signal
import sys
import tempfile
import threading
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import msdd

PLAN = """
radius_min = 3e-3
radius_max = 7e-3
seed = 1

[[thermal]]
discs = 60
porosities = [0.12, 0.14]
compressions = ["isotropic"]
repeats = 2
stops = [0.005]
"""


class Databases(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.plan, self.database = self.folder / "plan.toml", self.folder / "boxes.msdd"
        self.plan.write_text(PLAN)

    def test_trained(self) -> None:
        msdd.generate_database(self.plan, self.database)
        csv, out = self.folder / "boxes.csv", self.folder / "model.json"
        msdd.export_database(self.database, csv)
        model = msdd.train(self.database, out, model="constant", name="mine")
        self.assertEqual(model.info["name"], "mine")
        text = out.read_bytes()
        self.assertEqual(msdd.train([csv], out, model="constant", name="mine", threads=2).hash, model.hash)
        self.assertEqual(out.read_bytes(), text)
        # What is refused leaves the file as it was.
        for database, options, message in (
            ([], {}, "database = \\[\\], allowed"),
            (self.folder / "none.csv", {}, "none.csv"),
            (csv, {"model": "none"}, "model = none, allowed: constant, paper, increment, spheres"),
            (csv, {"epochs": 0}, "max_epochs = 0, allowed: 1 to 100000"),
            (csv, {"fix": {"lode": 0.1}}, "fix: lode = 0.1 with model increment"),
        ):
            with self.assertRaisesRegex(msdd.MsddError, message):
                msdd.train(database, out, **options)
        self.assertEqual(out.read_bytes(), text)
        self.assertEqual(list(self.folder.glob("*.part")), [])

    def test_made_and_opened(self) -> None:
        heard: list[tuple[int, int, int]] = []
        msdd.generate_database(self.plan, self.database, threads=2, progress=lambda *state: heard.append(state))
        self.assertEqual(heard[-1], (4, 4, 0))
        frame = msdd.read_database(self.database)
        csv = self.folder / "boxes.csv.gz"
        self.assertEqual(msdd.export_database(self.database, csv), len(frame))
        self.assertTrue(msdd.read_database(str(csv)).equals(frame))
        with gzip.open(csv, "rt") as file:
            rows = list(csv_module.DictReader(file))
        self.assertEqual(list(frame.columns), list(rows[0]))
        # To the last bit, which pandas does not do by itself.
        for name in ("porosity", "pressure", "conductivity_network_xx"):
            self.assertEqual(list(frame[name]), [float(row[name]) for row in rows])
        self.assertEqual(set(frame.attrs["units"]), set(frame.columns))
        self.assertEqual(frame.attrs["units"]["pressure"], "Pa")
        self.assertIn("plan", frame.attrs["provenance"])
        # One row is the box that msdd.pack makes.
        row = frame[frame.ramp == "packed"].iloc[0]
        box = msdd.pack(int(row.discs), seed=int(row.seed), porosity=row.target_porosity).average()
        np.testing.assert_allclose([row.porosity, row.pressure], [box.porosity, box.pressure], rtol=1e-12)

    def test_stopped_and_gone_on_with(self) -> None:
        def stop(done: int, total: int, failed: int) -> None:
            if done == 2:
                raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            msdd.generate_database(self.plan, self.database, progress=stop)
        heard: list[int] = []
        msdd.generate_database(self.plan, self.database, progress=lambda done, *_: heard.append(done))
        self.assertGreaterEqual(heard[0], 2)
        self.assertEqual(heard[-1], 4)

    def test_interrupted_by_the_keyboard(self) -> None:
        self.plan.write_text(PLAN.replace("repeats = 2", "repeats = 1000"))  # a minute or so
        # A shell starts what runs in the background with interrupts ignored; Python then leaves them so.
        self.addCleanup(signal.signal, signal.SIGINT, signal.getsignal(signal.SIGINT))
        signal.signal(signal.SIGINT, signal.default_int_handler)
        threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            msdd.generate_database(self.plan, self.database)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)

        class Enough(Exception):
            pass

        def enough(done: int, total: int, failed: int) -> None:
            raise Enough(done, total)

        with self.assertRaises(Enough) as stopped:
            msdd.generate_database(self.plan, self.database, progress=enough)
        self.assertLess(*stopped.exception.args)

    def test_mistakes(self) -> None:
        with self.assertRaises(FileNotFoundError):
            msdd.generate_database("/no/such.toml", self.database)
        self.plan.write_text("radius_min = 'small'")
        with self.assertRaisesRegex(msdd.MsddError, "radius_min"):
            msdd.generate_database(self.plan, self.database)
        for threads in (0, -1, 2**32 + 1, 1.5, "two"):
            with self.assertRaisesRegex(ValueError, "threads"):
                msdd.generate_database(self.plan, self.database, threads=threads)
        with self.assertRaises(msdd.MsddError):
            msdd.read_database("/no/such.msdd")
        with self.assertRaises(msdd.MsddError):
            msdd.read_database(__file__)
        with self.assertRaises(TypeError):
            msdd.export_database(None, "out.csv")
        with self.assertRaises(OSError):
            msdd.read_database("/no/such.csv")

    def test_without_pandas(self) -> None:
        with mock.patch.dict(sys.modules, {"pandas": None}):
            with self.assertRaisesRegex(ImportError, "needs pandas"):
                msdd.read_database(self.database)


if __name__ == "__main__":
    unittest.main()
