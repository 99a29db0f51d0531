"""advance.c in Python, by the package in rust/python.

    PYTHONPATH=rust/python python3 rust/capi/examples/advance.py [MODEL]
"""

import sys

import numpy as np

import msdd


def main():
    model = msdd.load_model(sys.argv[1] if len(sys.argv) > 1 else "builtin")
    material = msdd.Material(thermal_conductivity=100, young_modulus=1e7, mean_radius=5e-3)
    state = model.initial_state(material, np.full(1000, 0.125), 0.05)
    step = model.advance(material, state, 0.01)
    kxx, kyy, sxx, syy = (a[-1] for a in (step.conductivity_xx, step.conductivity_yy, step.stress_xx, step.stress_yy))
    assert np.ptp(step.conductivity_xx) == 0, "equal cells, equal answers"
    print(f"porosity {step.state['porosity'][-1]:.5f}, K {kxx:.3f} {kyy:.3f} W/(m K), pressure {(sxx + syy) / 2:.1f} Pa")


try:
    main()
except msdd.MsddError as error:
    sys.exit(f"advance: {error}")
