"""How long the sun shines."""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np

from .. import _checks
from ..scene import Scene
from ..view import visibility_along
from . import _arrays


def sun_hours(scene: Scene, points: Any, sun_directions: Any, hours: Any = None, normals: Any = None, *,
              up: Any = None, faces: Any = None, tolerance: float = 0.0, threads: int = 0,
              progress: Optional[Callable[[float, str], Any]] = None) -> np.ndarray:
    """For how long the sun shines on each point.

    The sun is one infinitely far point; whether it is seen is exact. It counts nothing at or below the horizon, which is
    the plane across `up`: a model of a landscape ends, and what shines from below its edge does not count.

    Parameters
    ----------
    scene : Scene
    points : (..., 3) floats
        World units.
    sun_directions : (..., 3) floats
        From the points to the sun, at as many times as there are; of any length but 0.
    hours : float or (...) floats
        How long each of the sun's positions stands for, 0 or more; or one for all. None: an hour each.
    normals : (..., 3) floats
        Of surfaces at the points, one each or one for all: the sun counts only in front of them. None: from all sides.
    up : three floats
        None: as the scene's file says, else (0, 1, 0).
    faces, tolerance
        As of View.visible: where points lie on surfaces up to rounding.
    threads, progress
        As of visibility.

    Returns
    -------
    (...) float64, in the unit of `hours`.

    Raises
    ------
    TypeError, ValueError, IndexError
        Naming the argument.

    Examples
    --------
    >>> angles = np.radians(np.arange(15, 180, 15))                     # an hour apart, at an equinox on the equator
    >>> suns = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    >>> shone = facemap.sun_hours(scene, scene.vertices, suns)
    """
    flat, shape = _arrays.points_of(points)
    surface = _arrays.normals_of(normals, shape)
    own = _arrays.flat_faces(faces, shape, _checks.core_of(scene).face_count)
    suns, suns_shape = _arrays.directions_of("sun_directions", sun_directions)
    lengths = _hours(hours, suns_shape)
    is_up = suns.astype(np.float64) @ _arrays.up_of(scene, up) > 0
    suns, lengths = suns[is_up], lengths[is_up]
    total = np.zeros(len(flat))
    for part in _arrays.blocks(len(suns), len(flat)):
        rows = visibility_along(scene, suns[part], flat, packed=True, faces=own, tolerance=tolerance, threads=threads,
                                progress=_arrays.part_of(progress, part, len(suns)))
        for sun, length, row in zip(suns[part].astype(np.float64), lengths[part], rows):
            shines = _arrays.bools(row, len(flat))
            total += length * (shines if surface is None else shines & _arrays.is_in_front(surface, sun))
    return total.reshape(shape)


def _hours(value: Any, shape: Any) -> np.ndarray:
    found = _checks.finite("hours", _checks.array("hours", 1.0 if value is None else value).astype(np.float64))
    if found.shape not in ((), shape):
        raise ValueError(f"hours: the shape is {found.shape}, and {shape} is needed, one a position of the sun")
    if found.size and found.min() < 0:
        raise ValueError(f"hours: {found.min()} is below 0")
    return np.broadcast_to(found, shape).reshape(-1)
