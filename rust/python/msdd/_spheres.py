"""The law of packings of spheres with gas between them, in three dimensions."""

from __future__ import annotations

import ctypes as c
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._columns import Array, State, address, aligned, table
from ._library import Handle, SphereBatchStruct, SphereMaterialStruct, SphereWallStruct, check, encoded, library

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")
"""Order of the components of stress, strain and conductivity along the first axis of their arrays."""


@dataclass(frozen=True)
class SphereMaterial:
    """Spheres and the gas between them."""

    diameter: float
    """of unequal spheres the Sauter mean, sum d^3/sum d^2 [m], 1e-9 to 1e3"""
    young_modulus: float
    """E of the spheres [Pa], 1e-9 to 1e15"""
    poisson_ratio: float
    """of the spheres, -0.99 to 0.5"""
    conductivity: float
    """k_s of the spheres [W/(m K)], 1e-12 to 1e12"""
    roughness: float = 0.0
    """height of the asperities (root mean square) over their slope [m], 0 to 1; 0: smooth"""
    hardness: float = 1e9
    """of the rough surface [Pa], 1 to 1e15; not used when smooth"""
    gas: str = "vacuum"
    """"air", "nitrogen", "helium", "argon" or "vacuum\""""
    gas_pressure: float = 101325.0
    """pressure of the gas [Pa], 1e-3 to 1e9; not used in a vacuum"""
    accommodation: float = 0.9
    """accommodation coefficient of the gas at the spheres, 0.01 to 1; not used in a vacuum"""
    emissivity: float = 0.0
    """of the spheres, opaque, grey and diffuse, 0 to 1; 0: without radiation"""
    size_spread: float = 0.0
    """standard deviation of the diameters over their mean, both weighted by surface, 0 to 0.25; 0: equal spheres"""

    def _struct(self) -> c.Structure:
        return SphereMaterialStruct(
            c.sizeof(SphereMaterialStruct),
            *map(float, (self.diameter, self.young_modulus, self.poisson_ratio, self.conductivity)),
            *map(float, (self.roughness, self.hardness)),
            encoded("gas", self.gas),
            *map(float, (self.gas_pressure, self.accommodation, self.emissivity, self.size_spread)),
        )


@dataclass(frozen=True)
class SphereWall:
    """The surface of a wall beside a bed of spheres."""

    conductivity: float
    """of the wall [W/(m K)], 1e-12 to 1e12"""
    young_modulus: float
    """of the wall [Pa], 1e-9 to 1e15"""
    poisson_ratio: float
    """of the wall, -0.99 to 0.5"""
    roughness: float = 0.0
    """of sphere and wall together: height of the asperities (root mean square) over their slope [m], 0 to 1; 0: smooth"""
    hardness: float = 1e9
    """of the softer of both [Pa], 1 to 1e15; not used when smooth"""
    spheres: float = 0.87
    """spheres at the wall on the square of a diameter, 0.01 to 1.16"""
    emissivity: float = 0.0
    """of the wall, 0 to 1; it exchanges radiation with spheres whose emissivity is above 0"""

    def _struct(self) -> c.Structure:
        return SphereWallStruct(
            c.sizeof(SphereWallStruct),
            *map(float, (self.conductivity, self.young_modulus, self.poisson_ratio)),
            *map(float, (self.roughness, self.hardness, self.spheres, self.emissivity)),
        )


@dataclass(frozen=True, eq=False)
class SphereStep:
    """Cells after a step. Tensors have their six components xx, yy, zz, xy, xz, yz along the first axis, then the shape of the
    cells.
    """

    state: State
    """state after the step: an array [-] for each of `Spheres.state_names`"""
    stress: Array
    """sigma [Pa], compression positive"""
    conductivity: Array
    """K [W/(m K)], of contacts, gas and radiation together"""
    gas_conductivity: Array
    """the part of it by the gas [W/(m K)], its mean over directions: there is more of it where contacts point"""
    radiation_conductivity: Array
    """what radiation between the spheres adds, alike in all directions [W/(m K)]"""
    solid_fraction: Array
    """volume of the spheres over the volume [-]"""
    outside: NDArray[np.bool_]
    """True where jamming fraction, pressure or stress ratio after the step, or the number of the gas, are outside of the training"""
    tangent: Optional[Array] = None
    """-d sigma_i/d strain_j [Pa] with i, j in the order of `COMPONENTS`: 6 x 6 and then the shape of the cells; None unless asked
    for. Where spheres slide it is not symmetric"""


