"""What of a terrain is seen."""

from __future__ import annotations

from typing import Any, Callable, Dict, Optional

import numpy as np

from .. import _checks
from ..scene import Scene
from ..view import View, _tolerance, visibility
from . import _arrays
from .ground import on_ground


def viewshed(terrain: Scene, observers: Any, points: Any = None, *, of: str = "vertices", eye_height: float = 1.7,
             target_height: float = 0.0, stand: bool = True, max_distance: Optional[float] = None, each: bool = False,
             faces: Any = None, tolerance: float = 0.0, up: Any = None, threads: int = 0,
             progress: Optional[Callable[[float, str], Any]] = None) -> np.ndarray:
    """From how many observers each vertex, point or face of a terrain is seen.

    Exact for the float32 numbers given: a vertex is not hidden by the faces that it belongs to, and grazing lines of
    sight are decided, not guessed. A straight line of sight is meant: the earth's curve and refraction are not in it,
    but may be in the heights.

    Parameters
    ----------
    terrain : Scene
        ``facemap.terrain`` makes one of a grid of heights; any scene will do.
    observers : (..., 3) floats
        World units.
    points : (..., 3) floats
        What is looked at; None: what `of` says.
    of : "vertices" or "faces"
        A face is seen if any part of it is, with a direction to show for it (View.visible_faces, which leaves few faces
        undecided: these do not count as seen).
    eye_height : float
        World units: how high the observers' eyes are above the ground, or above `observers` if they do not stand.
    target_height : float
        World units that vertices or points are lifted before they are looked at; what stands on the ground. Not for
        faces.
    stand : bool
        Whether observers stand on the ground under or over them, whatever height they are given; one without ground is
        a ValueError. Finding it takes time that grows with observers times faces, as on_ground does.
    max_distance : float
        World units, 0 or more: what is farther from an observer's eye does not count. Not for faces. None: no limit.
    each : bool
        Whether to tell of each observer, instead of counting them.
    faces, tolerance
        As of View.visible, for `points` that lie on the terrain up to rounding.
    up : three floats
        None: as the scene's file says, else (0, 1, 0).
    threads, progress
        As of visibility; progress is not told of faces.

    Returns
    -------
    Number of observers, int32, of shape (N,) for vertices, (M,) for faces, or the points'; with `each` bool, of the
    observers' shape and then that one. Vertices that belong to no face are not seen.

    Raises
    ------
    TypeError, ValueError
        Naming the argument.

    Examples
    --------
    >>> counts = facemap.viewshed(land, [[250, 0, 100], [400, 0, 300]], eye_height=1.7)
    >>> seen = counts.reshape(50, 80) > 0
    """
    _checks.core_of(terrain, "terrain")
    middle = _arrays.up_of(terrain, up)
    eyes, shape = _eyes(terrain, observers, _checks.finite_number("eye_height", eye_height),
                        _checks.truth("stand", stand), middle)
    lift = _checks.finite_number("target_height", target_height)
    _checks.choice("of", of, ("vertices", "faces"))
    _checks.truth("each", each)
    _checks.progress(progress)
    reach = _checks.optional(_distance, "max_distance", max_distance)
    options = dict(tolerance=_tolerance(tolerance), threads=_checks.threads(threads))
    if points is None and faces is not None:
        raise ValueError("faces: they are for points, and none are given")
    if points is None and of == "faces":
        if lift != 0 or reach is not None:
            raise ValueError("of: faces take no target_height and no max_distance")
        rows = (View(terrain, eye, threads).visible_faces().visible for eye in eyes)
        return _gathered(rows, shape, (terrain.face_count,), each)
    flat, targets_shape = _arrays.points_of(terrain.vertices if points is None else points)
    targets = flat if lift == 0 else _lifted("target_height", flat, lift, middle)
    own = None if points is None else _arrays.flat_faces(faces, targets_shape, terrain.face_count)
    rows = _rows(terrain, eyes, targets, reach, dict(faces=own, **options), progress)
    if points is None:
        is_used = np.zeros(len(flat), np.bool_)
        is_used[terrain.faces.reshape(-1)] = True
        rows = (row & is_used for row in rows)
    return _gathered(rows, shape, targets_shape, each)


def _distance(name: str, value: Any) -> float:
    found = _checks.number(name, value)
    if found < 0:
        raise ValueError(f"{name}: {found} is below 0")
    return found


def _eyes(terrain: Scene, observers: Any, height: float, stand: bool, up: np.ndarray) -> Any:
    flat, shape = _arrays.points_of(observers, "observers")
    if not stand:
        return _lifted("eye_height", flat, height, up), shape
    eyes = on_ground(terrain, flat, height, up=up)
    lost = np.isnan(eyes).any(axis=-1)
    if lost.any():
        raise ValueError(f"observers: there is no ground under or over {flat[lost][0].tolist()}; stand=False takes "
                         "observers where they are")
    return _checks.finite("eye_height", eyes), shape


def _lifted(name: str, points: np.ndarray, height: float, up: np.ndarray) -> np.ndarray:
    with np.errstate(over="ignore"):
        return _checks.finite(name, (points + height * up).astype(np.float32))


def _rows(terrain: Scene, eyes: np.ndarray, targets: np.ndarray, reach: Optional[float],
          options: Dict[str, Any], progress: Any) -> Any:
    """What each eye sees, one after the other."""
    for part in _arrays.blocks(len(eyes), len(targets)):
        told = _arrays.part_of(progress, part, len(eyes))
        packed = visibility(terrain, eyes[part], targets, packed=True, progress=told, **options)
        for eye, row in zip(eyes[part], packed):
            seen = _arrays.bools(row, len(targets))
            if reach is not None:
                offset = targets.astype(np.float64) - eye
                seen = seen & (np.einsum("ij,ij->i", offset, offset) <= reach * reach)
            yield seen


def _gathered(rows: Any, observers_shape: Any, targets_shape: Any, each: bool) -> np.ndarray:
    if each:
        return np.array(list(rows), np.bool_).reshape(observers_shape + targets_shape)
    count = np.zeros(int(np.prod(targets_shape)), np.int32)
    for row in rows:
        count += row
    return count.reshape(targets_shape)
