"""Signs of expressions over the real numbers that float32 inputs are.

An expression is written once, for numbers that know +, - and *. It is asked with float64 numbers that carry a bound of
their error, whole arrays at a time; where the bound leaves the sign open, with fractions.Fraction, which is exact.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Callable, Tuple

import numpy as np

U = 2.0**-53
"""Rounding to nearest in float64 is off by at most U times the result's magnitude (as long as nothing underflows)."""

SLACK = 1 + 16 * U
"""Bounds are sums of at most four products, rounded too: no number in them goes through more than eight roundings,
and (1 + U)^8 is below this."""


class Tracked:
    """Float64 numbers, and for each the most that it is off by.

    Inputs are float32: multiples of 2^-149 of at most 2^128. What comes of six factors that are differences of such
    numbers is a multiple of 2^-894 of at most 2^800, and an error bound of it that is not 0 at least 2^-1000 (U^2 times
    it): nothing overflows, and nothing that underflows counts.
    """

    __slots__ = ("value", "error")

    def __init__(self, value: np.ndarray, error: Any = 0.0) -> None:
        self.value, self.error = value, error

    def __add__(self, other: Tracked) -> Tracked:
        # |fl(x + y) - (X + Y)| <= U |fl(x + y)| + |x - X| + |y - Y|
        value = self.value + other.value
        return Tracked(value, (self.error + other.error + U * np.abs(value)) * SLACK)

    def __sub__(self, other: Tracked) -> Tracked:
        return self + Tracked(-other.value, other.error)

    def __mul__(self, other: Tracked) -> Tracked:
        # With x = X + e and y = Y + f: XY = xy - xf - ye + ef.
        value = self.value * other.value
        error = np.abs(self.value) * other.error + np.abs(other.value) * self.error + self.error * other.error
        return Tracked(value, (error + U * np.abs(value)) * SLACK)

    def __truediv__(self, other: Tracked) -> Tracked:
        # X/Y - x/y = ((X - x) y + x (y - Y)) / (Y y), and |Y| >= |y| - f; where that is not above 0, all is open.
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            value = self.value / other.value
            least = (np.abs(other.value) - other.error) * (1 - 4 * U)
            error = (self.error + np.abs(value) * other.error) / least + U * np.abs(value)
            return Tracked(value, np.where(least > 0, error * SLACK, np.inf))


Numbers = Any  # Tracked, or an array of Fraction
Triple = Tuple[Numbers, Numbers, Numbers]

use_doubles = True
"""False: every sign is found by fractions alone (slow; to test the doubles)."""


def minus(a: Triple, b: Triple) -> Triple:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def dot(a: Triple, b: Triple) -> Numbers:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Triple, b: Triple) -> Triple:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def det(a: Triple, b: Triple, c: Triple) -> Numbers:
    return dot(cross(a, b), c)


Expression = Callable[..., Numbers]

_fractions = np.frompyfunc(Fraction, 1, 1)


def tracked(points: np.ndarray) -> Tuple[Tracked, ...]:
    """The components along the last axis."""
    return tuple(Tracked(points[..., k].astype(np.float64)) for k in range(points.shape[-1]))


def exact(points: np.ndarray) -> Tuple[np.ndarray, ...]:
    return tuple(_fractions(points[..., k].astype(np.float64).astype(object)) for k in range(points.shape[-1]))


def signs_by_doubles(expression: Expression, *points: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """-1, 0 or 1 for each element, and whether that is sure."""
    found = expression(*map(tracked, points))
    shape = np.broadcast_shapes(*(p.shape[:-1] for p in points))
    sign = np.broadcast_to(np.sign(found.value).astype(np.int8), shape).copy()
    if not use_doubles:
        return sign, np.zeros(shape, np.bool_)
    sure = (np.abs(found.value) > found.error) | (np.maximum(np.abs(found.value), found.error) == 0)
    return sign, np.broadcast_to(sure, shape)


def signs_exactly(expression: Expression, where: np.ndarray, *points: np.ndarray) -> np.ndarray:
    """For the elements that the mask names, one after the other."""
    if not where.any():
        return np.zeros(0, np.int8)
    found = expression(*(exact(np.broadcast_to(p, where.shape + p.shape[-1:])[where]) for p in points))
    return np.array([(x > 0) - (x < 0) for x in found], np.int8)


def signs(expression: Expression, *points: np.ndarray) -> np.ndarray:
    """-1, 0 or 1 for each element of the points' common shape."""
    sign, sure = signs_by_doubles(expression, *points)
    sign[~sure] = signs_exactly(expression, ~sure, *points)
    return sign


def all_hold(where: np.ndarray, *conditions: Tuple[Any, ...]) -> np.ndarray:
    """Where all conditions hold: each one a function of signs, an expression, and its points.

    What doubles refuse by one condition is not asked exactly about another.
    """
    known = []
    for accepts, expression, *points in conditions:
        sign, sure = signs_by_doubles(expression, *points)
        where = where & (accepts(sign) | ~sure)
        known.append((sign, sure))
    for (sign, sure), (accepts, expression, *points) in zip(known, conditions):
        still_open = where & ~sure
        sign[still_open] = signs_exactly(expression, still_open, *points)
        where = where & accepts(sign)
    return where
