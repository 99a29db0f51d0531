"""What the solver has written, and a plug-in. tests/python/run makes both and sets MSDD_TEST_CASES and MSDD_TEST_PLUGIN."""

import json
import os
import re
import unittest
from pathlib import Path

import numpy as np

import msdd

CASES = os.environ.get("MSDD_TEST_CASES")
PLUGIN = os.environ.get("MSDD_TEST_PLUGIN")


@unittest.skipUnless(CASES, "MSDD_TEST_CASES is not set")
class Solver(unittest.TestCase):
    def setUp(self) -> None:
        self.ascii, self.binary = (Path(f"{CASES}-{format}") for format in ("ascii", "binary"))

    def test_formats_agree(self) -> None:
        self.assertEqual(msdd.time_folders(self.ascii), ["0", "0.25", "0.5"])
        names = [path.name for path in (self.ascii / "0.5").iterdir() if path.is_file()]
        self.assertGreater(len(names), 8)
        for name in names:
            here, there = (msdd.read_field(case, 0.5, name) for case in (self.ascii, self.binary))
            np.testing.assert_allclose(here, there, rtol=1e-15, err_msg=name)
            self.assertEqual(len(here), 72)
        self.assertIn(b"format      binary", (self.binary / "0.5/T").read_bytes())

    def test_mesh_is_that_of_openfoam(self) -> None:
        for case in (self.ascii, self.binary):
            mesh = msdd.read_mesh(case)
            np.testing.assert_allclose(mesh.centres, msdd.read_field(case, 0.5, "C"), rtol=1e-13)
            np.testing.assert_allclose(mesh.volumes, msdd.read_field(case, 0.5, "V"), rtol=1e-13)

    def test_summary_probes_and_audit_agree_with_the_fields(self) -> None:
        final = msdd.read_summary(self.ascii)["final"]
        porosity = msdd.read_field(self.ascii, "latest", "porosity")
        weights = msdd.read_mesh(self.ascii).volumes
        self.assertAlmostEqual(final["porosity"], np.average(porosity, weights=weights), places=8)
        stress = msdd.read_field(self.ascii, "latest", "stress")
        self.assertAlmostEqual(-np.average(stress[:, 0], weights=weights) / final["stress_xx"], 1, places=8)
        probes, temperature = msdd.read_probes(self.ascii), msdd.read_field(self.ascii)
        self.assertAlmostEqual(probes.times[-1], 0.5)
        for where, value in zip(probes.positions, probes.values[-1]):
            nearest = np.argmin(np.linalg.norm(msdd.read_mesh(self.ascii).centres - where, axis=1))
            self.assertAlmostEqual(temperature[nearest], value, places=10)
        self.assertEqual(msdd.read_probes(self.ascii, "stress").values.shape, (len(probes.times), 2, 6))
        files = ["massAudit/0/massAudit.dat", "probes/0/T", "probes/0/stress"]
        listed = json.loads((self.ascii / "postProcessing/msddFoam/tables.json").read_text())
        self.assertEqual(listed, {"schema": "msdd-tables-1", "runs": [{"start": 0, "files": files}]})
        audit = msdd.read_table(self.ascii, "massAudit")
        np.testing.assert_allclose(audit["Time"], np.linspace(0, 0.5, 11), atol=1e-12)
        self.assertLess(np.abs(audit["relative_change"]).max(), 1e-12)

    def test_solver_and_package_ask_the_same_model(self) -> None:
        # K of the solver's state at the end is that of the model for that state.
        model = msdd.load_model()
        self.assertEqual(msdd.read_summary(self.ascii)["model"]["hash"], model.hash)
        # The solver names reducedPressure what the model names reduced_pressure.
        names = {name: re.sub(r"_(\w)", lambda letter: letter[1].upper(), name) for name in model.state_names}
        state = {name: msdd.read_field(self.ascii, 0.5, field) for name, field in names.items()}
        answer = model.advance(msdd.Material(100, 1e7, 5e-3), state, 0.0)
        conductivity = msdd.read_field(self.ascii, 0.5, "conductivity")
        np.testing.assert_allclose(conductivity[:, 0], answer.conductivity_xx, rtol=1e-12)
        np.testing.assert_allclose(conductivity[:, 3], answer.conductivity_yy, rtol=1e-12)


@unittest.skipUnless(PLUGIN, "MSDD_TEST_PLUGIN is not set")
class Plugin(unittest.TestCase):
    def test_a_plugin_answers_as_a_model_does(self) -> None:
        model = msdd.load_model(f"plugin:{PLUGIN}")
        self.assertEqual((model.info["kind"], model.trained_range), ("plugin", {}))
        material = msdd.Material(100, 1e7, 5e-3)
        step = model.advance(material, model.initial_state(material, [0.12, 0.14]), 0.01)
        self.assertGreater(step.conductivity_xx[0], step.conductivity_xx[1])


if __name__ == "__main__":
    unittest.main()
