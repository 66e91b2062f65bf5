"""The ready uses, beside what is known of simple scenes and beside View's own answers."""

import numpy as np
import pytest

import facemap


def street(width: float, height: float) -> facemap.Scene:
    """Two walls along z, so long that their ends do not matter."""
    vertices, faces = [], []
    for x in (-width / 2, width / 2):
        first = len(vertices)
        vertices += [[x, 0, -1e6], [x, 0, 1e6], [x, height, 1e6], [x, height, -1e6]]
        faces += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
    return facemap.Scene(vertices, faces)


@pytest.fixture
def roof() -> facemap.Scene:
    """A square of 2 x 2 at height 1, over the middle."""
    return facemap.Scene([[-1, 1, -1], [1, 1, -1], [1, 1, 1], [-1, 1, 1]], [[0, 2, 1], [0, 3, 2]])


# ---- sky ----------------------------------------------------------------------------------------------------


def test_a_hemisphere_is_shared_evenly():
    sky = facemap.hemisphere(1000, (0, 0, 3))
    assert sky.shape == (1000, 3) and np.allclose(np.linalg.norm(sky, axis=1), 1)
    assert np.allclose(np.sort(sky[:, 2]), (np.arange(1000) + 0.5) / 1000)
    assert np.abs(sky[:, :2].mean(axis=0)).max() < 2e-3
    sides = np.linalg.norm(sky[:, np.newaxis] - sky, axis=2) + 9 * np.eye(1000)
    assert sides.min() > 0.6 * np.sqrt(2 * np.pi / 1000)


@pytest.mark.parametrize("directions, most", [(64, 0.08), (256, 0.025), (1024, 0.012), (4096, 0.004)])
def test_sky_view_factors_of_streets(directions, most):
    x = np.linspace(-0.45, 0.45, 10)
    for width, height in ((1, 0.3), (2, 1.5), (1, 4), (3.5, 2.2)):
        points = np.stack([width * x, 0 * x, 0.1 * x], axis=1)
        left, right = (np.hypot(width * (0.5 + sign * x), height) for sign in (1, -1))
        sines = np.array([width * (0.5 + x) / left, width * (0.5 - x) / right])  # of the walls' angles from the zenith
        scene = street(width, height)
        found = facemap.sky_view_factor(scene, points, directions=directions)
        assert np.abs(found - sines.mean(axis=0)).max() < most
        found = facemap.sky_view_factor(scene, points, directions=directions, weighting="plain")
        assert np.abs(found - np.arcsin(sines).sum(axis=0) / np.pi).max() < most


def test_sky_view_factor_counts_directions(bust, random):
    points = random.uniform(-2, 2, (3, 4, 3)).astype(np.float32)
    normals = random.normal(size=(3, 4, 3))
    sky = facemap.hemisphere(200, (0, 0, 1))
    free = np.array([facemap.View(bust, p).nearest(sky).face < 0 for p in points.reshape(-1, 3)]).reshape(3, 4, 200)
    unit = normals.astype(np.float32).astype(float)
    unit /= np.linalg.norm(unit, axis=-1, keepdims=True)
    known = (free * np.maximum(unit @ sky.T, 0)).sum(axis=-1) * 2 / 200
    found = facemap.sky_view_factor(bust, points, normals, directions=200, up=(0, 0, 1))
    assert found.shape == (3, 4) and np.allclose(found, known, atol=1e-12)


def test_an_open_plain_sees_all_of_the_sky(floor):
    assert facemap.sky_view_factor(floor, [0, 0, 0], directions=100) == pytest.approx(1, abs=1e-12)
    tilted = facemap.sky_view_factor(floor, [0, 1e-3, 0], (1, 0, 0), directions=4096)
    assert tilted == pytest.approx(0.5, abs=2e-3)
    assert facemap.sky_view_factor(floor, [0.3, -1, 0.2], directions=500) < 0.6


