"""The model of spheres: answers, arrays of all kinds, and mistakes that end in an exception and never in a crash."""

import dataclasses
import unittest
from typing import Any

import numpy as np

import msdd

STEEL = msdd.SphereMaterial(
    diameter=6e-3, young_modulus=2e11, poisson_ratio=0.3, conductivity=40, roughness=3e-7, hardness=3e9, gas="air"
)


class WithLaw(unittest.TestCase):
    law: msdd.Model

    @classmethod
    def setUpClass(cls) -> None:
        cls.law = msdd.load_model("builtin:spheres")

    def state(self, porosity: Any = 0.4, stress: Any = 1e4) -> dict[str, Any]:
        return self.law.initial_state(STEEL, porosity, stress=stress)


class Answers(WithLaw):
    def test_what_the_law_says_of_itself(self) -> None:
        self.assertRegex(self.law.hash, "^[0-9a-f]{64}$")
        self.assertIn(self.law.hash[:12], repr(self.law))
        self.assertEqual(set(self.state()), set(self.law.state_names))
        self.assertIn("law", self.law.info)

    def test_the_start_has_the_stress_and_the_solid_fraction_that_were_given(self) -> None:
        stress = [2e4, 1.8e4, 2.2e4, 1e3, -5e2, 0]
        step = self.law.advance(STEEL, self.state(np.array([0.42, 0.38]), stress))
        np.testing.assert_allclose(step.stress, np.transpose([stress, stress]), rtol=1e-6, atol=1e-6)
        np.testing.assert_allclose(step.solid_fraction, [0.58, 0.62], rtol=1e-9)
        np.testing.assert_array_equal(step.stress_xz, step.stress[4])
        self.assertTrue((step.gas_conductivity > 0).all() and (step.conductivity[:3] > step.gas_conductivity).all())

    def test_more_contacts_conduct_better_and_fabric_bears_a_deviator(self) -> None:
        stress = [1e4, 1e4, 1.4e4, 0, 0, 0]
        few, many = self.law.initial_state(STEEL, 0.4, stress=1e4, coordination=[4.5, 5.5])["coordination"]
        self.assertEqual((few, many), (4.5, 5.5))
        step = self.law.advance(STEEL, self.law.initial_state(STEEL, 0.4, stress=1e4, coordination=[4.5, 5.5]))
        self.assertGreater(step.conductivity[0, 1], 1.05 * step.conductivity[0, 0])
        fabric = [0.3, 0.3, 0.4, 0, 0, 0]
        known = self.law.initial_state(STEEL, 0.4, stress=stress, fabric=fabric)
        even = self.law.initial_state(STEEL, 0.4, stress=stress, fabric=[1 / 3] * 3 + [0] * 3)
        kept = [self.law.advance(STEEL, state, 1e-3).stress for state in (known, even)]
        ratios = [(each[2] - each[0]) / each[0] for each in kept]
        self.assertGreater(ratios[0], 1.5 * ratios[1])
        with self.assertRaisesRegex(msdd.InvalidArgument, r"coordination\[0\] = 13"):
            self.law.initial_state(STEEL, 0.4, stress=1e4, coordination=13)
        with self.assertRaisesRegex(ValueError, "fabric is 6 components"):
            self.law.initial_state(STEEL, 0.4, stress=1e4, fabric=0.3)

    def test_growth_is_the_strain_of_a_smaller_cell(self) -> None:
        grown = self.law.advance(STEEL, self.state(), 1e-3)
        pressed = self.law.advance(STEEL, self.state(), strain=[1 / 1.001 - 1] * 3 + [0] * 3)
        # The parts of a large step compose to it to the second order.
        np.testing.assert_allclose(grown.stress, pressed.stress, rtol=1e-6)
        self.assertGreater(grown.stress[0], 1e4)

    def test_less_mobilised_friction_is_stiffer(self) -> None:
        def pressed(**known: float) -> float:
            state = self.law.initial_state(STEEL, 0.4, stress=2e4, **known)
            return float(self.law.advance(STEEL, state, strain=[0, 0, -1e-4, 0, 0, 0]).stress[2])

        self.assertEqual(pressed(mobilised=0.85), pressed())
        self.assertGreater(pressed(mobilised=0.5), 1.05 * pressed(mobilised=1))
        self.assertEqual(float(self.law.initial_state(STEEL, 0.4, stress=2e4, mobilised=0.5)["mobilised"]), 0.5)
        with self.assertRaisesRegex(msdd.InvalidArgument, "mobilised"):
            pressed(mobilised=1.5)

    def test_the_tangent_is_the_derivative(self) -> None:
        state, strain, step = self.state(), np.array([-1e-4, 0, 0, 5e-5, 0, 0]), 1e-8
        tangent = self.law.advance(STEEL, state, strain=strain, tangent=True).tangent
        for j, change in enumerate(step * np.eye(6)):
            ends = [self.law.advance(STEEL, state, strain=strain + sign * change).stress for sign in (1, -1)]
            difference = (ends[1] - ends[0]) / (2 * step)
            np.testing.assert_allclose(tangent[:, j], difference, rtol=1e-4, atol=1e-5 * tangent[0, 0])

    def test_a_cell_that_turns_takes_its_stress_along(self) -> None:
        angle = 0.1
        turned = self.law.advance(STEEL, self.state(stress=[1.2e4, 1e4, 1e4, 0, 0, 0]), rotation=[0, 0, angle]).stress
        # Two turns by half of it, each taken as twice the arc tangent of its own half.
        angle = 4 * np.arctan(angle / 4)
        wanted = [1.1e4 + 1e3 * np.cos(2 * angle), 1.1e4 - 1e3 * np.cos(2 * angle), 1e4, 1e3 * np.sin(2 * angle), 0, 0]
        np.testing.assert_allclose(turned, wanted, rtol=1e-9, atol=1e-6)

    def test_a_breeder_bed_conducts_as_ceramic_and_helium_do(self) -> None:
        pebbles = msdd.SphereMaterial(1e-3, 9e10, 0.25, 2.4, gas="helium")
        step = self.law.advance(pebbles, self.law.initial_state(pebbles, 0.37, stress=1e4), temperature=873)
        # Helium has 0.33 W/(m K) there; the geometric mean is what little contrast gives.
        self.assertLess(abs(step.conductivity[0] / (2.4**0.63 * 0.33**0.37) - 1), 0.1)
        self.assertLess(step.conductivity[0] - step.gas_conductivity, 0.05 * step.conductivity[0])

    def test_spheres_that_radiate_conduct_more_along_all_axes(self) -> None:
        bright = dataclasses.replace(STEEL, emissivity=0.8)
        state = self.state(np.array([0.42, 0.38]))
        dark, lit = (self.law.advance(m, state, temperature=1000) for m in (STEEL, bright))
        self.assertTrue((dark.radiation_conductivity == 0).all() and (lit.radiation_conductivity > 0.1).all())
        np.testing.assert_allclose(lit.conductivity[:3] - dark.conductivity[:3], np.tile(lit.radiation_conductivity, (3, 1)))
        np.testing.assert_array_equal(lit.conductivity[3:], dark.conductivity[3:])
        mixed = self.law.advance(STEEL, state, temperature=1000, emissivity=[0, 0.8])
        np.testing.assert_array_equal(mixed.radiation_conductivity, [0, lit.radiation_conductivity[1]])

    def test_arrays_of_any_shape(self) -> None:
        state = self.state(np.full((2, 1), 0.4), np.full((6, 1, 3), 1e4) * np.array([1, 1, 1, 0, 0, 0])[:, None, None])
        step = self.law.advance(STEEL, state, strain=np.zeros((6, 2, 3)), temperature=400, tangent=True)
        self.assertEqual(step.stress.shape, (6, 2, 3))
        self.assertEqual(step.tangent.shape, (6, 6, 2, 3))
        self.assertEqual(step.outside.dtype, bool)


