"""Boxes of grains by DEM: packed, strained and averaged."""

from __future__ import annotations

import ctypes as c
import json
import threading
from dataclasses import asdict, dataclass
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from ._columns import Array
from ._library import AveragesStruct, Handle, check, encoded, library

_OUTCOMES = {0: "settled", 1: "capped", 2: "unjammed"}


@dataclass(frozen=True)
class Grains:
    """Material of the grains of a box."""

    density: float = 3000.0
    """[kg/m3], above 0; sets how fast grains move, not where they come to rest"""
    young_modulus: float = 1e7
    """E [Pa], above 0"""
    stiffness_ratio: float = 0.8
    """tangential over normal stiffness of a contact [-]"""
    friction_angle: float = 0.5
    """friction angle of contacts [rad]"""
    wall_stiffness_factor: float = 1.0
    """stiffness of a contact with a wall over that of one between grains [-]"""
    damping: float = 0.1
    """damping factor mu: a grain is held back by mu times the resultant of its contact forces, against its velocity [-]"""


@dataclass(frozen=True)
class Averages:
    """Averages over a box: over what lies 0.8 mean radii inside of its walls, or over all of a periodic one. Stresses [Pa],
    compression positive; conductivities over that of the grains, K/k [-]."""

    porosity: float
    """overlaps of grains counted once [-]"""
    porosity_sum_of_areas: float
    """1 - sum of the grains' areas over the area [-], overlaps counted twice"""
    fabric_index: float
    """F_xx - F_yy of the contacts' normals [-]; above 0 more contacts point along x"""
    fabric_conductivity: float
    """(K_xx - K_yy)/(K_xx + K_yy), affine [-]"""
    conductivity_xx: float
    """K_xx/k [-], affine: with grains' temperatures from the mean gradient, an upper bound"""
    conductivity_yy: float
    """K_yy/k [-], affine"""
    conductivity_xy: float
    """K_xy/k [-], affine"""
    conductivity_network_xx: float
    """K_xx/k [-], network: with the heat flow from grain to grain solved"""
    conductivity_network_yy: float
    """K_yy/k [-], network"""
    conductivity_network_xy: float
    """K_xy/k [-], network"""
    stress_xx: float
    """sigma_xx [Pa]"""
    stress_yy: float
    """sigma_yy [Pa]"""
    stress_xy: float
    """sigma_xy [Pa]"""
    stress_yx: float
    """sigma_yx [Pa]"""
    pressure: float
    """(stress_xx + stress_yy)/2 [Pa]"""
    coordination: float
    """contacts of a grain that has any [-]"""
    mean_radius: float
    """present mean radius of the grains [m]"""
    rattlers: int
    """number of grains without contact"""
    contacts: int
    """number of contacts between grains"""


class Contacts(NamedTuple):
    """Contacts that press. Of a contact with a wall, `i` is -1 (left), -2 (right), -3 (bottom) or -4 (top)."""

    i: NDArray[np.int64]
    """number of the one grain, or a wall"""
    j: NDArray[np.int64]
    """number of the other grain"""
    overlap: Array
    """[m]; the normal force is proportional to it"""
    tangential_force: Array
    """[N]"""


