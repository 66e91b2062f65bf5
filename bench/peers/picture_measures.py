"""How two pictures of a scene differ: silhouettes, depth, shadow masks, colours,
normals. Planes are NumPy arrays, upper row first."""
import struct
import zlib

import numpy

OTHER_DEPTH = 1e-3  # a share of the distance: far above what float32 rounds, far below what lies behind an edge
CLEARLY_OTHER = 8  # levels of 0 to 255
SHOWN_LARGEST = 32  # levels that are white in the picture of differences


def widen(mask):
    """The mask with the eight neighbours of each pixel."""
    padded = numpy.pad(mask, 1)
    height, width = mask.shape
    return numpy.logical_or.reduce([padded[y : y + height, x : x + width] for y in range(3) for x in range(3)])


def edge_band(mask):
    """Pixels among whose neighbours the mask has both values."""
    return widen(mask) & widen(~mask)


def percent(mask, among):
    return 100 * float((mask & among).sum()) / max(1, int(among.sum()))


def to_levels(linear):
    """sRGB levels of 0 to 255, not rounded."""
    value = numpy.clip(linear, 0, 1)
    return 255 * numpy.where(value <= 0.0031308, 12.92 * value, 1.055 * numpy.power(value, 1 / 2.4) - 0.055)


def write_png(path, levels):
    """Height x width x 3, or a mask."""
    if levels.ndim == 2:
        levels = numpy.dstack([levels * 255.0] * 3)
    pixels = numpy.clip(levels + 0.5, 0, 255).astype(numpy.uint8)
    height, width, _ = pixels.shape
    rows = numpy.hstack((numpy.zeros((height, 1), numpy.uint8), pixels.reshape(height, width * 3)))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows.tobytes())))
        file.write(chunk(b"IEND", b""))


def measure(folder, light_count):
    """Reads the planes that both programs left in the folder, writes pictures of their differences there."""
    load = lambda name: numpy.load(folder / f"{name}.npy")
    seen, theirs_seen = load("ours_id") >= 0, load("alpha")
    both = seen & theirs_seen
    measures = {"silhouette": float(both.sum() / (seen | theirs_seen).sum())}

    depth, theirs_depth = load("ours_depth"), load("depth")
    outline = edge_band(seen)
    other_depth = numpy.zeros_like(seen)
    other_depth[both] = abs(depth[both] - theirs_depth[both]) > OTHER_DEPTH * depth[both]
    measures["depth"] = percent(other_depth, both)

    measures.update(measure_masks(folder, light_count, both, outline))
    edges = outline.copy()
    for light in range(light_count):
        edges |= edge_band(ours_lit(folder, light))
    measures.update(measure_colors(folder, edges))
    measures.update(measure_surfaces(folder, both & ~widen(outline)))
    return measures


def ours_lit(folder, light):
    bits = numpy.load(folder / "ours_lights.npy")
    bits = bits.reshape(bits.shape[0], bits.shape[1], -1)
    return (bits[:, :, light // 8] >> (light % 8)) & 1 == 1


def measure_masks(folder, light_count, both, outline):
    lit_pixels = different = counted = band_pixels = anywhere = 0
    for light in range(light_count):
        lit, theirs = ours_lit(folder, light), numpy.load(folder / f"lit_{light}.npy")
        band = outline | edge_band(lit)
        compared = both & ~band
        wrong = compared & (lit != theirs)
        write_png(folder / f"mask_{light}.png", numpy.dstack([lit * 255.0, theirs * 255.0, wrong * 255.0]))
        lit_pixels += (lit & both).sum()
        different += wrong.sum()
        anywhere += (both & (lit != theirs)).sum()
        counted += compared.sum()
        band_pixels += (band & both).sum()
    pixels = light_count * max(1, both.sum())
    return {"lit": 100 * lit_pixels / pixels, "mask": 100 * different / max(1, counted),
            "band": 100 * band_pixels / pixels, "anywhere": 100 * anywhere / pixels}


def measure_colors(folder, edges):
    ours = 255 * numpy.load(folder / "ours.npy")[:, :, :3]
    theirs = to_levels(numpy.load(folder / "color.npy")[:, :, :3])
    difference = abs(ours - theirs)
    write_png(folder / "cycles.png", theirs)
    write_png(folder / "difference.png", difference * (255 / SHOWN_LARGEST))
    inside = ~widen(edges)
    return {"mean": float(difference.mean()), "inner_mean": float(difference[inside].mean()),
            "far": percent(difference.max(axis=2) > CLEARLY_OTHER, inside)}


def measure_surfaces(folder, inside):
    ours, theirs = [to_levels(numpy.load(folder / f"{name}.npy")[:, :, :3]) for name in ("ours_albedo", "albedo")]
    write_png(folder / "albedo.png", numpy.hstack((ours, theirs)))
    normal, other = [unit(numpy.load(folder / f"{name}.npy")) for name in ("ours_normal", "normal")]
    write_png(folder / "normal.png", 127.5 * (1 + numpy.hstack((normal, other))))
    angle = numpy.degrees(numpy.arccos(numpy.clip((normal * other).sum(axis=2), -1, 1)))
    return {"albedo": float(abs(ours - theirs)[inside].mean()), "normal": float(angle[inside].mean())}


def unit(vectors):
    vectors = vectors.astype(numpy.float64)
    return vectors / numpy.maximum(numpy.linalg.norm(vectors, axis=2, keepdims=True), 1e-9)
