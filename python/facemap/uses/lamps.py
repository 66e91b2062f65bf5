"""What lamps reach."""

from __future__ import annotations

from typing import Any, Callable, List, NamedTuple, Optional, Tuple

import numpy as np

from .. import _checks
from ..light import Light
from ..scene import Scene
from ..view import visibility, visibility_along
from . import _arrays

_LEAST_RIM = 0.001
"""A spot's rim is at least so wide, in cosines, as docs/lights.md has it."""


class Coverage(NamedTuple):
    """What lamp_coverage gives."""

    lit: np.ndarray
    irradiance: np.ndarray


def lamp_coverage(scene: Scene, points: Any, lamps: Any, normals: Any = None, *, faces: Any = None,
                  tolerance: float = 0.0, threads: int = 0,
                  progress: Optional[Callable[[float, str], Any]] = None) -> Coverage:
    """Which lamps reach each point, and the direct irradiance there, by inverse square and cosine.

    What stands between is exact, as View.visible has it. Where a lamp with a place reaches a point at distance d, it
    adds color * intensity * cos / d^2, times a spot's cone and a range's window as docs/lights.md has them; a
    directional light adds color * intensity * cos. With intensities in candela and metres this is lux. cos is that of
    the angle between normal and lamp; a lamp behind the surface does not reach it.

    Parameters
    ----------
    scene : Scene
        Its own lights are not asked.
    points : (..., 3) floats
        World units.
    lamps : sequence of Light, or (n, 3) floats
        Points are lamps of intensity 1 there.
    normals : (..., 3) floats
        Of surfaces at the points, one each or one for all, of any length but 0. None: each lamp is faced, cos is 1.
    faces, tolerance
        As of View.visible: where points lie on surfaces up to rounding.
    threads, progress
        As of visibility.

    Returns
    -------
    lit : (n, ...) bool
        Whether lamp i reaches a point, from in front of its normal if it has one: exact but for the rims of spots and
        ranges. A point at the very place of a lamp lies in no direction from it: no spot's cone holds it, and with a
        normal it is not lit. Without both it is, and the lamp's colours get an irradiance of infinity.
    irradiance : (..., 3) float64
        Linear RGB of all lamps together.

    Raises
    ------
    TypeError, ValueError, IndexError
        Naming the argument.

    Examples
    --------
    >>> lit, irradiance = facemap.lamp_coverage(scene, scene.vertices, [facemap.Light((0, 2, 3), intensity=800)])
    >>> dark = ~lit.any(axis=0)
    """
    flat, shape = _arrays.points_of(points)
    surface = _arrays.normals_of(normals, shape)
    own = _arrays.flat_faces(faces, shape, _checks.core_of(scene).face_count)
    lights = _lights(lamps)
    lit = _reached(scene, lights, flat, dict(faces=own, tolerance=tolerance, threads=threads, progress=progress))
    irradiance = np.zeros((len(flat), 3))
    for i, light in enumerate(lights):
        share, is_reached = _share(light, flat.astype(np.float64), surface)
        lit[i] &= is_reached
        irradiance += _times(np.where(lit[i], share, 0)[:, np.newaxis], np.array(light.color) * light.intensity)
    return Coverage(lit.reshape((len(lights),) + shape), irradiance.reshape(shape + (3,)))


def _lights(lamps: Any) -> List[Any]:
    """The library's own lights, whose values are checked."""
    if isinstance(lamps, Light):
        lamps = [lamps]
    try:
        found = list(lamps)
    except TypeError as error:
        raise TypeError(f"lamps: lights or places are needed, not {type(lamps).__name__}") from error
    if not any(isinstance(lamp, Light) for lamp in found):
        found = [Light(place) for place in _checks.finite("lamps", _checks.rows("lamps", lamps)).tolist()] if found else []
    for lamp in found:
        if not isinstance(lamp, Light):
            raise TypeError(f"lamps: a Light is needed, not {type(lamp).__name__}")
    return [lamp._core() for lamp in found]


def _reached(scene: Scene, lights: List[Any], points: np.ndarray, options: Any) -> np.ndarray:
    """(lights, points) bool: nothing stands between."""
    is_far = np.array([light.kind.name == "directional" for light in lights], np.bool_)
    near = np.array([light.position for light in lights], np.float32).reshape(-1, 3)[~is_far]
    far = -np.array([light.direction for light in lights], np.float32).reshape(-1, 3)[is_far]
    lit = np.zeros((len(lights), len(points)), np.bool_)
    if len(near):
        lit[~is_far] = visibility(scene, near, points, **options)
    if len(far):
        lit[is_far] = visibility_along(scene, far, points, **options)
    return lit


def _share(light: Any, points: np.ndarray, normals: Optional[np.ndarray]) -> Tuple[np.ndarray, np.ndarray]:
    """What a point gets of a light's intensity if nothing stands between, and whether it gets anything."""
    if light.kind.name == "directional":
        to_light, share = -_arrays.unit(np.array(light.direction)), np.ones(len(points))
        towards, places = -np.array(light.direction, np.float32).astype(np.float64), 0.0
    else:
        to_light, share = _from_a_place(light, points)
        towards, places = np.array(light.position, np.float32).astype(np.float64), points
    is_reached = share > 0
    if normals is None:
        return share, is_reached
    is_reached &= _arrays.is_in_front(normals, towards, places)
    cosine = np.maximum((_arrays.unit(normals) * to_light).sum(axis=-1), 0)
    return _times(np.where(is_reached, share, 0), cosine), is_reached


def _times(share: np.ndarray, factor: np.ndarray) -> np.ndarray:
    """Their product, where infinity times 0 is 0."""
    product = np.zeros(np.broadcast_shapes(share.shape, factor.shape))
    return np.multiply(share, factor, out=product, where=factor > 0)


def _from_a_place(light: Any, points: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """The direction to the lamp, zero at its very place, and the share without the surface's cosine."""
    offset = np.array(light.position, np.float32).astype(np.float64) - points
    squared = (offset * offset).sum(axis=-1)
    to_light = _arrays.unit(offset)
    factor = np.ones(len(points))
    if np.isfinite(light.range):
        with np.errstate(over="ignore"):
            factor *= 1 - np.minimum(np.sqrt(squared) / light.range, 1) ** 4
    if light.kind.name == "spot":
        cosine = -to_light @ _arrays.unit(np.array(light.direction))
        inner, outer = np.cos(light.inner_angle), np.cos(light.outer_angle)
        factor *= np.clip((cosine - outer) / max(_LEAST_RIM, inner - outer), 0, 1) ** 2
        factor[squared == 0] = 0
    with np.errstate(divide="ignore"):
        return to_light, _times(1 / squared, factor)
