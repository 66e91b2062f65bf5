"""Visibility from points."""

import pickle

import numpy as np
import pytest

import facemap
from facemap import _checks


@pytest.fixture
def above(floor):
    return facemap.View(floor, (0, 1, 0))


def test_what_is_behind_is_hidden_and_named(above):
    points = [[0.5, 0.5, 0], [0.5, 0, 0.2], [0.5, -1, 0.2], [0.2, -1, 0.5], [9, -1, 0]]
    assert above.visible(points).tolist() == [True, True, False, False, True]
    assert above.visible([0, -1, 0.1]).shape == () and not above.visible([0, -1, 0.1])


def test_nearest_and_all_hits(floor):
    floor.add(floor, [[1, 0, 0, 0], [0, 1, 0, -1], [0, 0, 1, 0], [0, 0, 0, 1]])
    view = facemap.View(floor, (0, 1, 0))
    directions = np.array([[[0.5, -2, 0.2]], [[0, 1, 0]], [[0, 0, 0]], [[np.nan, 0, 0]]], np.float32)
    face, distance = view.nearest(directions)
    assert face.shape == distance.shape == (4, 1)
    assert face.ravel().tolist() == [0, -1, -1, -1] and face.dtype == np.int32
    assert distance[0, 0] == pytest.approx(np.linalg.norm([0.25, 1, 0.1]), rel=1e-6) and np.isinf(distance[1:]).all()
    hits = view.all_hits(directions)
    assert hits.begins.tolist() == [0, 2, 2, 2, 2]
    assert hits.faces.tolist() == [0, 2] and hits.distances.dtype == np.float32


def test_own_faces(above):
    below = [[0.5, -1e-3, 0.2]]
    assert not above.visible(below)[0]
    assert above.visible(below, faces=[0])[0] and not above.visible(below, faces=[-1])[0]


def test_tolerance(above):
    assert above.visible([0.5, -1e-3, 0.2], tolerance=0.01)


def test_what_hides_a_point_is_named(above):
    assert above.blocked_by([[0.5, -1, 0.2], [0.2, -1, 0.5], [0.5, 0, 0.2], [0, 9, 0]]).tolist() == [0, 1, -1, -1]
    assert above.blocked_by([0.5, -1, 0.2], faces=0) == -1


def test_visible_and_hidden_faces_come_with_reasons(floor):
    floor.add(floor, np.diag([0.5, 1, 0.5, 1]) + [[0] * 4, [0, 0, 0, -1], [0] * 4, [0] * 4])
    view = facemap.View(floor, (0, 1, 0))
    found = view.visible_faces()
    assert found.states.tolist() == [1, 1, 0, 0]
    assert found.visible.tolist() == [True, True, False, False]
    assert np.array_equal(found.hidden, ~found.visible) and not found.undecided.any()
    assert view.nearest(found.witnesses[:2]).face.tolist() == [0, 1]
    assert [facemap.HIDDEN_REASONS[i] for i in found.reasons] == ["none", "none", "covered", "covered"]
    assert view.visible_vertices().tolist() == [True] * 4 + [False] * 4
    pieces = view.covered_pieces(2)
    assert pieces and all(piece.cover in (0, 1) and piece.corners.shape == (3, 3) for piece in pieces)
    assert view.covered_pieces(0) == []
    with pytest.raises(IndexError, match="face: 4 "):
        view.covered_pieces(4)


def test_the_picture_of_a_map_is_the_programs(program, bust, tmp_path):
    program("scene", "bust", "-o", tmp_path / "bust.obj")
    program("map", tmp_path / "bust.obj", "--at", "0.5,1.5,2", "-o", tmp_path / "map.npy", "--size", "64x64")
    view = facemap.View(bust, (0.5, 1.5, 2))
    frame = view.image(64, 64)
    assert np.array_equal(frame.color, np.load(tmp_path / "map.npy")[:64])  # the program's legend lies below
    assert frame.planes == ("range", "face_id") and (frame.face_id >= 0).any()
    assert np.array_equal(frame.face_id < 0, np.isinf(frame.range))
    assert view.image(9, 8, 90, (0, 1, 0)).image.shape == (8, 9, 3)
    with pytest.raises(ValueError, match="field_angle"):
        view.image(8, 8, 361)
    with pytest.raises(ValueError, match="sight"):
        view.image(8, 8, sight=(0, 0, 0))


