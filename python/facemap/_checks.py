"""Arguments as the library takes them; what is wrong with one is said with its name."""

from __future__ import annotations

import contextlib
import math
import operator
import os
from typing import Any, Iterable, Iterator, List, Optional, Sequence, Tuple

import numpy as np

from . import _facemap
from .errors import Error

Triple = Tuple[float, float, float]

MOST_PIXELS = 1 << 28
"""Of a picture, as of the program."""


def array(name: str, value: Any) -> np.ndarray:
    """Anything array-like as an array of real numbers."""
    try:
        found = np.asarray(value)
    except Exception as error:
        raise TypeError(f"{name}: this is not an array of numbers: {error}") from error
    if np.ma.is_masked(value):
        raise ValueError(f"{name}: some numbers are masked")
    if found.dtype.kind not in "fiu":
        raise TypeError(f"{name}: an array of real numbers is needed, not of {found.dtype}")
    return found


def floats(name: str, value: Any, *, columns: int = 3) -> np.ndarray:
    """Float32 numbers of shape (..., columns), C-contiguous: `value` itself if it is such an array.

    Other real numbers are rounded to float32 once.
    """
    found = array(name, value)
    if found.ndim == 0 or found.shape[-1] != columns:
        raise ValueError(f"{name}: the shape is {found.shape}, and (..., {columns}) is needed")
    with np.errstate(over="ignore", invalid="ignore"):
        return np.require(found, np.float32, ["C_CONTIGUOUS", "ALIGNED"])


def rows(name: str, value: Any, *, columns: int = 3) -> np.ndarray:
    """The same of shape (n, columns)."""
    found = floats(name, value, columns=columns)
    if found.ndim != 2:
        raise ValueError(f"{name}: the shape is {found.shape}, and (n, {columns}) is needed")
    return found


def finite(name: str, value: np.ndarray) -> np.ndarray:
    """The array, in which no number is infinite or NaN."""
    if not np.isfinite(value).all():
        raise ValueError(f"{name}: a number is not finite (as float32)")
    return value


def indices(name: str, value: Any, count: int, *, least: int = 0) -> np.ndarray:
    """Whole numbers of least .. count - 1, of any shape."""
    found = array(name, value)
    if found.size and found.dtype.kind not in "iu":
        raise TypeError(f"{name}: an array of whole numbers is needed, not of {found.dtype}")
    if found.size and (found.min() < least or found.max() >= count):
        wrong = found.min() if found.min() < least else found.max()
        raise IndexError(f"{name}: {wrong} is none of {least} .. {count - 1}")
    return found


def number(name: str, value: Any) -> float:
    """A real number, NaN excluded."""
    try:
        if isinstance(value, (str, bytes, bool, np.bool_)):
            raise TypeError("it is text or a truth value")
        found = float(value)
    except Exception as error:
        raise TypeError(f"{name}: a number is needed, not {_shown(value)}") from error
    if math.isnan(found):
        raise ValueError(f"{name}: a number is needed, not NaN")
    return found


def finite_number(name: str, value: Any) -> float:
    found = number(name, value)
    if math.isinf(found):
        raise ValueError(f"{name}: a finite number is needed, not {found}")
    return found


def whole(name: str, value: Any, least: int, most: int) -> int:
    """A whole number of least .. most."""
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError("it is a truth value")
        found = operator.index(value)
    except Exception as error:
        raise TypeError(f"{name}: a whole number is needed, not {_shown(value)}") from error
    if not least <= found <= most:
        raise ValueError(f"{name}: {found} is none of {least} .. {most}")
    return found


def picture_size(width: Any, height: Any) -> Tuple[int, int]:
    """Pixels of a picture."""
    size = whole("width", width, 1, 32768), whole("height", height, 1, 32768)
    if size[0] * size[1] > MOST_PIXELS:
        raise ValueError(f"width, height: {width}x{height} are more than {MOST_PIXELS} pixels")
    return size


def progress(value: Any) -> Any:
    """None or something to call."""
    if value is not None and not callable(value):
        raise TypeError(f"progress: something to call is needed, not {_shown(value)}")
    return value


def core_of(scene: Any, name: str = "scene") -> Any:
    """A Scene's own scene."""
    core = getattr(scene, "_core", None)
    if not isinstance(core, _facemap.Scene):
        raise TypeError(f"{name}: a Scene is needed, not {_shown(scene)}")
    return core


