"""Pictures."""

from __future__ import annotations

import os
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _checks, _facemap
from ._options import PLANES

_BITS = {"png": (8, 16), "jpeg": (8,), "exr": (16, 32), "pfm": (32,), "npy": (32,)}
_EXTENSIONS = {".png": "png", ".jpg": "jpeg", ".jpeg": "jpeg", ".exr": "exr", ".pfm": "pfm", ".npy": "npy"}
_PFM_PLANES = ("depth", "range", "position", "normal", "face_normal", "albedo")


class Frame:
    """A picture and what is behind each pixel, as arrays of shape (height, width, ...), row 0 at the top.

    ``Scene.render`` makes it. Arrays beside the colours are those of the ray through the pixel's centre, and are there
    if ``render(planes=...)`` asked for them; a ValueError says so otherwise. They are read-only and share the frame's
    memory, which they keep. A notebook shows the picture.

    Examples
    --------
    >>> frame = scene.render()
    >>> frame.depth[frame.face_id < 0]          # infinity where no face is
    """

    def __init__(self, image: _facemap.Image, planes: Sequence[str] = (), statistics: Optional[Dict[str, Any]] = None,
                 warnings: Sequence[str] = ()) -> None:
        self._image = image
        self._planes = tuple(planes)
        self._statistics = dict(statistics or {})
        self._warnings = list(warnings)
        self._levels: Optional[np.ndarray] = None
        self._mask: Optional[np.ndarray] = None

    @classmethod
    def from_array(cls, array: Any) -> Frame:
        """A picture of one's own, to be saved or shown.

        Parameters
        ----------
        array : (H, W) or (H, W, 3)
            Floats: linear light; uint8: sRGB levels.
        """
        found = _checks.array("array", array)
        if found.ndim == 2:
            found = np.repeat(found[:, :, np.newaxis], 3, axis=2)
        if found.ndim != 3 or found.shape[2] != 3 or found.size == 0:
            raise ValueError(f"array: the shape is {found.shape}, and (height, width) or (height, width, 3) is needed")
        if max(found.shape) > 32768:
            raise ValueError(f"array: the shape is {found.shape}, and 32768 pixels a side are the most")
        if found.dtype == np.uint8:
            return cls(_facemap.Image.from_levels(np.require(found, np.uint8, ["C_CONTIGUOUS", "ALIGNED"])))
        if found.dtype.kind != "f":
            raise TypeError(f"array: floats or uint8 are needed, not {found.dtype}")
        return cls(_facemap.Image.from_light(_checks.floats("array", found)))

    @property
    def width(self) -> int:
        """Pixels."""
        return self._image.width

    @property
    def height(self) -> int:
        """Pixels."""
        return self._image.height

    @property
    def planes(self) -> Tuple[str, ...]:
        """Names of the arrays that are there beside the colours."""
        return self._planes

    @property
    def statistics(self) -> Dict[str, Any]:
        """Times in milliseconds, memory in bytes, counts, and the way taken."""
        return self._statistics

    @property
    def warnings(self) -> List[str]:
        """Textures that could not be read: "file: reason"."""
        return self._warnings

    @property
    def color(self) -> np.ndarray:
        """(H, W, 3) float32: linear RGB; 1 is white."""
        return self._image.color

    @property
    def image(self) -> np.ndarray:
        """(H, W, 3) uint8: sRGB levels, those of the PNG file."""
        if self._levels is None:
            self._levels = self._image.levels(_facemap.Display())
            self._levels.setflags(write=False)
        return self._levels

    @property
    def depth(self) -> np.ndarray:
        """(H, W) float32: distance along the camera's sight (z), world units; below 0 behind it; infinity: no face."""
        return self._plane("depth")

    @property
    def range(self) -> np.ndarray:
        """(H, W) float32: distance along the ray, world units; infinity: no face."""
        return self._plane("range")

    @property
    def face_id(self) -> np.ndarray:
        """(H, W) int32: the face that is seen, an index into ``Scene.faces``; -1: none."""
        return self._plane("face_id")

    @property
    def position(self) -> np.ndarray:
        """(H, W, 3) float32: the point that is seen, world units; NaN: none."""
        return self._plane("position")

    @property
    def normal(self) -> np.ndarray:
        """(H, W, 3) float32: of shading, unit length; 0: no face."""
        return self._plane("normal")

    @property
    def face_normal(self) -> np.ndarray:
        """(H, W, 3) float32: of the face's plane on the side that is seen, unit length; 0: no face."""
        return self._plane("face_normal")

    @property
    def albedo(self) -> np.ndarray:
        """(H, W, 3) float32: the surface's own colour, linear RGB; 0: no face."""
        return self._plane("albedo")

    @property
    def uv(self) -> np.ndarray:
        """(H, W, 2) float32: texture coordinates; NaN where there are none."""
        return self._plane("uv")

    @property
    def object_id(self) -> np.ndarray:
        """(H, W) int32: an index into ``Scene.objects``; -1: none."""
        return self._plane("object_id")

    @property
    def material_id(self) -> np.ndarray:
        """(H, W) int32: an index into ``Scene.materials``; -1: none."""
        return self._plane("material_id")

    @property
    def hidden_lights(self) -> np.ndarray:
        """(H, W) int32: how many lights do not reach the point; -1: no face."""
        return self._plane("hidden_lights")

    @property
    def light_mask(self) -> np.ndarray:
        """(H, W, lights) bool: whether each light reaches the point: point lights, then spots, then directional ones,
        each kind in the order given."""
        self._check("light_mask")
        if self._mask is None:
            bits = self._image.light_bits
            mask = np.unpackbits(bits, axis=2, count=self._image.light_count, bitorder="little").view(np.bool_)
            mask.setflags(write=False)
            self._mask = mask
        return self._mask

    def png(self, exposure: float = 0, curve: str = "none", transfer: str = "srgb", threads: int = 0) -> bytes:
        """The bytes of a PNG file of 8 bits a channel; see ``save``."""
        return self._image.png(_display(exposure, curve, transfer), _checks.threads(threads))

    def _repr_png_(self) -> bytes:
        return self.png()

    def save(self, path: Union[str, os.PathLike], plane: Optional[str] = None, *, bits: Optional[int] = None,
             quality: int = 90, exposure: float = 0, curve: str = "none", transfer: str = "srgb",
             layers: Sequence[str] = (), threads: int = 0) -> None:
        """Writes the picture, or one of its planes: the bytes that ``facemap render`` writes.

        The file appears whole or not at all.

        Parameters
        ----------
        path : str or path
            .png, .jpg, .exr, .pfm or .npy.
        plane : str
            The name of one of the arrays: a .png or .jpg of it is for the eye.
        bits : int
            A channel: PNG 8 (if not said) or 16, EXR 16 (if not said) or 32.
        quality : int
            Of JPEG, 1 to 100.
        exposure : float
            PNG and JPEG: brighter by so many stops, -64 to 64.
        curve : "none" or "filmic"
            PNG and JPEG: "filmic" lets highlights fade instead of cutting them off.
        transfer : "srgb" or "linear"
            PNG.
        layers : names of arrays
            EXR: planes that the file holds beside the picture.
        threads : int
            0: as many as the process may run at once.

        Raises
        ------
        TypeError, ValueError
            Naming the argument; Error if the file cannot be written, with the reason.

        Examples
        --------
        >>> frame.save("out.png", exposure=0.5)
        >>> frame.save("depth.npy", "depth")
        """
        name = _checks.path("path", path)
        kind = _format_of(name)
        threads = _checks.threads(threads)
        quality = _checks.whole("quality", quality, 1, 100)
        bits = _bits(kind, bits)
        if plane is not None:
            encoded = self._encoded_plane(plane, kind, quality, threads)
        else:
            display = _display(exposure, curve, transfer)
            encoded = self._encoded(kind, bits, quality, display, layers, threads)
        _facemap.write_file(name, encoded)

    def _encoded(self, kind: str, bits: int, quality: int, display: _facemap.Display, layers: Sequence[str],
                 threads: int) -> bytes:
        layers = _checks.choices("layers", layers, PLANES)
        if layers and kind != "exr":
            raise ValueError("layers: only an EXR file has layers")
        if kind == "png":
            return self._image.png_16(display, threads) if bits == 16 else self._image.png(display, threads)
        if kind == "jpeg":
            if display.transfer == _facemap.Transfer.linear:
                raise ValueError("transfer: a JPEG file cannot say that it is linear")
            return self._image.jpeg(display, quality, threads)
        if kind == "exr":
            for layer in layers:
                self._check(layer)
            return self._image.exr(bits == 16, [PLANES[layer] for layer in layers], threads)
        return self._image.pfm() if kind == "pfm" else self._image.npy()

    def _encoded_plane(self, plane: str, kind: str, quality: int, threads: int) -> bytes:
        self._check(_checks.choice("plane", plane, PLANES))
        name = PLANES[plane]
        if kind == "exr":
            return self._image.plane_exr(name, threads)
        if kind == "npy":
            return self._image.plane_npy(name)
        if kind == "pfm":
            if plane not in _PFM_PLANES:
                raise ValueError(f"path: PFM holds one or three floats a pixel, which {plane} is not")
            return self._image.plane_pfm(name)
        picture = self._image.plane_picture(name)
        if kind == "jpeg":
            return picture.jpeg(_facemap.Display(), quality, threads)
        return picture.png(_facemap.Display(), threads)

    def _plane(self, name: str) -> np.ndarray:
        self._check(name)
        return self._image.plane(PLANES[name])

    def _check(self, name: str) -> None:
        if name not in self._planes:
            raise ValueError(f"{name}: this frame has none; render(planes=[..., {name!r}]) makes it")

    def __getstate__(self) -> Tuple[_facemap.Image, Tuple[str, ...], Dict[str, Any], List[str]]:
        return self._image, self._planes, self._statistics, self._warnings

    def __setstate__(self, state: Tuple[_facemap.Image, Tuple[str, ...], Dict[str, Any], List[str]]) -> None:
        Frame.__init__(self, *state)

    def __repr__(self) -> str:
        return f"<facemap.Frame: {self.width}x{self.height}, {', '.join(('color',) + self._planes)}>"


