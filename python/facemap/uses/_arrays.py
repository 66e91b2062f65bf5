"""Arguments that several uses have."""

from __future__ import annotations

import math
from typing import Any, Callable, Iterator, Optional, Tuple

import numpy as np

from .. import _checks

_BLOCK_BYTES = 1 << 26
"""Of answers that are held at once."""


def up_of(scene: Any, up: Any) -> np.ndarray:
    """The unit vector that points up: as given, else as the scene's file says, else y; float64."""
    found = scene.up if up is None else _checks.direction("up", up)
    return unit(np.array(found or (0.0, 1.0, 0.0)))


def unit(vectors: np.ndarray) -> np.ndarray:
    """Vectors of length 1 in float64; zero stays zero."""
    vectors = np.asarray(vectors, np.float64)
    largest = np.abs(vectors).max(axis=-1, keepdims=True, initial=0)
    scaled = vectors / np.where(largest > 0, largest, 1)
    length = np.sqrt((scaled * scaled).sum(axis=-1, keepdims=True))
    return scaled / np.where(length > 0, length, 1)


def points_of(value: Any, name: str = "points") -> Tuple[np.ndarray, Tuple[int, ...]]:
    """Finite rows (n, 3) of float32, and the shape of what is said of each."""
    found = _checks.finite(name, _checks.floats(name, value))
    return found.reshape(-1, 3), found.shape[:-1]


def normals_of(value: Any, shape: Tuple[int, ...]) -> Optional[np.ndarray]:
    """Rows (n, 3) of float32 numbers in float64, one a point, as long as they are given; None if there are none."""
    if value is None:
        return None
    found = _checks.finite("normals", _checks.floats("normals", value))
    if found.shape not in (shape + (3,), (3,)):
        raise ValueError(f"normals: the shape is {found.shape}, and {shape + (3,)} is needed, one a point")
    if not found.any(axis=-1).all():
        raise ValueError("normals: the zero vector is no normal")
    return np.broadcast_to(found, shape + (3,)).reshape(-1, 3).astype(np.float64)


def is_in_front(normals: np.ndarray, towards: np.ndarray, places: Any = 0.0) -> np.ndarray:
    """Whether normal . (towards - place) is above 0, row by row: exact for float32 numbers, here in float64.

    Products of two such numbers are exact. Their sum is off by at most 5 x 2^-53 times the sum of their magnitudes;
    where that leaves its sign open, math.fsum rounds it once.
    """
    terms = np.concatenate(np.broadcast_arrays(normals * towards, -normals * places), axis=-1)
    total = terms.sum(axis=-1)
    is_open = np.abs(total) <= 2.0**-50 * np.abs(terms).sum(axis=-1)
    total[is_open] = [math.fsum(row) for row in terms[is_open]]
    return total > 0


def directions_of(name: str, value: Any) -> Tuple[np.ndarray, Tuple[int, ...]]:
    """The same of directions: rows of float32, none of them zero."""
    found, shape = points_of(value, name)
    if not found.any(axis=-1).all():
        raise ValueError(f"{name}: the zero vector is no direction")
    return found, shape


def flat_faces(faces: Any, shape: Tuple[int, ...], count: int) -> Optional[np.ndarray]:
    """The faces that points lie on, one a point, as visibility takes them for flat points."""
    if faces is None:
        return None
    found = _checks.indices("faces", faces, count, least=-1)
    if found.shape != shape:
        raise ValueError(f"faces: the shape is {found.shape}, and {shape} is needed, one a point")
    return found.reshape(-1)


def blocks(rows: int, points: int) -> Iterator[slice]:
    """Slices of 0 .. rows - 1, of which the packed answers about so many points stay within some memory."""
    size = max(1, _BLOCK_BYTES // ((points + 7) // 8 + 1))
    for first in range(0, rows, size):
        yield slice(first, min(first + size, rows))


def bools(row: np.ndarray, points: int) -> np.ndarray:
    """A packed row as booleans."""
    return np.unpackbits(row, count=points, bitorder="little").view(np.bool_)


def part_of(progress: Optional[Callable[[float, str], Any]], part: slice, rows: int) -> Any:
    """What tells `progress` of a part of the rows as a part of all."""
    _checks.progress(progress)
    if progress is None:
        return None
    return lambda fraction, word: progress((part.start + fraction * (part.stop - part.start)) / rows, word)
