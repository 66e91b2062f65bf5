"""What is visible from a point."""

from __future__ import annotations

import math
from typing import Any, Callable, List, NamedTuple, Optional, Tuple

import numpy as np

from . import _checks, _facemap
from .frame import Frame
from .scene import Scene

MOST_TEXTURE_PIXELS = 1 << 26
"""Images of more pixels make no holes, unless it is asked for."""


class Nearest(NamedTuple):
    """What ``View.nearest`` gives: two arrays of the directions' shape."""

    face: np.ndarray
    distance: np.ndarray


class AllHits(NamedTuple):
    """What ``View.all_hits`` gives: direction i has elements begins[i] up to begins[i + 1] of the other two."""

    begins: np.ndarray
    faces: np.ndarray
    distances: np.ndarray


class VisibleFaces(NamedTuple):
    """What ``View.visible_faces`` gives: an answer a face, none of them ever wrong."""

    states: np.ndarray
    """(M,) uint8: 0 hidden, 1 visible, 2 undecided."""
    witnesses: np.ndarray
    """(M, 3) float32: a direction in which ``View.nearest`` names the face, for visible ones; else zero."""
    reasons: np.ndarray
    """(M,) uint8: why a face is hidden, an index into ``HIDDEN_REASONS``."""

    @property
    def visible(self) -> np.ndarray:
        """(M,) bool."""
        return self.states == 1

    @property
    def hidden(self) -> np.ndarray:
        """(M,) bool."""
        return self.states == 0

    @property
    def undecided(self) -> np.ndarray:
        """(M,) bool."""
        return self.states == 2


HIDDEN_REASONS = ("none", "left out", "edge-on", "covered")
"""Why a face is hidden: it is not, or not known; it is odd, or its material takes it away; the origin lies on its
plane; others stand before it (``View.covered_pieces``)."""


class CoveredPiece(NamedTuple):
    """A piece of a hidden face, and what hides it.

    Take the face `cover` and all faces that are reached from it across edges that the piece meets. Each such edge
    belongs to two faces, which have it in opposite directions, and each face stands before the hidden one wherever both
    are seen in the piece. Then the faces that are met along a direction, those turned towards the origin less those
    turned away, are as many in all of the piece; along `direction` they are not 0. So one of the faces is seen in every
    direction of the piece.
    """

    scale: int
    """Corners are in parts of it: a power of two."""
    corners: np.ndarray
    """(3, 3) uint64: each as a mean of the face's corners, with these weights."""
    cover: int
    """A face."""
    direction: np.ndarray
    """(3,) float32: from the origin, strictly inside the piece; it meets `cover`."""