def save_png(path: Union[str, os.PathLike], array: Any) -> None:
    """Writes an array as a picture: (H, W) or (H, W, 3), floats of linear light or uint8 of sRGB levels.

    The name's extension may be any that ``Frame.save`` takes.

    Examples
    --------
    >>> facemap.save_png("mask.png", mask.astype(float))
    """
    Frame.from_array(array).save(path)


def _format_of(path: str) -> str:
    extension = os.path.splitext(path)[1].lower()
    if extension not in _EXTENSIONS:
        raise ValueError(f"path: no format is known by the name {extension!r}; known are {', '.join(_EXTENSIONS)}")
    return _EXTENSIONS[extension]


def _bits(kind: str, bits: Optional[int]) -> int:
    known = _BITS[kind]
    if bits is None:
        return known[0]
    if _checks.whole("bits", bits, 1, 64) not in known:
        raise ValueError(f"bits: a channel of {kind} has {' or '.join(map(str, known))} bits, not {bits}")
    return bits


def _display(exposure: float, curve: str, transfer: str) -> _facemap.Display:
    display = _facemap.Display()
    display.exposure = _checks.finite_number("exposure", exposure)
    if not -64 <= display.exposure <= 64:
        raise ValueError(f"exposure: {exposure} is none of -64 .. 64 stops")
    display.curve = _checks.member("curve", curve, _facemap.Curve)
    display.transfer = _checks.member("transfer", transfer, _facemap.Transfer)
    return display
