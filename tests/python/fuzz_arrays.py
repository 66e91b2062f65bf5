"""Asks every function of the module with arrays and values that it was not made for.

Each call ends in an answer, or in TypeError, ValueError (facemap.Error is one) or IndexError that begins with the name
of an argument; anything else is a fault, as is a crash. FACEMAP_SEED repeats a run, FACEMAP_FUZZ_SECONDS says how long
it takes, FACEMAP_FUZZ_FROM=n skips what came before call n.
"""

from __future__ import annotations

import os
import re
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from dataclasses import fields
from typing import Any, Callable, Dict, NamedTuple, Tuple

import numpy as np

import facemap
from use_calls import use_calls
from wild_values import wild_value

REFUSALS = (TypeError, ValueError, IndexError)


class Call(NamedTuple):
    """A function, what makes good arguments for it, and what its messages may call them besides."""

    function: Callable[..., Any]
    good: Callable[[np.random.Generator], Dict[str, Any]]
    also: Tuple[str, ...] = ()


def triangle() -> facemap.Scene:
    return facemap.Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])


def some_points(random: np.random.Generator) -> np.ndarray:
    return random.normal(size=(int(random.integers(0, 6)), 3)).astype(np.float32)


def some_faces(random: np.random.Generator) -> np.ndarray:
    return random.integers(0, 4, (int(random.integers(1, 5)), 3))


def render(scene: facemap.Scene, camera: Dict[str, Any], light: Dict[str, Any], **more: Any) -> None:
    """One with cameras and lights of any fields."""
    frame = scene.render(facemap.Camera(**camera), [facemap.Light(**light)], **more)
    assert frame.color.shape == (frame.height, frame.width, 3)


RENDER = {"width": 6, "height": 4, "samples": 1, "planes": ["face_id"], "up": (0, 1, 0), "progress": None,
          "crop": (0, 0, 2, 2), "filter": "box", "filter_width": 2.0, "normals": "flat", "terminator_fix": True,
          "falloff": "constant", "background": (0, 0, 0), "ambient": (0, 0, 0), "sky_up": (0, 0, 0),
          "sky_down": "#ffffff", "materials": True, "max_texture_pixels": 9, "builder": "cover",
          "strategy": "auto", "light_maps": "auto", "map_memory": 0, "threads": 1}
CAMERA = {"position": (3, 2, 5), "look_at": (0, 0, 0), "up": (0, 1, 0), "field_angle": 50.0, "lens": "plane",
          "height": None, "matrix": None, "distortion": (), "pose": None, "layout": "3x2", "name": ""}
OPENCV = {"matrix": np.array([[5, 0, 3], [0, 5, 2], [0, 0, 1.0]]), "distortion": [0.1, 0, 0, 0],
          "pose": np.eye(4), "lens": "opencv"}
LIGHT = {field.name: field.default for field in fields(facemap.Light)}


