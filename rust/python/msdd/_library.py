"""Finds libmsdd.so, and says what its functions and structs look like: rust/capi/include/msdd.h for ctypes.

The tests compile these declarations against the header, so that neither can change alone.
"""

from __future__ import annotations

import ctypes as c
import os
from pathlib import Path
from typing import Optional, Union

from ._errors import raise_for

ABI_VERSION = 5
"""Version of the C interface that this package was written for."""

Doubles = c.c_void_p
"""Address of contiguous doubles; 0 or None is NULL."""


def _struct(name: str, *fields: tuple[str, type]) -> type[c.Structure]:
    """A struct of the header, which starts with its own size; all else is 0 or NULL until set."""
    return type(name, (c.Structure,), {"_fields_": [("struct_size", c.c_size_t), *fields]})


def _each(kind: type, names: str) -> list[tuple[str, type]]:
    return [(name, kind) for name in names.split()]


class Column(c.Structure):
    """A column that is read or written: msdd_input and msdd_output."""

    _fields_ = [("values", Doubles), ("stride", c.c_size_t)]


GrainsStruct = _struct(
    "msdd_grains",
    *_each(c.c_double, "conductivity young_modulus radius poisson_ratio roughness hardness"),
    ("gas", c.c_char_p),
    *_each(c.c_double, "gas_pressure accommodation emissivity size_spread"),
)
StartStruct = _struct(
    "msdd_start",
    *_each(c.c_size_t, "cells components"),
    *_each(Column, "porosity fabric_index fabric_xy solid_fraction"),
    *_each(c.c_void_p, "stress conductivity fabric"),
    *_each(Column, "coordination mobilised"),
)
StepStruct = _struct(
    "msdd_step",
    *_each(c.c_size_t, "cells components"),
    ("state", c.c_void_p),
    *_each(Column, "thermal_strain total_thermal_strain"),
    *_each(c.c_void_p, "strain rotation"),
    *_each(Column, "temperature solid_conductivity emissivity"),
    *_each(c.c_void_p, "next_state stress tangent conductivity"),
    *_each(Column, "gas_conductivity radiation_conductivity solid_fraction spread"),
    *_each(c.c_void_p, "distance outside"),
    ("outside_cells", c.c_size_t),
)
SphereWallStruct = _struct(
    "msdd_sphere_wall",
    *_each(c.c_double, "conductivity young_modulus poisson_ratio roughness hardness spheres emissivity"),
)
AveragesStruct = _struct(
    "msdd_averages",
    *_each(c.c_double, "porosity porosity_sum_of_areas fabric_index fabric_conductivity"),
    *_each(c.c_double, "conductivity_xx conductivity_yy conductivity_xy"),
    *_each(c.c_double, "conductivity_network_xx conductivity_network_yy conductivity_network_xy"),
    *_each(c.c_double, "stress_xx stress_yy stress_xy stress_yx pressure coordination mean_radius"),
    *_each(c.c_uint64, "rattlers contacts"),
)

Progress = c.CFUNCTYPE(c.c_int32, c.c_void_p, c.c_uint64, c.c_uint64, c.c_uint64)

_STATUS, _TEXT, _HANDLE = c.c_int32, c.c_char_p, c.c_void_p
_OUT = c.POINTER(c.c_void_p)
_GRAINS = c.POINTER(GrainsStruct)
_COLUMNS = c.POINTER(Column)

