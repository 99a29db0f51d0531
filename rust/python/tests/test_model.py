"""Models: answers, arrays of all kinds, and mistakes that end in an exception and never in a crash."""

import copy
import gc
import pickle
import resource
import threading
import unittest
from typing import Any

import numpy as np

import msdd
from msdd import _columns

MATERIAL = msdd.Material(thermal_conductivity=100, young_modulus=1e7, mean_radius=5e-3)
ANSWERS = ("conductivity_xx", "conductivity_yy", "stress_xx", "stress_yy")


class WithModel(unittest.TestCase):
    model: msdd.Model

    @classmethod
    def setUpClass(cls) -> None:
        cls.model = msdd.load_model()

    def state(self, porosity: Any = 0.12, **known: Any) -> dict[str, Any]:
        return self.model.initial_state(MATERIAL, porosity, **known)

    def advance(self, *arguments: Any, **options: Any) -> msdd.Step:
        return self.model.advance(MATERIAL, *arguments, **options)


class Description(WithModel):
    def test_what_a_model_says_of_itself(self) -> None:
        self.assertRegex(self.model.hash, "^[0-9a-f]{64}$")
        self.assertEqual(self.model.info["hash"], self.model.hash)
        self.assertEqual(self.model.state_names[:2], ("porosity", "fabric_index"))
        self.assertEqual(tuple(self.model.info["state"]), self.model.state_names)
        self.assertTrue(self.model.has_tangent)
        self.assertIn("increment", repr(self.model))

    def test_range_is_where_no_input_is_outside(self) -> None:
        low, high = self.model.trained_range["porosity"]
        state = {**self.state(np.full(2, 0.12)), "porosity": np.array([low, high])}
        self.assertFalse(self.advance(state, 0.0).outside.any())
        state["porosity"] += [-0.01, 0.02]
        beyond = self.advance(state, 0.0)
        np.testing.assert_allclose(beyond.distance["porosity"], [-0.01, 0.02], rtol=1e-12)
        self.assertTrue(beyond.outside.all() and beyond.outside.dtype == bool)

    def test_kinds_of_conductivity(self) -> None:
        affine = msdd.load_model(conductivity="affine")
        network = self.advance(self.state(), 0.0)
        self.assertGreater(affine.advance(MATERIAL, self.state(), 0.0).conductivity_xx, network.conductivity_xx)
        self.assertEqual(affine.with_conductivity("network").info, self.model.info)
        with self.assertRaisesRegex(msdd.InvalidArgument, "kind = other.*network, affine"):
            self.model.with_conductivity("other")

    def test_models_that_are_none(self) -> None:
        with self.assertRaisesRegex(msdd.FileError, "/no/such.json"):
            msdd.load_model("/no/such.json")
        with self.assertRaises(msdd.ModelError):
            msdd.load_model(__file__)
        with self.assertRaises(msdd.PluginError) as failure:
            msdd.load_model("plugin:" + __file__)
        self.assertEqual(failure.exception.status, 7)
        for source in (None, 3, b"builtin", msdd.load_model):
            with self.assertRaises(TypeError):
                msdd.load_model(source)
        with self.assertRaises(ValueError):
            msdd.load_model("builtin\0")


