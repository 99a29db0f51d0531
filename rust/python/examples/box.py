"""A box of grains, packed and heated by DEM, compared with the model's answer for the same box.

    python3 box.py [GRAINS]                      # number of grains, 500 unless given
"""

import sys

import msdd

discs = int(sys.argv[1]) if len(sys.argv) > 1 else 500
# Periodic, as the boxes are that the model was trained on: grains between walls are softer.
box = msdd.pack(discs, porosity=0.13, boundary="periodic", seed=3)
start = box.average()

grains = msdd.Material(thermal_conductivity=1, young_modulus=1e7, mean_radius=start.mean_radius)  # 1: K comes as K/k
model = msdd.load_model()
state = model.initial_state(
    grains,
    start.porosity,
    start.fabric_index,
    stress=[start.stress_xx, start.stress_yy, 0.0],
)

print("thermal strain   K_xx/k: box, model    K_yy/k: box, model    pressure [Pa]: box, model")
total, strain = 0.0, 0.004
for step in range(6):
    if step > 0:
        box.strain(thermal=strain)
        total = (1 + total) * (1 + strain) - 1
    # A strain of 0 leaves the state as it is, and answers for it.
    answer = model.advance(grains, state, strain if step > 0 else 0.0, total_thermal_strain=total)
    state, here = answer.state, box.average()
    pressure = float(answer.stress_xx + answer.stress_yy) / 2
    print(
        f"{total:14.4f}   {here.conductivity_network_xx:10.3f} {answer.conductivity_xx:7.3f}   "
        f"{here.conductivity_network_yy:12.3f} {answer.conductivity_yy:7.3f}   {here.pressure:14.0f} {pressure:7.0f}"
    )