# Name: what it returns, what it takes.
SIGNATURES: dict[str, tuple[Optional[type], list[type]]] = {
    "msdd_abi_version": (c.c_uint32, []),
    "msdd_version": (_TEXT, []),
    "msdd_last_error": (_TEXT, []),
    "msdd_text_free": (None, [c.c_void_p]),
    "msdd_model_load": (_STATUS, [_TEXT, _OUT]),
    "msdd_model_with_conductivity": (_STATUS, [_HANDLE, _TEXT, _OUT]),
    "msdd_model_hash": (_TEXT, [_HANDLE]),
    "msdd_model_describe": (_TEXT, [_HANDLE]),
    "msdd_model_state_size": (c.c_size_t, [_HANDLE]),
    "msdd_model_state_name": (_TEXT, [_HANDLE, c.c_size_t]),
    "msdd_model_components": (c.c_size_t, [_HANDLE]),
    "msdd_model_has_tangent": (c.c_int32, [_HANDLE]),
    "msdd_model_wall_friction": (_STATUS, [_HANDLE, _GRAINS, c.POINTER(c.c_double), c.POINTER(c.c_double)]),
    "msdd_model_initial_state": (_STATUS, [_HANDLE, _GRAINS, c.POINTER(StartStruct), _COLUMNS]),
    "msdd_model_advance": (_STATUS, [_HANDLE, _GRAINS, c.POINTER(StepStruct)]),
    "msdd_model_solid_fraction": (_STATUS, [_HANDLE, c.c_size_t, Doubles, Doubles]),
    "msdd_model_free": (None, [_HANDLE]),
    "msdd_wall_resistance": (
        _STATUS,
        [_GRAINS, c.POINTER(SphereWallStruct), c.c_size_t, Doubles, Doubles, Doubles, Doubles],
    ),
    "msdd_rve_pack": (_STATUS, [_TEXT, _OUT]),
    "msdd_rve_from_json": (_STATUS, [_TEXT, _OUT]),
    "msdd_rve_to_json": (_STATUS, [_HANDLE, _OUT]),
    "msdd_rve_clone": (_STATUS, [_HANDLE, _OUT]),
    "msdd_rve_strain": (_STATUS, [_HANDLE, *[c.c_double] * 4, c.POINTER(c.c_int32)]),
    "msdd_rve_homogenise": (_STATUS, [_HANDLE, c.POINTER(AveragesStruct)]),
    "msdd_rve_free": (None, [_HANDLE]),
    "msdd_database_generate": (_STATUS, [_TEXT, _TEXT, c.c_uint32, Progress, c.c_void_p]),
    "msdd_database_export_csv": (_STATUS, [_TEXT, _TEXT, c.POINTER(c.c_uint64)]),
    "msdd_train": (_STATUS, [_TEXT, _OUT]),
    "msdd_compared": (_STATUS, [_TEXT, _TEXT, c.POINTER(c.c_double), c.POINTER(c.c_double)]),
    "msdd_gas_conductivity": (_STATUS, [_TEXT, c.c_double, c.POINTER(c.c_double)]),
    "msdd_gas_properties": (_STATUS, [_TEXT, c.c_double, c.POINTER(c.c_double)]),
}


def _candidates() -> list[Path]:
    """Where the library may be: named by MSDD_LIBRARY, else next to this file, else where cargo leaves it in a checkout."""
    named = os.environ.get("MSDD_LIBRARY")
    if named:
        return [Path(named).resolve()]
    here = Path(__file__).resolve()
    found = [here.with_name("libmsdd.so")]
    checkout = here.parents[3] if len(here.parents) > 3 else None
    if checkout and (checkout / "rust/capi/include/msdd.h").is_file():
        target = Path(os.environ.get("CARGO_TARGET_DIR") or checkout / "target")
        found.append((checkout / target / "release/libmsdd.so").resolve())
    return found


def _load() -> tuple[c.CDLL, Path]:
    candidates = _candidates()
    path = next((path for path in candidates if path.is_file()), None)
    if path is None:
        tried = ", ".join(str(path) for path in candidates)
        raise ImportError(
            f"msdd: no library at {tried}: run `cargo build --release` in the checkout, or name the file in MSDD_LIBRARY"
        )
    try:
        library = c.CDLL(str(path))
        library.msdd_abi_version.restype = c.c_uint32
        abi = library.msdd_abi_version()
    except (OSError, AttributeError) as error:
        raise ImportError(f"msdd: {path} is not a libmsdd.so: {error}") from error
    if abi != ABI_VERSION:
        raise ImportError(
            f"msdd: {path} has version {abi} of the C interface, this package needs {ABI_VERSION}: "
            "take package and library from the same checkout"
        )
    for name, (returns, takes) in SIGNATURES.items():
        function = getattr(library, name)
        function.restype, function.argtypes = returns, takes
    return library, path


library, library_path = _load()
version: str = library.msdd_version().decode()


def check(status: int) -> None:
    """Raises the exception of a status other than 0, with the library's text."""
    if status != 0:
        raise_for(status, library.msdd_last_error().decode("utf-8", "replace"))


def encoded(name: str, text: Union[str, os.PathLike[str]]) -> bytes:
    """A text or path for C, which ends at the first NUL."""
    try:
        plain = os.fspath(text)
    except TypeError:
        raise TypeError(f"{name} is a text or a path, not {type(text).__name__}") from None
    if not isinstance(plain, str):
        raise TypeError(f"{name} is a text or a path, not {type(text).__name__}")
    if "\0" in plain:
        raise ValueError(f"{name} holds a NUL character")
    return plain.encode("utf-8", "surrogateescape")


class Handle:
    """Owns what the library made, and gives it back when Python does not need it any more: there is no closing by hand,
    hence nothing that could be used after it."""

    __slots__ = ("_as_parameter_", "_free")

    def __init__(self, made: c.c_void_p, free: str) -> None:
        self._as_parameter_ = made
        # Kept here, for at the end of the program the module's names may be gone first.
        self._free = getattr(library, free)

    def __del__(self) -> None:
        self._free(self._as_parameter_)

    def __reduce__(self) -> tuple[object, ...]:
        raise TypeError("what the library holds in memory can be neither copied nor pickled")