class View:
    """What is visible from a fixed point: a FaceMap that is asked about many points and directions at once.

    All answers are exact for the float32 numbers given, on every machine, whatever the number of threads. Arrays of
    float32 that are C-contiguous are used where they lie, and must not be changed during a call; others are converted.

    Parameters
    ----------
    scene : Scene
        As it is now: faces that are added later are not seen.
    origin : three floats
        World units; rounded to float32.
    threads : int
        0: as many as the process may run at once. In a process that was forked (multiprocessing's "fork") one works.
    cut_outs : bool
        Whether holes that materials make are holes; else every face is solid.
    max_texture_pixels : int
        Images of more make no holes.

    Raises
    ------
    TypeError, ValueError
        Naming the argument.

    Examples
    --------
    >>> view = facemap.View(scene, (0, 1.7, 0))
    >>> view.visible([[0, 0, -5], [0, 0, 5]])
    array([ True, False])
    """

    def __init__(self, scene: Scene, origin: Any, threads: int = 0, *, cut_outs: bool = True,
                 max_texture_pixels: int = MOST_TEXTURE_PIXELS) -> None:
        self._scene = _checks.core_of(scene)
        self._origin = _checks.triple("origin", origin)
        self._options = (_checks.threads(threads), _checks.truth("cut_outs", cut_outs),
                         _checks.whole("max_texture_pixels", max_texture_pixels, 0, 2**63 - 1))
        self._core = _facemap.View(self._scene, self._origin, *self._options)

    @property
    def origin(self) -> np.ndarray:
        """(3,) float32, world units."""
        return np.array(self._origin, np.float32)

    @property
    def memory_bytes(self) -> int:
        """Bytes of all that is kept."""
        return self._core.memory_bytes

    def prepare(self) -> View:
        """Makes now what ``visible`` else makes once it has been asked about so many points that it pays.

        Returns the view.
        """
        self._core.prepare()
        return self

    def visible(self, points: Any, faces: Any = None, tolerance: float = 0.0) -> np.ndarray:
        """Whether no face stands strictly between the origin and each point.

        A point on a face's plane is not hidden by that face; the origin itself is visible; a face that is seen edge-on
        hides nothing.

        Parameters
        ----------
        points : (..., 3) floats
            World units; finite.
        faces : (...) whole numbers
            The face that each point lies on, which never hides it; -1: none.
        tolerance : float
            World units: a face hides only points that are farther than this from its plane.

        Returns
        -------
        (...) bool

        Raises
        ------
        TypeError, ValueError, IndexError
            Naming the argument.

        Examples
        --------
        >>> view.visible(scene.vertices)
        """
        flat, shape = _flat("points", points)
        own = _own_faces(faces, shape, self._scene.face_count)
        with _checks.named("points"):
            return self._core.visible(flat, own, _tolerance(tolerance)).reshape(shape)

    def blocked_by(self, points: Any, faces: Any = None) -> np.ndarray:
        """The first face, seen from the origin, of those that stand strictly between it and each point.

        Of faces at exactly the same distance it is the one turned towards the origin, then the lower id. Parameters
        are those of ``visible``.

        Returns
        -------
        (...) int32
            -1: none, the point is visible.

        Examples
        --------
        >>> view.blocked_by([0, 0, 5])
        array(12, dtype=int32)
        """
        flat, shape = _flat("points", points)
        own = _own_faces(faces, shape, self._scene.face_count)
        with _checks.named("points"):
            return self._core.blocked_by(flat, own).reshape(shape)

    def nearest(self, directions: Any) -> Nearest:
        """The nearest face along each direction, and the distance to it.

        Edges and vertices belong to their faces. Of faces at exactly the same distance it is the one turned towards
        the origin, then the lower id.

        Parameters
        ----------
        directions : (..., 3) floats
            Of any length. Nothing is met along the zero vector and what is not finite.

        Returns
        -------
        face : (...) int32
            -1: none.
        distance : (...) float32
            World units; infinity: none.

        Examples
        --------
        >>> face, distance = view.nearest([[0, 0, -1], [0, -1, 0]])
        """
        flat, shape = _flat("directions", directions)
        face, distance = self._core.nearest(flat)
        return Nearest(face.reshape(shape), distance.reshape(shape))

    def all_hits(self, directions: Any) -> AllHits:
        """Every face that each direction meets, in exact order of distance.

        Of faces at the same distance the one turned towards the origin comes first, then the lower id.

        Parameters
        ----------
        directions : (..., 3) floats
            Of any length; in the order of their rows, n in all.

        Returns
        -------
        begins : (n + 1,) int64
            Direction i meets faces[begins[i]:begins[i + 1]].
        faces : (k,) int32
        distances : (k,) float32
            World units.

        Examples
        --------
        >>> begins, faces, distances = view.all_hits(directions)
        """
        flat, _ = _flat("directions", directions)
        return AllHits(*self._core.all_hits(flat))

    def image(self, width: int = 1024, height: int = 1024, field_angle: float = 360.0, sight: Any = None) -> Frame:
        """A picture of the map: the darker a pixel, the more faces lie in its direction (Wang 2022, Fig. 9).

        The distance from the middle is the angle from the sight. Pixels without a direction are pale blue.

        Parameters
        ----------
        width, height : int
            Pixels, 1 to 32768.
        field_angle : float
            Degrees across the shorter side, above 0 to 360: all directions.
        sight : three floats
            The direction in the middle. None: towards the middle of the scene.

        Returns
        -------
        Frame
            With ``face_id`` and ``range`` of the nearest face.

        Raises
        ------
        TypeError, ValueError
            Naming the argument.

        Examples
        --------
        >>> view.image(512, 512).save("map.png")
        """
        size = _checks.picture_size(width, height)
        angle = _checks.finite_number("field_angle", field_angle)
        if not 0 < angle <= 360:
            raise ValueError(f"field_angle: {angle} is not above 0 and at most 360 degrees")
        middle = (0.0, 0.0, 0.0) if sight is None else _checks.direction("sight", sight)
        with _checks.named("sight"):
            image = self._core.image(*size, math.radians(angle), middle)
        return Frame(image, ("range", "face_id"))

    def visible_faces(self) -> VisibleFaces:
        """Which faces are visible, each with a direction that sees it, and which are hidden.

        A face is visible if some direction of float32 numbers meets it first, strictly inside it; it is hidden if no
        direction of real numbers does. No answer is ever wrong; few faces are undecided.

        Returns
        -------
        VisibleFaces
            Of arrays ``states``, ``witnesses`` and ``reasons``, one element a face of the scene; ``visible``,
            ``hidden`` and ``undecided`` are masks.

        Examples
        --------
        >>> found = view.visible_faces()
        >>> scene.faces[found.visible]
        """
        return VisibleFaces(*self._core.visible_faces())

    def visible_vertices(self) -> np.ndarray:
        """Whether each vertex of the scene is visible, as ``visible`` has it.

        Returns
        -------
        (N,) bool

        Examples
        --------
        >>> scene.vertices[view.visible_vertices()]
        """
        return self._core.visible_vertices().view(np.bool_)

    def covered_pieces(self, face: int) -> List[CoveredPiece]:
        """Why ``visible_faces`` calls a face hidden because it is covered: pieces that make up the face, each with what
        covers it. None for faces that are visible, left out or seen edge-on; for one that was left undecided it takes
        more time than ``visible_faces`` does.

        Parameters
        ----------
        face : int

        Raises
        ------
        TypeError, IndexError
            If it is not one of the scene's.

        Examples
        --------
        >>> {piece.cover for piece in view.covered_pieces(12)}
        """
        number = int(_checks.indices("face", _checks.whole("face", face, -2**63, 2**63 - 1), self._scene.face_count))
        return [CoveredPiece(scale, np.array(corners, np.uint64), cover, np.array(direction, np.float32))
                for scale, corners, cover, direction in self._core.covered_pieces(number)]

    def __reduce__(self) -> Tuple[Any, ...]:
        return _view_from, (self._scene, self._origin, self._options)

    def __repr__(self) -> str:
        x, y, z = self._origin
        return f"<facemap.View from ({x:g}, {y:g}, {z:g}) of {self._scene.face_count} faces>"


