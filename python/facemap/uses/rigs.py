"""Several calibrated cameras on one body."""

from __future__ import annotations

import contextlib
from typing import Any, Iterator, List, Sequence

import numpy as np

from .. import _checks
from ..camera import Camera, _pose
from ..frame import Frame
from ..scene import Scene

_ARGUMENTS = {"matrix": "matrices", "distortion": "distortions", "pose": "poses",
              "matrix, distortion": "matrices, distortions"}
"""A camera's fields, and where they come from."""


def camera_rig(scene: Scene, matrices: Any, distortions: Any, poses: Any, width: int, height: int, *, rig: Any = None,
               fisheye: bool = True, lights: Any = None, samples: Any = 1, **options: Any) -> List[Frame]:
    """The pictures of several OpenCV cameras that are fixed to one body.

    Each is drawn through its own lens model, fisheye or pinhole, ray by ray: nothing is warped, and circles that the
    lens sees beyond 180 degrees are there. What the lights need is made once for all of them.

    Parameters
    ----------
    scene : Scene
    matrices : (n, 3, 3) floats
        Camera matrices, pixels, without skew; or (3, 3): the same for all.
    distortions : (n, k) floats
        k1, k2, k3, k4 of cv::fisheye (with fisheye=False those of cv::projectPoints); or (k,): the same for all; or
        None.
    poses : (n, 4, 4) floats
        OpenCV's R|t of each camera: camera = R body + t, with x to the right, y down and z ahead in the picture.
    width, height : int
        Pixels, of all cameras.
    rig : (4, 4) floats
        R|t of the body: body = R world + t. None: the body's axes are the world's.
    fisheye : bool
        Which of OpenCV's two models.
    lights, samples, **options
        As of Scene.render.

    Returns
    -------
    list of n Frame

    Raises
    ------
    TypeError, ValueError
        Naming the argument.

    Examples
    --------
    >>> K = [[160, 0, 160], [0, 160, 120], [0, 0, 1]]
    >>> turned = np.diag([-1, 1, -1, 1])                        # the second camera looks back
    >>> ahead, back = facemap.camera_rig(scene, K, [0.05, 0.01, 0, 0], [np.eye(4), turned], 320, 240)
    """
    _checks.core_of(scene)
    body = np.eye(4) if rig is None else _turn_and_place("rig", rig)
    places = _many("poses", poses, (4, 4), None)
    lenses = _many("matrices", matrices, (3, 3), len(places))
    bends = _distortions(distortions, len(places))
    cameras = [Camera.from_opencv(lens, bend, _turn_and_place(f"poses: camera {i}", place) @ body,
                                  fisheye=_checks.truth("fisheye", fisheye))
               for i, (lens, bend, place) in enumerate(zip(lenses, bends, places))]
    frames: List[Frame] = []
    with _named(frames):
        for frame in scene.frames(cameras, lights, width, height, samples, **options):
            frames.append(frame)
    return frames


def _turn_and_place(name: str, value: Any) -> np.ndarray:
    """R|t in (4, 4), where R is a rotation."""
    matrix = _checks.transform(name, value)
    _pose(matrix, name)
    return matrix


@contextlib.contextmanager
def _named(frames: List[Frame]) -> Iterator[None]:
    """What is said of a field of the camera behind these frames gets the name of the argument that it comes from."""
    try:
        yield
    except (TypeError, ValueError) as error:
        field, _, reason = str(error).partition(":")
        if field not in _ARGUMENTS:
            raise
        raise type(error)(f"{_ARGUMENTS[field]}: camera {len(frames)}:{reason}") from error


def _many(name: str, value: Any, shape: Any, count: Any) -> np.ndarray:
    found = _checks.array(name, value).astype(np.float64)
    if count is not None and found.shape == shape:
        found = np.broadcast_to(found, (count,) + shape)
    if found.ndim != 3 or found.shape[1:] != shape or (count is not None and len(found) != count):
        wanted = (("n" if count is None else count),) + shape
        raise ValueError(f"{name}: the shape is {found.shape}, and {wanted} is needed".replace("'", ""))
    return _checks.finite(name, found)


def _distortions(value: Any, count: int) -> Sequence[np.ndarray]:
    if value is None:
        return [np.zeros(0)] * count
    found = _checks.finite("distortions", _checks.array("distortions", value))
    if found.ndim == 1:
        return [found] * count
    if found.ndim != 2 or len(found) != count:
        raise ValueError(f"distortions: the shape is {found.shape}, and one row a camera is needed, {count} in all")
    return list(found)