# ---- sun ----------------------------------------------------------------------------------------------------


def test_sun_hours(roof):
    suns = np.array([[0, 2, 0], [1, 1, 0], [5, 1, 0], [1, -1, 0]])
    points = [[0.5, 0, 0.1], [-0.5, 0, 0.2], [0.1, 2, 0]]
    assert facemap.sun_hours(roof, points, suns).tolist() == [2, 1, 3]
    assert facemap.sun_hours(roof, points, suns, 0.25).tolist() == [0.5, 0.25, 0.75]
    assert facemap.sun_hours(roof, points, suns, [1, 2, 4, 8]).tolist() == [6, 4, 7]
    assert facemap.sun_hours(roof, points, suns, normals=(-1, 0.5, 0)).tolist() == [0, 0, 1]
    assert facemap.sun_hours(roof, [[[0.5, 0, 0]]], suns, up=(0, -1, 0)).tolist() == [[1]]
    assert facemap.sun_hours(roof, points, suns[3:]).tolist() == [0, 0, 0]


# ---- terrain ------------------------------------------------------------------------------------------------


def test_a_terrain_has_a_vertex_a_height():
    heights = np.array([[1.0, 2, 3], [4, 5, np.nan], [7, 8, 9], [1, 1, 1]])
    land = facemap.terrain(heights, 10, (100, 200))
    assert land.face_count == 2 * 4 and len(land.vertices) == 12
    assert land.vertices[7].tolist() == [110, 8, 220]
    assert facemap.terrain(heights, 10, (100, 200), up="z").vertices[7].tolist() == [110, 180, 8]
    for up, axis in (("y", 1), ("z", 2)):
        corners = facemap.terrain(heights, up=up).vertices[facemap.terrain(heights, up=up).faces]
        assert (np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, axis] > 0).all()


def test_masked_heights_are_holes():
    heights = np.ma.masked_equal([[1.0, 2, 3], [1, 2, -9]], -9)
    land = facemap.terrain(heights)
    assert land.face_count == 2 and np.array_equal(land.faces, facemap.terrain(heights.filled(np.nan)).faces)
    assert facemap.terrain(np.ma.array([[1, 2], [3, 4]])).face_count == 2


def test_terrains_keep_neighbours_apart():
    for up in "yz":
        with pytest.raises(ValueError, match="corner: .*subtract an offset"):
            facemap.terrain(np.zeros((3, 3)), 0.1, (5e5, 5.2e6), up)
    assert facemap.terrain(np.zeros((3, 3)), 10, (5e5, 5.2e6)).odd_faces["zero_area"] == 0


def test_points_stand_on_the_ground(random):
    heights = random.uniform(0, 3, (6, 7))
    land = facemap.terrain(heights)
    on_vertices = facemap.on_ground(land, land.vertices + [0, 9, 0], 0.5)
    assert np.allclose(on_vertices, land.vertices + [0, 0.5, 0], atol=1e-5)
    places = random.uniform(0, 5, (2, 20, 3))
    found = facemap.on_ground(land, places)
    for place in found.reshape(-1, 3):
        far = facemap.View(land, place + [0, 50, 0]).nearest([0, -1, 0])
        assert far.face >= 0 and far.distance == pytest.approx(50, abs=1e-4)
    assert np.isnan(facemap.on_ground(land, [[-1, 0, 2]])).all()


