"""Boxes of grains: the library's defaults, averages against sums over the grains, copies, and mistakes."""

import copy
import ctypes as c
import inspect
import json
import pickle
import threading
import unittest

import numpy as np

import msdd
from msdd import _library


class Boxes(unittest.TestCase):
    box: msdd.Rve

    @classmethod
    def setUpClass(cls) -> None:
        cls.box = msdd.pack(100)

    def test_defaults_are_those_of_the_library(self) -> None:
        made = c.c_void_p()
        _library.check(_library.library.msdd_rve_pack(None, c.byref(made)))
        self.assertEqual(msdd.pack().to_json(), msdd.Rve._own(made).to_json())
        # Named one by one, too, they are what the library does without them.
        named = {name: p.default for name, p in inspect.signature(msdd.pack).parameters.items() if p.default is not None}
        for name, value in named.items():
            made = c.c_void_p()
            text = json.dumps({"discs": 60, **({} if name == "discs" else {name: value})})
            _library.check(_library.library.msdd_rve_pack(text.encode(), c.byref(made)))
            self.assertEqual(msdd.pack(60).to_json(), msdd.Rve._own(made).to_json(), name)

    def test_every_argument_counts(self) -> None:
        usual = msdd.pack(60).to_json()
        others = [
            {"seed": 2},
            {"porosity": 0.14},
            {"compression": "horizontal"},
            {"boundary": "periodic"},
            {"radius_min": 4e-3},
            {"radius_max": 8e-3},
            {"relaxation": "fire"},
            {"grains": msdd.Grains(friction_angle=0.3)},
        ]
        for other in others:
            self.assertNotEqual(msdd.pack(60, **other).to_json(), usual, other)
        numbers = msdd.pack(np.int64(60), seed=np.uint8(1), porosity=np.float32(0.125), radius_max=np.float64(7e-3))
        self.assertEqual(numbers.to_json(), msdd.pack(60, porosity=0.125).to_json())

    def test_averages_are_those_of_the_grains(self) -> None:
        average, grains = self.box.average(), self.box.grains()
        self.assertEqual({len(column) for column in grains.values()}, {100})
        self.assertAlmostEqual(average.mean_radius, grains["radius"].mean(), places=12)
        self.assertAlmostEqual(average.pressure, (average.stress_xx + average.stress_yy) / 2)
        self.assertTrue(0.05 < average.porosity < 0.2 and average.conductivity_network_xx < average.conductivity_xx)
        self.assertIsInstance(average.rattlers, int)
        x_min, x_max, y_min, y_max = self.box.bounds()
        self.assertTrue((grains["x"] > x_min).all() and (grains["y"] < y_max).all() and x_max > x_min and y_max > y_min)

    def test_averages_of_a_periodic_box(self) -> None:
        box = msdd.pack(60, boundary="periodic")
        x_min, x_max, y_min, y_max = box.bounds()
        areas = np.pi * (box.grains()["radius"] ** 2).sum()
        share = areas / ((x_max - x_min) * (y_max - y_min))
        self.assertAlmostEqual(box.average().porosity_sum_of_areas, 1 - share, places=12)
        self.assertEqual(len(box.contacts().i), box.average().contacts)

    def test_contacts_overlap(self) -> None:
        walls = msdd.pack(60)
        sheared = msdd.pack(60, boundary="periodic")
        sheared.strain(xy=0.02)
        for box in (walls, sheared):
            contacts, grains = box.contacts(), box.grains()
            self.assertTrue((contacts.overlap > 0).all() and (contacts.overlap < 0.5 * grains["radius"].max()).all())
            # Coulomb: at most the tangent of the friction angle times the normal force, E times the overlap at most.
            self.assertTrue((np.abs(contacts.tangential_force) <= np.tan(0.5) * 1e7 * contacts.overlap).all())
            self.assertEqual({len(column) for column in contacts}, {len(contacts.i)})
        self.assertEqual(set(walls.contacts().i[walls.contacts().i < 0]), {-1, -2, -3, -4})
        self.assertTrue((sheared.contacts().i >= 0).all())

    def test_strains(self) -> None:
        box = self.box.copy()
        before = box.average()
        self.assertEqual(box.strain(thermal=0.01), "settled")
        after = box.average()
        self.assertAlmostEqual(after.mean_radius / before.mean_radius, 1.01, places=12)
        self.assertGreater(after.pressure, before.pressure)
        width = box.bounds()[1] - box.bounds()[0]
        box.strain(xx=-0.01)
        self.assertAlmostEqual((box.bounds()[1] - box.bounds()[0]) / width, 0.99, places=12)
        self.assertEqual(self.box.copy().strain(thermal=-0.1), "unjammed")

    def test_copies_go_their_own_way_and_bit_for_bit(self) -> None:
        text = self.box.to_json()
        others = [self.box.copy(), copy.copy(self.box), copy.deepcopy(self.box), pickle.loads(pickle.dumps(self.box))]
        others.append(msdd.Rve.from_json(text))
        for other in others:
            other.strain(thermal=0.002)
        self.assertEqual(len({other.to_json() for other in others}), 1)
        self.assertEqual(self.box.to_json(), text)
        self.assertIn("100 grains", repr(self.box))

    def test_mistakes(self) -> None:
        for wrong in ({"porosity": 2.0}, {"compression": "other"}, {"radius_min": -1.0}, {"seed": -1}, {"discs": "many"}):
            with self.assertRaises(msdd.InvalidArgument):
                msdd.pack(**{"discs": 60, **wrong})
        for wrong in ({"porosity": object()}, {"grains": {"density": 3000}}, {"radius_min": np.zeros(3)}):
            with self.assertRaises(TypeError):
                msdd.pack(60, **wrong)
        with self.assertRaises(ValueError):
            msdd.pack(60, porosity=float("nan"))
        before = self.box.to_json()
        for wrong in (0.3, float("nan"), float("inf")):
            with self.assertRaises(msdd.InvalidArgument):
                self.box.strain(thermal=wrong)
        with self.assertRaises(msdd.InvalidArgument):
            self.box.strain(xy=0.01)  # not between walls
        for wrong in (None, "much", np.zeros(3), 1j):
            with self.assertRaises((TypeError, ValueError)):
                self.box.strain(thermal=wrong)
        self.assertEqual(self.box.to_json(), before)
        for text in ("", "{}", before[:-20], before.replace("radius", "radios")):
            with self.assertRaises(msdd.MsddError):
                msdd.Rve.from_json(text)
        for wrong in (None, 3, {}):
            with self.assertRaises(TypeError):
                msdd.Rve.from_json(wrong)
        with self.assertRaises(TypeError):
            msdd.Rve()
        with self.assertRaises(AttributeError):
            object.__new__(msdd.Rve).average()

    def test_threads_take_turns(self) -> None:
        box = self.box.copy()
        step = 0.0005

        def heat() -> None:
            box.strain(thermal=step)
            box.average()

        threads = [threading.Thread(target=heat) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        grown = box.average().mean_radius / self.box.average().mean_radius
        self.assertAlmostEqual(grown, (1 + step) ** 8, places=12)


if __name__ == "__main__":
    unittest.main()