class Answers(WithModel):
    def test_hotter_grains_press_and_conduct_more(self) -> None:
        state = self.state()
        cold, hot = self.advance(state, -0.01), self.advance(state, 0.01)
        for name in ANSWERS:
            self.assertGreater(getattr(hot, name), getattr(cold, name))
        self.assertLess(hot.state["porosity"], cold.state["porosity"])

    def test_no_strain_leaves_the_state(self) -> None:
        state = self.state(np.linspace(0.08, 0.16, 9))
        after = self.advance(state, 0.0).state
        for name, column in state.items():
            np.testing.assert_array_equal(after[name], column)

    def test_known_stress_is_the_answer(self) -> None:
        step = self.advance(self.state(0.12, stress=[3000, 2500, 100]), 0.0)
        np.testing.assert_allclose([step.stress_xx, step.stress_yy, step.stress_xy], [3000, 2500, 100], rtol=1e-9)

    def test_known_conductivity_is_the_answer(self) -> None:
        known = {"conductivity_xx": 31.0, "conductivity_yy": 28.0, "conductivity_xy": 0.5}
        given = list(known.values())
        step = self.advance(self.state(0.12, fabric_index=0.02, fabric_xy=0.005, conductivity=given), 0.0)
        for name, value in known.items():
            self.assertAlmostEqual(float(getattr(step, name)), value, delta=1e-3)
        with self.assertRaisesRegex(ValueError, "conductivity is a number, or 3 components"):
            self.state(0.12, conductivity=[31.0])
        with self.assertRaises(AttributeError):
            step.stress_zz

    def test_scales(self) -> None:
        twice = msdd.Material(200, 3e7, 5e-3)
        here, there = self.advance(self.state(), 0.01), self.model.advance(twice, self.state(), 0.01)
        self.assertAlmostEqual(there.conductivity_xx / here.conductivity_xx, 2, places=12)
        self.assertAlmostEqual(there.stress_xx / here.stress_xx, 3, places=12)

    def test_total_strain_is_the_step_unless_given(self) -> None:
        same = self.advance(self.state(), 0.01, total_thermal_strain=0.01)
        none, other = self.advance(self.state(), 0.01), self.advance(self.state(), 0.01, total_thermal_strain=0.03)
        self.assertEqual(none.stress_xx, same.stress_xx)
        # Stress goes with the present radius.
        self.assertAlmostEqual(float(other.stress_xx / none.stress_xx), 1.03 / 1.01, places=12)

    def test_tangent_is_the_slope_of_the_stress(self) -> None:
        state, small = self.state(0.10), 1e-8
        base = np.array([-1e-4, 2e-4, 3e-4])
        tangent = self.advance(state, 0.0, strain=base, tangent=True).tangent
        self.assertEqual(tangent.shape, (3, 3))
        for j, change in enumerate(small * np.eye(3)):
            low, high = (self.advance(state, 0.0, strain=base + sign * change) for sign in (-1, 1))
            for i, answer in enumerate(("stress_xx", "stress_yy", "stress_xy")):
                slope = -float(getattr(high, answer) - getattr(low, answer)) / (2 * small)
                self.assertAlmostEqual(slope, tangent[i, j], delta=1 + 1e-4 * abs(slope))

    def test_shear_and_rotation(self) -> None:
        state = self.state(0.12, stress=[3500, 2500, 200])
        angle = 0.1
        turned = self.advance(state, 0.0, rotation=angle)
        c, s = np.cos(2 * angle), np.sin(2 * angle)
        along, across = c * 500 - s * 200, s * 500 + c * 200
        for found, expected in ((turned.stress_xx, 3000 + along), (turned.stress_yy, 3000 - along), (turned.stress_xy, across)):
            self.assertAlmostEqual(float(found), expected, delta=1)
        sheared = self.advance(state, 0.0, strain=[0, 0, 1e-3])
        self.assertLess(sheared.stress_xy, 199)
        self.assertNotEqual(sheared.conductivity_xy, 0)

    def test_only_what_was_asked_for(self) -> None:
        plain = self.advance(self.state(), 0.01)
        self.assertTrue(all(getattr(plain, name) is None for name in ("tangent", "spread")))
        full = self.advance(self.state(), 0.01, tangent=True, spread=True)
        self.assertTrue(0 < full.spread < 0.1)
        self.assertEqual(plain.conductivity_xx, full.conductivity_xx)
        paper = msdd.load_model("builtin:paper")
        state = paper.initial_state(MATERIAL, 0.12)
        self.assertFalse(paper.has_tangent)
        self.assertTrue(np.isnan(paper.advance(MATERIAL, state, 0.0, spread=True).spread))
        for options in ({"tangent": True}, {"strain": [0.01, 0, 0]}, {"strain": [0, 0, 0.01]}, {"rotation": 0.01}):
            with self.assertRaises(msdd.InvalidArgument):
                paper.advance(MATERIAL, state, 0.0, **options)

    def test_solid_fraction_and_wall_friction(self) -> None:
        fractions = self.model.solid_fraction([[0.1, 0.12, 0.14]])
        self.assertEqual(fractions.shape, (1, 3))
        self.assertTrue((np.diff(fractions) < 0).all() and (fractions > 0.8).all())
        friction = self.model.wall_friction(MATERIAL)
        self.assertTrue(0 < friction.limit < 1 and 0 < friction.slip < MATERIAL.mean_radius)
        with self.assertRaises(msdd.InvalidArgument):
            msdd.load_model("builtin:paper").wall_friction(MATERIAL)


