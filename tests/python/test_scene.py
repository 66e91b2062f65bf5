"""Scenes from arrays and files."""

import copy
import errno
import pickle
import threading
from types import SimpleNamespace

import numpy as np
import pytest

import facemap

CORNERS = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def test_arrays_are_the_scenes_own_and_read_only(floor):
    assert floor.vertices.dtype == np.float32 and floor.vertices.shape == (4, 3)
    assert floor.faces.tolist() == [[0, 2, 1], [0, 3, 2]]
    assert np.shares_memory(floor.vertices, floor.vertices)
    with pytest.raises(ValueError):
        floor.vertices[0, 0] = 7
    assert floor.bounds.tolist() == [[-1, 0, -1], [1, 0, 1]]
    assert floor.face_count == 2


def test_arrays_outlive_the_scene():
    vertices = facemap.Scene(CORNERS, [[0, 1, 2]]).vertices
    assert vertices.tolist() == CORNERS


def test_other_numbers_are_rounded_to_float32_once():
    scene = facemap.Scene(np.array(CORNERS) + 0.1, np.array([[0, 1, 2]], np.int16))
    assert np.array_equal(scene.vertices, (np.array(CORNERS) + 0.1).astype(np.float32))


@pytest.mark.parametrize("names", [("vertices", "faces"), ("vertices", "triangles")])
def test_meshes_of_others_are_taken(names):
    mesh = SimpleNamespace(**dict(zip(names, (CORNERS, [[0, 1, 2]]))))
    assert facemap.Scene(mesh).face_count == 1
    assert facemap.Scene.from_object(mesh).face_count == 1


def test_odd_faces_are_counted():
    scene = facemap.Scene(CORNERS, [[0, 1, 2], [2, 0, 1], [0, 0, 1]])
    assert scene.odd_faces == {"zero_area": 0, "repeated_vertex": 1, "duplicate": 1}
    assert scene.kept_faces.tolist() == [0]


def test_added_faces_come_behind_and_are_moved(floor):
    move = np.eye(4)
    move[:3, 3] = 0, 2, 0
    assert floor.add(facemap.Scene(CORNERS, [[0, 1, 2]]), move) is floor
    assert floor.face_count == 3
    assert floor.faces[2].tolist() == [4, 5, 6]
    assert floor.vertices[4].tolist() == [0, 2, 0]
    floor.add(SimpleNamespace(vertices=CORNERS, faces=[[0, 1, 2]])).add(floor)
    assert floor.face_count == 8


def test_faces_added_while_others_are_joined_are_kept(floor, monkeypatch):
    scene = facemap.Scene(CORNERS, [[0, 1, 2]]).add(floor)
    join = facemap._facemap.joined

    def joined(parts, threads):
        writer = threading.Thread(target=scene.add, args=(floor,))
        writer.start()
        writer.join()
        return join(parts, threads)

    with monkeypatch.context() as change:
        change.setattr(facemap._facemap, "joined", joined)
        assert scene.face_count == 3
    assert scene.face_count == 5
    assert pickle.loads(pickle.dumps(scene)).add(floor).face_count == 7


def test_mirrored_parts_keep_their_fronts(floor):
    floor.add(facemap.Scene(CORNERS, [[0, 1, 2]]), np.diag([-1.0, 1, 1, 1]))
    a, b, c = floor.vertices[floor.faces[2]]
    assert np.cross(b - a, c - a)[2] > 0


def assert_same_meshes(one, other):
    assert np.array_equal(one.vertices, other.vertices) and np.array_equal(one.faces, other.faces)


WAYS = [copy.copy, copy.deepcopy]
WAYS += [lambda thing, i=i: pickle.loads(pickle.dumps(thing, i)) for i in range(pickle.HIGHEST_PROTOCOL + 1)]


@pytest.mark.parametrize("again", WAYS)
def test_every_way_to_copy_a_scene_or_a_view_gives_the_same(floor, again):
    floor.lights = [facemap.Light((0, 2, 0))]
    copied, view = again(floor), again(facemap.View(floor, (0, 1, 0)))
    assert_same_meshes(copied, floor)
    assert copied.lights == floor.lights
    assert view.nearest([[0, -1, 0]]).distance.tolist() == [1]
    copied.add(floor)
    assert (copied.face_count, floor.face_count) == (4, 2)


@pytest.mark.parametrize("again", WAYS)
def test_what_lies_behind_is_copied_or_refused(again):
    assert again(facemap._facemap.Light.Kind.spot) == facemap._facemap.Light.Kind.spot
    for thing in facemap._facemap.Light(), facemap._facemap.RenderOptions(), facemap._facemap.Lens.equirect(4, 2):
        with pytest.raises(TypeError, match="cannot pickle"):
            again(thing)


def test_a_state_that_has_lost_bytes_is_refused(floor):
    again, (state,) = floor.render(width=4, height=4)._image.__reduce__()
    with pytest.raises(ValueError, match="bytes"):
        again((5, *state[1:]))
    with pytest.raises(ValueError, match="state"):
        again((*state[:3], state[3][:-1]))


