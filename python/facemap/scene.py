"""Scenes: meshes, and what lights and cameras stand among them."""

from __future__ import annotations

import os
import threading
from typing import Any, Callable, Dict, Iterable, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _checks, _facemap
from ._options import DEFAULT_PLANES, render_options
from .camera import Camera
from .frame import Frame
from .light import Light

_MOST_VERTICES = 2**32 - 1  # indices are uint32, and the last one means "none"


class Scene:
    """Triangles, and lights and cameras to see them with.

    Parameters
    ----------
    vertices : (N, 3) floats, or a mesh
        World units. Numbers other than float32 are rounded to float32 once; from there on every answer is exact. A
        mesh is any object with ``vertices`` and ``faces`` (as trimesh has) or ``triangles`` (as Open3D has).
    faces : (M, 3) whole numbers
        Rows of three indices into the vertices; counter-clockwise as seen from the front. Row i is face i in all
        answers. At least one.
    normals : (N, 3) floats
        One a vertex, for smooth shading; need not be of unit length. None: flat.
    texcoords : (N, 2) floats
        Texture coordinates, one a vertex.
    colors : (N, 3) floats
        Linear RGB in 0..1, one a vertex.
    color : three floats or "#rrggbb"
        Of the whole surface, linear RGB. None: grey, 0.8.
    threads : int
        That may work on a large mesh; 0: as many as the process may run at once. The scene does not depend on them.

    Attributes
    ----------
    lights : list of Light
        Used by ``render`` unless it is given others; yours to change.
    cameras : list of Camera
        The first one is used by ``render`` unless it is given another; yours to change.

    Raises
    ------
    TypeError, ValueError, IndexError
        For arrays of other types or shapes, numbers that are not finite, no faces, and indices out of range.

    Examples
    --------
    >>> floor = facemap.Scene([[-1, 0, -1], [1, 0, -1], [0, 0, 1]], [[0, 1, 2]])
    >>> scene = facemap.Scene(trimesh.load("part.stl"))
    """

    def __init__(self, vertices: Any, faces: Any = None, *, normals: Any = None, texcoords: Any = None,
                 colors: Any = None, color: Any = None, threads: int = 0) -> None:
        if faces is None:
            vertices, faces = _arrays_of(vertices)
        points = _checks.finite("vertices", _checks.rows("vertices", vertices))
        if len(points) > _MOST_VERTICES:
            raise ValueError(f"vertices: {len(points)} are too many")
        core = _facemap.scene_from_arrays(
            points, _corners(faces, len(points)),
            _vertex_array("normals", normals, len(points), 3), _vertex_array("texcoords", texcoords, len(points), 2),
            _vertex_array("colors", colors, len(points), 3), _checks.optional(_checks.color, "color", color),
            _checks.threads(threads))
        self._begin(core)

    @classmethod
    def from_object(cls, mesh: Any, **fields: Any) -> Scene:
        """The scene of any object with ``vertices`` and ``faces`` or ``triangles``; `fields` are those of Scene."""
        return cls(*_arrays_of(mesh), **fields)

    @classmethod
    def _of(cls, core: _facemap.Scene) -> Scene:
        scene = cls.__new__(cls)
        scene._begin(core)
        return scene

    def _begin(self, core: _facemap.Scene) -> None:
        self._parts: List[_facemap.Scene] = [core]  # joined when the sum is needed
        self._joining = threading.RLock()
        self.lights: List[Light] = [Light._from_core(light) for light in core.lights]
        self.cameras: List[Camera] = [Camera._from_core(camera) for camera in core.cameras]

    @property
    def _core(self) -> _facemap.Scene:
        with self._joining:
            count = len(self._parts)  # another thread may add more while these are joined
            if count > 1:
                self._parts[:count] = [_facemap.joined(self._parts[:count], 0)]
            return self._parts[0]

    def add(self, other: Union[Scene, Any], transform: Any = None) -> Scene:
        """Adds another scene's or mesh's faces behind those that are there, with their materials.

        The other's lights and cameras are not taken over. Views and arrays made before stay as they are.

        Parameters
        ----------
        other : Scene or mesh
            A mesh as Scene takes it.
        transform : (4, 4) floats
            Applied to column vectors: world = transform @ (x, y, z, 1), in float64, then rounded to float32 once. What
            it mirrors keeps its fronts. None: as it is.

        Returns
        -------
        Scene
            This one, so that calls can follow each other.

        Raises
        ------
        TypeError, ValueError
            For what is no mesh, and a matrix of another shape, that is not finite or not affine, or flattens the mesh.

        Examples
        --------
        >>> scene.add(chair, [[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        """
        added = (other if isinstance(other, Scene) else Scene.from_object(other))._core  # it may be this one
        if transform is not None:
            matrix = _checks.transform("transform", transform)
            with _checks.named("transform"):
                added = _facemap.moved(added, matrix, 0)
        self._parts.append(added)
        return self

    @property
    def vertices(self) -> np.ndarray:
        """(N, 3) float32, read-only: the scene's own numbers."""
        return self._core.vertices

    @property
    def faces(self) -> np.ndarray:
        """(M, 3) uint32, read-only: three indices into the vertices a face."""
        return self._core.faces

    @property
    def face_count(self) -> int:
        """Number of faces, the odd ones included."""
        return self._core.face_count

    @property
    def bounds(self) -> np.ndarray:
        """(2, 3) float32: the lower and the upper corner of the box of all faces that are not odd."""
        return np.array([self._core.lower, self._core.upper], np.float32)

    @property
    def odd_faces(self) -> Dict[str, int]:
        """How many faces take part in no answer, by cause: zero_area, repeated_vertex, duplicate (same corners as a
        face of lower id)."""
        return self._core.odd_faces

    @property
    def kept_faces(self) -> np.ndarray:
        """(K,) uint32, read-only, ascending: the faces that are not odd."""
        return self._core.kept_faces

    @property
    def up(self) -> Optional[Tuple[float, float, float]]:
        """The direction that points up, if the file's format states one."""
        return self._core.up

    @property
    def objects(self) -> List[str]:
        """Names of the file's objects; ``Frame.object_id`` has indices into it."""
        return self._core.objects

    @property
    def materials(self) -> List[str]:
        """Names of the materials; ``Frame.material_id`` has indices into it."""
        return self._core.materials

    @property
    def warnings(self) -> List[str]:
        """What was odd in the file: "file:line: text", one a cause."""
        return self._core.warnings

    def render(self, camera: Optional[Camera] = None, lights: Optional[Iterable[Light]] = None, width: int = 1024,
               height: int = 1024, samples: Union[int, str] = 1, *,
               planes: Union[str, Sequence[str]] = DEFAULT_PLANES, up: Optional[Sequence[float]] = None,
               progress: Optional[Callable[[float, str], Any]] = None, **options: Any) -> Frame:
        """Draws the scene with exact visibility and hard shadows: the pixels of ``facemap render``.

        Parameters
        ----------
        camera : Camera
            None: the scene's first, or one that sees all of it.
        lights : Lights
            None: the scene's own, or if it has none eight around it.
        width, height : int
            Pixels, 1 to 32768.
        samples : int or str
            n: n x n samples a pixel, 1 to 16; "edges": one, and 4 x 4 where a pixel may hold an edge; "edges:8".
        planes : names of Frame's arrays, or "all"
            What to fill beside the colours; of "depth", "range", "face_id", "normal", "light_mask" (these five if not
            said), "position", "face_normal", "albedo", "uv", "object_id", "material_id", "hidden_lights".
        up : three floats
            The world's up: of the sky, and of what is made up. None: the camera's, else the file's, else (0, 1, 0).
        progress : callable
            Called with the fraction done (0..1) and a word, some times a second. What it raises stops the call.
        **options
            crop : four ints x, y, width, height
                Only these pixels of the picture are made.
            filter : "box" or "blackman-harris"; filter_width : float, pixels
            normals : "smooth" or "flat"
            terminator_fix : bool
                Keeps coarse smooth surfaces from shadowing themselves in facets.
            falloff : "constant" or "inverse-square"
            background, ambient, sky_up, sky_down : linear RGB or "#rrggbb"
            materials : bool
                False: all is white.
            max_texture_pixels : int
                Larger images are left out, with a warning.
            builder : "cover" or "fill"; strategy : "auto", "lists" or "transposed"; light_maps : "auto", "keep" or
            "none"
                Time and memory alone (builder="fill", as published, can miss a face at its edge).
            map_memory : int
                Bytes that maps and working memory may take, as far as possible; 0: no limit.
            threads : int
                0: as many as the process may run at once.

        Returns
        -------
        Frame

        Raises
        ------
        TypeError, ValueError
            Naming the argument.

        Examples
        --------
        >>> frame = scene.render(facemap.Camera((3, 2, 5)), [facemap.Light((4, 6, 3))], 640, 480, samples="edges")
        >>> frame.save("out.png")
        """
        one = self.cameras[:1] if camera is None else [camera]
        return next(self.frames(one or [Camera()], lights, width, height, samples, planes=planes, up=up,
                                progress=progress, **options))

    def frames(self, cameras: Iterable[Camera], lights: Optional[Iterable[Light]] = None, width: int = 1024,
               height: int = 1024, samples: Union[int, str] = 1, *,
               planes: Union[str, Sequence[str]] = DEFAULT_PLANES, up: Optional[Sequence[float]] = None,
               progress: Optional[Callable[[float, str], Any]] = None, **options: Any) -> Iterator[Frame]:
        """A Frame for each camera, one after the other; what is made for the lights is made once.

        Arguments are those of ``render``; `up` is the first camera's if it is not given.

        Examples
        --------
        >>> for i, frame in enumerate(scene.frames(cameras)):
        ...     frame.save(f"frame_{i}.png")
        """
        width, height = _checks.picture_size(width, height)
        progress = _checks.progress(progress)
        names, settings = render_options(width, height, samples, planes, options)
        up = _checks.optional(_checks.direction, "up", up)
        try:
            one_by_one = iter(cameras)
        except TypeError as error:
            raise TypeError(f"cameras: a sequence of Camera is needed, not {type(cameras).__name__}") from error
        return self._drawn(one_by_one, lights, width, height, names, settings, up, progress)

    def _drawn(self, cameras: Iterator[Camera], lights: Optional[Iterable[Light]], width: int, height: int,
               names: Sequence[str], settings: Any, up: Optional[Sequence[float]], progress: Any) -> Iterator[Frame]:
        core, painter, world_up = self._core, None, None
        for camera in cameras:
            if not isinstance(camera, Camera):
                raise TypeError(f"camera: a Camera is needed, not {type(camera).__name__}")
            if painter is None:
                world_up = up if up is not None else camera._world_up(core)
            view = camera._complete(core, width, height, world_up)
            if painter is None:
                settings.set_up(world_up)
                painter = _facemap.Painter(core, view, self._lights(lights, core, world_up), settings)
            yield Frame(painter.render(view, progress), names, painter.statistics, painter.warnings)

    def _lights(self, lights: Optional[Iterable[Light]], core: _facemap.Scene,
                up: Sequence[float]) -> List[_facemap.Light]:
        wanted = self.lights if lights is None else lights
        if isinstance(wanted, Light):
            wanted = [wanted]
        try:
            wanted = list(wanted)
        except TypeError as error:
            raise TypeError(f"lights: a sequence of Light is needed, not {type(lights).__name__}") from error
        for light in wanted:
            if not isinstance(light, Light):
                raise TypeError(f"lights: a Light is needed, not {type(light).__name__}")
        if not wanted and lights is None:
            return _facemap.make_up_lights(core, up)
        return [light._core() for light in wanted]

    def __getstate__(self) -> Tuple[_facemap.Scene, List[Light], List[Camera]]:
        return self._core, self.lights, self.cameras

    def __setstate__(self, state: Tuple[_facemap.Scene, List[Light], List[Camera]]) -> None:
        self._begin(state[0])
        self.lights, self.cameras = state[1], state[2]

    def __repr__(self) -> str:
        return f"<facemap.Scene: {self.face_count} faces, {len(self.vertices)} vertices>"