class Arrays(WithModel):
    def test_shapes_broadcast_and_cells_are_independent(self) -> None:
        porosity, strain = np.linspace(0.08, 0.16, 5)[:, None], np.linspace(-0.02, 0.02, 7)
        step = self.advance(self.state(porosity), strain, spread=True, tangent=True)
        names = (*ANSWERS, "conductivity_xy", "stress_xy", "spread", "outside")
        for i, j in np.ndindex(5, 7):
            alone = self.advance(self.state(porosity[i, 0]), strain[j], spread=True, tangent=True)
            for name in names:
                self.assertEqual(getattr(alone, name).shape, ())
                self.assertEqual(getattr(step, name)[i, j], getattr(alone, name), name)
            np.testing.assert_array_equal(step.tangent[:, :, i, j], alone.tangent)
        for shape in ((0,), (3, 0), (2, 3, 4)):
            step = self.advance(self.state(np.full(shape, 0.12)), 0.01)
            self.assertEqual((step.conductivity_xx.shape, step.outside.shape), (shape, shape))

    def test_any_layout_and_type_of_number(self) -> None:
        expected = self.advance(self.state(np.full(4, 0.125)), np.full(4, 0.25)).stress_xx
        packed = np.zeros(4, [("byte", "u1"), ("strain", "f8")])
        packed["strain"] = 0.25
        strains = (
            np.full(8, 0.25)[::2],
            np.full(4, 0.25)[::-1],
            np.full((4, 3), 0.25)[:, 1],
            np.full(4, 0.25, np.float32),
            np.full(4, 0.25, ">f8"),
            np.ma.masked_array(np.full(4, 0.25)),
            packed["strain"],
            [0.25] * 4,
            0.25,
        )
        for strain in strains:
            np.testing.assert_array_equal(self.advance(self.state(np.full(4, 0.125)), strain).stress_xx, expected)
        whole = self.advance(self.state(0.125), np.array([0, 1, 10]))
        np.testing.assert_array_equal(whole.stress_xx, self.advance(self.state(0.125), [0.0, 1.0, 10.0]).stress_xx)

    def test_contiguous_columns_are_not_copied(self) -> None:
        flat, cube = np.linspace(0, 1, 24), np.zeros((2, 3, 4))
        for array in (flat, cube, flat[3:9]):
            _, columns = _columns.aligned({"array": array}, {"none": None})
            self.assertEqual(columns["array"].ctypes.data, array.ctypes.data)
        _, columns = _columns.aligned({"array": flat[::2]}, {"small": 1.0})
        self.assertNotEqual(columns["array"].ctypes.data, flat.ctypes.data)
        self.assertEqual(columns["small"].shape, (12,))

    def test_what_is_given_is_left_as_it_is(self) -> None:
        state = self.state(np.linspace(0.08, 0.16, 5))
        before = copy.deepcopy(state)
        for column in state.values():
            column.flags.writeable = False
        self.advance(state, 0.01)
        for name, column in before.items():
            np.testing.assert_array_equal(state[name], column)

    def test_wrong_arrays(self) -> None:
        state = self.state(np.full(4, 0.12))
        for strain in ("text", b"bytes", None, 1j, [1j], [None], ["0.01"], object(), [[0.1], [0.1, 0.2]], {}, np.array("2020", "M8")):
            with self.assertRaisesRegex(TypeError, "thermal_strain"):
                self.advance(state, strain)
        masked = np.ma.masked_array(np.full(4, 0.01), [0, 1, 0, 0])
        with self.assertRaisesRegex(TypeError, "masked"):
            self.advance(state, masked)
        with self.assertRaisesRegex(ValueError, r"porosity.*\(4,\).*thermal_strain \(3,\)"):
            self.advance(state, np.zeros(3))
        with self.assertRaisesRegex(KeyError, "the state lacks fabric_index"):
            self.advance({"porosity": 0.12}, 0.01)
        for other in (None, 3, np.zeros((5, 4)), [0.1]):
            with self.assertRaisesRegex(TypeError, "state is a dictionary"):
                self.advance(other, 0.01)
        for material in (None, 100, (100, 1e7, 5e-3), {}):
            with self.assertRaises(TypeError):
                self.model.advance(material, state, 0.01)
        with self.assertRaises((TypeError, ValueError)):
            self.model.advance(msdd.Material("a", None, 1), state, 0.01)

    def test_numbers_that_cannot_be(self) -> None:
        state = self.state(np.full(4, 0.12))
        with self.assertRaisesRegex(msdd.NonFinite, r"thermal_strain\[2\]"):
            self.advance(state, [0, 0, np.nan, 0])
        with self.assertRaisesRegex(msdd.NonFinite, r"porosity\[1\]"):
            self.advance({**state, "porosity": [0.1, np.inf, 0.1, 0.1]}, 0)
        for strain in (-1.5, 11):
            with self.assertRaises(msdd.InvalidArgument):
                self.advance(state, strain)
        with self.assertRaisesRegex(msdd.InvalidArgument, r"porosity\[0\] = 2"):
            self.state(2.0)
        with self.assertRaises(ValueError):  # all argument errors are
            self.state(0.12, stress=[1.0])
        with self.assertRaisesRegex(msdd.InvalidArgument, "material.radius"):
            self.model.advance(msdd.Material(100, 1e7, 0), state, 0.01)


class Handles(WithModel):
    def test_a_model_cannot_be_made_copied_or_pickled_by_hand(self) -> None:
        for attempt in (msdd.Model, lambda: copy.deepcopy(self.model), lambda: pickle.dumps(self.model)):
            with self.assertRaises(TypeError):
                attempt()
        with self.assertRaises(AttributeError):
            object.__new__(msdd.Model).hash
        # A shallow copy shares what the library holds, which lives as long as either.
        other = copy.copy(msdd.load_model())
        gc.collect()
        self.assertEqual(other.hash, self.model.hash)

    def test_memory_comes_back(self) -> None:
        def most_memory() -> int:
            return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # kB

        for _ in range(5):
            msdd.load_model()
        before = most_memory()
        for _ in range(200):  # of more than 50 kB each
            msdd.load_model().with_conductivity("affine")
        self.assertLess(most_memory() - before, 5000)

    def test_threads_share_a_model(self) -> None:
        state, strain = self.state(np.linspace(0.08, 0.16, 20000)), 0.01
        expected, found = self.advance(state, strain).stress_xx, []
        threads = [threading.Thread(target=lambda: found.append(self.advance(state, strain).stress_xx)) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(found), 8)
        for answer in found:
            np.testing.assert_array_equal(answer, expected)


if __name__ == "__main__":
    unittest.main()
