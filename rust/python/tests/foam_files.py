"""Writes files as OpenFOAM does, for the tests of what reads them."""

import gzip
from pathlib import Path

import numpy as np

HEAD = """/*--------------------------------*- C++ -*----------------------------------*\\
  =========    12 (3)                 |
\\*---------------------------------------------------------------------------*/
FoamFile
{{
    version     2.0;
    format      {format};
{more}    class       {kind};
    object      {name};
}}
// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

"""
KINDS = {1: "scalar", 3: "vector", 6: "symmTensor", 9: "tensor"}


def head(path: Path, kind: str, binary: bool = False, more: str = "") -> bytes:
    format = "binary" if binary else "ascii"
    arch = '    arch        "LSB;label=32;scalar=64";\n' if binary else ""
    return HEAD.format(format=format, more=arch + more, kind=kind, name=path.name).encode()


def store(path: Path, data: bytes, compressed: bool = False) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    if compressed:
        path.with_name(path.name + ".gz").write_bytes(gzip.compress(data))
    else:
        path.write_bytes(data)


def listed(values: np.ndarray, binary: bool) -> bytes:
    """A list with its length; of up to ten scalars on one line, as OpenFOAM has it."""
    count = f"{len(values)}".encode()
    if binary:
        return b"\n" + count + b"\n(" + values.tobytes() + b")"
    items = [f"({' '.join(map(repr, row.tolist()))})" if values.ndim > 1 else repr(row.item()) for row in values]
    if len(values) <= 10:
        return count + b"(" + " ".join(items).encode() + b")"
    return b"\n" + count + b"\n(\n" + "\n".join(items).encode() + b"\n)\n"


def write_field(path: Path, values: np.ndarray, binary: bool = False, compressed: bool = False) -> None:
    """A field with values in the cells, and boundary values that are none of them."""
    kind = KINDS[values.shape[1] if values.ndim > 1 else 1]
    data = head(path, f"vol{kind[0].upper()}{kind[1:]}Field", binary) + b"dimensions      [0 0 0 1 0 0 0];\n\n"
    data += f"internalField   nonuniform List<{kind}> ".encode() + listed(values, binary) + b";\n\n"
    data += b"boundaryField\n{\n    left\n    {\n        type    fixedValue;\n        value   uniform (1 (2) 3);\n    }\n}\n"
    store(path, data, compressed)


def write_mesh(case: Path, points: np.ndarray, faces: list, owner: list, neighbour: list, binary: bool = False) -> None:
    """A mesh; the number of cells is in the note of `owner`."""
    mesh = case / "constant/polyMesh"
    store(mesh / "points", head(mesh / "points", "vectorField", binary) + b"\n" + listed(points, binary).lstrip())
    if binary:
        starts = np.cumsum([0, *map(len, faces)]).astype("<i4")
        corners = np.concatenate(faces).astype("<i4")
        data = listed(starts, True) + b"\n" + listed(corners, True)
        store(mesh / "faces", head(mesh / "faces", "faceCompactList", True) + data)
    else:
        lines = [f"{len(face)}({' '.join(map(str, face))})" for face in faces]
        text = f"\n{len(faces)}\n(\n" + "\n".join(lines) + "\n)\n"
        store(mesh / "faces", head(mesh / "faces", "faceList") + text.encode())
    note = f'    note        "nPoints:{len(points)}  nCells:{max(owner) + 1}  nFaces:{len(faces)}";\n'
    for name, labels in (("owner", owner), ("neighbour", neighbour)):
        data = head(mesh / name, "labelList", binary, note) + b"\n" + listed(np.array(labels, "<i4"), binary).lstrip()
        store(mesh / name, data)


def two_cells() -> tuple:
    """A cube and, at its right, a wedge that narrows to an edge: points, faces, owner, neighbour."""
    points = np.array(
        [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)] + [[3, 0, 0], [3, 0, 1]], np.float64
    )
    faces = [
        [1, 3, 7, 5],  # between the two
        [0, 4, 6, 2],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [1, 8, 9, 5],
        [3, 7, 9, 8],
        [1, 3, 8],
        [5, 9, 7],
    ]
    return points, faces, [0, 0, 0, 0, 0, 0, 1, 1, 1, 1], [1]
