"""Small random scenes, origins, points and directions that are hard on purpose.

Faces share edges and vertices, lie in one plane, upon each other or through each other; coordinates are snapped to
grids, so that what is exactly equal is frequent; sizes go from denormal numbers to the largest; and most questions are
aimed at corners, edges and planes.
"""

from __future__ import annotations

import os
from typing import Tuple

import numpy as np

Random = np.random.Generator
Arrays = Tuple[np.ndarray, np.ndarray]

LARGEST = np.float32(np.finfo(np.float32).max)


def number_from_environment(name: str, otherwise: int) -> int:
    return int(os.environ.get(name, otherwise))


def as_float32(x: np.ndarray) -> np.ndarray:
    """Rounded once; what is too large becomes the largest finite number."""
    with np.errstate(over="ignore", under="ignore"):
        return np.clip(x, -float(LARGEST), float(LARGEST)).astype(np.float32)


def make_scene(random: Random) -> Arrays:
    """Vertices and faces; at least one face has an area, odd ones may be among them."""
    while True:
        kind = random.choice([_soup, _grid, _pool, _boxes, _terrain, _slabs])
        vertices, faces = kind(random)
        vertices = _moved(random, vertices)
        vertices, faces = _with_odd_faces(random, vertices, faces)
        faces = random.permutation(faces)
        if len(np.unique(vertices[faces].reshape(-1, 3), axis=0)) > 3:
            return np.ascontiguousarray(vertices), faces.astype(np.uint32)


def _soup(random: Random) -> Arrays:
    """Triangles anywhere, large and small."""
    count = random.integers(1, 60)
    centres = random.normal(size=(count, 1, 3))
    sizes = np.exp2(random.uniform(-4, 2, (count, 1, 1)))
    vertices = centres + sizes * random.normal(size=(count, 3, 3))
    return vertices.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3)


def _grid(random: Random) -> Arrays:
    """Triangles of few whole numbers: many share planes, edges and corners."""
    count, side = random.integers(1, 60), random.integers(1, 5)
    return random.integers(-side, side + 1, (3 * count, 3)).astype(float), np.arange(3 * count).reshape(-1, 3)


def _pool(random: Random) -> Arrays:
    """Few vertices, all triangles of some of them: each edge has many faces."""
    vertices = random.normal(size=(random.integers(4, 12), 3))
    if random.random() < 0.5:
        vertices = np.round(vertices * 3)
    return vertices, random.integers(0, len(vertices), (random.integers(1, 50), 3))


_BOX = np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2],
                 [2, 4, 6], [1, 3, 5], [3, 7, 5]])


def _boxes(random: Random) -> Arrays:
    """Boxes of whole numbers, in and upon each other."""
    vertices, faces = [], []
    for i in range(random.integers(1, 6)):
        low = random.integers(-4, 4, 3)
        high = low + random.integers(1, 5, 3)
        vertices += [[(high if corner >> axis & 1 else low)[axis] for axis in range(3)] for corner in range(8)]
        faces.append((_BOX if random.random() < 0.7 else _BOX[:, ::-1]) + 8 * i)
    return np.array(vertices, float), np.concatenate(faces)


