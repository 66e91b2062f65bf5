"""facemap.visibility_along against brute force. FACEMAP_QUERIES: how many pairs."""

import numpy as np

import facemap
from brute_force import Mesh
from brute_force_lights import Sun
from hard_scenes import make_directions, make_points, make_scene, number_from_environment


def test_directions_equal_brute_force(random):
    queries = number_from_environment("FACEMAP_QUERIES", 12_000)
    asked = hidden = behind_own = 0
    while asked < queries:
        vertices, faces = make_scene(random)
        scene, mesh = facemap.Scene(vertices, faces), Mesh(vertices, faces)
        somewhere = vertices[random.integers(len(vertices))]
        directions = make_directions(random, vertices, faces, somewhere, int(random.integers(1, 12)))
        directions = directions[np.isfinite(directions).all(axis=1) & directions.any(axis=1)]
        points, own = make_points(random, vertices, faces, somewhere, int(random.integers(1, 80)))
        tolerance = float(np.float32(random.choice([0, 0.01, 0.3]) * min(np.abs(vertices).max(), 1e38)))
        how = dict(threads=int(random.integers(1, 4)), memory=int(random.choice([0, 1, 1 << 20])))
        seen = facemap.visibility_along(scene, directions, points, **how)
        seen_with_own = facemap.visibility_along(scene, directions, points, faces=own, **how)
        seen_far = facemap.visibility_along(scene, directions, points, tolerance=tolerance, **how)
        assert seen.shape == (len(directions), len(points))
        for i, direction in enumerate(directions):
            sun = Sun(mesh, -direction)
            truth = ~sun.stand_before(points).any(axis=1)
            with_own = ~sun.stand_before(points, own).any(axis=1)
            far = ~sun.stand_before(points, tolerance=tolerance).any(axis=1)
            case = (f"along {direction.tolist()}\npoints = {points.tolist()}\nown = {own.tolist()}\n"
                    f"tolerance = {tolerance!r}\nvertices = {vertices.tolist()}\nfaces = {faces.tolist()}")
            assert seen[i].tolist() == truth.tolist(), case
            assert seen_with_own[i].tolist() == with_own.tolist(), case
            assert seen_far[i].tolist() == far.tolist(), case
            asked += len(points)
            hidden += int((~truth).sum())
            behind_own += int((with_own & ~truth).sum())
    print(f"{asked} pairs, {hidden} hidden, {behind_own} by their own face alone, 0 differences")
    assert hidden > queries // 20 and behind_own > queries // 1000