class Walls(unittest.TestCase):
    def test_contacts_of_hertz_in_a_vacuum(self) -> None:
        grains = msdd.SphereMaterial(6e-3, 2e11, 0.3, 40)
        wall = msdd.SphereWall(40, 2e11, 0.3, spheres=0.5)
        found = msdd.wall_resistance(grains, wall, stress=[1e4, 8e4, 0], conductivity=0.5)
        square = 6e-3**2 / 0.5
        radius = np.cbrt(0.75 * 1e4 * square * 3e-3 / (1e11 / (1 - 0.3**2)))
        self.assertAlmostEqual(found[0] / (square / (0.8 * 2 * radius * 40) - 0.88 * 3e-3 / 0.5), 1, places=10)
        self.assertEqual(found[2], 1e9)
        self.assertLess(found[1], found[0])

    def test_mistakes(self) -> None:
        with self.assertRaisesRegex(msdd.InvalidArgument, "wall.spheres = 2"):
            msdd.wall_resistance(STEEL, msdd.SphereWall(40, 2e11, 0.3, spheres=2), 1e4, 0.5)
        with self.assertRaisesRegex(TypeError, "SphereWall"):
            msdd.wall_resistance(STEEL, STEEL, 1e4, 0.5)  # type: ignore[arg-type]


