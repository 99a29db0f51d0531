"""Databases of boxes: made, exported, and opened as a pandas data frame."""

from __future__ import annotations

import csv
import ctypes as c
import json
import os
import signal
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Callable, Optional, Union

from ._library import Progress, check, encoded, library

if TYPE_CHECKING:
    import pandas

PathLike = Union[str, "os.PathLike[str]"]


def generate_database(
    plan: PathLike,
    database: PathLike,
    *,
    threads: int = 1,
    progress: Optional[Callable[[int, int, int], object]] = None,
) -> None:
    """Makes the database of a plan, or goes on with one that was begun: packs boxes, strains and averages them.

    Parameters
    ----------
    plan
        path of a plan, a TOML file
    database
        path of the file to write
    threads
        1 to 1024
    progress
        a function, called as `progress(done, total, failed)` after each packing. An exception in it, or Ctrl-C, stops the
        generation; what was made until then is kept

    Raises
    ------
    InvalidArgument, FileError, RveError
        also for a plan that is none, and a database of another plan.
    """
    text = Path(plan).read_text(encoding="utf-8")
    raised: list[BaseException] = []

    def hear(_: Optional[int], done: int, total: int, failed: int) -> int:
        try:
            if progress is not None and not raised:
                progress(done, total, failed)
        except BaseException as error:  # nothing may pass through the library
            raised.append(error)
        return len(raised)

    arguments = encoded("plan", text), encoded("database", database), _threads(threads)
    with _interrupts_kept(raised):
        status = library.msdd_database_generate(*arguments, Progress(hear), None)
    if raised:
        raise raised[0]
    check(status)


@contextmanager
def _interrupts_kept(raised: list[BaseException]) -> Iterator[None]:
    """Ctrl-C is put into the list. Python would raise it when a function begins that the library calls, where nothing can
    catch it, and it would be lost."""
    main = threading.current_thread() is threading.main_thread()
    if not main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return
    signal.signal(signal.SIGINT, lambda *_: raised.append(KeyboardInterrupt()))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _threads(threads: int) -> int:
    """ctypes takes a number modulo 2^32 without a word."""
    if not isinstance(threads, int) or not 1 <= threads <= 1024:
        raise ValueError(f"threads is a whole number from 1 to 1024, not {threads!r}")
    return threads


def export_database(database: PathLike, csv: PathLike) -> int:
    """Writes a database as CSV, compressed if the name ends in `.gz`, and next to it `FILE.columns.csv` (units and meaning of the
    columns) and `FILE.provenance.json`. The answer is the number of rows.

    Raises
    ------
    FileError, RveError
    """
    rows = c.c_uint64()
    check(library.msdd_database_export_csv(encoded("database", database), encoded("csv", csv), c.byref(rows)))
    return rows.value


def read_database(path: PathLike) -> pandas.DataFrame:
    """Opens a database, or the CSV of one, as a pandas data frame with a row for each state of each packing. `frame.attrs` holds
    the dictionaries "units" and "meaning" of the columns, and the "provenance".

    Raises
    ------
    ImportError
        without pandas;
    FileError, RveError
    FileNotFoundError
        when a CSV lacks the files next to it.
    """
    try:
        import pandas  # noqa: F401  (asked first: an export can take seconds)
    except ImportError as error:
        raise ImportError(
            "msdd.read_database needs pandas: install it (apt install python3-pandas, or pip install pandas), "
            "or write a CSV by msdd.export_database"
        ) from error
    path = Path(path)
    if _stem(path) is not None:
        return _read_csv(path)
    with tempfile.TemporaryDirectory(prefix="msdd-") as folder:
        exported = Path(folder) / "database.csv"
        export_database(path, exported)
        return _read_csv(exported)


def _stem(path: Path) -> Optional[str]:
    """Name of a CSV without its ending; None of any other file."""
    for ending in (".csv.gz", ".csv"):
        if path.name.endswith(ending):
            return path.name[: -len(ending)]
    return None


def _read_csv(path: Path) -> pandas.DataFrame:
    import pandas

    # Up to 3.0, pandas rounds every fourth number in the last bit unless told not to; later it warns of being told.
    old = tuple(map(int, pandas.__version__.split(".")[:2])) < (3, 1)
    frame = pandas.read_csv(path, low_memory=False, **({"float_precision": "round_trip"} if old else {}))
    with open(path.with_name(f"{_stem(path)}.columns.csv"), newline="", encoding="utf-8") as file:
        columns = list(csv.DictReader(file))
    frame.attrs["units"] = {column["name"]: column["unit"] for column in columns}
    frame.attrs["meaning"] = {column["name"]: column["meaning"] for column in columns}
    provenance = path.with_name(f"{_stem(path)}.provenance.json").read_text(encoding="utf-8")
    frame.attrs["provenance"] = json.loads(provenance)
    return frame