def test_viewshed_is_what_views_see(random):
    heights = random.uniform(0, 3, (12, 15)) + 0.2 * np.arange(12)[:, np.newaxis]
    land = facemap.terrain(heights)
    observers = random.uniform(1, 10, (3, 3))
    eyes = facemap.on_ground(land, observers, 1.7)
    known = np.array([facemap.View(land, eye).visible_vertices() for eye in eyes])
    assert 0 < known.sum() < known.size
    assert np.array_equal(facemap.viewshed(land, observers), known.sum(axis=0))
    assert np.array_equal(facemap.viewshed(land, observers, each=True), known)
    assert np.array_equal(facemap.viewshed(land, eyes, stand=False, eye_height=0), known.sum(axis=0))
    near = np.linalg.norm(land.vertices.astype(float) - eyes[0], axis=1) <= 4
    assert np.array_equal(facemap.viewshed(land, observers[0], max_distance=4), known[0] & near)
    faces = np.array([facemap.View(land, eye).visible_faces().visible for eye in eyes])
    assert np.array_equal(facemap.viewshed(land, observers, of="faces"), faces.sum(axis=0))
    masts = (land.vertices + [0, 1.5, 0]).astype(np.float32)
    lifted = np.array([facemap.View(land, eye).visible(masts) for eye in eyes])
    assert np.array_equal(facemap.viewshed(land, observers, target_height=1.5), lifted.sum(axis=0))
    corners = land.vertices[land.faces].astype(float)
    middles = corners.mean(axis=1).astype(np.float32)
    own = np.arange(land.face_count)
    on_faces = np.array([facemap.View(land, eye).visible(middles, own) for eye in eyes])
    assert np.array_equal(facemap.viewshed(land, observers, middles, faces=own), on_faces.sum(axis=0))
    grid = masts.reshape(12, 15, 3)
    assert np.array_equal(facemap.viewshed(land, observers, grid), lifted.sum(axis=0).reshape(12, 15))


def test_viewshed_of_no_points():
    land = facemap.terrain(np.zeros((2, 2)))
    for observers, shape in (([[0.5, 0, 0.5]], (1, 0)), (np.zeros((0, 3)), (0, 0)), ([0.5, 0, 0.5], (0,))):
        assert facemap.viewshed(land, observers, np.zeros((0, 3)), each=True).shape == shape
    assert facemap.viewshed(land, np.zeros((2, 0, 3)), each=True).shape == (2, 0, 4)
    assert facemap.viewshed(land, [0.5, 0, 0.5], max_distance=0).tolist() == [0, 0, 0, 0]


def test_where_there_is_no_ground_nothing_is_seen():
    heights = np.zeros((4, 4))
    heights[0, 0] = np.nan
    counts = facemap.viewshed(facemap.terrain(heights), [[2, 0, 2]]).reshape(4, 4)
    assert counts[0, 0] == 0 and counts.sum() == 15


# ---- lamps --------------------------------------------------------------------------------------------------


def test_lamp_coverage(roof):
    lamps = [facemap.Light((0, 3, 0), (1, 0.5, 0), 8), facemap.Light.sun((0, -1, 0), intensity=2),
             facemap.Light.spot((4, 2, 0), (0, -1, 0), 30, intensity=4)]
    points = np.array([[0, 0, 0.1], [4, 0, 0], [0, 2, 0]])
    lit, irradiance = facemap.lamp_coverage(roof, points, lamps, (0, 1, 0))
    assert lit.tolist() == [[False, True, True], [False, True, True], [False, True, False]]
    by_lamp = 8 * np.array([1, 0.5, 0]) * 3 / 125
    assert np.allclose(irradiance, [[0, 0, 0], by_lamp + 2 + 4 / 4, [10, 6, 2]])
    lit, irradiance = facemap.lamp_coverage(roof, points[1], lamps)
    assert lit.tolist() == [True, True, True] and np.allclose(irradiance, by_lamp * 5 / 3 + 2 + 1)
    lit, irradiance = facemap.lamp_coverage(roof, points.reshape(3, 1, 3), [[0, 3, 0]], (0, -1, 0))
    assert not lit.any() and lit.shape == (1, 3, 1) and irradiance.shape == (3, 1, 3)
    lit, irradiance = facemap.lamp_coverage(roof, points, [])
    assert lit.shape == (0, 3) and not irradiance.any()