def test_a_pickled_scene_is_the_same(bust):
    again = pickle.loads(pickle.dumps(bust))
    assert_same_meshes(again, bust)
    assert again.cameras == bust.cameras and again.lights == bust.lights
    size = {"width": 48, "height": 48, "planes": "all"}
    one, other = bust.render(**size), again.render(**size)
    assert one.png() == other.png()
    assert np.array_equal(one.light_mask, other.light_mask)


def test_a_file_is_read_with_its_materials(tmp_path):
    (tmp_path / "m.mtl").write_text("newmtl red\nKd 1 0 0\n")
    (tmp_path / "m.obj").write_text("mtllib m.mtl\no thing\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    scene = facemap.load(tmp_path / "m.obj")
    assert scene.materials == ["red"] and scene.objects == ["thing"] and scene.warnings == []
    again = pickle.loads(pickle.dumps(scene))
    assert again.materials == ["red"] and again.objects == ["thing"]


def test_a_broken_file_is_named_with_its_line(tmp_path):
    path = tmp_path / "broken.obj"
    path.write_text("v 0 0 0\nv 1 x 0\n")
    with pytest.raises(facemap.LoadError) as caught:
        facemap.load(path)
    assert caught.value.file == str(path) and caught.value.line == 2 and caught.value.reason
    assert str(caught.value).startswith(f"{path}:2:")
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, facemap.Error)
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value) and again.line == 2


def test_a_file_that_cannot_be_opened_is_an_os_error_too(tmp_path):
    with pytest.raises(OSError) as caught:
        facemap.load(tmp_path / "none.obj")
    assert isinstance(caught.value, facemap.OpenError) and isinstance(caught.value, facemap.LoadError)
    for error in caught.value, pickle.loads(pickle.dumps(caught.value)):
        assert error.filename == error.file == str(tmp_path / "none.obj") and error.errno == errno.ENOENT
        assert str(error) == f"{error.file}: {error.strerror}" and error.line == 0
    (tmp_path / "broken.obj").write_text("v 1 x 0\n")
    with pytest.raises(facemap.LoadError) as caught:
        facemap.load(tmp_path / "broken.obj")
    assert not isinstance(caught.value, OSError)


@pytest.mark.parametrize("vertices, faces, error, name", [
    (CORNERS, [[0, 1, 3]], IndexError, "faces: 3 "),
    (CORNERS, [[0, 1, -1]], IndexError, "faces: -1 "),
    (CORNERS, np.zeros((0, 3), int), ValueError, "faces: .*at least one"),
    (np.zeros((0, 3)), [[0, 1, 2]], IndexError, "faces"),
    (CORNERS, [[0, 1, 2, 0]], ValueError, "faces: the shape"),
    (CORNERS, [0, 1, 2], ValueError, "faces: the shape"),
    (CORNERS, [[0, 1, 2.0]], TypeError, "faces"),
    ([[0, 0], [1, 0]], [[0, 1, 0]], ValueError, "vertices: the shape"),
    ([[0, 0, np.nan]], [[0, 0, 0]], ValueError, "vertices: .*finite"),
    ([[0, 0, 1e300]], [[0, 0, 0]], ValueError, "vertices: .*finite"),
    ([[0, 0, 1j]], [[0, 0, 0]], TypeError, "vertices"),
    ([["a", "b", "c"]], [[0, 0, 0]], TypeError, "vertices"),
    ([[0, 0, 0], [1]], [[0, 0, 0]], TypeError, "vertices"),
    (None, [[0, 0, 0]], TypeError, "vertices"),
    (7, None, TypeError, "faces"),
    ("x.obj", None, TypeError, "facemap.load reads files"),
    (np.ma.masked_equal(CORNERS, 1), [[0, 1, 2]], ValueError, "vertices: some numbers are masked"),
    (CORNERS, np.ma.masked_equal([[0, 1, 2]], 1), ValueError, "faces: some numbers are masked"),
])
def test_wrong_arrays_are_named(vertices, faces, error, name):
    with pytest.raises(error, match=name):
        facemap.Scene(vertices, faces)


def test_wrong_vertex_arrays_and_transforms_are_named(floor):
    with pytest.raises(ValueError, match="normals: there are 1"):
        facemap.Scene(CORNERS, [[0, 1, 2]], normals=[[0, 0, 1]])
    with pytest.raises(ValueError, match="texcoords: the shape"):
        facemap.Scene(CORNERS, [[0, 1, 2]], texcoords=CORNERS)
    with pytest.raises(ValueError, match="transform: the shape"):
        floor.add(floor, np.eye(3))
    with pytest.raises(ValueError, match="transform: the last row"):
        floor.add(floor, np.ones((4, 4)))
    with pytest.raises(TypeError, match="faces"):
        floor.add(object())
