"""Exact visibility and rendering from fixed points, on the CPU: numpy in, numpy out.

>>> import facemap
>>> scene = facemap.load("model.obj")
>>> scene.render().save("model.png")
>>> facemap.View(scene, (0, 2, 5)).visible(scene.vertices)
"""

from ._facemap import __version__
from .camera import Camera
from .errors import Error, LoadError
from .frame import Frame, save_png
from .generated import generate
from .light import Light
from .scene import Scene, load
from .view import AllHits, Nearest, View, visibility

__all__ = [
    "AllHits",
    "Camera",
    "Error",
    "Frame",
    "Light",
    "LoadError",
    "Nearest",
    "Scene",
    "View",
    "__version__",
    "generate",
    "load",
    "save_png",
    "visibility",
]
