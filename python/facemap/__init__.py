"""Exact visibility and rendering from fixed points, on the CPU: numpy in, numpy out.

>>> import facemap
>>> scene = facemap.load("model.obj")
>>> scene.render().save("model.png")
>>> facemap.View(scene, (0, 2, 5)).visible(scene.vertices)
"""

from ._facemap import __version__
from .camera import Camera, Rays
from .errors import Error, LoadError, OpenError
from .frame import Frame, save_png
from .generated import generate
from .light import Light
from .scene import Scene, load
from .uses.ground import on_ground, terrain
from .uses.lamps import Coverage, lamp_coverage
from .uses.rigs import camera_rig
from .uses.sky import hemisphere, sky_view_factor
from .uses.spinning_lidar import Scan, lidar
from .uses.sun import sun_hours
from .uses.viewsheds import viewshed
from .view import HIDDEN_REASONS, AllHits, CoveredPiece, Nearest, View, VisibleFaces, visibility, visibility_along

__all__ = [
    "AllHits",
    "Camera",
    "Coverage",
    "CoveredPiece",
    "Error",
    "Frame",
    "HIDDEN_REASONS",
    "Light",
    "LoadError",
    "Nearest",
    "OpenError",
    "Rays",
    "Scan",
    "Scene",
    "View",
    "VisibleFaces",
    "__version__",
    "camera_rig",
    "generate",
    "hemisphere",
    "lamp_coverage",
    "lidar",
    "load",
    "on_ground",
    "save_png",
    "sky_view_factor",
    "sun_hours",
    "terrain",
    "viewshed",
    "visibility",
    "visibility_along",
]
