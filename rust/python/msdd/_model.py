"""Surrogate models: what cells of a granular bed do when their grains are heated."""

from __future__ import annotations

import ctypes as c
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._columns import Array, State, address, aligned, table
from ._library import BatchStruct, Handle, InitialStruct, MaterialStruct, check, encoded, library


@dataclass(frozen=True)
class Material:
    """What turns a model's dimensionless answers into SI units."""

    thermal_conductivity: float
    """k of the grains [W/(m K)], 1e-12 to 1e12"""
    young_modulus: float
    """E of the grains [Pa], 1e-9 to 1e15"""
    mean_radius: float
    """mean radius of the grains in the initial state [m], 1e-12 to 1e6"""

    def _struct(self) -> c.Structure:
        values = (self.thermal_conductivity, self.young_modulus, self.mean_radius)
        return MaterialStruct(c.sizeof(MaterialStruct), *map(float, values))


class WallFriction(NamedTuple):
    """Friction of a wall after the slip s [m] is `limit * s / (s + slip)`."""

    limit: float
    """friction coefficient of a wall that has slipped far [-]"""
    slip: float
    """slip at which half of it is mobilised [m]"""


@dataclass(frozen=True, eq=False)
class Step:
    """Cells after a step. All arrays have the shape of the cells that were asked for."""

    state: State
    """state after the step, a dictionary as before: an array [-] for each of `Model.state_names`"""
    conductivity_xx: Array
    """K_xx [W/(m K)]"""
    conductivity_yy: Array
    """K_yy [W/(m K)]"""
    conductivity_xy: Array
    """K_xy [W/(m K)]"""
    stress_xx: Array
    """sigma_xx [Pa], compression positive"""
    stress_yy: Array
    """sigma_yy [Pa], compression positive"""
    stress_xy: Array
    """sigma_xy [Pa], compression positive"""
    clamped: NDArray[np.bool_]
    """True where an input was outside the range that the model was trained in"""
    outside: State
    """how far outside, for each of `Model.state_names` and "thermal_strain", in that input's own unit: negative below the
    range, positive above, 0 inside"""
    spread: Optional[Array] = None
    """relative standard deviation of K between boxes of equal state [-], NaN if the model does not know; None unless asked for"""
    tangent: Optional[Array] = None
    """-d sigma_i/d strain_j [Pa] with i, j = xx, yy, xy: 3 x 3 and then the shape of the cells; None unless asked for. Where
    grains slide it is not symmetric"""


_ANSWERS = ("conductivity_xx", "conductivity_yy", "conductivity_xy", "stress_xx", "stress_yy", "stress_xy")


