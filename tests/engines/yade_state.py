"""States of msdd in YADE: reading and writing them, and the YADE engines that together have our contact law.

How a sphere becomes a disc: centres in z = 0, motion blocked but for x, y and spin; mass as given, I = m r^2/2.
How YADE's law becomes that of `rust/dem/src/law.rs`, beside its kn = 2 E r1 r2/(r1+r2), ks = nu kn:
  avoidGranularRatcheting, noRatch = False: slip with lever arms to the contact point, r - overlap/2 (walls: r - overlap);
  sphericalBodies = False: torque with those arms as well.
What stays different: damping (YADE's is per component and acts on spins; ours acts along the velocity and leaves spins
alone), the time step, and round-off. None of them changes what an equilibrium is, only the path to it.
"""

import sys

from yade import *
from yade import utils

DAMPING = 0.1
# For each wall: axis of its normal, and the side (+1 or -1) on which the grains are.
WALLS = {-1: (0, 1), -2: (0, -1), -3: (1, 1), -4: (1, -1)}
# Modulus of a wall over that of the grains where it should be infinite.
RIGID = 1e12


def load(state):
    """Adds the bodies of a state to YADE's scene. Returns a map from the state's numbers (walls: -1 to -4) to ids."""
    material, box, grains = state["material"], state["box"], state["particles"]
    grain = O.materials.append(frict_material(material, 1.0))
    wall = O.materials.append(frict_material(material, material["wall_stiffness_factor"]))
    places = {-1: box["x_min"], -2: box["x_max"], -3: box["y_min"], -4: box["y_max"]}
    ids = {}
    for key, (axis, sense) in WALLS.items():
        ids[key] = O.bodies.append(utils.wall(places[key], axis=axis, sense=sense, material=wall))
    zero = [0.0] * len(grains["x"])
    motion = [grains.get(key) or zero for key in ("vx", "vy", "angular_velocity")]
    columns = zip(grains["x"], grains["y"], grains["radius"], grains["mass"], *motion)
    for k, (x, y, radius, mass, vx, vy, spin) in enumerate(columns):
        ids[k] = O.bodies.append(utils.sphere((x, y, 0), radius, material=grain))
        body = O.bodies[ids[k]].state
        body.blockedDOFs = "zXY"
        body.mass = mass
        body.inertia = (0.5 * mass * radius**2,) * 3
        body.vel = (vx, vy, 0)
        body.angVel = (0, 0, spin)
    return ids


def frict_material(material, wall_factor):
    """The modulus E_w of walls for which YADE's stiffness of a wall contact, 2 E E_w r/(E + E_w), is wall_factor E r."""
    if wall_factor > 2.0:
        sys.exit("wall_stiffness_factor = %g, allowed here: at most 2" % wall_factor)
    ratio = wall_factor / (2.0 - wall_factor) if wall_factor < 2.0 else RIGID
    return FrictMat(
        density=material["density"],
        young=material["young_modulus"] * ratio,
        poisson=material["stiffness_ratio"],
        frictionAngle=material["friction_angle"],
    )


def set_engines(time_step, *runners, **collider):
    """Engines in the order of a step; `runners` come last."""
    O.dt = time_step
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], **collider),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(avoidGranularRatcheting=False), Ig2_Wall_Sphere_ScGeom(noRatch=False)],
            [Ip2_FrictMat_FrictMat_FrictPhys()],
            [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)],
        ),
        NewtonIntegrator(damping=DAMPING, gravity=(0, 0, 0)),
        *runners,
    ]


def set_contacts(state, ids):
    """Adds the contacts with their friction history. YADE's shear force acts on the contact's second body; our f_t t is the
    same whichever body comes first."""
    columns = state["contacts"]
    for i, j, force in zip(columns["i"], columns["j"], columns["tangential_force"]):
        contact = utils.createInteraction(ids[i], ids[j])
        tx, ty = tangent(contact)
        contact.phys.shearForce = (force * tx, force * ty, 0)


def tangent(contact):
    normal = contact.geom.normal
    return -normal[1], normal[0]


def real_contacts():
    return [contact for contact in O.interactions if contact.isReal and contact.geom.penetrationDepth > 0]


def check_stiffness(state, ids):
    """Compares kn and ks of every contact with our law, in case another version of YADE has another growParticles."""
    material = state["material"]
    factor, modulus, ratio = (material[k] for k in ("wall_stiffness_factor", "young_modulus", "stiffness_ratio"))
    walls = [ids[key] for key in WALLS]
    for contact in real_contacts():
        radii = [O.bodies[k].shape.radius for k in (contact.id1, contact.id2) if k not in walls]
        if len(radii) == 2:
            expected = 2.0 * modulus * radii[0] * radii[1] / (radii[0] + radii[1])
        else:
            expected = factor * modulus * radii[0]
        for found, wanted in ((contact.phys.kn, expected), (contact.phys.ks, ratio * expected)):
            if abs(found / wanted - 1.0) > 1e-9:
                sys.exit("contact %d-%d: stiffness %r, expected %r" % (contact.id1, contact.id2, found, wanted))


def written(state, ids):
    """The present state in our schema, with zero velocities. Ten digits give positions to 3e-11 m and forces to 2e-6 N."""
    names = {body: key for key, body in ids.items()}
    grains = [O.bodies[ids[k]] for k in range(len(state["particles"]["x"]))]
    rows = []
    for contact in real_contacts():
        (tx, ty), shear = tangent(contact), contact.phys.shearForce
        first, second = sorted((names[contact.id1], names[contact.id2]))
        rows.append((first, second, rounded(shear[0] * tx + shear[1] * ty)))
    rows.sort()
    columns = {
        "x": [rounded(body.state.pos[0]) for body in grains],
        "y": [rounded(body.state.pos[1]) for body in grains],
        "radius": [rounded(body.shape.radius) for body in grains],
        "mass": [rounded(body.state.mass) for body in grains],
    }
    contacts = dict(zip(("i", "j", "tangential_force"), map(list, zip(*rows)))) if rows else {}
    head = {key: state[key] for key in ("schema", "material")}
    # The position along the normal only: walls that slid along themselves have not moved in our sense.
    sides = {-1: "x_min", -2: "x_max", -3: "y_min", -4: "y_max"}
    box = {side: rounded(O.bodies[ids[key]].state.pos[WALLS[key][0]]) for key, side in sides.items()}
    return {**head, "box": box, "particles": columns, **({"contacts": contacts} if contacts else {})}


def rounded(value):
    return float("%.10g" % value)
