"""Scene.render's face_id and light_mask against brute force. FACEMAP_QUERIES: how many pixels."""

import numpy as np
import pytest

import facemap
from brute_force import Mesh
from brute_force import View as Referee
from brute_force_lights import Seen, Sun, lit_by_point
from hard_scenes import as_float32, make_origin, make_scene, number_from_environment, some_on_faces

WIDTH, HEIGHT = 13, 13  # odd: some rays go straight ahead, or along a plane of two axes


def make_camera(random, vertices, faces, position):
    """Of a lens at random; looks at some face, or along an axis."""
    if random.random() < 0.4:
        axes = random.permutation(np.eye(3)) * random.choice([-1, 1])
        away = 0.5 * max(1, np.abs(position).max())
        ahead = np.where(np.abs(position + axes[0] * away) > 3e38, -axes[0], axes[0])  # within float32
        target = as_float32(position + ahead * away)
        return facemap.Camera(position.tolist(), target.tolist(), axes[1], random.uniform(30, 120), "plane")
    target = position
    while np.array_equal(target, position):
        target = as_float32(some_on_faces(random, vertices, faces, 1)[0][0] + random.normal(size=3) * 1e-3)
    up = random.normal(size=3)
    lens = str(random.choice(["plane", "surface", "surface", "equirect", "cube", "opencv", "opencv-fisheye"]))
    if lens.startswith("opencv"):
        pose = some_pose(random, position)
        return facemap.Camera.from_opencv([10, 10, 6, 6], [0.05, -0.02, 0.001, 0.002], pose, lens == "opencv-fisheye")
    angle = random.uniform(10, 170) if lens == "plane" else random.uniform(10, 360)
    return facemap.Camera(position.tolist(), target.tolist(), up, angle, lens, layout="3x2")


def size_of(camera):
    return (12, 8) if camera.lens == "cube" else (WIDTH, HEIGHT)


def some_pose(random, position):
    """R|t of a camera that is turned somehow."""
    rotation = np.linalg.qr(random.normal(size=(3, 3)))[0]
    rotation *= np.sign(np.linalg.det(rotation))
    return np.concatenate([rotation, -(rotation @ position.astype(np.float64))[:, np.newaxis]], axis=1)


def make_lights(random, vertices, faces, position):
    """Point lights, then suns, as a light mask has them; some in a plane or line with the camera, edges and faces."""
    lamps = [make_origin(random, vertices, faces) for _ in range(random.integers(1, 4))]
    lamps = [np.where(random.random(3) < random.choice([0, 0.5, 0.8]), position, lamp) for lamp in lamps]
    suns = []
    while len(suns) < 2:
        aim = np.diff(some_on_faces(random, vertices, faces, 2)[0], axis=0)[0]
        direction = as_float32(aim if random.random() < 0.5 else random.integers(-2, 3, 3))
        if direction.any():
            suns.append(direction)
    return lamps, suns[:random.integers(0, 3)]


def compare(random, vertices, faces, camera, lamps, suns):
    """A picture and brute force; how many pixels have a face, and how many times they are lit and dark."""
    scene, mesh = facemap.Scene(vertices, faces), Mesh(vertices, faces)
    lights = [facemap.Light(lamp.tolist()) for lamp in lamps] + [facemap.Light.sun(sun.tolist()) for sun in suns]
    width, height = size_of(camera)
    origin, directions = camera.rays(scene, width, height)
    directions = directions.reshape(-1, 3)
    frame = scene.render(camera, lights, width, height, planes=["face_id", "light_mask"], terminator_fix=False,
                         strategy=str(random.choice(["auto", "lists", "transposed"])),
                         light_maps=str(random.choice(["auto", "keep", "none"])), threads=int(random.integers(1, 4)))
    case = (f"vertices = {vertices.tolist()}\nfaces = {faces.tolist()}\n{camera}\nlamps = {lamps}\nsuns = {suns}\n"
            f"{frame.statistics}")

    referee = Referee(mesh, origin)
    truth = np.array([met[0][0] if met else -1 for met in referee.all_hits(directions)])
    answers = frame.face_id.reshape(-1)
    wrong = np.nonzero(answers != truth)[0]
    assert not len(wrong), f"{answers[wrong]} not {truth[wrong]} along {directions[wrong].tolist()}\n{case}"

    pixels = np.nonzero(truth >= 0)[0]
    seen = Seen(origin, directions[pixels], truth[pixels], referee.sides[truth[pixels]])
    reaches = [lit_by_point(Referee(mesh, lamp), seen) for lamp in lamps] + [Sun(mesh, sun).lit(seen) for sun in suns]
    mask = frame.light_mask.reshape(len(truth), len(lights))
    assert not mask[truth < 0].any(), case
    for k, by_light in enumerate(reaches):
        wrong = np.nonzero(mask[pixels, k] != by_light)[0]
        assert not len(wrong), (f"light {k}: {mask[pixels[wrong], k]} on faces {truth[pixels[wrong]]} along "
                                f"{directions[pixels[wrong]].tolist()}\n{case}")
    return np.array([len(truth), len(pixels), np.sum(reaches), len(pixels) * len(lights) - np.sum(reaches)], int)


def test_pixels_equal_brute_force(random):
    queries = number_from_environment("FACEMAP_QUERIES", 12_000)
    counts, scenes, refused = np.zeros(4, int), 0, 0
    while counts[0] < queries:
        vertices, faces = make_scene(random)
        position = make_origin(random, vertices, faces)
        camera = make_camera(random, vertices, faces, position)
        lamps, suns = make_lights(random, vertices, faces, position)
        scenes += 1
        try:
            camera.rays(facemap.Scene(vertices, faces), *size_of(camera))
        except facemap.Error:  # a pose with what float32 does not hold
            refused += 1
            continue
        counts += compare(random, vertices, faces, camera, lamps, suns)
    print("{} pixels, {} with a face, {} times lit, {} times dark, 0 differences".format(*counts))
    assert refused < scenes // 10 + 2 and counts[1] > queries // 10 and min(counts[2:]) > queries // 50


def test_corners_between_light_and_pixel(random):
    """From the world's origin a ray's numbers can be doubled: light, corner and what is seen lie exactly on a line."""
    counts = np.zeros(4, int)
    for _ in range(20):
        camera = facemap.Camera((0, 0, 0), random.normal(size=3), random.normal(size=3), 60, "plane")
        wall = as_float32(camera.look_at + 3 * random.normal(size=(3, 3)))
        directions = camera.rays(facemap.Scene(wall, [[0, 1, 2]]), WIDTH, HEIGHT).directions.reshape(-1, 3)
        rays = directions[random.integers(len(directions), size=8)]
        corners = np.stack([-2 * rays, *as_float32(random.normal(size=(2, 8, 3)) - 2 * rays)], axis=1).reshape(-1, 3)
        vertices = np.concatenate([wall * np.float32(9), corners])
        counts += compare(random, vertices, np.arange(27).reshape(-1, 3), camera, list(-4 * rays[:6]), [])
    print("{} pixels, {} with a face, {} times lit, {} times dark, 0 differences".format(*counts))
    assert min(counts[2:]) > 20


def test_a_view_and_a_picture_agree():
    scene = facemap.generate("bust")
    camera = scene.cameras[0]
    origin, directions = camera.rays(scene, 64, 48)
    assert np.array_equal(facemap.View(scene, origin).nearest(directions).face,
                          scene.render(width=64, height=48, planes="face_id").face_id)


def test_rays_of_an_orthographic_camera_have_no_origin(bust):
    with pytest.raises(ValueError, match="lens: "):
        facemap.Camera(lens="orthographic").rays(bust)
