"""Conductivity of a bed against the thermal strain of its grains, as the surrogate model says it, with its spread.

    python3 conductivity.py [PICTURE.svg]       # draws, too, if a picture is named; needs matplotlib
"""

import sys

import numpy as np

import msdd

grains = msdd.Material(thermal_conductivity=100, young_modulus=1e7, mean_radius=5e-3)
model = msdd.load_model()

# Three beds at once, a column each, heated and cooled from the same start in steps of 0.1 %.
porosity = np.array([0.10, 0.12, 0.14])
curves = {}
for direction in (+1, -1):
    state = model.initial_state(grains, porosity)
    totals = direction * np.arange(0, 21) * 1e-3
    steps = []
    for before, total in zip(np.append(0.0, totals), totals):
        # The strain of a step is relative to the radius before it.
        strain = (1 + total) / (1 + before) - 1
        step = model.advance(grains, state, strain, total_thermal_strain=total, spread=True)
        state = step.state
        steps.append((total, step.conductivity_xx, step.conductivity_xx * step.spread))
    curves[direction] = [np.array(column) for column in zip(*steps)]

total, conductivity, spread = (np.concatenate([down[:0:-1], up]) for down, up in zip(curves[-1], curves[+1]))
print("thermal strain [%]   K_xx [W/(m K)] at initial porosity " + ", ".join(f"{value:.2f}" for value in porosity))
for strain, row in list(zip(total, conductivity))[::5]:
    print(f"{100 * strain:18.1f}  " + "".join(f"{value:8.2f}" for value in row))

if len(sys.argv) > 1:
    import matplotlib

    matplotlib.use("Agg")  # draws into a file, without a screen
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    for column, value in enumerate(porosity):
        (line,) = axes.plot(100 * total, conductivity[:, column], label=f"porosity {value:.2f} at the start")
        low, high = conductivity - spread, conductivity + spread
        axes.fill_between(100 * total, low[:, column], high[:, column], color=line.get_color(), alpha=0.25)
    axes.set_xlabel("thermal strain of the grains [%]")
    axes.set_ylabel("conductivity along x [W/(m K)]")
    axes.legend()
    figure.savefig(sys.argv[1])
