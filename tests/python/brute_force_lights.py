"""Which lights reach what a camera sees, and parallel light, by asking every face.

What a camera K sees along d on a face F is a fraction, P = K + (n . (a - K) / n . d) d. Multiplied by w = |n . d| it is
a polynomial: w (P - x) = w (K - x) + s (n . (a - K)) d for any point x, with s the side of F about K, which is the sign
of n . d. Parallel light goes along a direction l; a face's side is then s = sign n . l.
"""

from __future__ import annotations

from typing import Callable, List, NamedTuple, Optional

import numpy as np

from brute_force import MOST_AT_ONCE, Mesh, View, beyond, by_chunks, normal, without_own
from exact_numbers import Numbers, Triple, all_hold, cross, det, dot, minus, signs


class Seen(NamedTuple):
    """What a camera sees, one element a ray."""

    origin: np.ndarray  # (3,) float32
    directions: np.ndarray  # (n, 3) float32
    faces: np.ndarray  # (n,) face numbers
    sides: np.ndarray  # (n,) of the faces, about the origin


def _weight(a: Triple, b: Triple, c: Triple, d: Triple) -> Numbers:
    """n . d: w but for its sign."""
    return dot(normal(a, b, c), d)


def _offset(K: Triple, a: Triple, b: Triple, c: Triple, d: Triple, x: Triple) -> Triple:
    """(n . d) (P - x): w (P - x) but for the sign."""
    n = normal(a, b, c)
    along, away = dot(n, d), dot(n, minus(a, K))
    return tuple(along * (k - y) + away * component for k, y, component in zip(K, x, d))


def _edge(K, a, b, c, d, light, u, v):  # whether the light sees the point on the inner side of an edge
    return det(minus(u, light), minus(v, light), _offset(K, a, b, c, d, light))


def _height(K, a, b, c, d, p, q, r):  # n_G . w (P - p)
    return dot(normal(p, q, r), _offset(K, a, b, c, d, p))


def _edge_along(K, a, b, c, d, l, u, v):  # w det(u - P, v - P, l) = ((v - u) x w (P - u)) . l
    return dot(cross(minus(v, u), _offset(K, a, b, c, d, u)), l)


def lit_by_point(view: View, seen: Seen) -> np.ndarray:
    """(n,) bool: the light, where `view` is from, is on the side of the face that the camera sees, with nothing
    strictly between."""
    faces_it = (view.sides[seen.faces] == seen.sides) & (seen.sides != 0)
    return faces_it & ~_is_hidden(view.mesh, view.sides, seen, _edge, view.origin)


class Sun:
    """The mesh as parallel light along a direction sees it."""

    def __init__(self, mesh: Mesh, direction: np.ndarray) -> None:
        assert direction.dtype == np.float32
        self.mesh, self.direction = mesh, direction
        self.sides = np.where(mesh.is_kept, signs(_weight, mesh.a, mesh.b, mesh.c, direction), 0).astype(np.int8)

    def lit(self, seen: Seen) -> np.ndarray:
        """(n,) bool: as lit_by_point."""
        faces_it = (self.sides[seen.faces] == seen.sides) & (seen.sides != 0)
        return faces_it & ~_is_hidden(self.mesh, self.sides, seen, _edge_along, self.direction)

    def stand_before(self, points: np.ndarray, own: Optional[np.ndarray] = None, tolerance: float = 0.0) -> np.ndarray:
        """(n, faces) bool: which faces stand strictly between each point and where the light comes from; own faces
        and the tolerance as of View.stand_between."""
        return without_own(by_chunks(lambda p: self._stand_before(p, tolerance), len(self.mesh), points), own)

    def _stand_before(self, points: np.ndarray, tolerance: float) -> np.ndarray:
        mesh, s, P = self.mesh, self.sides, points[:, np.newaxis]

        def edge(P: Triple, u: Triple, v: Triple, l: Triple) -> Numbers:
            return det(minus(u, P), minus(v, P), l)

        return all_hold(np.broadcast_to(s != 0, (len(points), len(mesh))),
                        *((lambda sign: s * sign >= 0, edge, P, u, v, self.direction)
                          for u, v in ((mesh.a, mesh.b), (mesh.b, mesh.c), (mesh.c, mesh.a))),
                        *beyond(mesh, s, P, tolerance))


def _is_hidden(mesh: Mesh, sides: np.ndarray, seen: Seen, edge: Callable[..., Numbers],
               light: np.ndarray) -> np.ndarray:
    """(n,) bool: whether a face other than its own hides what is seen from a light that has these sides."""
    found: List[np.ndarray] = []
    step = max(1, MOST_AT_ONCE // len(mesh))
    for i in range(0, len(seen.faces), step):
        own, d = seen.faces[i:i + step, np.newaxis], seen.directions[i:i + step, np.newaxis]
        s = sides * seen.sides[i:i + step, np.newaxis]  # offsets have the sign of n . d, the camera's side
        point = (seen.origin, mesh.a[own], mesh.b[own], mesh.c[own], d)
        may = (s != 0) & (own != np.arange(len(mesh)))
        hides = all_hold(may, *((lambda sign: s * sign >= 0, edge, *point, light, u, v)
                                for u, v in ((mesh.a, mesh.b), (mesh.b, mesh.c), (mesh.c, mesh.a))),
                         (lambda sign: s * sign > 0, _height, *point, mesh.a, mesh.b, mesh.c))
        found.append(hides.any(axis=1))
    return np.concatenate(found) if found else np.zeros(0, np.bool_)
