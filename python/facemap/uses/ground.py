"""Terrains, and places on them."""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np

from .. import _checks
from ..scene import Scene
from . import _arrays

_BLOCK_PAIRS = 1 << 22
"""Points times faces that are held at once."""


def terrain(heights: Any, spacing: float = 1.0, corner: Sequence[float] = (0.0, 0.0), up: str = "y") -> Scene:
    """A landscape from a grid of heights: two triangles a cell, one vertex a height.

    Parameters
    ----------
    heights : (rows, columns) floats
        World units, at least 2 x 2. Row 0 is the far one (north), column 0 the left one (west). Where a number is NaN
        there is no ground: cells that touch it are left out. What a masked array masks is NaN.
    spacing : float
        World units from one row or column to the next.
    corner : two floats
        Where row 0, column 0 lies: x and z if y points up, x and y if z does. Map coordinates of many digits lose
        the last ones as float32; a ValueError says so where neighbours would coincide: subtract an offset.
    up : "y" or "z"
        Rows go towards +z if y points up, and towards -y if z does.

    Returns
    -------
    Scene
        Vertex row * columns + column has heights[row, column]; the vertices of NaN belong to no face.

    Raises
    ------
    TypeError, ValueError
        Naming the argument.

    Examples
    --------
    >>> land = facemap.terrain(np.random.default_rng(1).uniform(0, 5, (50, 80)), spacing=10)
    """
    grid = _grid(heights)
    if grid.ndim != 2 or min(grid.shape) < 2:
        raise ValueError(f"heights: the shape is {grid.shape}, and (rows, columns) of at least 2 is needed")
    if np.isinf(grid).any():
        raise ValueError("heights: a number is infinite")
    step = _checks.finite_number("spacing", spacing)
    if not step > 0:
        raise ValueError(f"spacing: {step} is not above 0")
    at = _checks.finite("corner", _checks.array("corner", corner))
    if at.shape != (2,):
        raise ValueError(f"corner: the shape is {at.shape}, and two numbers are needed")
    is_y = _checks.choice("up", up, ("y", "z")) == "y"
    rows, columns = grid.shape
    row, column = np.mgrid[0:rows, 0:columns]
    x = at[0] + step * column
    across = at[1] + step * row if is_y else at[1] - step * row
    known = np.where(np.isnan(grid), 0.0, grid)
    vertices = np.stack([x, known, across] if is_y else [x, across, known], axis=-1).reshape(-1, 3)
    if not np.abs(vertices).max() < np.finfo(np.float32).max:
        raise ValueError("heights, spacing, corner: a vertex would be too far away for float32")
    if _coincide(x[0]) or _coincide(across[:, 0]):
        raise ValueError(f"corner: with spacing {step:g} neighbouring places coincide as float32; subtract an offset")
    return Scene(vertices, _cells(~np.isnan(grid)))


def _grid(heights: Any) -> np.ndarray:
    """In float64; what is masked is NaN."""
    if not isinstance(heights, np.ma.MaskedArray):
        return _checks.array("heights", heights).astype(np.float64)
    grid = _checks.array("heights", heights.data).astype(np.float64)
    return np.where(np.ma.getmaskarray(heights), np.nan, grid)


def _coincide(places: np.ndarray) -> bool:
    return bool((np.diff(places.astype(np.float32)) == 0).any())


def _cells(is_known: np.ndarray) -> np.ndarray:
    """Two triangles, counter-clockwise from above, a cell whose corners are all known."""
    index = np.arange(is_known.size).reshape(is_known.shape)
    first, right, below, last = index[:-1, :-1], index[:-1, 1:], index[1:, :-1], index[1:, 1:]
    is_whole = is_known[:-1, :-1] & is_known[:-1, 1:] & is_known[1:, :-1] & is_known[1:, 1:]
    if not is_whole.any():
        raise ValueError("heights: no cell has four corners that are not NaN")
    corners = np.stack([first, below, last, first, last, right], axis=-1)
    return corners[is_whole].reshape(-1, 3)


def on_ground(scene: Scene, points: Any, height: float = 0.0, *, up: Any = None) -> np.ndarray:
    """Points moved along `up` so that they stand at a height above the highest surface over or under them.

    Computed in float64 and rounded to float32: to some 1e-7 of the scene's size. Each point is compared with every
    face: the time grows with points times faces.

    Parameters
    ----------
    scene : Scene
    points : (..., 3) floats
        World units; how high they lie does not matter.
    height : float
        World units above the ground.
    up : three floats
        None: as the scene's file says, else (0, 1, 0).

    Returns
    -------
    (..., 3) float32; NaN where there is no ground.

    Raises
    ------
    TypeError, ValueError
        Naming the argument.

    Examples
    --------
    >>> eyes = facemap.on_ground(land, [[120, 0, 80], [300, 0, 40]], 1.7)
    """
    flat, shape = _arrays.points_of(points)
    above = _checks.finite_number("height", height)
    core = _checks.core_of(scene)
    middle = _arrays.up_of(scene, up)
    corners = scene.vertices[scene.faces].astype(np.float64)
    side = _arrays.unit(np.cross(middle, np.eye(3)[np.abs(middle).argmin()]))
    axes = np.stack([side, np.cross(middle, side), middle], axis=1)
    ground = np.full(len(flat), -np.inf)
    places = flat.astype(np.float64) @ axes
    triangles = _Triangles(corners @ axes)
    size = max(1, _BLOCK_PAIRS // max(1, core.face_count))
    for first in range(0, len(flat), size):
        part = slice(first, first + size)
        ground[part] = triangles.highest(places[part, :2])
    moved = places.copy()
    moved[:, 2] = np.where(np.isneginf(ground), np.nan, ground + above)
    return (moved @ axes.T).astype(np.float32).reshape(shape + (3,))


class _Triangles:
    """Triangles seen from above, as planes z = a + b x + c y and three edges each."""

    def __init__(self, corners: np.ndarray) -> None:
        first, second, third = corners[:, 0], corners[:, 1], corners[:, 2]
        self._first, self._u, self._v = first, second - first, third - first
        self._area = self._u[:, 0] * self._v[:, 1] - self._u[:, 1] * self._v[:, 0]
        self._lower, self._upper = corners[:, :, :2].min(axis=1), corners[:, :, :2].max(axis=1)

    def highest(self, places: np.ndarray) -> np.ndarray:
        """The greatest height over each place, -infinity if there is none."""
        height = np.full(len(places), -np.inf)
        is_near = ((places[:, np.newaxis] >= self._lower) & (places[:, np.newaxis] <= self._upper)).all(axis=2)
        point, face = np.nonzero(is_near & (self._area != 0))
        offset = places[point] - self._first[face, :2]
        u, v, area = self._u[face], self._v[face], self._area[face]
        s = (offset[:, 0] * v[:, 1] - offset[:, 1] * v[:, 0]) / area
        t = (u[:, 0] * offset[:, 1] - u[:, 1] * offset[:, 0]) / area
        slack = 1e-9  # barycentric, without unit: places on an edge that rounding puts on neither side
        is_in = (s >= -slack) & (t >= -slack) & (s + t <= 1 + slack)
        z = self._first[face, 2] + s * u[:, 2] + t * v[:, 2]
        np.maximum.at(height, point[is_in], z[is_in])
        return height