class Rve:
    """A representative volume element: a box of grains at rest, made by `pack` or `Rve.from_json`. It can be copied
    and pickled. Threads take turns."""

    __slots__ = ("_handle", "_lock")

    _handle: Handle
    _lock: threading.Lock

    def __init__(self) -> None:
        raise TypeError("boxes are made by msdd.pack or msdd.Rve.from_json")

    @classmethod
    def _own(cls, made: c.c_void_p) -> Rve:
        self = object.__new__(cls)
        self._handle = Handle(made, "msdd_rve_free")
        self._lock = threading.Lock()
        return self

    @staticmethod
    def from_json(text: str) -> Rve:
        """The box of a state file, from its text, which goes on bit for bit.

        Raises
        ------
        RveError
            for a text that is no state, or a damaged one.
        """
        made = c.c_void_p()
        check(library.msdd_rve_from_json(encoded("text", text), c.byref(made)))
        return Rve._own(made)

    def to_json(self) -> str:
        """Text of a state file (schema "msdd-state-1"), as `msdd rve` writes it, from which the box goes on bit for bit."""
        text = c.c_void_p()
        with self._lock:
            check(library.msdd_rve_to_json(self._handle, c.byref(text)))
        try:
            return c.string_at(text.value or 0).decode()
        finally:
            library.msdd_text_free(text)

    def copy(self) -> Rve:
        """A copy, which is strained on its own."""
        made = c.c_void_p()
        with self._lock:
            check(library.msdd_rve_clone(self._handle, c.byref(made)))
        return Rve._own(made)

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Rve:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        return Rve.from_json, (self.to_json(),)

    def __repr__(self) -> str:
        return f"<msdd.Rve of {len(self.grains()['radius'])} grains>"

    def strain(self, thermal: float = 0.0, xx: float = 0.0, yy: float = 0.0, xy: float = 0.0) -> str:
        """Strains the box relative to its present state and lets the grains come to rest. The answer is "settled" (forces balance),
        "capped" (the most time steps came first) or "unjammed" (carries no load).

        Parameters
        ----------
        thermal
            radial strain of the grains, growth positive [-], -0.2 to 0.2
        xx, yy
            strain of the box along x and y, extension positive [-], -0.2 to 0.2
        xy
            way of the top along x over the height, of periodic boxes only [-], -0.2 to 0.2

        Raises
        ------
        InvalidArgument, RveError
            and the box is then as before.
        """
        outcome = c.c_int32()
        strains = (float(thermal), float(xx), float(yy), float(xy))
        with self._lock:
            check(library.msdd_rve_strain(self._handle, *strains, c.byref(outcome)))
        return _OUTCOMES[outcome.value]

    def average(self) -> Averages:
        """Porosity, fabric, conductivity, stress and more of the present state."""
        found = AveragesStruct(c.sizeof(AveragesStruct))
        with self._lock:
            check(library.msdd_rve_homogenise(self._handle, c.byref(found)))
        return Averages(**{name: getattr(found, name) for name in Averages.__dataclass_fields__})

    def grains(self) -> dict[str, Array]:
        """One value a grain: x, y, radius [m], mass [kg], vx, vy [m/s], angular_velocity [rad/s] and temperature [K]."""
        particles = json.loads(self.to_json())["particles"]
        return {name: np.array(column, np.float64) for name, column in particles.items()}

    def contacts(self) -> Contacts:
        """Which grains and walls press on each other, and how far they overlap."""
        state = json.loads(self.to_json())
        found = {name: np.array(column) for name, column in state["contacts"].items()}
        return Contacts(found["i"], found["j"], _overlaps(state, found), found["tangential_force"])

    def bounds(self) -> tuple[float, float, float, float]:
        """x_min, x_max, y_min, y_max of the box [m]."""
        box = json.loads(self.to_json())["box"]
        return box["x_min"], box["x_max"], box["y_min"], box["y_max"]


def pack(
    discs: int = 500,
    *,
    seed: int = 1,
    porosity: float = 0.12,
    compression: str = "isotropic",
    boundary: str = "walls",
    radius_min: float = 3e-3,
    radius_max: float = 7e-3,
    relaxation: str = "damped",
    grains: Optional[Grains] = None,
) -> Rve:
    """Packs a box of grains: they are laid out loosely, walls close in until the porosity is reached, and they come to rest.
    The same arguments give the same box, bit for bit.

    Parameters
    ----------
    discs
        number of grains
    seed
        of their places and radii
    porosity
        of the box at which the walls stop [-], overlaps counted once; 0.1 to 0.17 is usual
    compression
        "isotropic" (walls close in along x and y), "horizontal" (along x), "intermediate" (twice as fast along x) or "sheared"
        (along x, while y opens an eighth as fast)
    boundary
        "walls" or "periodic"
    radius_min, radius_max
        range of the radii [m], which are evenly spread between
    relaxation
        how grains come to rest, "damped" or "fire" (fast inertial relaxation engine)
    grains
        their material; None: `Grains()`

    Raises
    ------
    InvalidArgument, RveError
    """
    specification = {
        "discs": discs,
        "seed": seed,
        "porosity": porosity,
        "compression": compression,
        "boundary": boundary,
        "radius_min": radius_min,
        "radius_max": radius_max,
        "relaxation": relaxation,
        "material": asdict(Grains() if grains is None else grains),
    }
    made = c.c_void_p()
    text = json.dumps(specification, default=_number)
    check(library.msdd_rve_pack(encoded("specification", text), c.byref(made)))
    return Rve._own(made)


def _number(value: object) -> Any:
    """A number of numpy for JSON."""
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{type(value).__name__} is neither a number nor a text")


def _overlaps(state: dict[str, Any], contacts: dict[str, NDArray[Any]]) -> Array:
    """Overlaps of the contacts of a state [m]. A contact across the border of a periodic box is one with the image of grain j
    that lies shift_x and shift_y boxes away; the images above are sheared by shear_offset against the box."""
    box, i, j = state["box"], contacts["i"], contacts["j"]
    x, y, radius = (np.array(state["particles"][name]) for name in ("x", "y", "radius"))
    shift_x, shift_y = contacts.get("shift_x", 0), contacts.get("shift_y", 0)
    along = x[j] - x[i] + shift_x * (box["x_max"] - box["x_min"]) + shift_y * box.get("shear_offset", 0.0)
    across = y[j] - y[i] + shift_y * (box["y_max"] - box["y_min"])
    walls = [box["y_max"] - y[j], y[j] - box["y_min"], box["x_max"] - x[j], x[j] - box["x_min"]]  # of i = -4, ..., -1
    distance = np.choose(np.clip(i + 4, 0, 4), [*walls, np.hypot(along, across) - radius[i]])
    overlaps: Array = radius[j] - distance
    return overlaps
