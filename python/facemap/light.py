"""Lights."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any, Sequence, Union

import numpy as np

from . import _checks, _facemap

_LARGEST = float(np.finfo(np.float32).max)

Color = Union[Sequence[float], str]


@dataclass
class Light:
    """A light with hard, exact shadows: a point light unless `kind` says otherwise.

    Radiance = color * intensity * cos of the angle of incidence [/ distance^2] [* the spot's fade] [* the range's].

    Parameters
    ----------
    position : three floats
        World units. A directional light has none.
    color : three floats or str
        Linear RGB, 0 or more; or sRGB as "#rrggbb".
    intensity : float
        Multiplies the color; 0 or more.
    kind : "point", "spot" or "directional"
        "point" shines in all directions, "spot" within a cone about `direction`, "directional" everywhere along it.
    direction : three floats
        The way the light goes; of any length but 0.
    inner_angle, outer_angle : float
        Degrees from the direction, half of the cone's angle: full intensity within the inner one, nothing beyond the
        outer one.
    falloff : bool
        Whether it fades with the squared distance, whatever ``render(falloff=...)`` says.
    range : float
        World units; nothing is lit farther away than this.

    Raises
    ------
    TypeError, ValueError
        When it is used, naming the field.

    Examples
    --------
    >>> lamp = facemap.Light((2, 5, 1), color=(1, 0.9, 0.8))
    >>> sun = facemap.Light.sun((-1, -3, -2))
    """

    position: Sequence[float] = (0.0, 0.0, 0.0)
    color: Color = (1.0, 1.0, 1.0)
    intensity: float = 1.0
    kind: str = "point"
    direction: Sequence[float] = (0.0, 0.0, -1.0)
    inner_angle: float = 0.0
    outer_angle: float = 45.0
    falloff: bool = False
    range: float = math.inf

    def __eq__(self, other: Any) -> bool:
        return are_same(self, other)

    @classmethod
    def spot(cls, position: Sequence[float], direction: Sequence[float], outer_angle: float = 45.0,
             inner_angle: float = 0.0, **fields) -> Light:
        """A spot light; angles in degrees from its direction. `fields` are those of Light."""
        return cls(position, kind="spot", direction=direction, outer_angle=outer_angle, inner_angle=inner_angle,
                   **fields)

    @classmethod
    def sun(cls, direction: Sequence[float], color: Color = (1.0, 1.0, 1.0), **fields) -> Light:
        """A directional light, by the way its light goes. `fields` are those of Light."""
        return cls(color=color, kind="directional", direction=direction, **fields)

    def _core(self) -> _facemap.Light:
        light = _facemap.Light()
        light.kind = _checks.member("kind", self.kind, _facemap.Light.Kind)
        light.position = _checks.triple("position", self.position)
        light.color = _checks.color("color", self.color)
        light.intensity = _between("intensity", self.intensity, _LARGEST)
        light.direction = _checks.direction("direction", self.direction)
        light.outer_angle = math.radians(_between("outer_angle", self.outer_angle, 180))
        light.inner_angle = math.radians(_between("inner_angle", self.inner_angle, self.outer_angle))
        light.has_falloff = _checks.truth("falloff", self.falloff)
        light.range = _checks.number("range", self.range)
        if not light.range > 0:
            raise ValueError(f"range: {self.range} is not above 0")
        return light

    @classmethod
    def _from_core(cls, light: _facemap.Light) -> Light:
        return cls(light.position, light.color, light.intensity, light.kind.name, light.direction,
                   degrees(light.inner_angle), degrees(light.outer_angle), light.has_falloff, light.range)


def degrees(radians: float) -> float:
    """A file's angle in degrees, without the rounding of the two conversions: 13 digits, as the program has it."""
    return float(f"{radians * (180 / math.pi):.13g}")


def are_same(one: Any, other: Any) -> Any:
    """Whether two of a data class have equal fields, some of which may be arrays."""
    if type(other) is not type(one):
        return NotImplemented
    return all(_is_equal(getattr(one, field.name), getattr(other, field.name)) for field in fields(one))


def _is_equal(value: Any, other: Any) -> bool:
    if isinstance(value, str) or isinstance(other, str):
        return isinstance(value, str) and isinstance(other, str) and value == other
    return np.array_equal(value, other)


def _between(name: str, value: float, most: float) -> float:
    found = _checks.finite_number(name, value)
    if not 0 <= found <= most:
        raise ValueError(f"{name}: {found} is none of 0 .. {most}")
    return found
