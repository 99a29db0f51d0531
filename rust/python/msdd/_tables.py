"""Files of function objects: which of them are those of the present run, and their rows joined over its parts."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path
from typing import NamedTuple, Union

import numpy as np

from ._columns import Array
from ._errors import CaseError

LIST = "postProcessing/msddFoam/tables.json"
SCHEMA = "msdd-tables-1"

_TIME = re.compile(r"\d+(\.\d+)?([eE][+-]?\d+)?")


class Table(NamedTuple):
    file: Path
    """of the last part of the run"""
    head: list[str]
    """its lines that begin with #"""
    rows: Array
    """of all parts, in the order of time, without brackets, (rows, columns)"""


def time_of(name: str) -> Union[float, None]:
    """The time that a folder's name stands for; None of other folders."""
    return float(name) if _TIME.fullmatch(name) else None


def read_joined(case: Union[str, os.PathLike[str]], names: list[str], file: Union[str, None] = None) -> Table:
    """A table of a function object, whose folder in postProcessing is one of `names`; of the name `file`, or its only one.

    Rows from the start of a later part of the run on are those of that part. Raises CaseError.
    """
    table: Union[Table, None] = None
    for start, path in _parts(Path(case), names, file):
        try:
            lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]
        except (OSError, ValueError) as error:
            raise CaseError(f"{path}: {error}") from error
        head = [line for line in lines if line.lstrip().startswith("#")]
        rows = _numbers(path, [line for line in lines if not line.lstrip().startswith("#")])
        if table is not None and lines and (table.head or len(table.rows)):
            widths = {part.shape[1] for part in (rows, table.rows) if len(part)}
            if len(widths) > 1 or _columns(head) != _columns(table.head):
                raise CaseError(f"{path}: other points or columns than in {table.file}")
            first = rows[0, 0] if len(rows) else np.inf
            kept = [row for row in table.rows if row[0] <= start and row[0] < first]
            rows = np.array([*kept, *rows]).reshape(len(kept) + len(rows), max(widths, default=0))
        table = Table(path, head, rows) if table is None or lines else table
    assert table is not None
    return table


def _parts(case: Path, names: list[str], file: Union[str, None]) -> list[tuple[float, Path]]:
    """The files of a function object in the parts of the run, in the order of time, with the start of each."""
    post = case / "postProcessing"
    found = _listed(case, [post / name for name in names])
    for name in names:
        found = found or _unlisted(post / name)
    bases = sorted({_base(path) for _, path in found})
    if file is None and len(bases) > 1:
        raise CaseError(f"{post / names[0]}: several tables: {', '.join(bases)}")
    wanted = file or "".join(bases)
    # Of files of one start the last counts.
    parts = {start: path for start, path in found if _base(path) == wanted}
    if not parts:
        raise CaseError(f"{post / names[0]}: no {wanted or 'table'} in it")
    return list(parts.items())


def _listed(case: Path, folders: list[Path]) -> list[tuple[float, Path]]:
    """Those in the solver's list; none without a list."""
    file = case / LIST
    if not file.exists():
        return []
    try:
        content = json.loads(file.read_text(encoding="utf-8"))
        if content["schema"] != SCHEMA:
            raise CaseError(f"{file}: schema {content['schema']!r}, allowed: {SCHEMA}")
        paths = [(float(run["start"]), case / "postProcessing" / name) for run in content["runs"] for name in run["files"]]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise error if isinstance(error, CaseError) else CaseError(f"{file}: {error!r}") from error
    return [(start, path) for start, path in paths if path.parent.parent in folders]


def _unlisted(folder: Path) -> list[tuple[float, Path]]:
    """All files by the folders of the starts; of one folder, the file that was changed last at the end."""
    starts = [path for path in folder.iterdir() if time_of(path.name) is not None] if folder.is_dir() else []
    files = [(float(start.name), file) for start in starts for file in start.iterdir() if file.is_file()]
    return sorted(files, key=lambda part: (part[0], part[1].stat().st_mtime_ns))


def _base(path: Path) -> str:
    """The name that a file has where no other was there before: OpenFOAM adds the start to the name of a second one."""
    stem = path.stem.removesuffix(f"_{path.parent.name}") if path.suffix == ".dat" else path.stem
    return stem + path.suffix


def _columns(head: list[str]) -> list[list[str]]:
    """Points and names of columns in a head."""
    words = [line.lstrip("# ").split() for line in head]
    return [line for line in words if line and line[0] in ("Probe", "Time")]


def _numbers(file: Path, lines: list[str]) -> Array:
    rows = [line.replace("(", " ").replace(")", " ").split() for line in lines]
    if any(len(row) != len(rows[0]) for row in rows):
        raise CaseError(f"{file}: rows of different lengths; is the run still writing?")
    try:
        return np.array(rows, np.float64).reshape(len(rows), len(rows[0]) if rows else 0)
    except ValueError as error:
        raise CaseError(f"{file}: {error}") from None
