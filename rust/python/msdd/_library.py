"""Finds libmsdd.so, and says what its functions and structs look like: rust/capi/include/msdd.h for ctypes.

The tests compile these declarations against the header, so that neither can change alone.
"""

from __future__ import annotations

import ctypes as c
import os
from pathlib import Path
from typing import Optional, Union

from ._errors import raise_for

ABI_VERSION = 4
"""Version of the C interface that this package was written for."""

Doubles = c.c_void_p
"""Address of contiguous doubles; 0 or None is NULL."""


def _struct(name: str, *fields: tuple[str, type]) -> type[c.Structure]:
    """A struct of the header, which starts with its own size; all else is 0 or NULL until set."""
    return type(name, (c.Structure,), {"_fields_": [("struct_size", c.c_size_t), *fields]})


def _each(kind: type, names: str) -> list[tuple[str, type]]:
    return [(name, kind) for name in names.split()]


MaterialStruct = _struct("msdd_material", *_each(c.c_double, "thermal_conductivity young_modulus mean_radius"))
InitialStruct = _struct(
    "msdd_initial",
    ("cells", c.c_size_t),
    *_each(Doubles, "porosity fabric_index fabric_xy stress_xx stress_yy stress_xy"),
    *_each(Doubles, "conductivity_xx conductivity_yy conductivity_xy"),
)
BatchStruct = _struct(
    "msdd_batch",
    ("cells", c.c_size_t),
    *_each(Doubles, "state thermal_strain total_thermal_strain strain_xx strain_yy strain_xy rotation"),
    *_each(Doubles, "next_state conductivity_xx conductivity_yy conductivity_xy stress_xx stress_yy stress_xy"),
    *_each(Doubles, "tangent clamped outside spread"),
    ("clamped_cells", c.c_size_t),
)
SphereMaterialStruct = _struct(
    "msdd_sphere_material",
    *_each(c.c_double, "diameter young_modulus poisson_ratio conductivity roughness hardness"),
    ("gas", c.c_char_p),
    *_each(c.c_double, "gas_pressure accommodation emissivity size_spread"),
)
SphereWallStruct = _struct(
    "msdd_sphere_wall",
    *_each(c.c_double, "conductivity young_modulus poisson_ratio roughness hardness spheres emissivity"),
)
SphereBatchStruct = _struct(
    "msdd_sphere_batch",
    ("cells", c.c_size_t),
    *_each(Doubles, "state thermal_strain strain rotation temperature solid_conductivity emissivity"),
    *_each(Doubles, "next_state stress tangent conductivity gas_conductivity radiation_conductivity solid_fraction outside"),
    ("outside_cells", c.c_size_t),
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
_MATERIAL = c.POINTER(MaterialStruct)
_SPHERES = c.POINTER(SphereMaterialStruct)

# Name: what it returns, what it takes.
SIGNATURES: dict[str, tuple[Optional[type], list[type]]] = {
    "msdd_abi_version": (c.c_uint32, []),
    "msdd_version": (_TEXT, []),
    "msdd_last_error": (_TEXT, []),
    "msdd_text_free": (None, [c.c_void_p]),
    "msdd_surrogate_load": (_STATUS, [_TEXT, _OUT]),
    "msdd_surrogate_with_conductivity": (_STATUS, [_HANDLE, _TEXT, _OUT]),
    "msdd_surrogate_hash": (_TEXT, [_HANDLE]),
    "msdd_surrogate_describe": (_TEXT, [_HANDLE]),
    "msdd_surrogate_state_size": (c.c_size_t, [_HANDLE]),
    "msdd_surrogate_state_name": (_TEXT, [_HANDLE, c.c_size_t]),
    "msdd_surrogate_has_tangent": (c.c_int32, [_HANDLE]),
    "msdd_surrogate_wall_friction": (_STATUS, [_HANDLE, _MATERIAL, c.POINTER(c.c_double), c.POINTER(c.c_double)]),
    "msdd_surrogate_initial_state": (_STATUS, [_HANDLE, _MATERIAL, c.POINTER(InitialStruct), _OUT]),
    "msdd_surrogate_advance": (_STATUS, [_HANDLE, _MATERIAL, c.POINTER(BatchStruct)]),
    "msdd_surrogate_solid_fraction": (_STATUS, [_HANDLE, c.c_size_t, Doubles, Doubles]),
    "msdd_surrogate_free": (None, [_HANDLE]),
    "msdd_spheres_load": (_STATUS, [_TEXT, _OUT]),
    "msdd_spheres_hash": (_TEXT, [_HANDLE]),
    "msdd_spheres_describe": (_TEXT, [_HANDLE]),
    "msdd_spheres_state_size": (c.c_size_t, [_HANDLE]),
    "msdd_spheres_state_name": (_TEXT, [_HANDLE, c.c_size_t]),
    "msdd_spheres_initial_state": (_STATUS, [_HANDLE, _SPHERES, c.c_size_t, Doubles, _OUT, Doubles, Doubles, _OUT, _OUT]),
    "msdd_spheres_advance": (_STATUS, [_HANDLE, _SPHERES, c.POINTER(SphereBatchStruct)]),
    "msdd_spheres_free": (None, [_HANDLE]),
    "msdd_spheres_wall_resistance": (
        _STATUS,
        [_SPHERES, c.POINTER(SphereWallStruct), c.c_size_t, Doubles, Doubles, Doubles, Doubles],
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
    "msdd_compared": (_STATUS, [_TEXT, _TEXT, c.POINTER(c.c_double), c.POINTER(c.c_double)]),
    "msdd_gas_conductivity": (_STATUS, [_TEXT, c.c_double, c.POINTER(c.c_double)]),
    "msdd_gas_properties": (_STATUS, [_TEXT, c.c_double, c.POINTER(c.c_double)]),
}


def _candidates() -> list[Path]:
    """Where the library may be: named by MSDD_LIBRARY, else beside this file, else where cargo leaves it in a checkout."""
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
