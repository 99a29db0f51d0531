"""Centres and volumes of the cells of a mesh of OpenFOAM."""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple, Union

import numpy as np
from numpy.typing import NDArray

from ._columns import Array
from ._errors import CaseError
from ._foam import read_faces, read_whole


class Mesh(NamedTuple):
    """Cells of a mesh, in the order of the fields' values."""

    centres: Array
    """centres of the cells [m], (cells, 3)"""
    volumes: Array
    """their volumes [m3], (cells,); of a two-dimensional case the area times the thickness of the mesh"""


def read_mesh(case: Union[str, os.PathLike[str]], region: Union[str, None] = None) -> Mesh:
    """Centres and volumes of the cells of a case, from constant/polyMesh (blockMesh writes it), or of one of its regions, from
    `constant/<region>/polyMesh`.
    """
    folder = mesh_folder(case, region)
    if not folder.is_dir():
        raise CaseError(f"{folder / 'points'}: no such file{listed_regions(case)}")
    points = read_whole(folder / "points", "vector")
    faces = read_faces(folder / "faces")
    owner = read_whole(folder / "owner", "label").astype(np.int64)
    neighbour = read_whole(folder / "neighbour", "label").astype(np.int64)
    corners = np.concatenate(faces) if faces else np.zeros(0, np.int64)
    inside = [(corners, len(points)), (owner, np.inf), (neighbour, np.inf)]
    if len(owner) != len(faces) or len(neighbour) > len(owner) or any(np.any((n < 0) | (n >= m)) for n, m in inside):
        raise CaseError(f"{folder}: points, faces, owner and neighbour do not belong together")
    centres, areas = _faces(points, faces)
    # Each face counts for its owner and, with the area's direction reversed, for the neighbour of an inner face.
    cells = np.concatenate([owner, neighbour])
    count = int(cells.max()) + 1 if cells.size else 0
    centres = np.concatenate([centres, centres[: len(neighbour)]])
    areas = np.concatenate([areas, -areas[: len(neighbour)]])
    # A cell is cut into pyramids from a point inside to its faces; each has its centre at 3/4 of the way to the face.
    faces_of_cell = np.bincount(cells, minlength=count)[:, None]
    middle = _sums(centres, cells, count) / np.maximum(faces_of_cell, 1)
    volume = np.einsum("ij,ij->i", areas, centres - middle[cells]) / 3
    volumes: Array = np.bincount(cells, volume, count).astype(np.float64)
    if np.any(volumes <= 0):
        raise CaseError(f"{folder}: cells without volume, the first is number {int(np.argmax(volumes <= 0))}")
    return Mesh(_sums(volume[:, None] * (0.75 * centres + 0.25 * middle[cells]), cells, count) / volumes[:, None], volumes)


def mesh_folder(case: Union[str, os.PathLike[str]], region: Union[str, None]) -> Path:
    """The folder of a mesh; CaseError for a region that the case does not have."""
    folder = Path(case) / "constant" / (region or "") / "polyMesh"
    if region is not None and not folder.is_dir():
        raise CaseError(f"{folder}: no mesh of a region {region}{listed_regions(case)}")
    return folder


def listed_regions(case: Union[str, os.PathLike[str]]) -> str:
    """For messages: "; regions of the case: bed, wall", or nothing."""
    names = sorted(path.parent.name for path in (Path(case) / "constant").glob("*/polyMesh"))
    return f"; regions of the case, to be named by region=: {', '.join(names)}" if names else ""


def _sums(values: Array, groups: NDArray[np.int64], count: int) -> Array:
    """Sum of the rows of each group."""
    return np.stack([np.bincount(groups, column, count) for column in values.T], axis=1)


def _faces(points: Array, faces: list[NDArray[np.int64]]) -> tuple[Array, Array]:
    """Centres and area vectors of faces, each cut into triangles about the mean of its corners."""
    sizes = np.array([len(face) for face in faces], np.int64)
    if not faces:
        return np.zeros((0, 3)), np.zeros((0, 3))
    group = np.repeat(np.arange(len(faces)), sizes)
    here = points[np.concatenate(faces)]
    there = points[np.concatenate([np.roll(face, -1) for face in faces])]
    middle = (_sums(here, group, len(faces)) / sizes[:, None])[group]
    triangles = 0.5 * np.cross(there - here, middle - here)
    areas = _sums(triangles, group, len(faces))
    normals = areas / np.linalg.norm(areas, axis=1)[:, None]
    weights = np.einsum("ij,ij->i", triangles, normals[group])[:, None]
    weighted = _sums(weights * (here + there + middle) / 3, group, len(faces))
    return weighted / _sums(weights, group, len(faces)), areas