def test_arrays_that_fit_are_not_copied():
    points = np.zeros((10, 3), np.float32)
    assert _checks.floats("points", points) is points
    assert np.shares_memory(_checks.floats("points", points.reshape(2, 5, 3)), points)
    assert not np.shares_memory(_checks.floats("points", points.astype(np.float64)), points)


@pytest.mark.parametrize("change", [
    lambda a: a.astype(np.float64),
    lambda a: a.astype(">f4"),
    lambda a: np.asfortranarray(a),
    lambda a: np.repeat(a, 2, axis=0)[::2],
    lambda a: a[::-1].copy()[::-1],
    lambda a: a.tolist(),
    lambda a: np.frombuffer(b"x" + a.tobytes(), np.uint8)[1:].view(np.float32).reshape(a.shape),
], ids=["float64", "big-endian", "fortran", "strided", "reversed", "list", "unaligned"])
def test_every_layout_gives_the_same(bust, change):
    points = np.random.default_rng(1).uniform(-2, 2, (500, 3)).astype(np.float32)
    view = facemap.View(bust, (0, 1, 3))
    assert np.array_equal(view.visible(change(points)), view.visible(points))


def test_visibility_is_view_by_view(bust, random):
    origins = random.uniform(-3, 3, (2, 3, 3)).astype(np.float32)
    points = random.uniform(-1, 2, (5, 7, 3)).astype(np.float32)
    seen = facemap.visibility(bust, origins, points)
    assert seen.shape == (2, 3, 5, 7) and seen.dtype == np.bool_
    for i in np.ndindex(2, 3):
        assert np.array_equal(seen[i], facemap.View(bust, origins[i]).visible(points))
    packed = facemap.visibility(bust, origins, points, packed=True)
    assert packed.shape == (2, 3, 5)
    assert np.array_equal(np.unpackbits(packed, axis=2, count=35, bitorder="little").reshape(seen.shape), seen)


def test_visibility_along_is_nothing_that_a_view_from_the_point_meets(bust, random):
    directions = random.normal(size=(2, 3, 3)).astype(np.float32)
    points = random.uniform(-1, 2, (20, 3)).astype(np.float32)
    far = facemap.visibility_along(bust, directions, points)
    assert far.shape == (2, 3, 20) and far.dtype == np.bool_ and far.any() and not far.all()
    for i, point in enumerate(points):
        assert np.array_equal(far[:, :, i], facemap.View(bust, point).nearest(directions).face < 0)
    packed = facemap.visibility_along(bust, directions, points, packed=True)
    assert np.array_equal(np.unpackbits(packed, axis=2, count=20, bitorder="little").astype(bool), far)


def test_threads_do_not_matter(bust, random):
    points = random.uniform(-1, 2, (40_000, 3)).astype(np.float32)
    views = [facemap.View(bust, (1, 1, 3), threads) for threads in (1, 2, 3)]
    one, two, three = (view.visible(points) for view in views)
    assert np.array_equal(one, two) and np.array_equal(one, three)


def test_no_points_give_no_answers(above):
    none = np.zeros((0, 3), np.float32)
    assert above.visible(none).shape == (0,)
    assert above.nearest(none).face.shape == (0,)
    assert above.all_hits(none).begins.tolist() == [0]
    assert above.visible(np.zeros((4, 0, 3))).shape == (4, 0)
    scene = facemap.Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    assert facemap.visibility(scene, none, none).shape == (0, 0)
    assert facemap.visibility(scene, [[0, 0, 1]], none).shape == (1, 0)


