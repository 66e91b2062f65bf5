"""Arrays and other values that no function was made for, at random."""

from __future__ import annotations

import array
import decimal
import fractions
from typing import Any, List

import numpy as np

DTYPES = ["f2", "f4", "f4", "f8", "f8", ">f4", ">f8", "g", "i1", "i2", "i4", "i8", ">i4", "u1", "u2", "u4", "u8", "?",
          "c8", "c16", "O", "S3", "U3", "M8[s]", "m8[ms]", "V4", [("x", "f4"), ("y", "f4"), ("z", "f4")],
          [("x", "f4", (3,))]]
"""As numpy names them: numbers of each kind and byte order, and what are no numbers."""

LAST_AXES = [3, 3, 3, 3, 2, 1, 0, 4]
ODD_NUMBERS = [np.nan, np.inf, -np.inf, -1, -2, 0, 1e39, -1e39, 1e-46, 2**31, 2**31 - 1, -2**31, 2**32, 2**63 - 1,
               -2**63]


class Contrary:
    """Refuses to be what it looks like."""

    def _refuse(self, *_: Any, **__: Any) -> Any:
        raise RuntimeError("no")

    __array__ = __float__ = __index__ = __len__ = __getitem__ = __iter__ = __fspath__ = _refuse


class LooksLikeAnArray:
    """Becomes an array when it is asked."""

    def __init__(self, held: Any) -> None:
        self.held = held

    def __array__(self, *_: Any, **__: Any) -> Any:
        return self.held


class ShorterThanItSays:
    """A sequence whose length is a lie."""

    def __len__(self) -> int:
        return 3

    def __getitem__(self, index: int) -> float:
        return [1.0, 2.0][index]


def wild_array(random: np.random.Generator) -> np.ndarray:
    """Of any kind of elements, shape, layout and content; small."""
    dtype = np.dtype(DTYPES[random.integers(len(DTYPES))])
    shape = tuple(random.integers(0, 5, random.integers(0, 4)))
    if random.random() < 0.8:
        shape += (int(random.choice(LAST_AXES)),)
    return _laid_out(random, _filled(random, shape, dtype))


def array_like(good: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """Of as many columns as a good one, and numbers of the same kind, but of any precision, layout and content."""
    dtypes = ["f2", "f4", "f8", ">f4", "g", "i4"] if good.dtype.kind == "f" else ["i1", "u2", "i4", ">i4", "u4", "u8"]
    rows = good.shape[:1] if random.random() < 0.5 else (int(random.integers(0, 6)),)
    return _laid_out(random, _filled(random, rows + good.shape[1:], np.dtype(str(random.choice(dtypes)))))


def _filled(random: np.random.Generator, shape: Any, dtype: np.dtype) -> np.ndarray:
    numbers = random.normal(size=shape) if random.random() < 0.5 else random.integers(0, 8, shape).astype(float)
    if random.random() < 0.5:
        numbers = np.where(random.random(shape) < 0.1, random.choice(ODD_NUMBERS, shape), numbers)
    if dtype.kind == "O":
        things = np.empty(shape, object)
        for place in np.ndindex(*things.shape):
            things[place] = random.choice([1.5, 1]) if random.random() < 0.9 else wild_object(random)
        return things
    if dtype.kind in "fc":
        with np.errstate(all="ignore"):
            return np.asarray(numbers).astype(dtype)
    bits = random.integers(0, 256, (*shape, dtype.itemsize), np.uint8)
    small = bits * (np.arange(dtype.itemsize) == (dtype.itemsize - 1 if dtype.byteorder == ">" else 0)) % np.uint8(5)
    chosen = np.ascontiguousarray(small if random.random() < 0.7 else bits)
    if dtype.kind == "U":
        return np.asarray(numbers).astype(dtype)
    return np.ndarray(shape, dtype, chosen.tobytes()).copy()


def _laid_out(random: np.random.Generator, values: np.ndarray) -> np.ndarray:
    """The same array, lying otherwise in memory."""
    kind = random.integers(9)
    if values.ndim == 0 or kind == 0:
        return values
    if kind == 1:
        return np.asfortranarray(values)
    if kind == 2:
        return values[::-1]
    if kind == 3:
        return np.repeat(values, 2, axis=-1)[..., ::2]
    if kind == 4:
        return np.broadcast_to(values[:1], values.shape)
    if kind == 5 and values.dtype.kind != "O":
        buffer = np.zeros(values.nbytes + 1, np.uint8)
        unaligned = buffer[1:].view(values.dtype) if values.nbytes else values.ravel()
        unaligned = unaligned.reshape(values.shape)
        unaligned[...] = values
        return unaligned
    if kind == 6:
        values = values.copy()
        values.setflags(write=False)
        return values
    if kind == 7 and values.dtype.kind in "fiu":
        return np.ma.masked_array(values, random.random(values.shape) < 0.3)
    return np.swapaxes(values, 0, -1)


def wild_object(random: np.random.Generator) -> Any:
    """No array, but what may stand where one should."""
    ring: List[Any] = [1.0, 2.0]
    ring.append(ring)
    things = (
        None, True, False, 0, 1, -1, 3, 40000, 2**31, 2**63, 2**64, -2**63, 10**400, 0.5, -0.5, 1e300, float("nan"),
        float("inf"), 1j, "", "a", "edges", "edges:99", "\0", "\ud800", "#12345g", "ä" * 300, b"", b"abc", (), [], {},
        set(), [[1, 2], [3]], [[1, 2, 3], [4, 5]], [None] * 3, ["a", "b", "c"], [[0, 0, 0]], (1, 2, 3), [1e400] * 3,
        ring, range(3), iter([1.0, 2.0, 3.0]), (x for x in (1, 2, 3)), memoryview(b"abc"), array.array("d", [1, 2, 3]),
        array.array("f"), fractions.Fraction(1, 3), decimal.Decimal("0.1"), decimal.Decimal("NaN"), np.float32(1),
        np.float64("nan"), np.int64(-1), np.uint64(2**64 - 1), np.bool_(True), np.datetime64("2000-01-01"),
        np.matrix([[1.0, 2.0, 3.0]]), np.array(300), np.array(None), Contrary(), LooksLikeAnArray([1, 2, 3]),
        LooksLikeAnArray(np.zeros((2, 3), np.float32)), LooksLikeAnArray(np.array("x")), ShorterThanItSays(), object(),
        type, len, Ellipsis, NotImplemented, np.float32, slice(3))
    return things[random.integers(len(things))]


def wild_value(good: Any, random: np.random.Generator) -> Any:
    """To stand where `good` should."""
    if isinstance(good, np.ndarray) and random.random() < 0.6:
        return array_like(good, random)
    if random.random() < 0.4:
        return wild_object(random)
    found = wild_array(random)
    kind = random.random()
    if kind < 0.1:
        return found.tolist()
    return LooksLikeAnArray(found) if kind < 0.15 else found
