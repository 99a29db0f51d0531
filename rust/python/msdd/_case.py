"""Results of a case of msddFoam: summary, probes, tables of function objects, fields."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path
from typing import Any, NamedTuple, Union

import numpy as np

from ._columns import Array
from ._errors import CaseError
from ._foam import open_file, read_internal_field
from ._mesh import listed_regions, mesh_folder
from ._tables import read_joined, time_of

PathLike = Union[str, "os.PathLike[str]"]


class Probes(NamedTuple):
    """What probes saw of a field."""

    times: Array
    """[s], (times,)"""
    positions: Array
    """where the probes are [m], (probes, 3)"""
    values: Array
    """in the field's unit, (times, probes), or (times, probes, components)"""


def read_summary(path: PathLike) -> dict[str, Any]:
    """What the solver says of a run: steps, wall time, model, mean state at the end and more.

    Parameters
    ----------
    path
        folder of a case, whose `postProcessing/msddFoam/summary.json` is read; or a JSON file, such as the `results/summary.json`
        that `scripts/run` writes
    """
    path = Path(path)
    file = path / "postProcessing/msddFoam/summary.json" if path.is_dir() else path
    try:
        summary = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise CaseError(f"{file}: {error}") from error
    if not isinstance(summary, dict):
        raise CaseError(f"{file}: no JSON object")
    return summary


def read_probes(case: PathLike, field: str = "T", name: str = "probes", region: Union[str, None] = None) -> Probes:
    """What a function object of the type probes saw of a field. The files of the present run are joined in the order of time.

    Parameters
    ----------
    case
        folder of the case
    field
        "T" [K] or any that the probes list
    name
        of the function object
    region
        of the function object, if it has one
    """
    table = read_joined(case, _places(name, region), field)
    found = re.findall(r"^# *Probe +\d+ *\(([^()]*)\)", "\n".join(table.head), re.MULTILINE)
    try:
        positions: Array = np.array([where.split() for where in found], np.float64).reshape(len(found), 3)
    except ValueError as error:
        raise CaseError(f"{table.file}: {error}") from None
    if not len(table.rows):
        return Probes(np.zeros(0), positions, np.zeros((0, len(positions))))
    count = table.rows.shape[1] - 1
    if len(positions) == 0 or count == 0 or count % len(positions):
        raise CaseError(f"{table.file}: {count} values in a row, allowed: a multiple of the {len(positions)} probes")
    values = table.rows[:, 1:].reshape(len(table.rows), len(positions), -1)
    return Probes(table.rows[:, 0], positions, values[:, :, 0] if values.shape[2] == 1 else values)


def read_table(case: PathLike, name: str, region: Union[str, None] = None) -> dict[str, Array]:
    """What a function object of this project wrote to `postProcessing`: an array (times,) for each column by its name in the head
    of the file, "Time" [s] first. The files of the present run are joined.

    Parameters
    ----------
    case
        folder of the case
    name
        of the function object in system/controlDict, whatever its type
    region
        of the function object, if it has one
    """
    table = read_joined(case, _places(name, region))
    names = table.head[-1].lstrip("# ").split() if table.head else []
    if not names or names[0] != "Time":
        raise CaseError(f"{table.file}: no line with names of columns, which begins with Time")
    if len(table.rows) and table.rows.shape[1] != len(names):
        raise CaseError(f"{table.file}: {table.rows.shape[1]} values in a row for {len(names)} names of columns")
    return dict(zip(names, table.rows.reshape(-1, len(names)).T))


def _places(name: str, region: Union[str, None]) -> list[str]:
    """Folders in postProcessing of a function object: most put the region before the name, probes after it."""
    return [name] if region is None else [f"{region}/{name}", f"{name}/{region}"]


def time_folders(case: PathLike) -> list[str]:
    """Names of the folders of a case that hold fields, such as "0", "0.5", "20", in the order of time."""
    try:
        names = [entry.name for entry in Path(case).iterdir() if entry.is_dir()]
    except OSError as error:
        raise CaseError(f"{case}: {error}") from error
    return sorted((name for name in names if time_of(name) is not None), key=float)


def read_field(
    case: PathLike, time: Union[str, float] = "latest", field: str = "T", region: Union[str, None] = None
) -> Array:
    """Values of a field in the cells: (cells,), or (cells, components) of a vector (x, y, z), a symmetric tensor (xx, xy, xz, yy,
    yz, zz) or a tensor (xx, xy, xz, yx, yy, ...). A uniform field is filled in over the cells, for which the mesh has to be there.
    Macros such as `$T0` are refused; `foamDictionary -expand` prints their values.

    Parameters
    ----------
    case
        folder of the case; of a parallel run after reconstructPar
    time
        a name as in `time_folders`, a number, or "latest", the last folder with fields
    field
        "T" [K], "porosity", "conductivity" [W/(m K)] and so on. The field "stress" [Pa] is positive in tension. "bed/T" means T of
        the region bed
    region
        required in a case of several regions; None: the region without a name, which is the bed of msddFoam
    """
    if region is None and "/" in field:
        region, field = field.split("/", 1)
    mesh = mesh_folder(case, region)
    folder = Path(case) / _folder(case, time, region or "")
    path = folder / (region or "") / field
    if not path.exists() and not path.with_name(f"{field}.gz").exists():
        raise CaseError(f"{path}: no such file{listed_regions(case)}")
    uniform, values = read_internal_field(open_file(path))
    if not uniform:
        return values
    owner = open_file(mesh / "owner")
    cells = re.search(rb"nCells: *(\d+)", owner.data)
    if cells is None:
        raise owner.wrong("no number of cells in its note")
    return np.tile(values, (int(cells.group(1)), 1)) if values.ndim else np.full(int(cells.group(1)), values)


def _folder(case: PathLike, time: Union[str, float], region: str) -> str:
    folders = time_folders(case)
    if not folders:
        raise CaseError(f"{case}: no folder of a time, such as 0")
    if time == "latest":
        # Passing over folders in which only a function object has left its state.
        whole = [name for name in folders if any(path.is_file() for path in (Path(case) / name / region).glob("*"))]
        return (whole or folders)[-1]
    if isinstance(time, str) and time in folders:
        return time
    wanted = time_of(str(time))
    for name in folders:
        if wanted is not None and abs(float(name) - wanted) <= 1e-9 * abs(wanted):
            return name
    raise CaseError(f"{case}: no time {time}; there are {', '.join(folders)}")
