"""What the examples share: simple scenes, and colours for numbers."""

import os

import numpy as np

import facemap

# How much larger or smaller than written the pictures are, and where they go.
SCALE = float(os.environ.get("FACEMAP_EXAMPLE_SCALE", "1"))
FOLDER = os.environ.get("FACEMAP_EXAMPLE_FOLDER", "out/python")

COLD_TO_HOT = ["#26234a", "#2f5d8c", "#3f9c8f", "#a7c957", "#f6d55c", "#fff6d8"]

_BOX = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                 [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])


def boxes(lower, upper):
    """Vertices and faces of boxes, from their corners (n, 3) and (n, 3)."""
    pick = np.array([[(i >> k) & 1 for k in range(3)] for i in range(8)])
    vertices = np.where(pick, np.asarray(upper)[:, None], np.asarray(lower)[:, None]).reshape(-1, 3)
    faces = (_BOX + 8 * np.arange(len(lower))[:, None, None]).reshape(-1, 3)
    return vertices, faces


def city(blocks=7, seed=3):
    """Houses of 8 to 40 metres on a square ground, y up, the middle at the origin."""
    random = np.random.default_rng(seed)
    x, z = np.meshgrid(np.arange(blocks), np.arange(blocks))
    corner = 30.0 * (np.stack([x.ravel(), 0 * x.ravel(), z.ravel()], axis=1) - [blocks / 2, 0, blocks / 2]) + [5, 0, 5]
    size = np.stack([random.uniform(11, 20, blocks**2), random.gamma(3.0, 5.0, blocks**2) + 8,
                     random.uniform(11, 20, blocks**2)], axis=1)
    size[:, 1] = np.minimum(size[:, 1], 40)
    half = 15.0 * blocks + 5
    ground = [[-half, 0, -half], [half, 0, -half], [half, 0, half], [-half, 0, half]]
    return facemap.Scene(ground, [[0, 2, 1], [0, 3, 2]]).add(facemap.Scene(*boxes(corner, corner + size)))


def colours(values, names=COLD_TO_HOT):
    """sRGB in 0..1 for values of 0..1."""
    rows = np.array([[int(name[i:i + 2], 16) for i in (1, 3, 5)] for name in names]) / 255
    at = np.linspace(0, 1, len(rows))
    return np.stack([np.interp(values, at, rows[:, k]) for k in range(3)], axis=-1)


def seen_points(scene, camera, width, height):
    """A picture's frame at twice the size, which pixels see a face, and the points there with their faces."""
    size = [2 * max(8, round(SCALE * n)) for n in (width, height)]
    frame = scene.render(camera, [], *size, planes=("position", "face_id", "face_normal"))
    is_seen = frame.face_id >= 0
    return frame, is_seen, frame.position[is_seen], frame.face_id[is_seen]


def picture(frame, is_seen, rgb, background="#e9edf2"):
    """sRGB levels, half as large: colours of the points that are seen, darkened where they face aside."""
    image = np.broadcast_to(colours(np.zeros(is_seen.shape), [background]), is_seen.shape + (3,)).copy()
    facing = np.abs(frame.face_normal[is_seen] @ (np.array([0.35, 0.85, 0.4]) / 1.0024))
    image[is_seen] = rgb * (0.4 + 0.6 * facing)[:, None]
    height, width = is_seen.shape
    smaller = image.reshape(height // 2, 2, width // 2, 2, 3).mean(axis=(1, 3))
    return np.round(255 * np.clip(smaller, 0, 1)).astype(np.uint8)


def save(name, levels):
    """Writes a picture to the folder and shows it in a notebook."""
    os.makedirs(FOLDER, exist_ok=True)
    path = os.path.join(FOLDER, name)
    facemap.save_png(path, levels)
    print(path)
    return facemap.Frame.from_array(levels)