def truth(name: str, value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: True or False is needed, not {_shown(value)}")
    return bool(value)


def threads(value: Any) -> int:
    return whole("threads", value, 0, 1024)


def text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name}: text is needed, not {_shown(value)}")
    return value


def path(name: str, value: Any) -> str:
    try:
        found = os.fsdecode(value)
    except TypeError as error:
        raise TypeError(f"{name}: a path is needed, not {_shown(value)}") from error
    if "\0" in found:
        raise ValueError(f"{name}: a path has no NUL in it")
    try:
        os.fsencode(found)
    except UnicodeEncodeError as error:
        raise ValueError(f"{name}: the file system has no such name: {error.reason}") from error
    return found


def triple(name: str, value: Any) -> Triple:
    """Three finite numbers."""
    found = array(name, value)
    if found.shape != (3,):
        raise ValueError(f"{name}: the shape is {found.shape}, and three numbers are needed")
    with np.errstate(over="ignore"):
        finite(name, found.astype(np.float32))
    return float(found[0]), float(found[1]), float(found[2])


def direction(name: str, value: Any) -> Triple:
    found = triple(name, value)
    if not any(np.float32(x) != 0 for x in found):
        raise ValueError(f"{name}: the zero vector is no direction")
    return found


def color(name: str, value: Any) -> Triple:
    """Linear RGB as three numbers of at least 0, or sRGB as "#rrggbb"."""
    if isinstance(value, str):
        return _color_from_text(name, value)
    found = triple(name, value)
    if min(found) < 0:
        raise ValueError(f"{name}: a colour's value is below 0")
    return found


def choice(name: str, value: Any, choices: Iterable[str]) -> str:
    known = list(choices)
    if not isinstance(value, str):
        raise TypeError(f"{name}: one of {', '.join(known)} is needed, not {_shown(value)}")
    if value not in known:
        raise ValueError(f"{name}: {value!r} is none of {', '.join(known)}")
    return value


def choices(name: str, value: Any, known: Iterable[str]) -> List[str]:
    """A sequence of some of them."""
    if isinstance(value, str):
        value = [value]
    try:
        return [choice(name, each, known) for each in value]
    except TypeError as error:
        raise TypeError(f"{name}: a sequence of names is needed, not {_shown(value)}") from error


def member(name: str, value: Any, enumeration: Any) -> Any:
    """The enumerator called `value`."""
    members = enumeration.__members__
    return members[choice(name, value, members)]


def matrix(name: str, value: Any, shapes: Sequence[Tuple[int, int]]) -> np.ndarray:
    """Finite float64 numbers of one of the shapes."""
    found = array(name, value)
    if found.shape not in shapes:
        wanted = " or ".join(str(shape) for shape in shapes)
        raise ValueError(f"{name}: the shape is {found.shape}, and {wanted} is needed")
    return finite(name, found.astype(np.float64))


def transform(name: str, value: Any) -> np.ndarray:
    """A (4, 4) matrix whose last row is 0, 0, 0, 1."""
    found = matrix(name, value, [(4, 4)])
    if not np.array_equal(found[3], (0, 0, 0, 1)):
        raise ValueError(f"{name}: the last row is {found[3].tolist()}, and [0, 0, 0, 1] is needed")
    return found


def optional(check: Any, name: str, value: Optional[Any]) -> Any:
    """None, or what `check` makes of the value."""
    return None if value is None else check(name, value)


@contextlib.contextmanager
def named(name: str) -> Iterator[None]:
    """What the library says of the argument gets its name."""
    try:
        yield
    except Error as error:
        raise Error(f"{name}: {error}") from error


def _shown(value: Any) -> str:
    shown = f"{type(value).__name__}"
    return f"{value!r}" if isinstance(value, (int, float, str, type(None))) and len(repr(value)) < 60 else shown


def _color_from_text(name: str, value: str) -> Triple:
    try:
        if len(value) != 7 or value[0] != "#":
            raise ValueError("no #rrggbb")
        levels = bytes.fromhex(value[1:])
    except ValueError as error:
        raise ValueError(f"{name}: {value!r} is not a colour #rrggbb") from error
    pixel = _facemap.Image.from_levels(np.frombuffer(levels, np.uint8).reshape(1, 1, 3)).color[0, 0]
    return float(pixel[0]), float(pixel[1]), float(pixel[2])
