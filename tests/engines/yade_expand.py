"""Strains a packed state in YADE, an independent engine with our contact law (see yade_state.py).

    yade -n -x -j1 tests/engines/yade_expand.py STATE OUT_PREFIX STOP [STOP ...]

Reads a state file, follows one ramp, relaxes at each stop, and writes the state there to OUT_PREFIX<STOP>.json, for `msdd
rve homogenise`. Prints one line a stop. All stops of a ramp are of one kind:
  0.01      radii, r = r0 (1 + 0.01), at constant mass
  xx=-0.01  extension of the box along x; both walls move by half of it
  slide=2   the top wall slides by +2 mm along x, the bottom wall by -2 mm
"""

import json
import math
import os.path
import sys

from yade import *
from yade import utils

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import yade_state

RATE = 0.02  # strain rate, 1/s; for sliding walls that of 2 u/height, where u is the displacement of each wall
TIME_STEP = 2e-4  # s; the bound is 0.8e-3 or more for radii of 3 to 7 mm and E = 10 MPa
UNBALANCED_LIMIT = 1e-5  # mean resultant force over mean normal force at rest; msdd stops at 1e-4
LOOK_EVERY = 500
STEP_CAP = 200000


class Ramp:
    """Grows the radii from strain `start` to `stop` in equal steps. It is an engine of YADE's own loop, because calling
    O.run for each step takes 40 ms every time."""

    def __init__(self, start, stop):
        self.start, self.stop, self.strain, self.done = start, stop, start, 0
        self.steps = max(1, math.ceil(abs(stop - start) / (RATE * TIME_STEP)))

    def begin(self):
        pass

    def end(self):
        pass

    def step(self):
        if self.done < self.steps:
            self.done += 1
            strain = self.start + (self.stop - self.start) * self.done / self.steps
            # This also multiplies kn and ks of existing contacts; new contacts are made with the new radii.
            utils.growParticles((1.0 + strain) / (1.0 + self.strain), updateMass=False, dynamicOnly=True)
            self.strain = strain


class WallRamp:
    """Moves two walls at constant speed, each by half of (stop - start) times `length`, apart if that is positive. `walls`
    are the bodies that then move to lower and to higher x."""

    def __init__(self, walls, length, start, stop):
        self.walls = walls
        self.steps = max(1, math.ceil(abs(stop - start) / (RATE * TIME_STEP)))
        self.speed = 0.5 * (stop - start) * length / (self.steps * TIME_STEP)

    def begin(self):
        for wall, sense in zip(self.walls, (-1, 1)):
            O.bodies[wall].state.vel = (sense * self.speed, 0, 0)

    def end(self):
        for wall in self.walls:
            O.bodies[wall].state.vel = (0, 0, 0)

    def step(self):
        pass


def make_ramp(state, ids, before, after):
    """The ramp from stop `before` (none: the packed state) to `after`."""
    kind, _, value = after.rpartition("=")
    start, stop = float(before.rpartition("=")[2] or 0.0), float(value)
    box = state["box"]
    if kind == "":
        return Ramp(start, stop)
    if kind == "xx":
        return WallRamp((ids[-1], ids[-2]), box["x_max"] - box["x_min"], start, stop)
    if kind == "slide":
        height = box["y_max"] - box["y_min"]
        start, stop = (2e-3 * way / height for way in (start, stop))
        return WallRamp((ids[-3], ids[-4]), height, start, stop)
    sys.exit("unknown kind of stop: " + after)


def calm_rattlers():
    """Slows discs without contact, which would keep their velocity for ever: the damping is proportional to the force."""
    for body in O.bodies:
        if body.dynamic and O.forces.f(body.id).norm() == 0.0:
            body.state.vel *= 0.5
            body.state.angVel *= 0.5


def relax():
    """Steps until the forces are in balance; returns the number of steps and the remaining imbalance."""
    unbalanced, steps = math.inf, 0
    while unbalanced >= UNBALANCED_LIMIT:
        if steps >= STEP_CAP:
            sys.exit("not in equilibrium after %d steps: %g out of balance" % (steps, unbalanced))
        O.run(LOOK_EVERY, True)
        steps += LOOK_EVERY
        unbalanced = unbalanced_force()
    return steps, unbalanced


def unbalanced_force():
    resultants = [O.forces.f(body.id).norm() for body in O.bodies if body.dynamic]
    normal = [contact.phys.normalForce.norm() for contact in yade_state.real_contacts()]
    return sum(resultants) / len(resultants) * len(normal) / max(sum(normal), 1e-300)


def main(state_file, prefix, *stops):
    global ramp
    with open(state_file) as file:
        state = json.load(file)
    ids = yade_state.load(state)
    runners = PyRunner(command="ramp.step()", iterPeriod=1), PyRunner(command="calm_rattlers()", iterPeriod=50)
    # Update bounding boxes at every step, since the radii change.
    yade_state.set_engines(TIME_STEP, *runners, verletDist=0)
    yade_state.set_contacts(state, ids)
    reached = ""
    for stop in stops:
        ramp = make_ramp(state, ids, reached, stop)
        ramp.begin()
        O.run(ramp.steps, True)
        ramp.end()
        steps, unbalanced = relax()
        yade_state.check_stiffness(state, ids)
        reached = stop
        with open("%s%s.json" % (prefix, stop), "w") as file:
            json.dump(yade_state.written(state, ids), file, separators=(",", ":"))
        print("yade: stop %s, %d steps to %.1e out of balance" % (stop, ramp.steps + steps, unbalanced), flush=True)


main(*sys.argv[1:])
