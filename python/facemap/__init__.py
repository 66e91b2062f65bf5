"""Exact visibility and rendering from fixed points, on the CPU: numpy in, numpy out.

>>> import facemap
>>> scene = facemap.load("model.obj")
>>> scene.render().save("model.png")
>>> facemap.View(scene, (0, 2, 5)).visible(scene.vertices)
"""

from ._facemap import __version__
from .camera import Camera, Rays
from .errors import Error, LoadError
from .frame import Frame, save_png
from .generated import generate
from .light import Light
from .scene import Scene, load
from .view import HIDDEN_REASONS, AllHits, CoveredPiece, Nearest, View, VisibleFaces, visibility, visibility_along

__all__ = [
    "AllHits",
    "Camera",
    "CoveredPiece",
    "Error",
    "Frame",
    "HIDDEN_REASONS",
    "Light",
    "LoadError",
    "Nearest",
    "Rays",
    "Scene",
    "View",
    "VisibleFaces",
    "__version__",
    "generate",
    "load",
    "save_png",
    "visibility",
    "visibility_along",
]
