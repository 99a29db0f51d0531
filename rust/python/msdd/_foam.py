"""OpenFOAM's files as numpy arrays: ascii and binary, also compressed; lists of numbers, vectors and tensors."""

from __future__ import annotations

import gzip
import re
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._errors import CaseError

COMPONENTS = {"scalar": 1, "vector": 3, "sphericalTensor": 1, "symmTensor": 6, "tensor": 9, "label": 1}

_HEADER = re.compile(rb"FoamFile\s*\{(.*?)\}", re.DOTALL)
_COMMENT = re.compile(rb"/\*.*?\*/|//[^\n]*", re.DOTALL)


class FoamFile(NamedTuple):
    """A file of OpenFOAM, and what its header says of the numbers in it."""

    path: Path
    data: bytes
    binary: bool
    real: np.dtype[Any]
    label: np.dtype[Any]

    def wrong(self, what: str) -> CaseError:
        return CaseError(f"{self.path}: {what}")


def open_file(path: Path) -> FoamFile:
    """Reads a file, or the same with .gz."""
    packed = path.with_name(path.name + ".gz")
    try:
        data = gzip.decompress(packed.read_bytes()) if packed.is_file() and not path.exists() else path.read_bytes()
    except (OSError, EOFError) as error:
        raise CaseError(f"{path}: {error}") from error
    header = _HEADER.search(data)
    text = header.group(1) if header else b""
    binary = re.search(rb"\bformat\s+binary\s*;", text) is not None
    if not binary:
        data = _COMMENT.sub(b" ", data)
    order = ">" if b"MSB" in text else "<"
    real = re.search(rb"scalar=(\d+)", text)
    label = re.search(rb"label=(\d+)", text)
    width = int(real.group(1)) // 8 if real else 8
    whole = int(label.group(1)) // 8 if label else 4
    return FoamFile(path, data, binary, np.dtype(f"{order}f{width}"), np.dtype(f"{order}i{whole}"))


def numbers(file: FoamFile, text: bytes) -> NDArray[np.float64]:
    """All numbers of a text with or without brackets."""
    if b"$" in text:
        macro = text[text.find(b"$") :].split()[0].decode(errors="replace")
        raise file.wrong(f"{macro} is a macro, allowed: numbers; 'foamDictionary -expand {file.path.name}' prints them")
    try:
        return np.array(text.translate(bytes.maketrans(b"()", b"  ")).split(), np.float64)
    except ValueError as error:
        raise file.wrong(f"no list of numbers: {error}") from None


def read_list(file: FoamFile, kind: str, start: int = 0) -> tuple[NDArray[np.float64], int]:
    """The list that begins at `start` with its length, of one of `COMPONENTS`, and where it ends: an array (length,), or
    (length, components). Labels come as doubles, which hold every one exactly."""
    head = re.compile(rb"\s*(\d+)\s*([({])").match(file.data, start)
    if head is None:
        raise file.wrong(f"no list of {kind} where one should be")
    count, width, begin = int(head.group(1)), COMPONENTS[kind], head.end()
    if head.group(2) == b"{":
        end = file.data.find(b"}", begin)
        values = np.tile(numbers(file, file.data[begin:end]), count)
    elif file.binary:
        item = file.label if kind == "label" else file.real
        end = begin + count * width * item.itemsize
        if end >= len(file.data):
            raise file.wrong(f"ends before its list of {count} {kind} does")
        values = np.frombuffer(file.data[begin:end], item).astype(np.float64)
    else:
        close = re.compile(rb"\)\s*\)" if width > 1 and count > 0 else rb"\)").search(file.data, begin)
        if close is None:
            raise file.wrong(f"ends before its list of {count} {kind} does")
        end = close.end() - 1
        values = numbers(file, file.data[begin:end])
    if values.size != count * width:
        raise file.wrong(f"{values.size} numbers in a list of {count} {kind}")
    return (values if width == 1 else values.reshape(count, width)), end + 1


def read_internal_field(file: FoamFile) -> tuple[bool, NDArray[np.float64]]:
    """Whether the values in the cells are uniform, and the value, () or (components,), or values, (cells,) or
    (cells, components)."""
    macro = re.search(rb"\binternalField\s+\$[^;]*", file.data)
    if macro is not None:
        numbers(file, macro.group(0))
    entry = re.search(rb"\binternalField\s+(uniform|nonuniform)\s*", file.data)
    if entry is None:
        raise file.wrong("no internalField (one that another file includes is not looked for)")
    if entry.group(1) == b"uniform":
        end = file.data.find(b";", entry.end())
        value = numbers(file, file.data[entry.end() : end])
        return True, (value[0] if value.size == 1 else value)
    head = re.compile(rb"List<(\w+)>").match(file.data, entry.end())
    kind = head.group(1).decode() if head else ""
    if head is None or kind not in COMPONENTS:
        raise file.wrong(f"a field of {kind or 'something unknown'} cannot be read")
    return False, read_list(file, kind, head.end())[0]


def first_list(file: FoamFile) -> int:
    """Where the list of a file that holds nothing else begins."""
    header = _HEADER.search(file.data)
    begin = re.compile(rb"^\d+\s*[({]", re.MULTILINE).search(file.data, header.end() if header else 0)
    if begin is None:
        raise file.wrong("no list in it")
    return begin.start()


def read_whole(path: Path, kind: str) -> NDArray[np.float64]:
    """The list of a file that holds nothing else, as `read_list` gives it."""
    file = open_file(path)
    return read_list(file, kind, first_list(file))[0]


def read_faces(path: Path) -> list[NDArray[np.int64]]:
    """Point numbers of each face of a mesh."""
    file = open_file(path)
    begin = first_list(file)
    if file.binary:
        starts, end = read_list(file, "label", begin)
        corners, _ = read_list(file, "label", end)
        return np.split(corners.astype(np.int64), starts[1:-1].astype(np.int64)) if starts.size > 1 else []
    count, flat = (part.astype(np.int64) for part in np.split(numbers(file, file.data[begin:]), [1]))
    faces: list[NDArray[np.int64]] = []
    at = 0
    for _ in range(count[0]):
        if at >= flat.size or flat[at] < 3 or at + flat[at] >= flat.size:
            raise file.wrong(f"no list of {count[0]} faces")
        faces.append(flat[at + 1 : at + 1 + flat[at]])
        at += int(flat[at]) + 1
    return faces
