"""What is visible, by asking every face: the referee of the exact tests.

It shares nothing with the library but the definitions (include/facemap/viewpoint.h, docs/algorithm.md): signs of
expressions over the real numbers that the float32 inputs are.

Letters: O origin, a, b, c a face's corners, n = (b - a) x (c - a), s = sign det(a - O, b - O, c - O): -1 if the face is
turned towards O, 1 if away, 0 if it is seen edge-on.
"""

from __future__ import annotations

import math
from typing import Callable, List, Optional, Tuple

import numpy as np

import exact_numbers
from exact_numbers import (Numbers, Triple, all_hold, cross, det, dot, exact, minus, signs, tracked)

MOST_AT_ONCE = 1 << 17
"""Pairs of a question and a face: some tens of MB of numbers."""


def normal(a: Triple, b: Triple, c: Triple) -> Triple:
    return cross(minus(b, a), minus(c, a))


def edge_along(O: Triple, a: Triple, b: Triple, d: Triple) -> Numbers:
    """Which side of the plane through O, a and b the direction d is on."""
    return det(minus(a, O), minus(b, O), d)


def edge_towards(O: Triple, a: Triple, b: Triple, P: Triple) -> Numbers:
    return edge_along(O, a, b, minus(P, O))


def height(a: Triple, b: Triple, c: Triple, P: Triple) -> Numbers:
    """n . (P - a)."""
    return dot(normal(a, b, c), minus(P, a))


def excess(a: Triple, b: Triple, c: Triple, P: Triple, tolerance: Tuple[Numbers]) -> Numbers:
    """Above 0 if P is farther than the tolerance from the plane."""
    n, h = normal(a, b, c), height(a, b, c, P)
    return h * h - tolerance[0] * tolerance[0] * dot(n, n)


class Mesh:
    """Faces, and which of them take part."""

    def __init__(self, vertices: np.ndarray, faces: np.ndarray) -> None:
        assert vertices.dtype == np.float32
        self.corners = vertices[faces]
        self.a, self.b, self.c = (self.corners[:, k] for k in range(3))
        self.is_kept = self._has_area() & ~self._is_duplicate()

    def __len__(self) -> int:
        return len(self.corners)

    def _has_area(self) -> np.ndarray:
        return np.any([signs(lambda a, b, c, k=k: normal(a, b, c)[k], self.a, self.b, self.c) != 0 for k in range(3)],
                      axis=0)

    def _is_duplicate(self) -> np.ndarray:
        seen, found = set(), np.zeros(len(self), np.bool_)
        for face, corners in enumerate(self.corners):
            places = tuple(sorted(tuple(x + 0.0 for x in corner.tolist()) for corner in corners))  # -0 is 0
            found[face] = places in seen
            seen.add(places)
        return found

    def sides(self, origin: np.ndarray) -> np.ndarray:
        """s for each face; 0 for those that take no part."""
        s = signs(lambda O, a, b, c: det(minus(a, O), minus(b, O), minus(c, O)), origin, self.a, self.b, self.c)
        return np.where(self.is_kept, s, 0).astype(np.int8)