class Model:
    """A surrogate model, made by `load_model`. It never changes, and several threads may use it at once: other threads of
    Python run while it computes. It cannot be pickled. Porosity counts overlaps of grains once.
    """

    __slots__ = ("_handle", "_state_names")

    _handle: Handle
    _state_names: tuple[str, ...]

    def __init__(self) -> None:
        raise TypeError("models are made by msdd.load_model")

    @classmethod
    def _own(cls, made: c.c_void_p) -> Model:
        self = object.__new__(cls)
        self._handle = Handle(made, "msdd_surrogate_free")
        size = library.msdd_surrogate_state_size(self._handle)
        names = (library.msdd_surrogate_state_name(self._handle, column) for column in range(size))
        self._state_names = tuple(name.decode() for name in names)
        return self

    def __repr__(self) -> str:
        return f"<msdd.Model {self.info['name']!r} {self.hash[:12]}>"

    @property
    def hash(self) -> str:
        """SHA-256 of the model file or plug-in, 64 hexadecimal digits."""
        text: bytes = library.msdd_surrogate_hash(self._handle)
        return text.decode()

    @property
    def info(self) -> dict[str, Any]:
        """What the model says of itself: kind, name, state, conductivities, scores, and the database it was trained on."""
        description: dict[str, Any] = json.loads(library.msdd_surrogate_describe(self._handle))
        return description

    @property
    def trained_range(self) -> dict[str, tuple[float, float]]:
        """Least and largest value of each input in the training, beyond which `Step.clamped` is set: porosity [-], fabric_index
        [-], thermal_strain [-] and, of a model that carries stress, fabric, jamming_fraction, elastic_compression, elastic_shear
        [-] and pressure (reduced as the state is). Empty for a plug-in, which does not tell."""
        ranges = self.info.get("trained_range") or {}
        return {name: (ends["min"], ends["max"]) for name, ends in ranges.items()}

    @property
    def state_names(self) -> tuple[str, ...]:
        """Names of the columns of a state; the first two are "porosity" and "fabric_index" (F_xx - F_yy)."""
        return self._state_names

    @property
    def has_tangent(self) -> bool:
        """Whether the model answers mechanical strains, and has a mechanical tangent."""
        return bool(library.msdd_surrogate_has_tangent(self._handle))

    def with_conductivity(self, kind: str) -> Model:
        """The same model with conductivities of another kind.

        Parameters
        ----------
        kind
            "network" (heat flow from grain to grain solved) or "affine" (temperatures of grains taken from the mean gradient, an
            upper bound); `info["conductivities"]` lists those that it was trained for.

        Raises
        ------
        InvalidArgument
            for any other.
        """
        made = c.c_void_p()
        check(library.msdd_surrogate_with_conductivity(self._handle, encoded("kind", kind), c.byref(made)))
        return Model._own(made)

    def initial_state(
        self,
        material: Material,
        porosity: ArrayLike,
        fabric_index: ArrayLike = 0.0,
        *,
        fabric_xy: Optional[ArrayLike] = None,
        stress_xx: Optional[ArrayLike] = None,
        stress_yy: Optional[ArrayLike] = None,
        stress_xy: Optional[ArrayLike] = None,
        conductivity_xx: Optional[ArrayLike] = None,
        conductivity_yy: Optional[ArrayLike] = None,
        conductivity_xy: Optional[ArrayLike] = None,
    ) -> State:
        """State of cells at the start, an array for each of `state_names`. What is not given is the mean of the packings of the
        training. Arrays of any shapes that broadcast to one; the state has that shape.

        Parameters
        ----------
        material
            what turns the answers of the model into SI units
        porosity
            overlaps counted once [-], 0 to 1
        fabric_index
            F_xx - F_yy [-], -1 to 1
        fabric_xy
            F_xy [-], -1 to 1; None: 0
        stress_xx, stress_yy
            [Pa], compression positive; both or none
        stress_xy
            [Pa]; None: 0
        conductivity_xx, conductivity_yy
            [W/(m K)], both or none. A packing that conducts better than others of its state keeps doing so
        conductivity_xy
            [W/(m K)]; None: 0

        Raises
        ------
        InvalidArgument
            for a value out of range,
        NonFinite
            for NaN and infinity; the text names column and index.
        """
        shape, columns = aligned(
            {"porosity": porosity, "fabric_index": fabric_index},
            {
                "fabric_xy": fabric_xy,
                "stress_xx": stress_xx,
                "stress_yy": stress_yy,
                "stress_xy": stress_xy,
                "conductivity_xx": conductivity_xx,
                "conductivity_yy": conductivity_yy,
                "conductivity_xy": conductivity_xy,
            },
        )
        initial = InitialStruct(c.sizeof(InitialStruct), _count(shape))
        for name, column in columns.items():
            setattr(initial, name, address(column))
        state = {name: np.empty(shape) for name in self._state_names}
        scales = _scales(material)
        check(library.msdd_surrogate_initial_state(self._handle, scales, c.byref(initial), table(state.values())))
        return state

    def advance(
        self,
        material: Material,
        state: Mapping[str, ArrayLike],
        thermal_strain: ArrayLike,
        *,
        total_thermal_strain: Optional[ArrayLike] = None,
        strain_xx: Optional[ArrayLike] = None,
        strain_yy: Optional[ArrayLike] = None,
        strain_xy: Optional[ArrayLike] = None,
        rotation: Optional[ArrayLike] = None,
        spread: bool = False,
        tangent: bool = False,
    ) -> Step:
        """Takes cells through one step. Arrays of any shapes that broadcast to one; what is given is never changed.

        Parameters
        ----------
        material
            what turns the answers of the model into SI units
        state
            an array for each of `state_names`: a dictionary, or a data frame; other columns are ignored
        thermal_strain
            radial strain of the grains in this step, relative to their present radius, growth positive [-], -1 to 10
        total_thermal_strain
            radial strain since the initial state, this step included [-], -1 to 10; None: `thermal_strain`, which is right for a
            single step from the start. The stress depends on it, because it depends on the present radius
        strain_xx, strain_yy, strain_xy
            strain of the cell in this step, extension positive, applied together with the thermal one [-], -0.2 to 0.2; `strain_xy`
            is twice the shear strain, du_x/dy + du_y/dx; None: 0. Requires `has_tangent`
        rotation
            angle by which the cell turns, (du_y/dx - du_x/dy)/2, counter-clockwise positive [rad]; None: 0. Requires `has_tangent`
        spread
            whether to compute `Step.spread`, too
        tangent
            whether to compute the mechanical tangent, too. Requires `has_tangent`

        Raises
        ------
        InvalidArgument, NonFinite, PluginError
        KeyError
            for a missing column of the state.
        """
        if not hasattr(state, "keys"):
            raise TypeError(f"state is a dictionary of arrays by name, not {type(state).__name__}")
        missing = [name for name in self._state_names if name not in state]
        if missing:
            raise KeyError(f"the state lacks {', '.join(missing)}")
        total = thermal_strain if total_thermal_strain is None else total_thermal_strain
        before = {f"state[{name!r}]": state[name] for name in self._state_names}
        shape, columns = aligned(
            {**before, "thermal_strain": thermal_strain, "total_thermal_strain": total},
            {"strain_xx": strain_xx, "strain_yy": strain_yy, "strain_xy": strain_xy, "rotation": rotation},
        )
        after = {name: np.empty(shape) for name in self._state_names}
        outside = {name: np.empty(shape) for name in (*self._state_names, "thermal_strain")}
        wanted = _ANSWERS + (("spread",) if spread else ())
        answers = {name: np.empty(shape) for name in wanted}
        clamped = np.empty(shape, np.bool_)
        # Arrays and tables live to the end of this function, and so do the addresses in the batch.
        tables = {
            "state": table(columns[name] for name in before),
            "next_state": table(after.values()),
            "outside": table(outside.values()),
        }
        stiffness = np.empty((3, 3, *shape)) if tangent else None
        if stiffness is not None:
            tables["tangent"] = table(stiffness[i, j, ...] for i in range(3) for j in range(3))
        batch = BatchStruct(struct_size=c.sizeof(BatchStruct), cells=_count(shape), clamped=address(clamped))
        for name, pointers in tables.items():
            setattr(batch, name, c.addressof(pointers))
        for name, column in {**columns, **answers}.items():
            if name not in before:
                setattr(batch, name, address(column))
        check(library.msdd_surrogate_advance(self._handle, _scales(material), c.byref(batch)))
        return Step(state=after, outside=outside, clamped=clamped, tangent=stiffness, **answers)

    def solid_fraction(self, porosity: ArrayLike) -> Array:
        """Sum of the areas of the grains over the area of an initial state [-], overlaps counted twice: a fit to the database. The
        bulk density that conserves mass is the density of the grains times this.

        Parameters
        ----------
        porosity
            overlaps counted once [-], 0 to 1
        """
        shape, columns = aligned({"porosity": porosity}, {})
        answer = np.empty(shape)
        given = address(columns["porosity"])
        check(library.msdd_surrogate_solid_fraction(self._handle, _count(shape), given, address(answer)))
        return answer

    def wall_friction(self, material: Material) -> WallFriction:
        """Friction of walls that slip along the grains.

        Raises
        ------
        InvalidArgument
            when the model was not trained with slipping walls.
        """
        limit, slip = c.c_double(), c.c_double()
        check(library.msdd_surrogate_wall_friction(self._handle, _scales(material), c.byref(limit), c.byref(slip)))
        return WallFriction(limit.value, slip.value)


def load_model(source: Union[str, os.PathLike[str]] = "builtin", conductivity: Optional[str] = None) -> Model:
    """Loads a surrogate model. Loading a plug-in runs its code: take none from a stranger.

    Parameters
    ----------
    source
        "builtin", the model that comes with the library; "builtin:paper", the network of the paper; a path of a model file; or
        "plugin:" and the path of a shared library
    conductivity
        "network" or "affine", see `Model.with_conductivity`; None: as the model was made

    Raises
    ------
    FileError, ModelError, PluginError, InvalidArgument
    """
    made = c.c_void_p()
    check(library.msdd_surrogate_load(encoded("source", source), c.byref(made)))
    model = Model._own(made)
    return model if conductivity is None else model.with_conductivity(conductivity)


def _scales(material: Material) -> Any:
    if not isinstance(material, Material):
        raise TypeError(f"material is a msdd.Material, not {type(material).__name__}")
    return c.byref(material._struct())


def _count(shape: tuple[int, ...]) -> int:
    return int(np.prod(shape, dtype=np.int64))
