"""The referee itself: answers that are known, and doubles against fractions alone."""

from fractions import Fraction

import numpy as np
import pytest

import exact_numbers
from brute_force import Mesh, View
from exact_numbers import Tracked, det, minus, signs
from hard_scenes import make_directions, make_origin, make_points, make_scene


def test_bounds_hold(random):
    """Every value is within its bound, whatever is computed."""
    x = (random.normal(size=(6, 4000)) * np.exp2(random.integers(-149, 127, (6, 4000)))).astype(np.float32)
    x[:, ::2] = x[0, ::2] * (1 + random.integers(-4, 5, (6, 2000)) * np.float32(2.0**-23))  # differences cancel

    def expression(a, b, c, d, e, f):
        return (a - b) * (c - d) * (e - f) - (a - f) * (b - e) * (c + d)

    found = expression(*(Tracked(row.astype(np.float64)) for row in x))
    truth = expression(*(exact_numbers.exact(row[:, np.newaxis])[0] for row in x))
    off = [abs(Fraction(value) - t) - Fraction(error) for value, error, t in zip(found.value, found.error, truth)]
    assert max(off) <= 0
    quotient = Tracked(found.value, found.error) / Tracked(x[0].astype(np.float64))
    known = np.isfinite(quotient.error) & (x[0] != 0)
    for value, error, t, y in zip(quotient.value[known], quotient.error[known], truth[known], x[0][known]):
        assert abs(Fraction(value) - t / Fraction(float(y))) <= Fraction(error)


def test_signs_that_doubles_do_not_know():
    a = np.array([[1, 0, 0], [1, 0, 0]], np.float32)
    b = np.array([[0, 1, 0], [0, 1, 0]], np.float32)
    c = np.array([[2.0**100, 2.0**100, 2.0**-149], [2.0**100, 2.0**100, 0]], np.float32)
    o = np.array([2.0**-100, 2.0**-100, 0], np.float32)
    expression = lambda o, a, b, c: det(minus(a, o), minus(b, o), minus(c, o))  # noqa: E731
    assert signs(expression, o, a, b, c).tolist() == [1, 0]


def test_what_is_known():
    vertices = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], np.float32)
    mesh = Mesh(vertices, np.array([[0, 2, 1], [0, 3, 2], [2, 0, 1], [0, 0, 1]]))
    assert mesh.is_kept.tolist() == [True, True, False, False]
    view = View(mesh, np.array([0, 1, 0], np.float32))
    assert view.sides.tolist() == [-1, -1, 0, 0]
    directions = np.array([[0.5, -2, 0.2], [0, -1, 0], [0, 1, 0], [0, 0, 0], [np.nan, 0, 0]], np.float32)
    assert view.all_hits(directions) == [[(0, pytest.approx(np.hypot(1, np.hypot(0.25, 0.1))))],
                                         [(0, 1), (1, 1)], [], [], []]
    points = np.array([[0.5, 0, 0.2], [0.5, -1, 0.2], [0.2, -1, 0.5], [9, -1, 0], [0, 1, 0]], np.float32)
    assert view.first_blockers(points).tolist() == [-1, 0, 1, -1, -1]
    assert view.first_blockers(points, np.array([0, 0, 0, 0, 0])).tolist() == [-1, -1, 1, -1, -1]
    assert view.stand_between(points, tolerance=1.0).sum() == 0  # none is farther than 1 from the plane
    below = View(mesh, np.array([0, -1, 0], np.float32))
    assert below.sides.tolist() == [1, 1, 0, 0]
    assert View(mesh, np.array([5, 0, 0], np.float32)).sides.tolist() == [0, 0, 0, 0]


def test_doubles_say_what_fractions_do(random, monkeypatch):
    for _ in range(8):
        vertices, faces = make_scene(random)
        origin = make_origin(random, vertices, faces)
        points, own = make_points(random, vertices, faces, origin, 6)
        directions = make_directions(random, vertices, faces, origin, 6)
        found = []
        for use_doubles in (True, False):
            monkeypatch.setattr(exact_numbers, "use_doubles", use_doubles)
            view = View(Mesh(vertices, faces), origin)
            tolerance = float(np.float32(0.1 * np.abs(vertices).max()))
            found.append((view.mesh.is_kept.tolist(), view.sides.tolist(), view.first_blockers(points, own).tolist(),
                          view.stand_between(points, tolerance=tolerance).tolist(),
                          [[face for face, _ in hits] for hits in view.all_hits(directions)]))
        assert found[0] == found[1]
