"""The ready uses against brute force: what they count is exact. FACEMAP_QUERIES: about how many pairs."""

import numpy as np

import facemap
from brute_force import Mesh
from brute_force import View as Referee
from brute_force_lights import Sun
from exact_numbers import dot, minus, signs
from hard_scenes import make_directions, make_origin, make_points, make_scene, number_from_environment
from test_exact_rays import is_right_distance

UP = np.array([0, 1, 0], np.float32)


class Case:
    """A scene of ordinary size, points about it, and what is said in a failure."""

    def __init__(self, random, points):
        while True:
            vertices, faces = make_scene(random)
            if 1e-4 < np.abs(vertices).max() < 1e6:
                break
        self.vertices, self.faces = vertices, faces
        self.scene, self.mesh = facemap.Scene(vertices, faces), Mesh(vertices, faces)
        self.origins = np.array([make_origin(random, vertices, faces) for _ in range(3)])
        self.points, self.own = make_points(random, vertices, faces, self.origins[0], points)
        self.normals = random.integers(-2, 3, (points, 3)).astype(np.float32)
        self.normals[~self.normals.any(axis=1)] = UP

    def visible(self, **how):
        """(origins, points) bool."""
        return ~np.array([Referee(self.mesh, o).stand_between(self.points, **how).any(axis=1) for o in self.origins])

    def free(self, directions, **how):
        """(directions, points) bool."""
        return ~np.array([Sun(self.mesh, -d).stand_before(self.points, **how).any(axis=1) for d in directions])

    def __str__(self):
        return (f"vertices = {self.vertices.tolist()}\nfaces = {self.faces.tolist()}\norigins = {self.origins.tolist()}"
                f"\npoints = {self.points.tolist()}\nown = {self.own.tolist()}\nnormals = {self.normals.tolist()}")


def cases(random, points, pairs):
    """So many that they are FACEMAP_QUERIES pairs together."""
    for _ in range(max(1, number_from_environment("FACEMAP_QUERIES", 12_000) // (4 * pairs))):
        yield Case(random, points)


def some_directions(random, case, count):
    found = make_directions(random, case.vertices, case.faces, case.origins[0], count)
    return found[np.isfinite(found).all(axis=1) & found.any(axis=1)]


def test_lamps_reach_what_they_see(random):
    for case in cases(random, 50, 150):
        truth = case.visible(own=case.own)
        lit = facemap.lamp_coverage(case.scene, case.points, case.origins, faces=case.own).lit
        assert np.array_equal(lit, truth), case
        facing = signs(lambda n, lamp, point: dot(n, minus(lamp, point)), case.normals, case.origins[:, np.newaxis],
                       case.points) > 0
        lit = facemap.lamp_coverage(case.scene, case.points, case.origins, case.normals, faces=case.own).lit
        assert np.array_equal(lit, truth & facing), f"{np.argwhere(lit != (truth & facing)).tolist()}\n{case}"


def test_suns_reach_what_sees_them(random):
    for case in cases(random, 50, 300):
        suns = some_directions(random, case, 6)
        hours = 2.0**random.integers(-3, 4, len(suns))  # sums of which are exact
        weights = hours * (suns[:, 1] > 0)
        shone = facemap.sun_hours(case.scene, case.points, suns, hours, up=UP, faces=case.own)
        free = case.free(suns, own=case.own)
        assert np.array_equal(shone, weights @ free), case
        facing = signs(lambda n, d: dot(n, d), case.normals, suns[:, np.newaxis]) > 0
        shone = facemap.sun_hours(case.scene, case.points, suns, hours, case.normals, up=UP, faces=case.own)
        assert np.array_equal(shone, weights @ (free & facing)), case


def test_the_sky_that_is_seen(random):
    for case in cases(random, 20, 300):
        sky = facemap.hemisphere(15, UP).astype(np.float32)
        seen = facemap.sky_view_factor(case.scene, case.points, directions=15, weighting="plain", up=UP)
        assert np.array_equal(seen, case.free(sky).sum(axis=0) / 15), case


def test_what_observers_see(random):
    for case in cases(random, 50, 150):
        how = dict(stand=False, eye_height=0, each=True)
        truth = case.visible()
        assert np.array_equal(facemap.viewshed(case.scene, case.origins, case.points, **how), truth), case
        how["each"] = False
        assert np.array_equal(facemap.viewshed(case.scene, case.origins, case.points, **how), truth.sum(axis=0)), case
        truth = case.visible(own=case.own)
        counts = facemap.viewshed(case.scene, case.origins, case.points, faces=case.own, **how)
        assert np.array_equal(counts, truth.sum(axis=0)), case


def test_beams_return_from_the_nearest_face(random):
    for case in cases(random, 1, 192):
        turn = np.linalg.qr(random.normal(size=(3, 3)))[0] if random.random() < 0.5 else np.eye(3)
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = turn * np.sign(np.linalg.det(turn)), case.origins[0]
        elevations, azimuths = np.linspace(-90, 90, 12), np.arange(0, 360, 22.5)
        scan = facemap.lidar(case.scene, pose, elevations, azimuths)
        e, a = np.radians(elevations)[:, np.newaxis], np.radians(azimuths)
        beams = np.stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e) + 0 * a], axis=-1) @ pose[:3, :3].T
        truth = Referee(case.mesh, case.origins[0]).all_hits(beams.astype(np.float32).reshape(-1, 3))
        assert scan.faces.ravel().tolist() == [hits[0][0] if hits else -1 for hits in truth], f"{pose}\n{case}"
        for distance, hits in zip(scan.ranges.ravel(), truth):
            assert is_right_distance(distance, hits[0][1] if hits else np.inf), f"{pose}\n{case}"