@pytest.mark.filterwarnings("error")
def test_lamp_coverage_at_a_lamps_very_place(roof):
    place = [[1, 3, 0]]
    for fields, known in (({}, np.inf), ({"color": (1, 0, 0)}, [np.inf, 0, 0]), ({"intensity": 0}, 0),
                          ({"range": 2}, np.inf), ({"range": 1e-300}, np.inf)):
        lit, irradiance = facemap.lamp_coverage(roof, place, facemap.Light(place[0], **fields))
        assert lit.all() and np.array_equal(irradiance[0], np.broadcast_to(known, 3))
        lit, irradiance = facemap.lamp_coverage(roof, place, facemap.Light(place[0], **fields), (0, 1, 0))
        assert not lit.any() and not irradiance.any()
    for angle in (30, 180):
        lit, irradiance = facemap.lamp_coverage(roof, place, facemap.Light.spot(place[0], (0, -1, 0), angle))
        assert not lit.any() and not irradiance.any()
    assert not facemap.lamp_coverage(roof, [[1, 3, 1]], facemap.Light(place[0], range=1e-300)).lit.any()


def test_lamp_coverage_is_what_a_picture_shows():
    """Of a white floor, cone and range included."""
    floor = facemap.Scene([[-9, 0, -9], [9, 0, -9], [9, 0, 9], [-9, 0, 9]], [[0, 2, 1], [0, 3, 2]], color=(1, 1, 1))
    floor.add(facemap.Scene([[0, 0.5, 0], [1, 0.5, 0], [0, 0.7, 1]], [[0, 2, 1]]))
    lamps = [facemap.Light((1, 2, 1), (1, 0.8, 0.5), 3, falloff=True, range=4),
             facemap.Light.spot((-1, 3, 0), (0.3, -1, 0.1), 40, 10, intensity=5, falloff=True),
             facemap.Light.sun((1, -2, 0.5), intensity=0.3)]
    camera = facemap.Camera((0, 6, 0.1), look_at=(0, 0, 0), lens="plane")
    frame = floor.render(camera, lamps, 64, 64, planes=("position", "face_id", "light_mask"), materials=False,
                         background=(0, 0, 0))
    is_floor = frame.face_id < 2
    points = frame.position[is_floor]
    points[:, 1] = 0
    lit, irradiance = facemap.lamp_coverage(floor, points, lamps, (0, 1, 0))
    assert np.array_equal(lit.T, frame.light_mask[is_floor])
    assert np.allclose(irradiance, frame.color[is_floor], rtol=1e-4, atol=1e-5)


# ---- lidar --------------------------------------------------------------------------------------------------


def test_lidar_draws_true_circles(floor):
    pose = np.eye(4)
    pose[:3, :3] = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])  # the sensor's z is the world's y
    pose[:3, 3] = (0.05, 0.25, -0.1)
    scan = facemap.lidar(floor, pose, [-60, -30, 10], np.arange(0, 360, 5), max_range=0.6)
    assert scan.ranges.shape == scan.faces.shape == (3, 72) and scan.points.shape == (3, 72, 3)
    assert np.allclose(scan.ranges[0], 0.25 / np.sin(np.radians(60)), rtol=1e-6)
    assert np.allclose(scan.ranges[1], 0.5, rtol=1e-6)
    assert np.isinf(scan.ranges[2]).all() and (scan.faces[2] == -1).all() and np.isnan(scan.points[2]).all()
    rings = scan.points[:2] - pose[:3, 3]
    assert np.allclose(np.hypot(rings[..., 0], rings[..., 2]), [[0.25 / np.tan(np.radians(e))] for e in (60, 30)],
                       rtol=1e-5)
    assert np.allclose(scan.points[:2, :, 1], 0, atol=1e-6)
    assert scan.points[1, 0] == pytest.approx([0.05 + 0.25 * np.sqrt(3), 0, -0.1], abs=1e-6)     # ahead
    assert scan.points[1, 18, 2] < -0.5                                                         # left
    assert (facemap.lidar(floor, pose, [-60, -30], [0], 0.4).faces[:, 0] >= 0).tolist() == [True, False]
    assert (facemap.lidar(floor, pose, [-60, -30], [0], 9, 0.4).faces[:, 0] >= 0).tolist() == [False, True]


