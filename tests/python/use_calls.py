"""The ready uses, as fuzz_arrays.py asks them."""

from __future__ import annotations

from typing import Any, Callable, Dict, Tuple

import numpy as np

import facemap


def use_calls() -> Dict[str, Tuple[Callable[..., Any], Dict[str, Any]]]:
    """Functions, and good arguments for them."""
    scene = facemap.Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2], [0, 3, 1]])
    land = facemap.terrain(np.eye(3))
    two = np.zeros((2, 3), np.float32)
    asked = {"faces": None, "tolerance": 0.0, "threads": 1, "progress": None}
    return {
        "sky_view_factor": (facemap.sky_view_factor, dict(scene=scene, points=two, normals=two + 1, directions=5,
                                                          weighting="plain", up=(0, 1, 0), **asked)),
        "hemisphere": (facemap.hemisphere, dict(count=5, up=(0, 1, 0))),
        "sun_hours": (facemap.sun_hours, dict(scene=scene, points=two, sun_directions=two + 1, hours=np.ones(2),
                                              normals=None, up=None, **asked)),
        "terrain": (facemap.terrain, dict(heights=np.eye(3), spacing=1.0, corner=(0.0, 0.0), up="y")),
        "on_ground": (facemap.on_ground, dict(scene=land, points=two, height=1.0, up=None)),
        "viewshed": (facemap.viewshed, dict(terrain=land, observers=two, points=None, of="vertices", eye_height=1.7,
                                            target_height=0.0, stand=True, max_distance=None, each=False, up=None,
                                            **asked)),
        "lamp_coverage": (facemap.lamp_coverage, dict(scene=scene, points=two, lamps=two + 1, normals=two + 1, **asked)),
        "lidar": (facemap.lidar, dict(scene=scene, pose=np.eye(4), elevations=np.zeros(2), azimuths=np.zeros(2),
                                      max_range=9.0, min_range=0.0, threads=1)),
        "camera_rig": (facemap.camera_rig, dict(scene=scene, matrices=np.diag([5.0, 5, 1]), distortions=np.zeros(4),
                                                poses=np.eye(4)[np.newaxis], width=6, height=4, rig=None, fisheye=True,
                                                lights=None, samples=1)),
    }
