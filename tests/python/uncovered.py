"""What others leave of a face, seen from a point: exact, in whole numbers.

A direction within a face's cone is a mean of its corners, with weights w: d = w0 (a - O) + w1 (b - O) + w2 (c - O).
Each condition of another face standing before it (three edges, and which plane is nearer along d) is linear in d, hence
in w. So the face is a triangle of weights, from which convex pieces are cut away.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import List, Optional, Tuple

from brute_force import View
from exact_numbers import cross, det, dot, minus

Weights = Tuple[int, int, int]
Piece = List[Weights]  # corners of a convex polygon with an area, each up to a factor above 0


class Cutter:
    def __init__(self, view: View) -> None:
        self._sides = view.sides.tolist()
        numbers = [[[Fraction(x) for x in corner] for corner in face] for face in view.mesh.corners.tolist()]
        origin = [Fraction(x) for x in view.origin.tolist()]
        about = [[[x - o for x, o in zip(corner, origin)] for corner in face] for face in numbers]
        unit = math.lcm(*(x.denominator for face in about for corner in face for x in corner))
        self._corners = [[tuple(int(x * unit) for x in corner) for corner in face] for face in about]
        self._normals = [cross(minus(b, a), minus(c, a)) for a, b, c in self._corners]
        self._dets = [det(*face) for face in self._corners]

    def uncovered(self, face: int) -> List[Piece]:
        """Pieces of the face, which is not seen edge-on, that make up all that is seen of it but for edges."""
        pieces: List[Piece] = [[(1, 0, 0), (0, 1, 0), (0, 0, 1)]]
        for other, side in enumerate(self._sides):
            conditions = self._before(other, face) if side != 0 and other != face else None
            if conditions is not None:
                pieces = [part for piece in pieces for part in _cut_away(piece, conditions)]
            if not pieces:
                break
        return pieces

    def _before(self, other: int, face: int) -> Optional[List[Weights]]:
        """Linear conditions that are at least 0 where `other` hides `face`; None: it does so nowhere."""
        s, t = self._sides[other], self._sides[face]
        a, b, c = self._corners[other]
        edges = [tuple(s * det(u, v, corner) for corner in self._corners[face]) for u, v in ((a, b), (b, c), (c, a))]
        # t_face - t_other = D_face / (n_face . d) - D_other / (n_other . d), times both (n . d), of sign s and t.
        nearer = tuple(s * t * (self._dets[face] * dot(self._normals[other], corner) -
                                self._dets[other] * dot(self._normals[face], corner)) for corner in self._corners[face])
        if any(nearer):
            return edges + [nearer]
        return edges if (s, other) < (t, face) else None  # in one plane: the rule of what is equally far


def _cut_away(piece: Piece, conditions: List[Weights]) -> List[Piece]:
    """The parts of the piece in which some condition is below 0."""
    heights = [[dot(condition, corner) for corner in piece] for condition in conditions]
    if any(max(row) <= 0 for row in heights):
        return [piece]
    parts, rest = [], piece
    for condition in conditions:
        heights_now = [dot(condition, corner) for corner in rest]
        if min(heights_now) < 0:
            parts.append(_clip(rest, [-height for height in heights_now]))
        if max(heights_now) <= 0:
            break
        rest = _clip(rest, heights_now)
    return parts


def _clip(piece: Piece, heights: List[int]) -> Piece:
    """What is at height 0 or above; some corner is above."""
    found = []
    for i, (corner, height) in enumerate(zip(piece, heights)):
        before, height_before = piece[i - 1], heights[i - 1]
        if height * height_before < 0:
            crossing = [abs(height_before) * x + abs(height) * y for x, y in zip(corner, before)]
            factor = math.gcd(*crossing)
            found.append(tuple(x // factor for x in crossing))
        if height >= 0:
            found.append(corner)
    return found
