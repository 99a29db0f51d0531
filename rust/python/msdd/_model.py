"""Models: what cells of a granular bed do when their grains are heated."""

from __future__ import annotations

import ctypes as c
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._columns import Array, State, address, aligned, column, components, count, table
from ._library import Handle, StartStruct, StepStruct, check, encoded, library
from ._material import AnyMaterial, Material, SphereMaterial, scales

PLANE = ("xx", "yy", "xy")
"""Order of the components of stress, strain and conductivity of discs, along the first axis of their arrays."""
SPACE = ("xx", "yy", "zz", "xy", "xz", "yz")
"""Order of the components of stress, strain and conductivity of spheres."""


class WallFriction(NamedTuple):
    """Friction of a wall after the slip s [m] is `limit * s / (s + slip)`."""

    limit: float
    """friction coefficient of a wall that has slipped far [-]"""
    slip: float
    """slip at which half of it is mobilised [m]"""


@dataclass(frozen=True, eq=False)
class Step:
    """Cells after a step. Tensors have their components along the first axis, in the order of `Model.components`, then the shape
    of the cells; `stress_xx`, `conductivity_xy` and so on are single components."""

    components: tuple[str, ...]
    """names of the components of tensors"""
    state: State
    """state after the step, a dictionary as before: an array [-] for each of `Model.state_names`"""
    stress: Array
    """sigma [Pa], compression positive"""
    conductivity: Array
    """K [W/(m K)]; of spheres of contacts, gas and radiation together"""
    outside: NDArray[np.bool_]
    """True where an input is outside of the range of the training; of spheres jamming fraction, pressure or stress ratio after the
    step, or the number of the gas"""
    distance: Optional[State] = None
    """of discs: how far outside, for each of `Model.state_names` and "thermal_strain", in that input's own unit: negative below the
    range, positive above, 0 inside"""
    gas_conductivity: Optional[Array] = None
    """of spheres: the part of K by the gas [W/(m K)], its mean over directions: there is more of it where contacts point"""
    radiation_conductivity: Optional[Array] = None
    """of spheres: the part of K by radiation between the spheres, equal in all directions [W/(m K)]"""
    solid_fraction: Optional[Array] = None
    """of spheres: their volume over the volume [-]"""
    spread: Optional[Array] = None
    """relative standard deviation of K between boxes of equal state [-], NaN if the model does not give it; None unless asked for"""
    tangent: Optional[Array] = None
    """-d sigma_i/d strain_j [Pa], in the order of the components: 3 x 3 or 6 x 6 and then the shape of the cells; None unless asked
    for. Where grains slide it is not symmetric"""

    def __getattr__(self, name: str) -> Array:
        quantity, _, component = name.rpartition("_")
        if quantity in ("stress", "conductivity") and component in self.components:
            tensor: Array = getattr(self, quantity)
            return tensor[self.components.index(component), ...]
        raise AttributeError(f"a step has no {name}")


