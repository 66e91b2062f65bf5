#pragma once

#include <facemap/scene.h>
#include <facemap/viewpoint.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace facemap {

struct VisibilityOptions {
  int threads = 0;         ///< 0: as many as the process may run at once
  std::size_t memory = 0;  ///< bytes that working memory may take, as far as possible; 0: no limit; not heeded with a
                           ///< tolerance or holes, which take a viewpoint an origin
  bool cut_outs = true;    ///< holes that materials make are holes; else every face is solid
  std::uint64_t max_texture_pixels = Scene::kMostTexturePixels;  ///< images of more make no holes
};

/// Bytes of a row of visibility(): one bit a point.
constexpr std::size_t visibility_row_bytes(std::size_t points) { return points / 8 + (points % 8 != 0); }

/// Which points are visible from which origins, as Viewpoint::visible has it: row i of `bits`, visibility_row_bytes()
/// long, is about origin i; bit j % 8 (least significant first) of its byte j / 8 is 1 if point j is visible. Bits past
/// the last point are 0. Throws Error as Viewpoint does, and if `bits` is not as long as the rows together.
void visibility(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets,
                std::span<std::uint8_t> bits, const VisibilityOptions& options = {},
                const Viewpoint::Progress& progress = {});

/// Which points see infinitely far along which directions (of any length): row i of `bits` is about direction i, as
/// above; a point's bit is 1 if no face stands strictly between it and what is infinitely far along the direction. So
/// the sky and suns are asked about: parallel light that goes the other way (ParallelLight). Throws Error as
/// visibility() does, and if a direction is zero or not finite.
void visibility_along(const Scene& scene, std::span<const Vector> directions, const Viewpoint::Targets& targets,
                      std::span<std::uint8_t> bits, const VisibilityOptions& options = {},
                      const Viewpoint::Progress& progress = {});

}  // namespace facemap