# ---- camera rig ---------------------------------------------------------------------------------------------


def test_a_rig_is_its_cameras_one_by_one(bust):
    K = np.array([[40, 0, 24], [0, 40, 18], [0, 0, 1.0]])
    back = np.diag([-1.0, 1, -1, 1])
    rig = np.eye(4)
    rig[:3, 3] = (0, 0, 4)
    turned = np.diag([1.0, -1, -1, 1])
    frames = facemap.camera_rig(bust, K, [0.05, 0.01, 0, 0], [turned, back], 48, 36, rig=rig)
    for frame, pose in zip(frames, (turned, back)):
        camera = facemap.Camera.from_opencv(K, [0.05, 0.01, 0, 0], pose @ rig, fisheye=True)
        assert np.array_equal(frame.image, bust.render(camera, width=48, height=36).image)
    assert len(frames) == 2
    plain = facemap.camera_rig(bust, np.stack([K, 2 * K - np.diag([0, 0, 1])]), None, [turned, back], 48, 36,
                               fisheye=False)
    assert plain[0].face_id.shape == (36, 48)


# ---- wrong arguments ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("call, error, name", [
    (lambda s: facemap.sky_view_factor(7, [[0, 0, 0]]), TypeError, "scene"),
    (lambda s: facemap.sky_view_factor(s, [[0, 0]]), ValueError, "points: the shape"),
    (lambda s: facemap.sky_view_factor(s, [[0, 0, np.nan]]), ValueError, "points"),
    (lambda s: facemap.sky_view_factor(s, [[0, 0, 0]], [[0, 0, 0]]), ValueError, "normals: the zero"),
    (lambda s: facemap.sky_view_factor(s, [[0, 0, 0]], np.ones((2, 3))), ValueError, "normals: the shape"),
    (lambda s: facemap.sky_view_factor(s, [[0, 0, 0]], directions=0), ValueError, "directions"),
    (lambda s: facemap.sky_view_factor(s, [[0, 0, 0]], weighting="sine"), ValueError, "weighting"),
    (lambda s: facemap.sky_view_factor(s, [[0, 0, 0]], up=(0, 0, 0)), ValueError, "up"),
    (lambda s: facemap.sky_view_factor(s, [[0, 0, 0]], faces=[9]), IndexError, "faces"),
    (lambda s: facemap.sky_view_factor(s, [[0, 0, 0]], progress=3), TypeError, "progress"),
    (lambda s: facemap.sun_hours(s, [[0, 0, 0]], [[0, 0, 0]]), ValueError, "sun_directions"),
    (lambda s: facemap.sun_hours(s, [[0, 0, 0]], [[0, 1, 0]], [1, 2]), ValueError, "hours"),
    (lambda s: facemap.sun_hours(s, [[0, 0, 0]], [[0, 1, 0]], -1), ValueError, "hours"),
    (lambda s: facemap.terrain([1, 2]), ValueError, "heights"),
    (lambda s: facemap.terrain([[1, np.nan], [1, 1]]), ValueError, "heights"),
    (lambda s: facemap.terrain(np.zeros((2, 2)), 0), ValueError, "spacing"),
    (lambda s: facemap.terrain(np.zeros((2, 2)), up="x"), ValueError, "up"),
    (lambda s: facemap.viewshed(s, [[5, 0, 5]]), ValueError, "observers: there is no ground"),
    (lambda s: facemap.viewshed(s, [[0, 0, 0]], of="edges"), ValueError, "of"),
    (lambda s: facemap.viewshed(s, [[0, 0, 0]], of="faces", target_height=1), ValueError, "of"),
    (lambda s: facemap.viewshed(s, [[0, 0, 0]], faces=[0]), ValueError, "faces"),
    (lambda s: facemap.viewshed(s, [[0, 0, 0]], eye_height="tall"), TypeError, "eye_height"),
    (lambda s: facemap.viewshed(s, [[0, 0, 0]], max_distance=-1), ValueError, "max_distance: -1.0 is below 0"),
    (lambda s: facemap.viewshed(s, [[0, 0, 0]], [[0, 0, 0]], of="nonsense"), ValueError, "of"),
    (lambda s: facemap.viewshed(s, [[0, 0, 0]], of="faces", tolerance="junk"), TypeError, "tolerance"),
    (lambda s: facemap.viewshed(s, [[0, 0, 0]], of="faces", progress=5), TypeError, "progress"),
    (lambda s: facemap.viewshed(s, np.zeros((0, 3)), threads=-1), ValueError, "threads"),
    (lambda s: facemap.viewshed(s, [[0, 0, 0]], np.ma.masked_equal([[0, 1, 2]], 1)), ValueError,
     "points: some numbers are masked"),
    (lambda s: facemap.lamp_coverage(s, [[0, 0, 0]], 7), TypeError, "lamps"),
    (lambda s: facemap.lamp_coverage(s, [[0, 0, 0]], [[0, 0]]), ValueError, "lamps"),
    (lambda s: facemap.lamp_coverage(s, [[0, 0, 0]], [facemap.Light(), 3]), TypeError, "lamps"),
    (lambda s: facemap.lidar(s, np.eye(3), [0], [0]), ValueError, "pose"),
    (lambda s: facemap.lidar(s, 2 * np.eye(4) - np.diag([0, 0, 0, 1]), [0], [0]), ValueError, "pose"),
    (lambda s: facemap.lidar(s, np.eye(4) + 1e39 * np.eye(4, k=3), [0], [0]), ValueError, "pose: .*finite"),
    (lambda s: facemap.lidar(s, np.eye(4), [91], [0]), ValueError, "elevations"),
    (lambda s: facemap.lidar(s, np.eye(4), [0], 0), ValueError, "azimuths"),
    (lambda s: facemap.lidar(s, np.eye(4), [0], [0], "far"), TypeError, "max_range"),
    (lambda s: facemap.camera_rig(s, np.eye(3), None, np.eye(4), 8, 8), ValueError, "poses"),
    (lambda s: facemap.camera_rig(s, np.eye(3), None, [np.eye(4)], 8, 8, rig=np.diag([2, 2, 2, 1])), ValueError,
     "^rig: .*no rotation"),
    (lambda s: facemap.camera_rig(s, np.eye(3), None, [np.eye(4), np.diag([1, 1, -1, 1])], 8, 8), ValueError,
     "^poses: camera 1: .*no rotation"),
    (lambda s: facemap.camera_rig(s, [np.eye(3), np.diag([1, -1, 1])], None, [np.eye(4)] * 2, 8, 8), ValueError,
     "^matrices.*: camera 1: "),
    (lambda s: facemap.camera_rig(s, np.eye(2), None, [np.eye(4)], 8, 8), ValueError, "matrices"),
    (lambda s: facemap.camera_rig(s, np.eye(3), [[1], [2]], [np.eye(4)], 8, 8), ValueError, "distortions"),
])
def test_wrong_arguments_are_named(floor, call, error, name):
    with pytest.raises(error, match=name):
        call(floor)


def test_progress_is_told_and_stops(floor):
    told = []
    facemap.sky_view_factor(floor, [[0, 0, 0]], directions=50, progress=lambda fraction, word: told.append(fraction))
    assert told and told[-1] == 1 and sorted(told) == told

    def stop(fraction, word):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        facemap.sun_hours(floor, [[0, 0, 0]], [[0, 1, 0]], progress=stop)