class View:
    """The mesh as it is seen from a point."""

    def __init__(self, mesh: Mesh, origin: np.ndarray) -> None:
        assert origin.dtype == np.float32
        self.mesh, self.origin = mesh, origin
        self.sides = mesh.sides(origin)

    # Which faces

    def meets(self, directions: np.ndarray, *, strictly: bool = False) -> np.ndarray:
        """(n, faces) bool: s det(a - O, b - O, d) >= 0 for the three edges; strictly inside: > 0."""
        return by_chunks(lambda d: self._meets(d, edge_along, 1 if strictly else 0), len(self.mesh), directions)

    def stand_between(self, points: np.ndarray, own: Optional[np.ndarray] = None,
                      tolerance: float = 0.0) -> np.ndarray:
        """(n, faces) bool: which faces stand strictly between O and each point.

        `own` (n,): the face that never hides the point, or -1. A tolerance of float32: only what the point is farther
        from than this counts.
        """
        return without_own(by_chunks(lambda p: self._stand_between(p, tolerance), len(self.mesh), points), own)

    def _meets(self, targets: np.ndarray, edge: Callable[..., Numbers], least: int, *more: Tuple) -> np.ndarray:
        mesh, s, P = self.mesh, self.sides, targets[:, np.newaxis]
        may = (s != 0) & np.any(targets != (self.origin if edge is edge_towards else 0), axis=1)[:, np.newaxis]
        return all_hold(may, *((lambda sign: s * sign >= least, edge, self.origin, u, v, P)
                               for u, v in ((mesh.a, mesh.b), (mesh.b, mesh.c), (mesh.c, mesh.a))), *more)

    def _stand_between(self, points: np.ndarray, tolerance: float) -> np.ndarray:
        P = points[:, np.newaxis]
        return self._meets(points, edge_towards, 0, *beyond(self.mesh, self.sides, P, tolerance))

    # In which order

    def all_hits(self, directions: np.ndarray) -> List[List[Tuple[int, float]]]:
        """For each direction the faces that it meets, in order, each with its distance."""
        usable = np.isfinite(directions).all(axis=1)
        directions = np.where(usable[:, np.newaxis], directions, np.float32(0))
        found = []
        for d, met in zip(directions, self.meets(directions)):
            length = math.sqrt(sum(float(x)**2 for x in d))
            found.append([(face, t * length) for face, t in self._in_order(np.nonzero(met)[0], d, None)])
        return found

    def first_blockers(self, points: np.ndarray, own: Optional[np.ndarray] = None) -> np.ndarray:
        """(n,) int32: the first of those that stand between, or -1."""
        found = np.full(len(points), -1, np.int32)
        for i, between in enumerate(self.stand_between(points, own)):
            faces = np.nonzero(between)[0]
            if len(faces) > 1:
                found[i] = self._in_order(faces, None, points[i])[0][0]
            elif len(faces) == 1:
                found[i] = faces[0]
        return found

    def _in_order(self, faces: np.ndarray, d: Optional[np.ndarray],
                  P: Optional[np.ndarray]) -> List[Tuple[int, float]]:
        """Faces that are met along d or on the way to P, by t, the hit's O + t d; then s; then number."""
        if len(faces) == 0:
            return []
        corners = [self.mesh.corners[faces, k] for k in range(3)]
        is_point = d is None
        target = P if is_point else d
        t = _hit_parameter(tracked(self.origin), *map(tracked, corners), tracked(target), is_point)
        value, error = np.broadcast_to(t.value, len(faces)), np.broadcast_to(t.error, len(faces))
        order = np.argsort(value)
        with np.errstate(invalid="ignore"):  # infinite errors: nothing is sure
            low, high = (value - error)[order], (value + error)[order]
            is_sure = np.all(error <= 2.0**-40 * value) and np.all(high[:-1] < low[1:])
        if is_sure and exact_numbers.use_doubles:
            return [(int(faces[i]), float(value[i])) for i in order]
        t = _hit_parameter(exact(self.origin[np.newaxis]), *map(exact, corners), exact(target[np.newaxis]),
                           is_point)
        ordered = sorted(zip(t, self.sides[faces].tolist(), faces.tolist()))
        return [(face, float(parameter)) for parameter, _, face in ordered]


def _hit_parameter(O: Triple, a: Triple, b: Triple, c: Triple, target: Triple, is_point: bool) -> Numbers:
    """n . (a - O) / n . d, where O + t d meets the plane."""
    n = normal(a, b, c)
    return dot(n, minus(a, O)) / dot(n, minus(target, O) if is_point else target)


def beyond(mesh: Mesh, s: np.ndarray, P: np.ndarray, tolerance: float) -> List[Tuple]:
    """Conditions that points stand beyond the faces' planes."""
    conditions: List[Tuple] = [(lambda sign: s * sign > 0, height, mesh.a, mesh.b, mesh.c, P)]
    if tolerance > 0:
        conditions.append((lambda sign: sign > 0, excess, mesh.a, mesh.b, mesh.c, P,
                           np.array([tolerance], np.float32)))
    return conditions


def without_own(found: np.ndarray, own: Optional[np.ndarray]) -> np.ndarray:
    if own is not None:
        has_own = own >= 0
        found[np.nonzero(has_own)[0], own[has_own]] = False
    return found


def by_chunks(ask: Callable[[np.ndarray], np.ndarray], face_count: int, questions: np.ndarray) -> np.ndarray:
    step = max(1, MOST_AT_ONCE // face_count)
    parts = [ask(questions[i:i + step]) for i in range(0, len(questions), step)]
    return np.concatenate(parts) if parts else np.zeros((0, face_count), np.bool_)
