"""View.visible, blocked_by, visible_vertices and visibility against brute force. FACEMAP_QUERIES: how many points."""

import numpy as np

import facemap
from brute_force import Mesh
from brute_force import View as Referee
from hard_scenes import make_origin, make_points, make_scene, number_from_environment

POINTS = 200  # a view


def show(vertices, faces, origin):
    """What is needed to ask again."""
    return f"vertices = {vertices.tolist()}\nfaces = {faces.tolist()}\norigin = {origin.tolist()}"


def equal(answers, truth, questions, case):
    wrong = np.nonzero(np.asarray(answers) != truth)[0]
    assert not len(wrong), (f"{len(wrong)} differences, the first: {answers[wrong[0]]} for "
                            f"{[q[wrong[0]].tolist() for q in questions]}, not {truth[wrong[0]]}\n{case}")


def some_tolerance(random, vertices):
    """0, or as far as faces are from each other: often exactly so."""
    if random.random() < 0.4:
        a, b = vertices[random.integers(len(vertices), size=2)].astype(np.float64)
        return float(np.float32(min(np.abs(a - b).max(), 1e38)))
    extent = np.ptp(vertices.astype(np.float64), axis=0).max()
    tolerance = random.choice([0, 2.0**-22, 0.01, 0.25, 1]) * extent * random.uniform(0.5, 1)
    return float(np.float32(min(tolerance, 1e38)))


def test_points_equal_brute_force(random):
    queries = number_from_environment("FACEMAP_QUERIES", 12_000)
    asked = hidden = odd = behind_own = within_tolerance = 0
    while asked < queries:
        vertices, faces = make_scene(random)
        scene = facemap.Scene(vertices, faces)
        mesh = Mesh(vertices, faces)
        assert np.array_equal(np.nonzero(mesh.is_kept)[0], scene.kept_faces), show(vertices, faces, np.zeros(3))
        for _ in range(2):
            origin = make_origin(random, vertices, faces)
            points, own = make_points(random, vertices, faces, origin, POINTS)
            tolerance = some_tolerance(random, vertices)
            case = show(vertices, faces, origin)
            view = facemap.View(scene, origin, threads=int(random.integers(1, 4)))
            if random.random() < 0.5:
                view.prepare()
            referee = Referee(mesh, origin)
            between = referee.stand_between(points)
            visible = ~between.any(axis=1)
            equal(view.visible(points), visible, [points], case)
            with_own = ~referee.stand_between(points, own).any(axis=1)
            equal(view.visible(points, own), with_own, [points, own], case)
            far = ~referee.stand_between(points, tolerance=tolerance).any(axis=1)
            equal(view.visible(points, tolerance=tolerance), far, [points], f"{case}\ntolerance = {tolerance!r}")
            equal(view.blocked_by(points), referee.first_blockers(points), [points], case)
            equal(view.blocked_by(points, own), referee.first_blockers(points, own), [points, own], case)
            vertices_seen = ~referee.stand_between(vertices).any(axis=1)
            equal(view.visible_vertices(), vertices_seen, [vertices], case)
            asked += POINTS
            hidden += int((~visible).sum())
            behind_own += int((with_own & ~visible).sum())
            within_tolerance += int((far & ~visible).sum())
            odd += len(faces) - len(scene.kept_faces)
    print(f"{asked} points, {hidden} hidden, {behind_own} by their own face alone, {within_tolerance} within the "
          f"tolerance alone, {odd} odd faces, 0 differences")
    assert min(hidden, behind_own, within_tolerance, odd) > queries // 1000


def test_many_points_are_answered_as_few_are(random):
    """Other ways are taken for many."""
    for _ in range(4):
        vertices, faces = make_scene(random)
        origin = make_origin(random, vertices, faces)
        points, own = make_points(random, vertices, faces, origin, 300)
        order = random.permutation(np.tile(np.arange(300), 100))
        scene = facemap.Scene(vertices, faces)
        referee = Referee(Mesh(vertices, faces), origin)
        case = show(vertices, faces, origin)
        visible = ~referee.stand_between(points).any(axis=1)
        with_own = ~referee.stand_between(points, own).any(axis=1)
        equal(facemap.View(scene, origin).visible(points[order]), visible[order], [points[order]], case)
        equal(facemap.View(scene, origin).visible(points[order], own[order]), with_own[order],
              [points[order], own[order]], case)
        equal(facemap.View(scene, origin).blocked_by(points[order]), referee.first_blockers(points)[order],
              [points[order]], case)


def test_visibility_equals_brute_force(random):
    queries = number_from_environment("FACEMAP_QUERIES", 12_000)
    asked = hidden = 0
    while asked < queries:
        vertices, faces = make_scene(random)
        mesh = Mesh(vertices, faces)
        origins = np.array([make_origin(random, vertices, faces) for _ in range(random.integers(1, 9))])
        points, own = make_points(random, vertices, faces, origins[0], int(random.integers(1, 100)))
        tolerance = some_tolerance(random, vertices)
        how = dict(threads=int(random.integers(1, 4)), memory=int(random.choice([0, 1, 1 << 20])))
        scene = facemap.Scene(vertices, faces)
        seen = facemap.visibility(scene, origins, points, **how)
        seen_with_own = facemap.visibility(scene, origins, points, faces=own, **how)
        seen_far = facemap.visibility(scene, origins, points, tolerance=tolerance, **how)
        packed = facemap.visibility(scene, origins, points, packed=True, **how)
        assert np.array_equal(packed, np.packbits(seen, axis=1, bitorder="little"))
        for i, origin in enumerate(origins):
            referee = Referee(mesh, origin)
            case = show(vertices, faces, origin)
            truth = ~referee.stand_between(points).any(axis=1)
            equal(seen[i], truth, [points], case)
            equal(seen_with_own[i], ~referee.stand_between(points, own).any(axis=1), [points, own], case)
            equal(seen_far[i], ~referee.stand_between(points, tolerance=tolerance).any(axis=1), [points],
                  f"{case}\ntolerance = {tolerance!r}")
            asked += len(points)
            hidden += int((~truth).sum())
    print(f"{asked} pairs, {hidden} hidden, 0 differences")
