"""Pictures: the program's bytes, and the arrays behind them."""

import copy
import math
import pickle
import re
import shlex

import numpy as np
import pytest

import facemap


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """The bust as a file."""
    path = tmp_path_factory.mktemp("model") / "bust.obj"
    return path


def write_model(program, path):
    program("scene", "bust", "-o", path)
    first = path.read_text().splitlines()[0]
    return shlex.split(first.split(path.name, 1)[1])


def test_the_same_bytes_as_the_program(program, model, tmp_path, bust):
    flags = write_model(program, model)
    size = ["--size", "120x90", "-q"]
    for name, more, options in [
        ("plain.png", ["--samples", "1"], {}),
        ("edges.png", ["--samples", "edges", "--background", "#2b3440"],
         {"samples": "edges", "background": "#2b3440"}),
        ("grid.png", ["--samples", "2x2", "--normals", "flat", "--falloff", "inverse-square"],
         {"samples": 2, "normals": "flat", "falloff": "inverse-square"}),
        ("window.png", ["--samples", "3x3", "--filter", "blackman-harris", "--filter-width", "2"],
         {"samples": 3, "filter": "blackman-harris", "filter_width": 2}),
        ("sky.png", ["--sky", "0.5,0.6,0.7,0.2,0.2,0.2", "--ambient", "0.1,0.1,0.1"],
         {"sky_up": (0.5, 0.6, 0.7), "sky_down": (0.2, 0.2, 0.2), "ambient": (0.1, 0.1, 0.1)}),
        ("part.png", ["--crop", "10,20,64x32"], {"crop": (10, 20, 64, 32)}),
    ]:
        program("render", model, "-o", tmp_path / name, *flags, *size, *more)
        frame = bust.render(width=120, height=90, **options)
        assert frame.png() == (tmp_path / name).read_bytes(), name
        assert frame._repr_png_() == frame.png()
        frame.save(tmp_path / f"ours_{name}")
        assert (tmp_path / f"ours_{name}").read_bytes() == frame.png()


def test_what_is_made_up_is_what_the_program_makes_up(program, model, tmp_path):
    write_model(program, model)
    program("render", model, "-o", tmp_path / "a.png", "-q", "--size", "64x48")
    assert facemap.load(model).render(width=64, height=48).png() == (tmp_path / "a.png").read_bytes()


@pytest.mark.parametrize("flags, camera", [
    (["--camera", "1,2,3", "--projection", "plane", "--field-angle", "40"],
     facemap.Camera((1, 2, 3), lens="plane", field_angle=40)),
    (["--lens", "orthographic"], facemap.Camera(lens="orthographic")),
    (["--lens", "orthographic", "--ortho-height", "1.5", "--look-at", "0,1,0"],
     facemap.Camera(lens="orthographic", height=1.5, look_at=(0, 1, 0))),
    (["--lens", "equirect", "--camera", "0.5,1.5,2"], facemap.Camera((0.5, 1.5, 2), lens="equirect")),
    (["--lens", "cube", "--camera", "0.5,1.5,2"], facemap.Camera((0.5, 1.5, 2), lens="cube")),
    (["--up", "z", "--camera", "3,0,0.5"], facemap.Camera((3, 0, 0.5), up=(0, 0, 1))),
    (["--lens", "opencv", "--camera-matrix", "60,61,47,31", "--distortion", "0.1,-0.05,0.001,0.002"],
     facemap.Camera.from_opencv([[60, 0, 47], [0, 61, 31], [0, 0, 1]], [0.1, -0.05, 0.001, 0.002])),
    (["--lens", "opencv-fisheye", "--camera-matrix", "40,40,47,31", "--distortion", "0.1,-0.05,0.01,0.002",
      "--opencv-pose", "1,0,0,0,0,-1,0,1,0,0,-1,3"],
     facemap.Camera.from_opencv((40, 40, 47, 31), [0.1, -0.05, 0.01, 0.002],
                                [[1, 0, 0, 0], [0, -1, 0, 1], [0, 0, -1, 3]], fisheye=True)),
])
def test_every_lens_is_the_programs(program, model, tmp_path, flags, camera):
    write_model(program, model)
    light = ["--light", "1,3,4", "--spot", "-2,4,1,2,-4,-1,40,20,1,0.5,0.5", "--sun", "-1,-2,-1,0.3,0.3,0.3"]
    lights = [facemap.Light((1, 3, 4)),
              facemap.Light.spot((-2, 4, 1), (2, -4, -1), 20, 10, color=(1, 0.5, 0.5)),
              facemap.Light.sun((-1, -2, -1), (0.3, 0.3, 0.3))]
    program("render", model, "-o", tmp_path / "a.png", "-q", "--size", "96x64", *light, *flags)
    frame = facemap.load(model).render(camera, lights, 96, 64)
    assert frame.png() == (tmp_path / "a.png").read_bytes()