def visibility(scene: Scene, origins: Any, points: Any, packed: bool = False,
               progress: Optional[Callable[[float, str], Any]] = None, memory: int = 0, *, faces: Any = None,
               tolerance: float = 0.0, threads: int = 0, cut_outs: bool = True,
               max_texture_pixels: int = MOST_TEXTURE_PIXELS) -> np.ndarray:
    """Which points are visible from which origins, as ``View.visible`` has it, by several threads.

    Parameters
    ----------
    scene : Scene
    origins : (..., 3) floats
        World units; finite.
    points : (..., 3) floats
        World units; finite.
    packed : bool
        Whether answers are bits: an eighth of the memory. ``numpy.unpackbits(row, count=n, bitorder="little")`` has
        them one by one.
    progress : callable
        Called with the fraction done (0..1) and a word, some times a second. What it raises stops the call.
    memory : int
        Bytes that working memory may take, as far as possible; 0: no limit. The answer's own memory is beside it.
    faces : whole numbers of the points' shape
        The face that each point lies on, which never hides it; -1: none.
    tolerance : float
        World units: a face hides only points that are farther than this from its plane.
    threads : int
        0: as many as the process may run at once.
    cut_outs, max_texture_pixels
        As of View.

    Returns
    -------
    bool, of the origins' shape and then the points'; or packed uint8, of the origins' shape and then (n + 7) // 8
        bytes for n points, the first one in the least significant bit.

    Raises
    ------
    TypeError, ValueError, IndexError
        Naming the argument.

    Examples
    --------
    >>> seen = facemap.visibility(scene, lamps, desks)
    >>> seen.any(axis=0)                        # desks that some lamp reaches
    """
    return _ask_many(_facemap.visibility_bits, scene, "origins", origins, points, faces, tolerance, packed, threads,
                     memory, cut_outs, max_texture_pixels, progress)


