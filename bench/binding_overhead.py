"""What the Python module adds to a call of the library: View.visible beside the same in C++, in turns.

    PYTHONPATH=build/release/python:build/release/bench python3 bench/binding_overhead.py
"""

import argparse
import statistics
import time

import numpy as np

import binding
import facemap


def surface_points(scene: facemap.Scene, count: int, seed: int) -> np.ndarray:
    """Random points on the faces, each face as likely as its area."""
    random = np.random.default_rng(seed)
    corners = scene.vertices[scene.faces].astype(np.float64)
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    u, v = random.random((2, count))
    u, v = np.where(u + v > 1, (1 - u, 1 - v), (u, v))
    a, b, c = corners[random.choice(len(areas), count, p=areas / areas.sum())].transpose(1, 0, 2)
    return (a + u[:, None] * (b - a) + v[:, None] * (c - a)).astype(np.float32)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scene", default="chessboard")
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repeat", type=int, default=15)
    arguments = parser.parse_args()

    scene = facemap.generate(arguments.scene)
    points = surface_points(scene, arguments.points, 1)
    origin = scene.lights[0].position
    view = facemap.View(scene, origin, arguments.threads).prepare()
    question = binding.Question(scene.vertices, scene.faces, points, *origin, arguments.threads)

    ours, alone = [], []
    for turn in range(2 * arguments.repeat + 2):
        if turn % 2:
            alone.append(question.ask())
        else:
            begin = time.perf_counter()
            seen = view.visible(points)
            ours.append(time.perf_counter() - begin)
    assert int(seen.sum()) == question.seen()
    python, cpp = (1000 * statistics.median(times[1:]) for times in (ours, alone))
    print(f"{arguments.scene}, {arguments.points} points, {arguments.threads} threads: Python {python:.2f} ms, "
          f"C++ {cpp:.2f} ms, overhead {100 * (python / cpp - 1):.1f} %")


if __name__ == "__main__":
    main()