def test_planes_are_the_programs(program, model, tmp_path, bust):
    flags = write_model(program, model)
    frame = bust.render(width=60, height=40, planes="all")
    from facemap._options import PLANES
    wanted = [f for name in PLANES.values() for f in ("--aov", f"{name}={tmp_path / name}.npy")]
    program("render", model, "-o", tmp_path / "a.exr", "-q", "--size", "60x40", *flags, *wanted)
    for name, plane in PLANES.items():
        theirs = np.load(tmp_path / f"{plane}.npy")
        if name == "light_mask":
            theirs = np.unpackbits(theirs.reshape(40, 60, -1), axis=2, count=8, bitorder="little").astype(bool)
        assert np.array_equal(getattr(frame, name), theirs, equal_nan=theirs.dtype.kind == "f"), name
        frame.save(tmp_path / "ours.npy", name)
        assert (tmp_path / "ours.npy").read_bytes() == (tmp_path / f"{plane}.npy").read_bytes(), name


@pytest.mark.parametrize("name, flags, options", [
    ("a.png", ["--bits", "16", "--exposure", "0.5", "--curve", "filmic"],
     {"bits": 16, "exposure": 0.5, "curve": "filmic"}),
    ("a.png", ["--transfer", "linear"], {"transfer": "linear"}),
    ("a.jpg", ["--quality", "70"], {"quality": 70}),
    ("a.exr", ["--aov", "z", "--aov", "id"], {"layers": ["depth", "face_id"]}),
    ("a.exr", ["--bits", "32"], {"bits": 32}),
    ("a.pfm", [], {}),
    ("a.npy", [], {}),
])
def test_every_format_is_the_programs(program, model, tmp_path, bust, name, flags, options):
    view = write_model(program, model)
    program("render", model, "-o", tmp_path / name, "-q", "--size", "60x40", *view, *flags)
    bust.render(width=60, height=40).save(tmp_path / f"ours_{name}", **options)
    assert (tmp_path / f"ours_{name}").read_bytes() == (tmp_path / name).read_bytes()


def test_arrays_are_shared_and_outlive_the_frame(bust):
    frame = bust.render(width=20, height=10)
    assert np.shares_memory(frame.color, frame.color) and np.shares_memory(frame.depth, frame.depth)
    assert frame.color.shape == (10, 20, 3) and frame.color.dtype == np.float32
    assert frame.image.shape == (10, 20, 3) and frame.image.dtype == np.uint8
    assert frame.face_id.dtype == np.int32 and frame.normal.shape == (10, 20, 3)
    assert frame.light_mask.shape == (10, 20, 8) and frame.light_mask.dtype == np.bool_
    assert np.array_equal(np.isinf(frame.range), frame.face_id < 0)
    color, kept = frame.color, frame.color.copy()
    del frame
    assert np.array_equal(color, kept)
    with pytest.raises(ValueError):
        color[0, 0] = 1


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy] + [
    lambda frame, i=i: pickle.loads(pickle.dumps(frame, i)) for i in range(pickle.HIGHEST_PROTOCOL + 1)])
def test_every_way_to_copy_a_frame_gives_the_same(bust, again):
    frame = bust.render(width=20, height=10, planes="all")
    copied = again(frame)
    assert copied.png() == frame.png() and copied.planes == frame.planes
    assert copied.statistics == frame.statistics and copied.warnings == frame.warnings
    for name in ("color", "image", *frame.planes):
        one, other = getattr(copied, name), getattr(frame, name)
        assert np.array_equal(one, other, equal_nan=one.dtype.kind == "f") and one.dtype == other.dtype, name
    assert again(facemap.Frame.from_array(np.ones((2, 3), np.float32))).color.shape == (2, 3, 3)


def test_planes_that_were_not_asked_for_say_so(floor):
    frame = floor.render(width=4, height=4, planes=["uv"])
    assert frame.planes == ("uv",) and np.isnan(frame.uv).all()
    with pytest.raises(ValueError, match="depth: .*planes"):
        frame.depth
    with pytest.raises(ValueError, match="light_mask: .*planes"):
        frame.light_mask


def test_cameras_one_after_the_other_share_the_lights_work(bust):
    cameras = [facemap.Camera((x, 1, 3), (0, 1, 0)) for x in (-1, 0, 1)]
    frames = list(bust.frames(cameras, width=32, height=32))
    assert [f.png() for f in frames] == [bust.render(c, width=32, height=32).png() for c in cameras]


@pytest.mark.parametrize("lens", ["surface", "plane", "equirect", "cube", "opencv", "opencv-fisheye"])
def test_a_views_answers_along_a_cameras_rays_are_the_pictures(bust, lens):
    matrix = (40, 40, 47, 31) if lens.startswith("opencv") else None
    camera = facemap.Camera((0.5, 1.5, 2), lens=lens, matrix=matrix)
    origin, directions = camera.rays(bust, 96, 64)
    view = facemap.View(bust, origin)
    face, distance = view.nearest(directions)
    frame = bust.render(camera, width=96, height=64)
    assert np.array_equal(face, frame.face_id) and np.array_equal(distance, frame.range)
    with pytest.raises(ValueError, match="lens"):
        facemap.Camera(lens="orthographic").rays(bust)


