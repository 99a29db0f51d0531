"""Arrays of the caller as the library wants them: contiguous doubles of one shape, copied only where they are not."""

from __future__ import annotations

import ctypes as c
from collections.abc import Iterable, Mapping
from typing import Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._library import Column

Array = NDArray[np.float64]
State = dict[str, Array]
"""State of cells: an array for each name in `Model.state_names`, all of one shape."""


def _numbers(name: str, values: ArrayLike) -> NDArray[np.generic]:
    """An array of real numbers of any kind, or a TypeError that names the column."""
    try:
        array = np.asarray(values)
    except ValueError as error:  # ragged lists
        raise TypeError(f"{name} is not an array of numbers: {error}") from None
    if array.dtype.kind not in "buif":
        raise TypeError(f"{name} is not an array of real numbers: its type is {array.dtype}")
    if isinstance(values, np.ma.MaskedArray) and np.any(values.mask):
        raise TypeError(f"{name} has masked values: fill them first")
    return array


def aligned(
    needed: Mapping[str, ArrayLike], optional: Mapping[str, Optional[ArrayLike]]
) -> tuple[tuple[int, ...], dict[str, Array]]:
    """The arrays broadcast to their common shape, as contiguous doubles, without those that are None and may be. An array
    that is all of that already is passed on as it is, without a copy."""
    arrays = {name: _numbers(name, values) for name, values in needed.items()}
    arrays.update({name: _numbers(name, values) for name, values in optional.items() if values is not None})
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise ValueError(f"columns of shapes that do not go together: {shapes}") from None
    # Aligned to 8 bytes, too, which a field of a packed record is not.
    return shape, {
        name: np.require(np.broadcast_to(array, shape), np.float64, ["C", "A"]) for name, array in arrays.items()
    }


def address(array: NDArray[np.generic]) -> int:
    """Where an array begins; it has to live as long as the address is used."""
    return array.ctypes.data


def column(array: NDArray[np.generic]) -> Column:
    """A contiguous array as a column of the library; it has to live as long as the column is used."""
    return Column(address(array), 1)


def table(arrays: Iterable[NDArray[np.generic]]) -> c.Array[Column]:
    """Several columns, for an `msdd_input *` or `msdd_output *`."""
    columns = [column(array) for array in arrays]
    return (Column * len(columns))(*columns)


def components(name: str, values: ArrayLike, names: tuple[str, ...], isotropic: bool = False) -> dict[str, ArrayLike]:
    """The components of a tensor or vector by name, from a list of as many arrays or an array with them along its first axis;
    with `isotropic` also from a single number, which is then that of the normal components."""
    count = len(names)
    if np.ndim(values) == 0 and (isotropic or count == 1):
        return {f"{name}_{key}": (values if key in ("xx", "yy", "zz", "z") else 0.0) for key in names}
    if not isinstance(values, (list, tuple, np.ndarray)) or len(values) != count:
        number = "a number, or " if isotropic else ""
        raise ValueError(f"{name} is {number}{count} components, {', '.join(names)}, along its first axis")
    return {f"{name}_{key}": values[index] for index, key in enumerate(names)}


def count(shape: tuple[int, ...]) -> int:
    """Number of cells of a shape."""
    return int(np.prod(shape, dtype=np.int64))