class Spheres:
    """The law of packings of equal spheres, made by `load_spheres`. It never changes, and several threads may use it at once. It
    cannot be pickled.
    """

    __slots__ = ("_handle", "_state_names")

    _handle: Handle
    _state_names: tuple[str, ...]

    def __init__(self) -> None:
        raise TypeError("laws of spheres are made by msdd.load_spheres")

    @classmethod
    def _own(cls, made: c.c_void_p) -> Spheres:
        self = object.__new__(cls)
        self._handle = Handle(made, "msdd_spheres_free")
        size = library.msdd_spheres_state_size(self._handle)
        names = (library.msdd_spheres_state_name(self._handle, column) for column in range(size))
        self._state_names = tuple(name.decode() for name in names)
        return self

    def __repr__(self) -> str:
        return f"<msdd.Spheres {self.hash[:12]}>"

    @property
    def hash(self) -> str:
        """SHA-256 of the model file, 64 hexadecimal digits."""
        text: bytes = library.msdd_spheres_hash(self._handle)
        return text.decode()

    @property
    def info(self) -> dict[str, Any]:
        """The model file: numbers of the law, ranges of the training, and the database that it was fitted to."""
        description: dict[str, Any] = json.loads(library.msdd_spheres_describe(self._handle))
        return description

    @property
    def state_names(self) -> tuple[str, ...]:
        """Names of the state's columns."""
        return self._state_names

    def initial_state(
        self,
        material: SphereMaterial,
        solid_fraction: ArrayLike,
        stress: ArrayLike,
        *,
        coordination: Optional[ArrayLike] = None,
        mobilised: Optional[ArrayLike] = None,
        fabric: Optional[ArrayLike] = None,
    ) -> State:
        """State of packings at the start, an array for each of `state_names`. Arrays of any shapes that broadcast to one; the state
        has that shape.

        Parameters
        ----------
        material
            spheres and gas
        solid_fraction
            volume of the spheres over the volume [-], 0.3 to 0.8
        stress
            [Pa], compression positive: one number or array, the pressure; or six components in a list or along the first axis.
            Spheres under no pressure just do not touch
        coordination
            contacts per sphere, all spheres counted [-], 0 to 12; None: as in a periodic box with this solid fraction, stress and
            mobilised friction. Beds under gravity have about 0.4 more
        mobilised
            mobilised part of the friction [-], 0 to 1; 0.84 to 0.93 in beds that were poured; None: 0.85
        fabric
            mean of n n over the contacts, with the normals n: six components [-], -1 to 1; None: as in usual packings

        Raises
        ------
        InvalidArgument
            for a value out of range,
        NonFinite
            for NaN and infinity; the text names column and index.
        """
        load = _components("stress", stress, COMPONENTS, isotropic=True)
        directions = {} if fabric is None else _components("fabric", fabric, COMPONENTS)
        shape, columns = aligned(
            {"solid_fraction": solid_fraction, **load},
            {"coordination": coordination, "mobilised": mobilised, **directions},
        )
        state = {name: np.empty(shape) for name in self._state_names}
        count, solid, given = _count(shape), address(columns["solid_fraction"]), table(columns[name] for name in load)
        contacts = None if coordination is None else address(columns["coordination"])
        friction = None if mobilised is None else address(columns["mobilised"])
        normals = table(columns[name] for name in directions) if directions else None
        answer = table(state.values())
        check(
            library.msdd_spheres_initial_state(
                self._handle, _scales(material), count, solid, given, contacts, friction, normals, answer
            )
        )
        return state

    def advance(
        self,
        material: SphereMaterial,
        state: Mapping[str, ArrayLike],
        thermal_strain: ArrayLike = 0.0,
        *,
        strain: Optional[ArrayLike] = None,
        rotation: Optional[ArrayLike] = None,
        temperature: Optional[ArrayLike] = None,
        solid_conductivity: Optional[ArrayLike] = None,
        emissivity: Optional[ArrayLike] = None,
        tangent: bool = False,
    ) -> SphereStep:
        """Takes cells through one step. Arrays of any shapes that broadcast to one; what is given is never changed.

        Parameters
        ----------
        material
            spheres and gas
        state
            an array for each of `state_names`: a dictionary, or a data frame; other columns are ignored
        thermal_strain
            growth of the radii in this step, relative to the present ones [-], above -0.2, to 0.2
        strain
            six components of the strain of the cell in this step, in a list or along the first axis, extension positive [-], above
            -0.2, to 0.2; the last three are twice the shears, du_x/dy + du_y/dx and so on; None: 0
        rotation
            three components of the angle by which the cell turns, half of the curl of the displacement [rad]; None: 0
        temperature
            of the gas [K], 0 to 1e5; None: 293.15
        solid_conductivity
            of the spheres [W/(m K)], 1e-12 to 1e12; None: as in the material
        emissivity
            of the spheres, 0 to 1; None: as in the material
        tangent
            whether to compute the mechanical tangent, too

        Raises
        ------
        InvalidArgument
            for a value out of range, and where the spheres conduct less than the gas;
        NonFinite
            for NaN and infinity;
        KeyError
            for a missing column of the state.
        """
        if not hasattr(state, "keys"):
            raise TypeError(f"state is a dictionary of arrays by name, not {type(state).__name__}")
        missing = [name for name in self._state_names if name not in state]
        if missing:
            raise KeyError(f"the state lacks {', '.join(missing)}")
        before = {f"state[{name!r}]": state[name] for name in self._state_names}
        strains = {} if strain is None else _components("strain", strain, COMPONENTS)
        angles = {} if rotation is None else _components("rotation", rotation, ("x", "y", "z"))
        shape, columns = aligned(
            {**before, "thermal_strain": thermal_strain, **strains, **angles},
            {"temperature": temperature, "solid_conductivity": solid_conductivity, "emissivity": emissivity},
        )
        after = {name: np.empty(shape) for name in self._state_names}
        stress, conductivity = np.empty((6, *shape)), np.empty((6, *shape))
        answers = {name: np.empty(shape) for name in ("gas_conductivity", "radiation_conductivity", "solid_fraction")}
        outside = np.empty(shape, np.bool_)
        stiffness = np.empty((6, 6, *shape)) if tangent else None
        # Arrays and tables live to the end of this function, and so do the addresses in the batch.
        tables = {
            "state": table(columns[name] for name in before),
            "next_state": table(after.values()),
            "stress": table(stress[i, ...] for i in range(6)),
            "conductivity": table(conductivity[i, ...] for i in range(6)),
        }
        if strains:
            tables["strain"] = table(columns[name] for name in strains)
        if angles:
            tables["rotation"] = table(columns[name] for name in angles)
        if stiffness is not None:
            tables["tangent"] = table(stiffness[i, j, ...] for i in range(6) for j in range(6))
        batch = SphereBatchStruct(struct_size=c.sizeof(SphereBatchStruct), cells=_count(shape), outside=address(outside))
        for name, pointers in tables.items():
            setattr(batch, name, c.addressof(pointers))
        for name in ("thermal_strain", "temperature", "solid_conductivity", "emissivity"):
            if name in columns:
                setattr(batch, name, address(columns[name]))
        for name, column in answers.items():
            setattr(batch, name, address(column))
        check(library.msdd_spheres_advance(self._handle, _scales(material), c.byref(batch)))
        return SphereStep(
            state=after, stress=stress, conductivity=conductivity, outside=outside, tangent=stiffness, **answers
        )