def test_arrays_become_pictures(tmp_path):
    levels = np.arange(48, dtype=np.uint8).reshape(4, 4, 3) * 5
    facemap.save_png(tmp_path / "a.png", levels)
    assert np.array_equal(facemap.Frame.from_array(levels).image, levels)
    assert (tmp_path / "a.png").read_bytes() == facemap.Frame.from_array(levels).png()
    grey = facemap.Frame.from_array(np.array([[0.0, 0.5], [1.0, 2.0]]))
    assert grey.image[:, :, 0].tolist() == [[0, 188], [255, 255]]
    with pytest.raises(ValueError, match="array: the shape"):
        facemap.save_png(tmp_path / "b.png", np.zeros(3))
    with pytest.raises(TypeError, match="array"):
        facemap.save_png(tmp_path / "b.png", np.zeros((2, 2), int))


@pytest.mark.parametrize("options, error, name", [
    ({"width": 0}, ValueError, "width"),
    ({"height": 2.5}, TypeError, "height"),
    ({"samples": 17}, ValueError, "samples"),
    ({"samples": "many"}, ValueError, "samples"),
    ({"planes": ["colour"]}, ValueError, "planes"),
    ({"planes": 3}, TypeError, "planes"),
    ({"filter": "cone"}, ValueError, "filter"),
    ({"filter_width": math.nan}, ValueError, "filter_width"),
    ({"crop": (0, 0, 99, 99)}, ValueError, "crop"),
    ({"background": (1, 2)}, ValueError, "background"),
    ({"background": (-1, 0, 0)}, ValueError, "background"),
    ({"background": "#12345g"}, ValueError, "background"),
    ({"up": (0, 0, 0)}, ValueError, "up"),
    ({"threads": -1}, ValueError, "threads"),
    ({"colour": 1}, TypeError, "colour"),
    ({"camera": 7}, TypeError, "camera"),
    ({"lights": 7}, TypeError, "lights"),
    ({"lights": [7]}, TypeError, "lights"),
    ({"lights": [facemap.Light((0, math.inf, 0))]}, ValueError, "position"),
    ({"lights": [facemap.Light(intensity=-1)]}, ValueError, "intensity"),
    ({"lights": [facemap.Light.sun((0, 0, 0))]}, ValueError, "direction"),
    ({"camera": facemap.Camera(lens="pinhole")}, ValueError, "lens"),
    ({"camera": facemap.Camera(field_angle=0)}, ValueError, "field_angle"),
    ({"camera": facemap.Camera(field_angle=180, lens="plane")}, ValueError, "field_angle"),
    ({"camera": facemap.Camera(lens="opencv")}, ValueError, "matrix"),
    ({"camera": facemap.Camera(pose=np.ones((3, 4)))}, ValueError, "pose"),
    ({"camera": facemap.Camera((0, 0, 0), (0, 0, 0))}, ValueError, "look_at"),
    ({"camera": facemap.Camera((0, np.nan, 0))}, ValueError, "position"),
])
def test_wrong_arguments_are_named(floor, options, error, name):
    with pytest.raises(error, match=name):
        floor.render(**{"width": 8, "height": 8, **options})


def test_frames_complain_at_once(floor, tmp_path):
    with pytest.raises(TypeError, match="cameras: .*not Camera"):
        floor.frames(facemap.Camera())
    with pytest.raises(ValueError, match="width"):
        floor.frames([], width=-5)
    with pytest.raises(ValueError, match="bits"):
        floor.render(width=8, height=8).save(tmp_path / "depth.npy", "depth", bits=77)


def test_lights_and_cameras_of_arrays_are_compared(floor):
    lamps = [facemap.Light(np.array([0, 1, z])) for z in (2, 3)]
    floor.lights[:] = lamps
    floor.lights.remove(facemap.Light((0, 1, 3)))
    assert floor.lights == lamps[:1] != lamps[1:] and lamps[0] != facemap.Camera() and lamps[0] != 7
    assert facemap.Light(color="#ffffff") == facemap.Light(color="#ffffff") != facemap.Light(color=np.ones(3))
    camera = facemap.Camera.from_opencv(np.eye(3), np.zeros(4), np.eye(4))
    assert camera == facemap.Camera.from_opencv(np.eye(3), np.zeros(4), np.eye(4)) != facemap.Camera()


def test_files_that_cannot_be_written_are_named(floor, tmp_path):
    frame = floor.render(width=4, height=4)
    with pytest.raises(facemap.Error, match=re.escape(str(tmp_path / "none" / "a.png"))):
        frame.save(tmp_path / "none" / "a.png")
    with pytest.raises(ValueError, match="path: no format"):
        frame.save("a.gif")
    with pytest.raises(ValueError, match="bits"):
        frame.save(tmp_path / "a.png", bits=32)
    with pytest.raises(ValueError, match="layers"):
        frame.save(tmp_path / "a.png", layers=["depth"])


def test_progress_is_told_and_its_exception_passed_on(bust):
    told = []
    bust.render(width=64, height=64, progress=lambda fraction, phase: told.append((fraction, phase)))
    assert told and told[-1] == (1.0, "done")
    with pytest.raises(ZeroDivisionError):
        bust.render(width=64, height=64, progress=lambda fraction, phase: 1 / 0)