class Mistakes(WithLaw):
    def test_values(self) -> None:
        with self.assertRaisesRegex(msdd.InvalidArgument, "solid_fraction"):
            self.state(0.1)
        with self.assertRaises(msdd.NonFinite):
            self.state(np.nan)
        with self.assertRaisesRegex(msdd.InvalidArgument, "strain"):
            self.law.advance(STEEL, self.state(), strain=[0.5, 0, 0, 0, 0, 0])
        with self.assertRaisesRegex(msdd.InvalidArgument, "neon.*air"):
            self.law.initial_state(msdd.SphereMaterial(6e-3, 2e11, 0.3, 40, gas="neon"), 0.4, stress=1e4)
        with self.assertRaisesRegex(msdd.InvalidArgument, "size_spread = 0.5, allowed: 0 to 0.25"):
            self.law.initial_state(msdd.SphereMaterial(6e-3, 2e11, 0.3, 40, size_spread=0.5), 0.4, stress=1e4)
        with self.assertRaisesRegex(msdd.InvalidArgument, "at least that of the gas"):
            foam = msdd.SphereMaterial(6e-3, 1e7, 0.2, 0.03, gas="helium")
            self.law.advance(foam, self.law.initial_state(foam, 0.4, stress=1e3))

    def test_kinds_and_shapes(self) -> None:
        with self.assertRaisesRegex(TypeError, "SphereMaterial"):
            self.law.initial_state(msdd.Material(1, 1, 1), 0.4, stress=1e4)
        for stress in ([1e4, 1e4], np.full(7, 1e4)):
            with self.assertRaisesRegex(ValueError, "stress is a number, or 6 components"):
                self.state(0.4, stress)
        with self.assertRaisesRegex(ValueError, "rotation is 3 components"):
            self.law.advance(STEEL, self.state(), rotation=0.1)
        with self.assertRaisesRegex(KeyError, self.law.state_names[0]):
            self.law.advance(STEEL, {})
        with self.assertRaisesRegex(ValueError, "do not go together"):
            self.law.advance(STEEL, self.state([0.4, 0.39]), [1e-4, 1e-4, 1e-4])
        with self.assertRaises(TypeError):
            msdd.Model()

    def test_files(self) -> None:
        path = __file__.replace("python/tests/test_spheres.py", "surrogate/models/spheres.json")
        self.assertEqual(msdd.load_model(path).hash, self.law.hash)
        with self.assertRaises(msdd.InvalidArgument):  # stress is needed
            self.law.initial_state(STEEL, 0.4)


if __name__ == "__main__":
    unittest.main()