def load(path: Union[str, os.PathLike], *, max_bytes: int = 1 << 34, max_faces: int = 100_000_000,
         allow_outside: bool = False, threads: int = 0) -> Scene:
    """Reads a model: OBJ, glTF, PLY or STL, by its content, or by its name where that does not say.

    Parameters
    ----------
    path : str or path
        The file.
    max_bytes, max_faces : int
        A file of more, or one that names such a file, is refused.
    allow_outside : bool
        Whether it may name files outside of its folder.
    threads : int
        That may read; 0: as many as the process may run at once.

    Returns
    -------
    Scene
        With the file's materials, lights and cameras.

    Raises
    ------
    LoadError
        With file, line, column and reason; its subclass OpenError, an OSError too, for a file that cannot be opened.

    Examples
    --------
    >>> scene = facemap.load("model.obj")
    """
    core = _facemap.load(_checks.path("path", path), _checks.whole("max_bytes", max_bytes, 1, 2**63 - 1),
                         _checks.whole("max_faces", max_faces, 1, 2**31 - 1),
                         _checks.truth("allow_outside", allow_outside), _checks.threads(threads))
    return Scene._of(core)


def _arrays_of(mesh: Any) -> Tuple[Any, Any]:
    faces = getattr(mesh, "faces", None)
    if faces is None:
        faces = getattr(mesh, "triangles", None)
    if not hasattr(mesh, "vertices") or faces is None:
        hint = "; facemap.load reads files" if isinstance(mesh, (str, bytes, os.PathLike)) else ""
        raise TypeError(f"faces: none are given, and {type(mesh).__name__} is no mesh with vertices and faces{hint}")
    return mesh.vertices, faces


def _corners(faces: Any, vertex_count: int) -> np.ndarray:
    found = _checks.array("faces", faces)
    if found.ndim != 2 or found.shape[1] != 3:
        raise ValueError(f"faces: the shape is {found.shape}, and (n, 3) is needed")
    if len(found) == 0:
        raise ValueError("faces: a scene needs at least one")
    if len(found) >= 2**31:
        raise ValueError(f"faces: {len(found)} are too many")
    return np.require(_checks.indices("faces", found, vertex_count), np.uint32, ["C_CONTIGUOUS", "ALIGNED"])


def _vertex_array(name: str, value: Any, count: int, columns: int) -> Optional[np.ndarray]:
    if value is None:
        return None
    found = _checks.finite(name, _checks.rows(name, value, columns=columns))
    if len(found) != count:
        raise ValueError(f"{name}: there are {len(found)}, and {count} vertices")
    return found
