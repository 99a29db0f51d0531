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

    path: the folder of a case, whose postProcessing/msddFoam/summary.json is read; or a JSON file, such as the
        results/summary.json that scripts/run writes. Raises CaseError.
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


def read_probes(case: PathLike, field: str = "T", name: str = "probes") -> Probes:
    """What the function object `name` (type probes) of a case saw of a field. A restarted run is joined to what came before.

    case: folder of the case. field: "T" [K] or any that the probes list. Raises CaseError.
    """
    times, values, positions = np.zeros(0), None, np.zeros((0, 3))
    for start, file in _outputs(case, name, field):
        text = _text(file)
        found = re.findall(r"^# *Probe +\d+ *\(([^()]*)\)", text, re.MULTILINE)
        positions = _table(file, [where.split() for where in found], 3)
        rows = [line.replace("(", " ").replace(")", " ").split() for line in _rows(text)]
        if not rows:
            continue
        table = _table(file, rows, None)
        if len(positions) == 0 or table.shape[1] == 1 or (table.shape[1] - 1) % len(positions):
            raise CaseError(f"{file}: {len(positions)} probes do not go with {table.shape[1] - 1} values a row")
        new = table[:, 1:].reshape(len(rows), len(positions), -1)
        if values is None:
            values = new[:0]
        if values.shape[1:] != new.shape[1:]:
            raise CaseError(f"{file}: other probes than before the restart")
        kept = times <= start
        times, values = np.append(times[kept], table[:, 0]), np.concatenate([values[kept], new])
    if values is None:
        values = np.zeros((0, len(positions), 1))
    return Probes(times, positions, values[:, :, 0] if values.shape[2] == 1 else values)


def read_table(case: PathLike, name: str) -> dict[str, Array]:
    """What a function object of ours (massAudit, heatAudit, wallPressure, spaceProbes, ...) wrote: an array (times,) for each
    column by its name, "Time" [s] first. A restarted run is joined to what came before.

    case: folder of the case. name: of the function object in system/controlDict, whatever its type. Raises CaseError.
    """
    table: dict[str, Array] = {}
    for start, file in _outputs(case, name, _table_name(case, name)):
        text = _text(file)
        comments = [line for line in text.splitlines() if line.startswith("#")]
        names = comments[-1][1:].split() if comments else []
        if not names or names[0] != "Time":
            raise CaseError(f"{file}: no line with names of columns, which begins with Time")
        columns = dict(zip(names, _table(file, [line.split() for line in _rows(text)], len(names)).T))
        if table and list(table) != names:
            raise CaseError(f"{file}: other columns than before the restart")
        kept = table["Time"] <= start if table else np.zeros(0, np.bool_)
        table = {name: np.concatenate([table[name][kept], new]) if table else new for name, new in columns.items()}
    return table


def _table_name(case: PathLike, name: str) -> str:
    """The file that a function object writes: it is named after its type, which its name need not be."""
    folder = Path(case) / "postProcessing" / name
    starts = time_folders(folder) if folder.is_dir() else []
    tables = [(start, file) for start in starts for file in (folder / start).glob("*.dat")]
    # Where a run is repeated, OpenFOAM writes a second file beside the first, and adds the time to its name.
    files = {file.name for start, file in tables if not file.stem.endswith(f"_{start}")}
    if len(files) > 1 and f"{name}.dat" not in files:
        raise CaseError(f"{folder}: several tables: {', '.join(sorted(files))}")
    return files.pop() if len(files) == 1 else f"{name}.dat"


def time_folders(case: PathLike) -> list[str]:
    """Names of the folders of a case that hold fields, such as "0", "0.5", "20", in the order of time."""
    try:
        names = [entry.name for entry in Path(case).iterdir() if entry.is_dir()]
    except OSError as error:
        raise CaseError(f"{case}: {error}") from error
    return sorted((name for name in names if _time(name) is not None), key=float)


def read_field(case: PathLike, time: Union[str, float] = "latest", field: str = "T") -> Array:
    """Values of a field in the cells, at a time that was written: (cells,), or (cells, components) of a vector (x, y, z), a
    symmetric tensor (xx, xy, xz, yy, yz, zz) or a tensor (xx, xy, xz, yx, yy, ...). A uniform field is filled in.

    case: folder of the case; of a parallel run after reconstructPar. time: as in `time_folders`, a number, or "latest".
    field: "T" [K], "porosity", "conductivity" [W/(m K)] ... Mind that OpenFOAM's field "stress" [Pa] is tension positive,
    unlike all else here. Ascii and binary, compressed or not. Raises CaseError.
    """
    folder = Path(case) / _folder(case, time)
    uniform, values = read_internal_field(open_file(folder / field))
    if not uniform:
        return values
    owner = open_file(Path(case) / "constant/polyMesh/owner")
    cells = re.search(rb"nCells: *(\d+)", owner.data)
    if cells is None:
        raise owner.wrong("no number of cells in its note")
    return np.tile(values, (int(cells.group(1)), 1)) if values.ndim else np.full(int(cells.group(1)), values)


def _folder(case: PathLike, time: Union[str, float]) -> str:
    folders = time_folders(case)
    if not folders:
        raise CaseError(f"{case}: no folder of a time, such as 0")
    if time == "latest":
        return folders[-1]
    if isinstance(time, str) and time in folders:
        return time
    wanted = _time(str(time))
    for name in folders:
        if wanted is not None and abs(float(name) - wanted) <= 1e-9 * abs(wanted):
            return name
    raise CaseError(f"{case}: no time {time}; there are {', '.join(folders)}")


def _time(name: str) -> Union[float, None]:
    """The time that a folder's name stands for; None of other folders."""
    return float(name) if re.fullmatch(r"\d+(\.\d+)?([eE][+-]?\d+)?", name) else None


def _outputs(case: PathLike, name: str, file: str) -> list[tuple[float, Path]]:
    """The files of a function object, one for each start of the solver, with the time of the start."""
    folder = Path(case) / "postProcessing" / name
    starts = time_folders(folder) if folder.is_dir() else []
    found = [(float(start), folder / start / file) for start in starts if (folder / start / file).is_file()]
    if not found:
        raise CaseError(f"{folder}: no {file} in it")
    return found


def _text(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        raise CaseError(f"{file}: {error}") from error


def _rows(text: str) -> list[str]:
    return [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]


def _table(file: Path, rows: list[list[str]], width: Union[int, None]) -> Array:
    """Rows of numbers of one length."""
    width = (len(rows[0]) if rows else 1) if width is None else width
    if any(len(row) != width for row in rows):
        raise CaseError(f"{file}: rows of different lengths; is the run still writing?")
    try:
        return np.array(rows, np.float64).reshape(len(rows), width)
    except ValueError as error:
        raise CaseError(f"{file}: {error}") from None
