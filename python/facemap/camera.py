"""Cameras."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple, Optional, Sequence

import numpy as np

from . import _checks, _facemap
from .light import are_same, degrees

_LENSES = ("surface", "plane", "orthographic", "equirect", "cube", "opencv", "opencv-fisheye")


class Rays(NamedTuple):
    """What ``Camera.rays`` gives."""

    origin: np.ndarray
    directions: np.ndarray


@dataclass
class Camera:
    """Where a camera stands, where it looks, and its lens. What is None is made up so that all of the scene is seen.

    Parameters
    ----------
    position, look_at, up : three floats or None
        World units: its place, the point in the middle of the picture, and the direction that points up there.
    field_angle : float
        Degrees: across the shorter side ("surface", up to 360) or from bottom to top ("plane", below 180).
    lens : str
        "surface" (a fisheye: distance from the middle is proportional to the angle), "plane" (perspective),
        "orthographic", "equirect" (a panorama of all directions), "cube" (a cube map), "opencv" or "opencv-fisheye"
        (a calibrated camera).
    height : float or None
        World units that an orthographic picture shows from bottom to top.
    matrix : (3, 3) or four floats fx, fy, cx, cy
        OpenCV's camera matrix, pixels, for the two calibrated lenses.
    distortion : floats
        OpenCV's coefficients: k1, k2, p1, p2, k3 ... of a pinhole, k1, k2, k3, k4 of a fisheye.
    pose : (3, 4) or (4, 4) floats
        OpenCV's R|t, camera = R world + t, with x to the right, y down and z ahead; in place of position, look_at and
        up.
    layout : "3x2", "6x1" or "1x6"
        How a cube map's faces (right, left, up, down, ahead, behind) lie in the picture.
    name : str
        The file's name for it.

    Raises
    ------
    TypeError, ValueError
        When it is used, naming the field.

    Examples
    --------
    >>> facemap.Camera((3, 2, 5), look_at=(0, 1, 0), lens="plane", field_angle=40)
    >>> facemap.Camera.from_opencv(K, D, pose, fisheye=True)
    """

    position: Optional[Sequence[float]] = None
    look_at: Optional[Sequence[float]] = None
    up: Optional[Sequence[float]] = None
    field_angle: float = 50.0
    lens: str = "surface"
    height: Optional[float] = None
    matrix: Any = None
    distortion: Sequence[float] = ()
    pose: Any = None
    layout: str = "3x2"
    name: str = ""

    def __eq__(self, other: Any) -> bool:
        return are_same(self, other)

    @classmethod
    def from_opencv(cls, matrix: Any, distortion: Sequence[float] = (), pose: Any = None, fisheye: bool = False,
                    name: str = "") -> Camera:
        """A camera as OpenCV's calibration gives it.

        Parameters
        ----------
        matrix : (3, 3) floats
            Pixels, without skew.
        distortion : floats
            0, 4, 5 or 8 coefficients of cv::projectPoints, or with `fisheye` 0 or 4 of cv::fisheye.
        pose : (3, 4) or (4, 4) floats
            R|t: camera = R world + t. None: what is made up.
        """
        return cls(lens="opencv-fisheye" if fisheye else "opencv", matrix=matrix, distortion=distortion, pose=pose,
                   name=name)

    def rays(self, scene: Any, width: int = 1024, height: int = 1024) -> Rays:
        """The rays through the centres of a picture's pixels: the very numbers that ``Scene.render`` asks about.

        Parameters
        ----------
        scene : Scene
            For what is made up.
        width, height : int
            Pixels.

        Returns
        -------
        origin : (3,) float32
            World units.
        directions : (height, width, 3) float32
            Of about unit length; zero where the lens sees nothing.

        Raises
        ------
        ValueError
            For an orthographic camera: its rays have no common origin.

        Examples
        --------
        >>> origin, directions = camera.rays(scene, 640, 480)
        >>> facemap.View(scene, origin).nearest(directions).face     # Frame.face_id
        """
        if self.lens == "orthographic":
            raise ValueError("lens: the rays of an orthographic camera have no common origin")
        width, height = _checks.picture_size(width, height)
        view = self._complete(_checks.core_of(scene), width, height, None)
        with _checks.named("camera"):
            return Rays(np.array(view.position, np.float32), view.directions(width, height))

    def _complete(self, scene: _facemap.Scene, width: int, height: int,
                  up: Optional[Sequence[float]]) -> _facemap.CompleteCamera:
        wanted = _facemap.WantedCamera()
        self._place(wanted)
        self._set_lens(wanted, width, height)
        world_up = up if up is not None else self._world_up(scene)
        return _facemap.complete_view(scene, wanted, world_up)

    def _world_up(self, scene: _facemap.Scene) -> Sequence[float]:
        if self.up is not None and self.pose is None:
            return _checks.direction("up", self.up)
        return scene.up or (0.0, 1.0, 0.0)

    def _place(self, wanted: _facemap.WantedCamera) -> None:
        if self.pose is None:
            wanted.position = _checks.optional(_checks.triple, "position", self.position)
            wanted.look_at = _checks.optional(_checks.triple, "look_at", self.look_at)
            wanted.up = _checks.optional(_checks.direction, "up", self.up)
            if wanted.position is not None and wanted.position == wanted.look_at:
                raise ValueError("look_at: the camera stands at the point that it looks at")
            return
        if self.position is not None or self.look_at is not None or self.up is not None:
            raise ValueError("pose: it takes the place of position, look_at and up; give one or the other")
        wanted.set_pose(_pose(self.pose))

    def _set_lens(self, wanted: _facemap.WantedCamera, width: int, height: int) -> None:
        lens = _checks.choice("lens", self.lens, _LENSES)
        self._refuse_what_does_not_go(lens)
        if lens in ("surface", "plane"):
            wanted.set_projection(_facemap.Projection.__members__[lens])
            wanted.set_field_angle(math.radians(_field_angle(self.field_angle, 360 if lens == "surface" else 180)))
        elif lens == "orthographic":
            wanted.set_parallel()
            if self.height is not None:
                wanted.set_height(_above_0("height", self.height))
        elif lens == "equirect":
            wanted.set_lens(_facemap.Lens.equirect(width, height))
        elif lens == "cube":
            wanted.set_lens(_cube(_checks.member("layout", self.layout, _facemap.CubeLayout), width, height))
        else:
            make = _facemap.Lens.opencv_fisheye if lens == "opencv-fisheye" else _facemap.Lens.opencv
            matrix, distortion = _camera_matrix(self.matrix), _distortion(self.distortion)
            with _checks.named("matrix, distortion"):
                wanted.set_lens(make(matrix, distortion, width, height))

    def _refuse_what_does_not_go(self, lens: str) -> None:
        if self.matrix is None and lens.startswith("opencv"):
            raise ValueError(f"matrix: the lens {lens} needs one")
        if self.matrix is not None and not lens.startswith("opencv"):
            raise ValueError(f"matrix: it is for the lenses opencv and opencv-fisheye, not for {lens}")
        if self.height is not None and lens != "orthographic":
            raise ValueError(f"height: it is for the lens orthographic, not for {lens}")

    @classmethod
    def _from_core(cls, camera: _facemap.ModelCamera) -> Camera:
        known = {"position": camera.position, "look_at": camera.look_at, "up": camera.up, "name": camera.name}
        if camera.is_parallel:
            return cls(lens="orthographic", height=float(np.float32(camera.height)), **known)
        return cls(lens="plane", field_angle=degrees(camera.field_angle), **known)


def _above_0(name: str, value: Any) -> float:
    found = _checks.finite_number(name, value)
    if not found > 0:
        raise ValueError(f"{name}: {found} is not above 0")
    return found


def _field_angle(value: Any, most: float) -> float:
    found = _above_0("field_angle", value)
    if found > most or found == most == 180:
        raise ValueError(f"field_angle: {found} degrees are too many for this lens")
    return found


def _pose(value: Any, name: str = "pose") -> np.ndarray:
    """The upper three rows of R|t, where R must turn and no more, to what six digits leave of it."""
    pose = _checks.matrix(name, value, [(3, 4), (4, 4)])
    if pose.shape == (4, 4):
        pose = _checks.transform(name, pose)[:3]
    rotation = pose[:, :3]
    error = np.abs(rotation @ rotation.T - np.eye(3)).max()
    if not error <= 1e-5 or not np.linalg.det(rotation) > 0:
        raise ValueError(f"{name}: the first three columns are no rotation: rows of length 1, square to each other, "
                         "unmirrored")
    return pose


def _camera_matrix(value: Any) -> Sequence[float]:
    matrix = _checks.array("matrix", value)
    if matrix.shape == (4,):
        return _checks.finite("matrix", matrix.astype(np.float64)).tolist()
    matrix = _checks.matrix("matrix", value, [(3, 3)])
    if matrix[0, 1] != 0 or matrix[1, 0] != 0 or not np.array_equal(matrix[2], (0, 0, 1)):
        raise ValueError("matrix: [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] is needed, without skew")
    return [matrix[0, 0], matrix[1, 1], matrix[0, 2], matrix[1, 2]]


def _distortion(value: Any) -> Sequence[float]:
    found = _checks.array("distortion", np.zeros(0) if value is None else value)
    return _checks.finite("distortion", found.astype(np.float64)).ravel().tolist()


def _cube(layout: _facemap.CubeLayout, width: int, height: int) -> _facemap.Lens:
    columns = {"3x2": 3, "6x1": 6, "1x6": 1}[layout.name]
    side = width // columns
    if side < 1 or (width, height) != (columns * side, 6 // columns * side):
        raise ValueError(f"width, height: {width}x{height} does not hold square faces in the layout {layout.name}")
    return _facemap.Lens.cube(layout, side)