def load_spheres(source: Union[str, os.PathLike[str]] = "builtin") -> Spheres:
    """Loads the law of packings of spheres.

    Parameters
    ----------
    source
        "builtin", the law that comes with the library, or the path of a file made by `msdd train --model spheres`

    Raises
    ------
    FileError, ModelError
    """
    made = c.c_void_p()
    check(library.msdd_spheres_load(encoded("source", source), c.byref(made)))
    return Spheres._own(made)


def wall_resistance(
    material: SphereMaterial,
    wall: SphereWall,
    stress: ArrayLike,
    conductivity: ArrayLike,
    temperature: ArrayLike = 293.15,
) -> Array:
    """What a wall adds to the resistance of a bed that has one conductivity up to its surface [m2 K/W], 0 to 1e9. Arrays of any
    shapes that broadcast to one; the answer has that shape.

    Parameters
    ----------
    material
        spheres and gas
    wall
        the surface of the wall
    stress
        normal to the wall [Pa], compression positive; where it is 0 or less, gas alone conducts
    conductivity
        of the bed across the wall [W/(m K)], 0 and above
    temperature
        of the gas [K], 0 to 1e5

    Raises
    ------
    InvalidArgument
        for a value out of range,
    NonFinite
        for NaN and infinity.
    """
    if not isinstance(wall, SphereWall):
        raise TypeError(f"wall is a msdd.SphereWall, not {type(wall).__name__}")
    shape, columns = aligned({"stress": stress, "temperature": temperature, "conductivity": conductivity}, {})
    found = np.empty(shape)
    given = [address(column) for column in columns.values()]
    surface = c.byref(wall._struct())
    check(library.msdd_spheres_wall_resistance(_scales(material), surface, _count(shape), *given, address(found)))
    return found


def _scales(material: SphereMaterial) -> Any:
    if not isinstance(material, SphereMaterial):
        raise TypeError(f"material is a msdd.SphereMaterial, not {type(material).__name__}")
    return c.byref(material._struct())


def _components(
    name: str, values: ArrayLike, components: tuple[str, ...], isotropic: bool = False
) -> dict[str, ArrayLike]:
    """The components of a tensor or vector by name, from a list of as many arrays or an array with them along its first axis;
    with `isotropic` also from a single number, which is then that of the normal components."""
    count = len(components)
    if isotropic and np.ndim(values) == 0:
        return {f"{name}_{key}": (values if index < 3 else 0.0) for index, key in enumerate(components)}
    if not isinstance(values, (list, tuple, np.ndarray)) or len(values) != count:
        number = "a number, or " if isotropic else ""
        raise ValueError(f"{name} is {number}{count} components, {', '.join(components)}, along its first axis")
    return {f"{name}_{key}": values[index] for index, key in enumerate(components)}


def _count(shape: tuple[int, ...]) -> int:
    return int(np.prod(shape, dtype=np.int64))
