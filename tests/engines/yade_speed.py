"""Measures the speed of YADE on a packed state, for scripts/compare-engines.

    yade -n -x -j1 tests/engines/yade_speed.py STATE BLOCK BLOCKS RATE

Runs BLOCKS blocks of BLOCK steps, the radii growing at RATE [1/s] (0: at rest), and prints the particle-steps per second
of processor time of the fastest block after the first.
"""

import json
import os.path
import sys
import time

from yade import *
from yade import utils

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import yade_state

TIME_STEP = 2e-4  # s


def grow():
    global strain
    utils.growParticles((1.0 + strain + RATE * TIME_STEP) / (1.0 + strain), updateMass=False, dynamicOnly=True)
    strain += RATE * TIME_STEP


def main(state_file, block, blocks):
    with open(state_file) as file:
        state = json.load(file)
    ids = yade_state.load(state)
    # Timed inside YADE's loop, because O.run notices the end of a run only every 40 ms.
    runners = [PyRunner(command="stamps.append(time.process_time())", iterPeriod=block)]
    if RATE != 0.0:
        runners.insert(0, PyRunner(command="grow()", iterPeriod=1))
    # YADE's own choice of bounding boxes, half the smallest radius wider than the discs; wide enough for growing discs, too.
    yade_state.set_engines(TIME_STEP, *runners)
    yade_state.set_contacts(state, ids)
    O.run(block * blocks + 1, True)
    best = min(after - before for before, after in zip(stamps, stamps[1:]))
    print("particle_steps_per_second %.6g" % (len(state["particles"]["x"]) * block / best))


stamps, strain, RATE = [], 0.0, float(sys.argv[4])
main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
