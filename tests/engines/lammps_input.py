"""A LAMMPS run of a state, for scripts/compare-engines.

    python3 tests/engines/lammps_input.py STATE OUT_FOLDER BLOCK BLOCKS RATE

Writes OUT_FOLDER/data and OUT_FOLDER/in.lammps: BLOCKS runs of BLOCK steps, the radii growing at RATE [1/s] (0: at
rest). As near to our law as LAMMPS's fastest granular style comes, gran/hooke/history:
  one normal stiffness, E times the mean radius, for all pairs and for the walls (ours depends on both radii);
  viscous damping of the overlap, a tenth of critical (its damping has no like of ours);
  the friction history of the state is not read: contacts begin without tangential force.
"""

import json
import math
import sys

TIME_STEP = 2e-4  # s
DEPTH = 0.02  # m, thickness of the periodic box in z, which LAMMPS needs


def main(state_file, folder, block, blocks, rate):
    with open(state_file) as file:
        state = json.load(file)
    material, box, grains = state["material"], state["box"], state["particles"]
    radii = grains["radius"]
    with open(folder + "/data", "w") as file:
        file.write("discs\n\n%d atoms\n1 atom types\n\n" % len(radii))
        # LAMMPS loses atoms outside its box, so it is a radius wider than the walls.
        margin = max(radii)
        for axis in "xy":
            low, high = box[axis + "_min"] - margin, box[axis + "_max"] + margin
            file.write("%.17g %.17g %slo %shi\n" % (low, high, axis, axis))
        file.write("%g %g zlo zhi\n\nAtoms # sphere\n\n" % (-DEPTH / 2, DEPTH / 2))
        for k, (x, y, radius) in enumerate(zip(grains["x"], grains["y"], radii), 1):
            file.write("%d 1 %.17g %.17g %.17g %.17g 0\n" % (k, 2 * radius, material["density"], x, y))
    with open(folder + "/in.lammps", "w") as file:
        file.write("\n".join(commands(material, box, radii, folder, block, blocks, rate)) + "\n")


def commands(material, box, radii, folder, block, blocks, rate):
    mean = sum(radii) / len(radii)
    stiffness = material["young_modulus"] * mean
    mass = material["density"] * math.pi * mean**2
    damping = 0.2 * math.sqrt(stiffness / mass)
    law = "%.10g %.10g %.10g NULL %.10g 0" % (
        stiffness,
        material["stiffness_ratio"] * stiffness,
        damping,
        math.tan(material["friction_angle"]),
    )
    # The 1 after sphere lets radii change during the run.
    style = "atom_style sphere 1" if rate != 0.0 else "atom_style sphere"
    yield from ("units si", "dimension 2", style, "atom_modify map array", "boundary f f p", "newton off")
    yield from ("comm_modify vel yes", "read_data %s/data" % folder)
    # Mass of a disc: area times density times a depth of 1 m.
    yield "set type 1 density/disc %.10g" % material["density"]
    yield from ("pair_style gran/hooke/history " + law, "pair_coeff * *")
    yield "neighbor %.6g bin" % (0.25 * mean)
    yield "neigh_modify delay 0 every 1 check yes"
    yield "timestep %g" % TIME_STEP
    yield "fix motion all nve/sphere disc"
    yield "fix plane all enforce2d"
    for axis in "xy":
        sides = "%splane %.17g %.17g" % (axis, box[axis + "_min"], box[axis + "_max"])
        yield "fix wall_%s all wall/gran hooke/history %s %s" % (axis, law, sides)
    if rate != 0.0:
        yield "variable growth equal 1+%g*%g*step" % (rate, TIME_STEP)
        yield "fix growth all adapt 1 atom diameter v_growth scale yes mass no"
    yield from ("thermo_style custom step ke atoms", "thermo %d" % block)
    yield from ["run %d" % block] * blocks


main(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]), float(sys.argv[5]))
