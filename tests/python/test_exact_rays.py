"""View.nearest and all_hits against brute force. FACEMAP_QUERIES: how many directions."""

import numpy as np

import facemap
from brute_force import Mesh
from brute_force import View as Referee
from hard_scenes import make_directions, make_origin, make_scene, number_from_environment

DIRECTIONS = 150  # a view

SHARPNESS = 2.0**-29
"""Relative: the library's distance is sharp to 2^-30, the referee's to 2^-39; then it is rounded to float32 once."""


def is_right_distance(distance, truth):
    if truth < np.finfo(np.float32).tiny:
        return True  # past the range of normal numbers
    if np.isinf(distance):
        return truth * (1 + SHARPNESS) >= 2.0**128 - 2.0**103  # from there on the nearest float32 is infinity
    with np.errstate(over="ignore"):
        unit = min(float(np.spacing(distance)), 2.0**104)  # in the last place; infinity beside the largest number
    return abs(float(distance) - truth) <= 0.5 * unit + SHARPNESS * truth


def test_rays_equal_brute_force(random):
    queries = number_from_environment("FACEMAP_QUERIES", 12_000)
    asked = hits = ties = 0
    while asked < queries:
        vertices, faces = make_scene(random)
        scene, mesh = facemap.Scene(vertices, faces), Mesh(vertices, faces)
        for _ in range(2):
            origin = make_origin(random, vertices, faces)
            directions = make_directions(random, vertices, faces, origin, DIRECTIONS)
            view = facemap.View(scene, origin, threads=int(random.integers(1, 4)))
            face, distance = view.nearest(directions)
            begins, met, distances = view.all_hits(directions)
            assert len(begins) == DIRECTIONS + 1 and begins[0] == 0 and begins[-1] == len(met) == len(distances)
            for i, truth in enumerate(Referee(mesh, origin).all_hits(directions)):
                case = (f"along {directions[i].tolist()}\nvertices = {vertices.tolist()}\nfaces = {faces.tolist()}\n"
                        f"origin = {origin.tolist()}")
                here = slice(begins[i], begins[i + 1])
                assert met[here].tolist() == [f for f, _ in truth], case
                assert all(is_right_distance(*pair) for pair in zip(distances[here], (t for _, t in truth))), (
                    f"{distances[here].tolist()} for {truth} {case}")
                assert face[i] == (truth[0][0] if truth else -1), case
                assert is_right_distance(distance[i], truth[0][1] if truth else np.inf), (
                    f"{distance[i]} for {truth} {case}")
                hits += len(truth)
                ties += sum(one == two for (_, one), (_, two) in zip(truth, truth[1:]))
            asked += DIRECTIONS
    print(f"{asked} directions, {hits} hits, {ties} ties, 0 differences")
    assert hits > queries and ties > queries // 10


def test_many_rays_are_answered_as_few_are(random):
    """Other ways are taken for many."""
    for _ in range(4):
        vertices, faces = make_scene(random)
        origin = make_origin(random, vertices, faces)
        directions = make_directions(random, vertices, faces, origin, 200)
        truth = [[face for face, _ in hits] for hits in Referee(Mesh(vertices, faces), origin).all_hits(directions)]
        order = random.permutation(np.tile(np.arange(200), 100))
        view = facemap.View(facemap.Scene(vertices, faces), origin)
        first = np.array([hits[0] if hits else -1 for hits in truth])
        assert np.array_equal(view.nearest(directions[order]).face, first[order])
        assert view.all_hits(directions[order]).faces.tolist() == [face for i in order for face in truth[i]]
