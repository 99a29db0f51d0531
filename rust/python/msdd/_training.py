"""Training of models on databases of boxes."""

from __future__ import annotations

import ctypes as c
import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Optional, Union

from ._library import check, encoded, library
from ._model import Model, load_model

PathLike = Union[str, "os.PathLike[str]"]


def train(
    database: Union[PathLike, Sequence[PathLike]],
    out: PathLike,
    *,
    model: str = "increment",
    name: Optional[str] = None,
    seed: int = 1,
    restarts: Optional[int] = None,
    epochs: Optional[int] = None,
    patience: Optional[int] = None,
    fix: Optional[Mapping[str, float]] = None,
    threads: int = 0,
) -> Model:
    """Trains a model as `msdd train` does, writes its file and loads it.

    Parameters
    ----------
    database
        databases, or CSVs exported from them, all together; for spheres also folders of beds of DEM
    out
        model file to write (JSON)
    model
        kind: "constant", "paper", "increment" or "spheres"
    name
        of the model; by default its kind
    seed
        of the split into training and held-out packings
    restarts, epochs, patience
        as the options of `msdd train`
    fix
        parameters of the law of spheres that keep their values, for example `{"lode": 0.45}`
    threads
        0: one per core. The result does not depend on it

    Raises
    ------
    InvalidArgument, FileError, ModelError
        for data or options that cannot be used; nothing is written then.
    """
    files = [database] if isinstance(database, (str, os.PathLike)) else database
    request = {
        "database": [os.fspath(file) for file in files],
        "model": model,
        "name": name,
        "seed": seed,
        "restarts": restarts,
        "epochs": epochs,
        "patience": patience,
        "fix": dict(fix or {}),
        "threads": threads,
    }
    text = c.c_void_p()
    check(library.msdd_train(encoded("request", json.dumps(request)), c.byref(text)))
    try:
        model_file = c.string_at(text.value or 0)
    finally:
        library.msdd_text_free(text)
    beside = Path(f"{os.fspath(out)}.part")
    beside.write_bytes(model_file)
    beside.replace(out)
    return load_model(out)