class Model:
    """A model of discs, of spheres or of a plug-in, made by `load_model`. It never changes, and several threads may use it at once:
    other threads of Python run while it computes. It cannot be pickled. Porosity counts overlaps of grains once.
    """

    __slots__ = ("_handle", "_state_names", "_components")

    _handle: Handle
    _state_names: tuple[str, ...]
    _components: tuple[str, ...]

    def __init__(self) -> None:
        raise TypeError("models are made by msdd.load_model")

    @classmethod
    def _own(cls, made: c.c_void_p) -> Model:
        self = object.__new__(cls)
        self._handle = Handle(made, "msdd_model_free")
        size = library.msdd_model_state_size(self._handle)
        names = (library.msdd_model_state_name(self._handle, column) for column in range(size))
        self._state_names = tuple(name.decode() for name in names)
        self._components = SPACE if library.msdd_model_components(self._handle) == len(SPACE) else PLANE
        return self

    def __repr__(self) -> str:
        return f"<msdd.Model {self.info.get('name', 'spheres')!r} {self.hash[:12]}>"

    @property
    def hash(self) -> str:
        """SHA-256 of the model file or plug-in, 64 hexadecimal digits."""
        text: bytes = library.msdd_model_hash(self._handle)
        return text.decode()

    @property
    def info(self) -> dict[str, Any]:
        """Of discs kind, name, state, conductivities, scores, and the database of the training; of spheres the model file."""
        description: dict[str, Any] = json.loads(library.msdd_model_describe(self._handle))
        return description

    @property
    def trained_range(self) -> dict[str, tuple[float, float]]:
        """Of discs: least and largest value of each input in the training, beyond which `Step.outside` is set: porosity [-],
        fabric_index [-], thermal_strain [-] and, of a model that carries stress, fabric, jamming_fraction, elastic_compression,
        elastic_shear [-] and pressure (reduced as the state is). Empty for spheres and for a plug-in, which does not give it."""
        ranges = self.info.get("trained_range") or {}
        return {name: (ends["min"], ends["max"]) for name, ends in ranges.items()}

    @property
    def state_names(self) -> tuple[str, ...]:
        """Names of the columns of a state; the first two of discs are "porosity" and "fabric_index" (F_xx - F_yy)."""
        return self._state_names

    @property
    def components(self) -> tuple[str, ...]:
        """Names of the components of stress, strain and conductivity: xx, yy, xy of discs, xx, yy, zz, xy, xz, yz of spheres."""
        return self._components

    @property
    def has_tangent(self) -> bool:
        """Whether the model answers mechanical strains, and has a mechanical tangent."""
        return bool(library.msdd_model_has_tangent(self._handle))

    @property
    def _in_space(self) -> bool:
        return self._components == SPACE

    def _scales(self, material: AnyMaterial) -> Any:
        return scales(material, SphereMaterial if self._in_space else Material)

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
        check(library.msdd_model_with_conductivity(self._handle, encoded("kind", kind), c.byref(made)))
        return Model._own(made)

    def initial_state(
        self,
        material: AnyMaterial,
        porosity: ArrayLike,
        fabric_index: ArrayLike = 0.0,
        *,
        fabric_xy: Optional[ArrayLike] = None,
        stress: Optional[ArrayLike] = None,
        conductivity: Optional[ArrayLike] = None,
        fabric: Optional[ArrayLike] = None,
        coordination: Optional[ArrayLike] = None,
        mobilised: Optional[ArrayLike] = None,
    ) -> State:
        """State of cells at the start, an array for each of `state_names`. What is not given is the mean of usual packings. Arrays
        of any shapes that broadcast to one; the state has that shape.

        Parameters
        ----------
        material
            `Material` of discs, `SphereMaterial` of spheres
        porosity
            overlaps counted once [-], 0 to 1; of spheres 0.2 to 0.7
        fabric_index, fabric_xy
            of discs: F_xx - F_yy and F_xy [-], -1 to 1; None: 0
        stress
            [Pa], compression positive: one number or array, the pressure; or the components in a list or along the first axis.
            Needed for spheres, which just do not touch under no pressure
        conductivity
            of discs [W/(m K)], as the stress. A packing that conducts better than others of its state keeps doing so
        fabric
            of spheres: mean of n n over the contacts, with the normals n: six components [-], -1 to 1; None: as in usual packings
        coordination
            of spheres: contacts per sphere, all spheres counted [-], 0 to 12; None: as in a periodic box with this porosity, stress
            and mobilised friction. Beds under gravity have about 0.4 more
        mobilised
            of spheres: mobilised part of the friction [-], 0 to 1; 0.84 to 0.93 in beds that were poured; None: 0.85

        Raises
        ------
        InvalidArgument
            for a value out of range,
        NonFinite
            for NaN and infinity; the text names column and index.
        """
        given = self._scales(material)
        tensors = {
            name: {} if values is None else components(name, values, self._components, isotropic=name != "fabric")
            for name, values in {"stress": stress, "conductivity": conductivity, "fabric": fabric}.items()
        }
        shape, columns = aligned(
            {"porosity": porosity, "fabric_index": fabric_index, **tensors["stress"]},
            {
                "fabric_xy": fabric_xy,
                "coordination": coordination,
                "mobilised": mobilised,
                **tensors["conductivity"],
                **tensors["fabric"],
            },
        )
        if self._in_space:
            columns["solid_fraction"] = np.require(1.0 - columns.pop("porosity"), np.float64, ["C"])
        start = StartStruct(struct_size=c.sizeof(StartStruct), cells=count(shape), components=len(self._components))
        # Arrays and tables live to the end of this function, and so do the addresses in the struct.
        tables = {name: table(columns[key] for key in keys) for name, keys in tensors.items() if keys}
        _fill(start, tables, columns)
        state = {name: np.empty(shape) for name in self._state_names}
        check(library.msdd_model_initial_state(self._handle, given, c.byref(start), table(state.values())))
        return state

    def advance(
        self,
        material: AnyMaterial,
        state: Mapping[str, ArrayLike],
        thermal_strain: ArrayLike = 0.0,
        *,
        total_thermal_strain: Optional[ArrayLike] = None,
        strain: Optional[ArrayLike] = None,
        rotation: Optional[ArrayLike] = None,
        temperature: Optional[ArrayLike] = None,
        solid_conductivity: Optional[ArrayLike] = None,
        emissivity: Optional[ArrayLike] = None,
        spread: bool = False,
        tangent: bool = False,
    ) -> Step:
        """Takes cells through one step. Arrays of any shapes that broadcast to one; what is given is never changed.

        Parameters
        ----------
        material
            `Material` of discs, `SphereMaterial` of spheres
        state
            an array for each of `state_names`: a dictionary, or a data frame; other columns are ignored
        thermal_strain
            radial strain of the grains in this step, relative to their present radius, growth positive [-], above -1, to 10; of
            spheres above -0.2, to 0.2
        total_thermal_strain
            of discs: radial strain since the initial state, this step included [-], -1 to 10; None: `thermal_strain`, which is right
            for a single step from the start. The stress depends on it, because it depends on the present radius
        strain
            components of the strain of the cell in this step, in a list or along the first axis, extension positive [-], above -0.2,
            to 0.2; shears are du_x/dy + du_y/dx and so on, twice those of the tensor; None: 0. Requires `has_tangent`
        rotation
            angle by which the cell turns, half of the curl of the displacement [rad]: in the plane one number or array,
            counter-clockwise positive, in space three components; None: 0. Requires `has_tangent`
        temperature
            of spheres: of the gas [K], 0 to 1e5; None: 293.15
        solid_conductivity
            of spheres [W/(m K)], 1e-12 to 1e12; None: as in the material
        emissivity
            of spheres, 0 to 1; None: as in the material
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
        given = self._scales(material)
        before = {f"state[{name!r}]": state[name] for name in self._state_names}
        strains = {} if strain is None else components("strain", strain, self._components)
        axes = ("x", "y", "z") if self._in_space else ("z",)
        angles = {} if rotation is None else components("rotation", rotation, axes)
        total = thermal_strain if total_thermal_strain is None and not self._in_space else total_thermal_strain
        shape, columns = aligned(
            {**before, "thermal_strain": thermal_strain, **strains, **angles},
            {
                "total_thermal_strain": total,
                "temperature": temperature,
                "solid_conductivity": solid_conductivity,
                "emissivity": emissivity,
            },
        )
        number = len(self._components)
        after = {name: np.empty(shape) for name in self._state_names}
        tensors = {name: np.empty((number, *shape)) for name in ("stress", "conductivity")}
        stiffness = np.empty((number, number, *shape)) if tangent else None
        outside = np.empty(shape, np.bool_)
        tables = {name: table(tensor[i, ...] for i in range(number)) for name, tensor in tensors.items()}
        tables["next_state"] = table(after.values())
        for name, keys in (("state", before), ("strain", strains), ("rotation", angles)):
            if keys:
                tables[name] = table(columns[key] for key in keys)
        if stiffness is not None:
            tables["tangent"] = table(stiffness[i, j, ...] for i in range(number) for j in range(number))
        wanted = ["gas_conductivity", "radiation_conductivity", "solid_fraction"] if self._in_space else []
        answers = {name: np.empty(shape) for name in wanted + (["spread"] if spread else [])}
        distance = None
        if not self._in_space:
            distance = {name: np.empty(shape) for name in (*self._state_names, "thermal_strain")}
            tables["distance"] = table(distance.values())
        step = StepStruct(
            struct_size=c.sizeof(StepStruct), cells=count(shape), components=number, outside=address(outside)
        )
        # Arrays and tables live to the end of this function, and so do the addresses in the struct.
        _fill(step, tables, {**columns, **answers})
        check(library.msdd_model_advance(self._handle, given, c.byref(step)))
        return Step(
            components=self._components,
            state=after,
            outside=outside,
            distance=distance,
            tangent=stiffness,
            **tensors,
            **answers,
        )

    def solid_fraction(self, porosity: ArrayLike) -> Array:
        """Sum of the areas (volumes) of the grains over that of an initial state [-], overlaps counted twice: of discs a fit to the
        database, of spheres 1 - porosity. The bulk density that conserves mass is the density of the grains times this.

        Parameters
        ----------
        porosity
            overlaps counted once [-], 0 to 1
        """
        shape, columns = aligned({"porosity": porosity}, {})
        answer = np.empty(shape)
        given = address(columns["porosity"])
        check(library.msdd_model_solid_fraction(self._handle, count(shape), given, address(answer)))
        return answer

    def wall_friction(self, material: Material) -> WallFriction:
        """Friction of walls that slip along the grains.

        Raises
        ------
        InvalidArgument
            when the model was not trained with slipping walls.
        """
        limit, slip = c.c_double(), c.c_double()
        check(library.msdd_model_wall_friction(self._handle, self._scales(material), c.byref(limit), c.byref(slip)))
        return WallFriction(limit.value, slip.value)


def load_model(source: Union[str, os.PathLike[str]] = "builtin", conductivity: Optional[str] = None) -> Model:
    """Loads a model. Loading a plug-in runs its code: take none from a stranger.

    Parameters
    ----------
    source
        "builtin", the model of discs that comes with the library; "builtin:paper", the network of the paper; "builtin:spheres", the
        model of spheres with gas between them; a path of a model file; or "plugin:" and the path of a shared library
    conductivity
        of discs: "network" or "affine", see `Model.with_conductivity`; None: as the model was made

    Raises
    ------
    FileError, ModelError, PluginError, InvalidArgument
    """
    made = c.c_void_p()
    check(library.msdd_model_load(encoded("source", source), c.byref(made)))
    model = Model._own(made)
    return model if conductivity is None else model.with_conductivity(conductivity)


def _fill(struct: Any, tables: Mapping[str, Any], columns: dict[str, Array]) -> None:
    """Sets the tables and columns of a struct by their names; columns that it does not have belong to a table."""
    members = {name for name, _ in struct._fields_}
    for name, pointers in tables.items():
        setattr(struct, name, c.addressof(pointers))
    for name in members & columns.keys():
        setattr(struct, name, column(columns[name]))
