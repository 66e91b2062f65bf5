"""View.visible_faces against brute force: every witness, and every face that is called hidden.

FACEMAP_QUERIES: five times as many as faces.
"""

from fractions import Fraction

import numpy as np

import facemap
from brute_force import Mesh
from brute_force import View as Referee
from exact_numbers import det
from hard_scenes import as_float32, make_origin, make_scene, number_from_environment
from uncovered import Cutter

LEFT_OUT, EDGE_ON, COVERED = (facemap.view.HIDDEN_REASONS.index(name) for name in ("left out", "edge-on", "covered"))


def into(random, corners, origin, count):
    """Directions into a face."""
    weights = random.dirichlet((0.7, 0.7, 0.7), count)
    return as_float32(weights @ (corners.astype(np.float64) - origin))


def test_faces_equal_brute_force(random):
    queries = number_from_environment("FACEMAP_QUERIES", 12_000) // 5
    asked = visible = covered = undecided = 0
    while asked < queries:
        vertices, faces = make_scene(random)
        origin = make_origin(random, vertices, faces)
        case = f"vertices = {vertices.tolist()}\nfaces = {faces.tolist()}\norigin = {origin.tolist()}"
        view = facemap.View(facemap.Scene(vertices, faces), origin, threads=int(random.integers(1, 4)))
        found = view.visible_faces()
        referee = Referee(Mesh(vertices, faces), origin)
        cutter = Cutter(referee)
        assert np.array_equal(found.reasons == LEFT_OUT, ~referee.mesh.is_kept), case
        assert np.array_equal(found.reasons == EDGE_ON, referee.mesh.is_kept & (referee.sides == 0)), case
        assert found.hidden[(found.reasons == LEFT_OUT) | (found.reasons == EDGE_ON)].all(), case
        assert np.array_equal(found.hidden, found.reasons != 0), case
        assert not found.witnesses[~found.visible].any(), case

        seen = np.nonzero(found.visible)[0]
        all_hits = referee.all_hits(found.witnesses[seen])
        first = [hits[0][0] if hits else -1 for hits in all_hits]
        assert first == seen.tolist(), f"witnesses see {first}, not {seen.tolist()}\n{case}"
        for face, hits in zip(seen, all_hits):  # what is seen with nothing at the same distance has an area
            is_tied = len(hits) > 1 and hits[0][1] * (1 + 1e-9) >= hits[1][1]
            assert is_tied or cutter.uncovered(int(face)), f"face {face} is seen, but the referee cut it away\n{case}"
        inside = referee.meets(found.witnesses[seen], strictly=True)[np.arange(len(seen)), seen]
        assert inside.all(), f"witnesses of {seen[~inside].tolist()} are on their outlines\n{case}"

        for face in np.nonzero(found.reasons == COVERED)[0]:
            left = cutter.uncovered(int(face))
            assert not left, f"face {face} is called hidden, but it is seen in {left}\n{case}"
            directions = into(random, referee.mesh.corners[face], origin, 8)
            strictly = referee.meets(directions, strictly=True)[:, face]
            first = [hits[0][0] if hits else -1 for hits in referee.all_hits(directions[strictly])]
            assert face not in first, f"face {face} is called hidden, but it is seen\n{case}"
            check_pieces(view.covered_pieces(int(face)), referee, int(face), case)
        asked += len(faces)
        visible += len(seen)
        covered += int((found.reasons == COVERED).sum())
        undecided += int(found.undecided.sum())
    print(f"{asked} faces, {visible} visible, {covered} covered, {undecided} undecided, 0 wrong")
    assert visible > queries // 10 and covered > queries // 50


def check_pieces(pieces, referee, face, case):
    """They make up the face, and along its direction each is covered by the face that it names."""
    area = Fraction(0)
    for scale, corners, cover, direction in pieces:
        rows = [[Fraction(int(x), scale) for x in row] for row in corners]
        assert all(sum(row) == 1 for row in rows), case
        area += abs(det(*rows))
        hits = [hit for hit, _ in referee.all_hits(direction[np.newaxis])[0]]
        assert cover in hits and face in hits and hits.index(cover) < hits.index(face), case
    assert area == 1, case