def visibility_along(scene: Scene, directions: Any, points: Any, packed: bool = False,
                     progress: Optional[Callable[[float, str], Any]] = None, memory: int = 0, *, faces: Any = None,
                     tolerance: float = 0.0, threads: int = 0, cut_outs: bool = True,
                     max_texture_pixels: int = MOST_TEXTURE_PIXELS) -> np.ndarray:
    """Which points see infinitely far along which directions: the sky, and the sun.

    A point does if no face stands strictly between it and what is infinitely far along the direction. A point on a
    face's plane is not hidden by that face; a face that is seen edge-on hides nothing.

    Parameters
    ----------
    scene : Scene
    directions : (..., 3) floats
        From the points towards the far, of any length but 0; finite.
    points : (..., 3) floats
        World units; finite.
    packed, progress, memory, faces, tolerance, threads, cut_outs, max_texture_pixels
        As of visibility.

    Returns
    -------
    bool, of the directions' shape and then the points'; or packed uint8, as visibility gives it.

    Raises
    ------
    TypeError, ValueError, IndexError
        Naming the argument.

    Examples
    --------
    >>> to_the_sun = [0.5, 0.7, 0.1]
    >>> sunny = facemap.visibility_along(scene, to_the_sun, scene.vertices)
    """
    flat = _checks.finite("directions", _checks.floats("directions", directions))
    if not flat.any(axis=-1).all():
        raise ValueError("directions: the zero vector is no direction")
    return _ask_many(_facemap.visibility_along_bits, scene, "directions", flat, points, faces, tolerance, packed,
                     threads, memory, cut_outs, max_texture_pixels, progress)


def _ask_many(ask: Callable[..., np.ndarray], scene: Scene, from_name: str, start: Any, points: Any, faces: Any,
              tolerance: float, packed: bool, threads: int, memory: int, cut_outs: bool, max_texture_pixels: int,
              progress: Optional[Callable[[float, str], Any]]) -> np.ndarray:
    """What visibility and visibility_along have in common."""
    core = _checks.core_of(scene)
    from_flat, from_shape = _flat(from_name, start)
    flat, shape = _flat("points", points)
    own = _own_faces(faces, shape, core.face_count)
    _checks.finite(from_name, from_flat)
    is_packed = _checks.truth("packed", packed)
    with _checks.named("points"):
        bits = ask(core, from_flat, flat, own, _tolerance(tolerance), _checks.threads(threads),
                   _checks.whole("memory", memory, 0, 2**63 - 1), _checks.truth("cut_outs", cut_outs),
                   _checks.whole("max_texture_pixels", max_texture_pixels, 0, 2**63 - 1), _checks.progress(progress))
    if is_packed:
        return bits.reshape(from_shape + bits.shape[1:])
    return np.unpackbits(bits, axis=1, count=len(flat), bitorder="little").view(np.bool_).reshape(from_shape + shape)


def _view_from(scene: _facemap.Scene, origin: Tuple[float, float, float], options: Tuple[int, bool, int]) -> View:
    threads, cut_outs, most = options
    return View(Scene._of(scene), origin, threads, cut_outs=cut_outs, max_texture_pixels=most)


def _flat(name: str, value: Any) -> Tuple[np.ndarray, Tuple[int, ...]]:
    """Rows of three, and the shape of what is said of each."""
    found = _checks.floats(name, value)
    return found.reshape(-1, 3), found.shape[:-1]


def _own_faces(faces: Any, shape: Tuple[int, ...], count: int) -> Optional[np.ndarray]:
    if faces is None:
        return None
    found = _checks.indices("faces", faces, count, least=-1)
    if found.shape != shape:
        raise ValueError(f"faces: the shape is {found.shape}, and {shape} is needed, one a point")
    return np.require(found, np.int32, ["C_CONTIGUOUS", "ALIGNED"]).reshape(-1)


def _tolerance(value: Any) -> float:
    found = _checks.finite_number("tolerance", value)
    if found < 0 or not np.isfinite(np.float32(found)):
        raise ValueError(f"tolerance: {found} is below 0 or too large for float32")
    return found
