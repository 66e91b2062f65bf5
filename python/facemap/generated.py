"""Scenes that a program makes."""

from __future__ import annotations

from . import _checks, _facemap
from .camera import Camera
from .light import Light
from .scene import Scene


def generate(name: str, detail: int = 1) -> Scene:
    """A scene made by a program, the same on every machine, with a camera and eight lights.

    Parameters
    ----------
    name : "chessboard", "grass", "bust" or "typewriter"
        Of 123,314, 86,864, 44,590 and 145,558 faces.
    detail : int
        1 to 24; the number of faces grows about with its square.

    Examples
    --------
    >>> facemap.generate("bust").render().save("bust.png")
    """
    known = _checks.choice("name", name, _facemap.generator_names())
    core, (position, look_at, up, field_angle), lights = _facemap.generate(
        known, _checks.whole("detail", detail, 1, _facemap.most_detail))
    scene = Scene._of(core)
    scene.cameras = [Camera(position, look_at, up, field_angle)]
    scene.lights = [Light(position, color) for position, color in lights]
    return scene