def _terrain(random: Random) -> Arrays:
    """A height field: neighbours share edges and turn the same way."""
    side = random.integers(2, 7)
    x, z = np.meshgrid(np.arange(side), np.arange(side))
    y = random.normal(size=x.shape)
    if random.random() < 0.5:
        y = np.round(y)
    i = (np.arange(side - 1)[:, np.newaxis] * side + np.arange(side - 1)).reshape(-1, 1)
    faces = np.concatenate([i + [0, side, 1], i + [1, side, side + 1]])
    return np.stack([x - side // 2, y, z - side // 2], axis=-1).reshape(-1, 3).astype(float), faces


def _slabs(random: Random) -> Arrays:
    """Large triangles one behind the other, some in the same plane, some next to it by a unit in the last place."""
    count = random.integers(2, 25)
    corners = random.integers(-6, 7, (count, 3, 2)).astype(float)
    depth = random.integers(1, 5, (count, 1)) * np.ones(3)
    near = random.random((count, 1)) < 0.4
    depth = np.where(near, depth * (1 + random.integers(-2, 3, (count, 3)) * 2.0**-23), depth)
    vertices = np.concatenate([corners, depth[..., np.newaxis]], axis=-1)
    return np.roll(vertices, random.integers(3), axis=-1).reshape(-1, 3), np.arange(3 * count).reshape(-1, 3)


def _moved(random: Random, vertices: np.ndarray) -> np.ndarray:
    """Scaled, and moved, as float32."""
    kind = random.random()
    if kind < 0.45:
        return as_float32(vertices)
    if kind < 0.6:  # some digits are lost
        return as_float32(vertices + random.normal(size=3) * 10.0**random.uniform(0, 7))
    if kind < 0.75:
        return as_float32(vertices * random.uniform(0.5, 2) * 10.0**random.uniform(-30, 30))
    if kind < 0.85:  # denormal numbers
        return as_float32(vertices * 2.0**-random.integers(135, 148))
    if kind < 0.95:  # differences beyond float32
        return as_float32(vertices / np.abs(vertices).max() * float(LARGEST))
    return as_float32(vertices * 10.0**random.uniform(-8, 8, 3))  # flat or long


def _with_odd_faces(random: Random, vertices: np.ndarray, faces: np.ndarray) -> Arrays:
    """Adds faces upon others, turned, with repeated corners, of no area; and vertices of the same place."""
    more = []
    for _ in range(random.integers(0, 4)):
        face = faces[random.integers(len(faces))]
        kind = random.integers(4)
        if kind == 0:
            more.append(random.permutation(face))
        elif kind == 1:
            more.append([face[0], face[1], face[1]])
        elif kind == 2:  # on one line: a corner, another one, and their mean if that is exact
            vertices = np.concatenate([vertices, vertices[face[:1]] / 2 + vertices[face[1:2]] / 2])
            more.append([face[0], face[1], len(vertices) - 1])
        else:  # the same corners by other indices, with -0 for 0
            copies = np.where(vertices[face] == 0, -vertices[face], vertices[face])
            vertices = np.concatenate([vertices, copies])
            more.append(np.arange(len(vertices) - 3, len(vertices)))
    return vertices, np.concatenate([faces, np.array(more, faces.dtype).reshape(-1, 3)])


# Where to stand, and what to ask


def some_on_faces(random: Random, vertices: np.ndarray, faces: np.ndarray, count: int) -> Arrays:
    """Points at corners, on edges, in and beside faces (but for rounding), and the faces; as float64."""
    which = random.integers(len(faces), size=count)
    corners = vertices[faces[which]].astype(np.float64)
    kind = random.integers(6, size=count)
    weights = np.empty((count, 3))
    weights[kind == 0] = (1, 0, 0)
    weights[kind == 1] = (0.5, 0.5, 0)
    weights[kind == 2] = (0.5, 0.25, 0.25)
    edge = random.random(count)
    weights[kind == 3] = np.stack([edge, 1 - edge, 0 * edge], axis=1)[kind == 3]
    weights[kind == 4] = random.dirichlet((1, 1, 1), count)[kind == 4]
    beside = random.integers(-2, 4, (count, 2)).astype(float)
    weights[kind == 5] = np.concatenate([1 - beside.sum(axis=1, keepdims=True), beside], axis=1)[kind == 5]
    weights = random.permuted(weights, axis=1)
    return np.einsum("nk,nkx->nx", weights, corners), which


def make_origin(random: Random, vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """A (3,) float32: at a vertex, in a face's plane, among the faces, beside them, far away, or the world's own."""
    low, high = vertices.min(axis=0).astype(np.float64), vertices.max(axis=0).astype(np.float64)
    size = (high - low).max()
    kind = random.random()
    if kind < 0.35:
        found = some_on_faces(random, vertices, faces, 1)[0][0]
    elif kind < 0.7:
        found = low + (high - low) * random.uniform(-0.5, 1.5, 3)
    elif kind < 0.8:
        found = np.round((low + high) / 2) + random.integers(-6, 7, 3)
    elif kind < 0.9:
        found = (low + high) / 2 + random.normal(size=3) * size * 10.0**random.uniform(0, 6)
    else:
        found = np.zeros(3)
    return as_float32(found)


def make_points(random: Random, vertices: np.ndarray, faces: np.ndarray, origin: np.ndarray,
                count: int) -> Arrays:
    """(count, 3) float32, and (count,) int32: the face that each may be said to lie on, or -1."""
    on, which = some_on_faces(random, vertices, faces, count)
    share = random.choice([0.5, 0.75, 1, 1, 1, 1, 1, 1.25, 1.5, 2, 3], (count, 1))
    points = as_float32(origin + (on - origin) * share)
    nudged = random.random(count) < 0.3
    points[nudged] = _nudged(random, points[nudged])
    low, high = vertices.min(axis=0).astype(np.float64), vertices.max(axis=0).astype(np.float64)
    anywhere = random.random(count) < 0.15
    points[anywhere] = as_float32(low + (high - low) * random.uniform(-0.5, 1.5, (count, 3)))[anywhere]
    points[random.random(count) < 0.01] = origin
    own = np.where(random.random(count) < 0.5, which, random.integers(len(faces), size=count))
    own[random.random(count) < 0.4] = -1
    return points, own.astype(np.int32)


def make_directions(random: Random, vertices: np.ndarray, faces: np.ndarray, origin: np.ndarray,
                    count: int) -> np.ndarray:
    """(count, 3) float32, of every length; a few are zero or not finite."""
    aims = some_on_faces(random, vertices, faces, count)[0] - origin
    wild = random.random(count) < 0.1
    aims[wild] = random.normal(size=(count, 3))[wild]
    square = random.random(count) < 0.05
    aims[square] = random.integers(-1, 2, (count, 3))[square]
    longest = np.abs(aims).max(axis=1, keepdims=True)
    aims = np.where(longest > 0, aims / np.where(longest > 0, longest, 1), 0)
    kind = random.random((count, 1))
    length = np.where(kind < 0.6, np.where(longest > 0, longest, 1), np.exp2(random.uniform(-8, 8, (count, 1))))
    length = np.where(kind > 0.9, np.exp2(random.uniform(-149, 127, (count, 1))), length)
    directions = as_float32(aims * length)
    nudged = random.random(count) < 0.2
    directions[nudged] = _nudged(random, directions[nudged])
    broken = random.random(count) < 0.01
    directions[broken, 0] = random.choice([np.nan, np.inf, -np.inf], broken.sum())
    return directions


def _nudged(random: Random, numbers: np.ndarray) -> np.ndarray:
    """Some numbers become their neighbours."""
    with np.errstate(over="ignore"):
        towards = random.choice([-np.inf, np.inf], numbers.shape).astype(np.float32)
        moved = np.nextafter(numbers, towards)
    return np.where((random.random(numbers.shape) < 0.5) & np.isfinite(moved), moved, numbers)