def calls(directory: str) -> Dict[str, Call]:
    """Everything public, by name."""
    scene, corner = facemap.generate("bust"), triangle()
    view = facemap.View(scene, (0, 1, 3), threads=1)
    frame = corner.render(width=6, height=4, planes="all")
    views = {"packed": False, "progress": None, "memory": 0, "faces": None, "tolerance": 0.0, "threads": 1,
             "cut_outs": True, "max_texture_pixels": 9}

    def few(**more: Any) -> Callable[[np.random.Generator], Dict[str, Any]]:
        """These arguments, with points for some_points."""
        return lambda random: {name: made(random) if made is some_points else made for name, made in more.items()}

    def mesh(random: np.random.Generator) -> Dict[str, Any]:
        points = random.normal(size=(4, 3)).astype(np.float32)
        return {"vertices": points, "faces": some_faces(random), "normals": points, "texcoords": points[:, :2],
                "colors": np.abs(points), "color": None, "threads": 1}

    def add(other: Any, transform: Any) -> None:
        triangle().add(other, transform).render(width=2, height=2)

    def generate(name: Any, detail: Any) -> None:
        is_good = isinstance(detail, (int, np.integer)) and 1 <= detail <= 24
        facemap.generate(name, 25 if is_good else detail)  # good ones take seconds

    uses = {name: Call(use, few(**good)) for name, (use, good) in use_calls().items()}
    return {
        **uses,
        "Scene": Call(facemap.Scene, mesh),
        "Scene.from_object": Call(facemap.Scene.from_object, few(mesh=corner), ("vertices", "faces")),
        "Scene.add": Call(add, few(other=corner, transform=np.eye(4)), ("vertices", "faces")),
        "View": Call(lambda **a: facemap.View(**a).nearest([0, 0, 1]),
                     few(scene=corner, origin=(0, 0, 1), threads=1, cut_outs=True, max_texture_pixels=9)),
        "View.visible": Call(view.visible, few(points=some_points, faces=None, tolerance=0.0)),
        "View.blocked_by": Call(view.blocked_by, few(points=some_points, faces=None)),
        "View.nearest": Call(view.nearest, few(directions=some_points)),
        "View.all_hits": Call(view.all_hits, few(directions=some_points)),
        "View.covered_pieces": Call(view.covered_pieces, few(face=0)),
        "visibility": Call(facemap.visibility, few(scene=corner, origins=some_points, points=some_points, **views)),
        "visibility_along": Call(facemap.visibility_along,
                                 few(scene=corner, directions=np.eye(3), points=some_points, **views)),
        "Scene.render": Call(lambda **a: corner.render(**a),
                             few(camera=facemap.Camera(), lights=[facemap.Light((1, 2, 3))], **RENDER)),
        "Camera": Call(lambda **a: render(corner, a, LIGHT, width=6, height=4), few(**CAMERA), ("width, height",)),
        "Camera.opencv": Call(lambda **a: render(corner, a, LIGHT, width=6, height=4), few(**OPENCV),
                              ("camera", "height", "field_angle", "layout")),
        "Camera.rays": Call(facemap.Camera((0, 0, 3)).rays, few(scene=corner, width=6, height=4)),
        "Light": Call(lambda **a: render(corner, CAMERA, a, width=6, height=4), few(**LIGHT)),
        "Frame.from_array": Call(lambda array: facemap.Frame.from_array(array)._repr_png_(), few(array=np.eye(3))),
        "Frame.png": Call(frame.png, few(exposure=0.0, curve="none", transfer="srgb", threads=1)),
        "Frame.save": Call(lambda **a: frame.save(**a),
                           few(path=os.path.join(directory, "a.png"), plane=None, bits=8, quality=90, exposure=0.0,
                               curve="none", transfer="srgb", layers=(), threads=1)),
        "save_png": Call(facemap.save_png, few(path=os.path.join(directory, "b.png"), array=np.eye(3))),
        "load": Call(facemap.load, few(path=os.path.join(directory, "none.obj"), max_bytes=99, max_faces=9,
                                       allow_outside=False, threads=1), ("none.obj", "file")),
        "generate": Call(generate, few(name="bust", detail=25)),
    }


def is_proper(error: BaseException, call: Call, arguments: Dict[str, Any]) -> bool:
    """Whether it is a refusal that says which argument it is about."""
    if isinstance(error, RuntimeError) and str(error) == "no":
        return True  # a value's own
    if callable(arguments.get("progress")):
        return True  # what it raises itself is passed on
    if not isinstance(error, REFUSALS):
        return False
    if isinstance(error, facemap.LoadError):
        return bool(error.reason)
    said = str(error).split(":")[0]
    names = re.split(r"\W+", said)
    return any(name in names for name in (*arguments, *call.also)) or said in call.also


def shown(value: Any) -> str:
    try:
        kind = f"{value.dtype!r} {value.shape} " if isinstance(value, np.ndarray) else ""
        return kind + " ".join(repr(value).split())[:300]
    except Exception:
        return f"a {type(value)}"


def ask(number: int, seed: int, name: str, call: Call, counts: Counter) -> bool:
    """One call with up to three arguments made wild; whether it ended as it may."""
    random = np.random.default_rng([seed, number])
    arguments = call.good(random)
    for changed in random.choice(list(arguments), random.choice([0, 1, 1, 1, 2, 3])):
        arguments[changed] = wild_value(arguments[changed], random)
    try:
        call.function(**arguments)
        counts["answered"] += 1
    except Exception as error:
        counts[type(error).__name__] += 1
        if not is_proper(error, call, arguments):
            traceback.print_exc()
            print(f"FACEMAP_SEED={seed} call {number}: {name}")
            for argument, value in arguments.items():
                print(f"  {argument} = {shown(value)}")
            return False
    return True


def main() -> int:
    warnings.simplefilter("ignore")
    seed = int(os.environ.get("FACEMAP_SEED", np.random.SeedSequence().entropy % 2**32))
    number = int(os.environ.get("FACEMAP_FUZZ_FROM", 0))
    end = time.monotonic() + float(os.environ.get("FACEMAP_FUZZ_SECONDS", 5))
    print(f"FACEMAP_SEED={seed}", flush=True)
    counts: Counter = Counter()
    faults, first = 0, number
    with tempfile.TemporaryDirectory() as directory:
        os.chdir(directory)  # where wild paths lead
        known = list(calls(directory).items())
        while time.monotonic() < end and faults < 5:
            name, call = known[number % len(known)]
            if os.environ.get("FACEMAP_FUZZ_TRACE"):
                print(number, name, file=sys.stderr, flush=True)
            faults += not ask(number, seed, name, call, counts)
            number += 1
        os.chdir("/")
    print(f"{number - first} calls, {faults} faults: " + ", ".join(f"{n} {kind}" for kind, n in counts.most_common()))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