def test_a_view_keeps_its_scene_as_it_was(floor):
    view = facemap.View(floor, (0, 1, 0))
    floor.add(floor, [[1, 0, 0, 0], [0, 1, 0, 0.5], [0, 0, 1, 0], [0, 0, 0, 1]])
    assert view.nearest([0, -1, 0.1]).distance == pytest.approx(np.hypot(1, 0.1))
    assert facemap.View(floor, (0, 1, 0)).nearest([0, -1, 0]).distance == 0.5
    del floor
    assert view.prepare() is view and view.memory_bytes > 0
    again = pickle.loads(pickle.dumps(view))
    assert again.origin.tolist() == [0, 1, 0] and not again.visible([0, -1, 0.1])


@pytest.mark.parametrize("call, error, name", [
    (lambda v: v.visible([[0, 0]]), ValueError, "points: the shape"),
    (lambda v: v.visible([[0, 0, np.nan]]), ValueError, "points: .*finite"),
    (lambda v: v.visible([[0, 0, 1e39]]), ValueError, "points: .*finite"),
    (lambda v: v.visible(7), ValueError, "points: the shape"),
    (lambda v: v.visible(None), TypeError, "points"),
    (lambda v: v.visible("abc"), TypeError, "points"),
    (lambda v: v.visible([[0, 0, 1j]]), TypeError, "points"),
    (lambda v: v.visible([[0, 0, 1]], faces=[2]), IndexError, "faces: 2 "),
    (lambda v: v.visible([[0, 0, 1]], faces=[-2]), IndexError, "faces: -2 "),
    (lambda v: v.visible([[0, 0, 1]], faces=[0, 1]), ValueError, "faces: the shape"),
    (lambda v: v.visible([[0, 0, 1]], faces=[0.0]), TypeError, "faces"),
    (lambda v: v.visible([[0, 0, 1]], tolerance=-1), ValueError, "tolerance"),
    (lambda v: v.visible([[0, 0, 1]], tolerance="a"), TypeError, "tolerance"),
    (lambda v: v.blocked_by([[np.inf, 0, 1]]), ValueError, "points: .*finite"),
    (lambda v: v.covered_pieces(0.5), TypeError, "face"),
    (lambda v: v.nearest([[1, 2, 3, 4]]), ValueError, "directions: the shape"),
    (lambda v: v.all_hits(np.zeros((2, 2))), ValueError, "directions: the shape"),
    (lambda v: facemap.View(7, (0, 0, 0)), TypeError, "scene"),
    (lambda v: facemap.View(facemap.generate("bust"), (0, np.nan, 0)), ValueError, "origin"),
    (lambda v: facemap.View(facemap.generate("bust"), (0, 0)), ValueError, "origin"),
    (lambda v: facemap.View(facemap.generate("bust"), (0, 0, 0), threads=1.5), TypeError, "threads"),
    (lambda v: facemap.visibility(None, [[0, 0, 0]], [[0, 0, 0]]), TypeError, "scene"),
    (lambda v: facemap.visibility_along(facemap.generate("bust"), [[0, 0, 0]], [[0, 0, 0]]), ValueError, "directions"),
    (lambda v: facemap.visibility_along(facemap.generate("bust"), [[0, 0, np.inf]], [[0, 0, 0]]), ValueError,
     "directions"),
    (lambda v: v.image(32768, 32768), ValueError, "width, height: .*pixels"),
    (lambda v: facemap.Camera((0, 0, 1)).rays(facemap.generate("bust"), 32768, 32768), ValueError, "width, height"),
    (lambda v: facemap.generate("castle"), ValueError, "name"),
    (lambda v: facemap.generate("bust", 99), ValueError, "detail"),
])
def test_wrong_arguments_are_named(above, call, error, name):
    with pytest.raises(error, match=name):
        call(above)
