"""A spinning LiDAR."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from .. import _checks
from ..camera import _pose
from ..scene import Scene
from ..view import View


class Scan(NamedTuple):
    """What lidar gives: E elevations by A azimuths."""

    ranges: np.ndarray
    faces: np.ndarray
    points: np.ndarray


def lidar(scene: Scene, pose: Any, elevations: Any, azimuths: Any, max_range: float = np.inf, min_range: float = 0.0,
          *, threads: int = 0) -> Scan:
    """What a spinning LiDAR measures from one place: the nearest face along each beam, exactly.

    Each ring is a cone of constant elevation: a true circle about the sensor's axis, as the device draws it, not the row
    of a panorama or the polyline of a few pinhole pictures. The sensor's axes are x ahead, y left and z up; a beam goes
    along (cos e cos a, cos e sin a, sin e), so that azimuths run counter-clockwise seen from above. Beams are computed
    in float64 and rounded to float32, which turns them by less than 1e-7 radians.

    Parameters
    ----------
    scene : Scene
    pose : (4, 4) floats
        World from sensor: world = pose @ (x, y, z, 1); a rotation and a place.
    elevations : (E,) floats
        Degrees above the sensor's xy-plane, -90 to 90, one a ring.
    azimuths : (A,) floats
        Degrees.
    max_range, min_range : float
        World units: what is nearer or farther gives no return. What is too near still hides what is behind it.
    threads : int
        0: as many as the process may run at once.

    Returns
    -------
    ranges : (E, A) float32
        World units along the beam; infinity where nothing returns.
    faces : (E, A) int32
        Of the scene; -1 where nothing returns.
    points : (E, A, 3) float32
        World units; NaN where nothing returns.

    Raises
    ------
    TypeError, ValueError
        Naming the argument.

    Examples
    --------
    >>> pose = np.eye(4)
    >>> scan = facemap.lidar(scene, pose, np.linspace(-25, 15, 32), np.arange(0, 360, 0.2), max_range=100)
    >>> cloud = scan.points[scan.faces >= 0]
    """
    matrix = _pose(_checks.transform("pose", pose))
    rings = _degrees("elevations", elevations)
    if rings.size and np.abs(rings).max() > np.pi / 2:
        raise ValueError("elevations: one is none of -90 .. 90")
    turns = _degrees("azimuths", azimuths)
    nearest, farthest = _checks.number("min_range", min_range), _checks.number("max_range", max_range)
    beams = _beams(rings, turns) @ matrix[:3, :3].T
    with np.errstate(over="ignore"):
        origin = _checks.finite("pose", matrix[:3, 3].astype(np.float32))
    face, distance = View(scene, origin, threads).nearest(beams)
    is_lost = (distance > farthest) | (distance < nearest)
    face[is_lost], distance[is_lost] = -1, np.inf
    with np.errstate(invalid="ignore"):
        points = origin + np.where(face < 0, np.nan, distance)[..., np.newaxis] * beams
    return Scan(distance, face, points.astype(np.float32))


def _degrees(name: str, value: Any) -> np.ndarray:
    """Radians in float64 of a row of degrees."""
    found = _checks.array(name, value)
    if found.ndim != 1:
        raise ValueError(f"{name}: the shape is {found.shape}, and (n,) is needed")
    return np.radians(_checks.finite(name, found.astype(np.float64)))


def _beams(elevations: np.ndarray, azimuths: np.ndarray) -> np.ndarray:
    """Unit vectors (E, A, 3) in the sensor's axes."""
    across, up = np.cos(elevations)[:, np.newaxis], np.sin(elevations)[:, np.newaxis]
    one = np.ones_like(azimuths)
    return np.stack([across * np.cos(azimuths), across * np.sin(azimuths), up * one], axis=-1)
