"""What Scene.render takes, as the library's renderer takes it."""

from __future__ import annotations

from typing import Any, Callable, Dict, List, Sequence, Tuple, Union

from . import _checks, _facemap

PLANES = {
    "depth": "z",
    "range": "depth",
    "face_id": "id",
    "normal": "normal",
    "light_mask": "lights",
    "position": "position",
    "face_normal": "face-normal",
    "albedo": "albedo",
    "uv": "uv",
    "object_id": "object",
    "material_id": "material",
    "hidden_lights": "shadows",
}
"""Frame's arrays and the planes of the library that they are."""

DEFAULT_PLANES = ("depth", "range", "face_id", "normal", "light_mask")

Options = _facemap.RenderOptions


def _member(field: str, enumeration: Any) -> Callable[[Options, Any], None]:
    return lambda options, value: setattr(options, field, _checks.member(field, value, enumeration))


def _truth(field: str) -> Callable[[Options, Any], None]:
    return lambda options, value: setattr(options, field, _checks.truth(field, value))


def _whole(field: str, least: int, most: int) -> Callable[[Options, Any], None]:
    return lambda options, value: setattr(options, field, _checks.whole(field, value, least, most))


def _color(field: str) -> Callable[[Options, Any], None]:
    return lambda options, value: getattr(options, f"set_{field}")(_checks.color(field, value))


def _set_crop(options: Options, value: Any) -> None:
    if value is None:
        return
    box = _checks.indices("crop", value, 32769)
    if box.shape != (4,):
        raise ValueError("crop: four whole numbers x, y, width, height are needed")
    x, y, width, height = box.tolist()
    if width < 1 or height < 1 or x + width > options.width or y + height > options.height:
        raise ValueError(f"crop: {(x, y, width, height)} does not lie within {options.width}x{options.height} pixels")
    options.set_crop((x, y, width, height))


def _set_filter_width(options: Options, value: Any) -> None:
    options.filter_width = _checks.finite_number("filter_width", value)
    if not 0 < options.filter_width <= 16:
        raise ValueError(f"filter_width: {value} is not above 0 and at most 16 pixels")


_SETTERS: Dict[str, Callable[[Options, Any], None]] = {
    "crop": _set_crop,
    "filter": _member("filter", _facemap.Filter),
    "filter_width": _set_filter_width,
    "normals": _member("normals", _facemap.Normals),
    "terminator_fix": _truth("terminator_fix"),
    "falloff": _member("falloff", _facemap.Falloff),
    "background": _color("background"),
    "ambient": _color("ambient"),
    "sky_up": _color("sky_up"),
    "sky_down": _color("sky_down"),
    "materials": _truth("materials"),
    "max_texture_pixels": _whole("max_texture_pixels", 1, 2**63 - 1),
    "builder": _member("builder", _facemap.Builder),
    "strategy": _member("strategy", _facemap.Strategy),
    "light_maps": _member("light_maps", _facemap.LightMaps),
    "map_memory": _whole("map_memory", 0, 2**63 - 1),
    "threads": _whole("threads", 0, 1024),
}


def render_options(width: int, height: int, samples: Union[int, str], planes: Union[str, Sequence[str]],
                   more: Dict[str, Any]) -> Tuple[List[str], Options]:
    """The names of the planes, and the options."""
    options = Options()
    options.width, options.height = width, height
    _set_samples(options, samples)
    names = _plane_names(planes)
    for name in names:
        options.add_plane(PLANES[name])
    for name, value in more.items():
        if name not in _SETTERS:
            raise TypeError(f"render() has no argument {name!r}; it has {', '.join(_SETTERS)}")
        _SETTERS[name](options, value)
    return names, options


def _set_samples(options: Options, samples: Union[int, str]) -> None:
    if isinstance(samples, str):
        kind, _, side = samples.partition(":")
        if kind != "edges" or not (side.isdecimal() or samples == "edges") or len(side) > 2:
            raise ValueError(f"samples: {samples!r} is neither a number nor \"edges\" or \"edges:8\"")
        options.set_edges(True)
        samples = int(side or 4)
    options.samples = _checks.whole("samples", samples, 1, 16)


def _plane_names(planes: Union[str, Sequence[str]]) -> List[str]:
    if isinstance(planes, str) and planes == "all":
        return list(PLANES)
    return _checks.choices("planes", planes, PLANES)
