#include <facemap/error.h>
#include <facemap/visibility.h>

#include <vector>

#include "simd/floating_point_mode.h"

namespace facemap {

void visibility(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets,
                std::span<std::uint8_t> bits, const VisibilityOptions& options, const Viewpoint::Progress& progress) {
  const FloatingPointMode mode;
  const std::size_t points = targets.points.size(), row = visibility_row_bytes(points);
  if (bits.size() != origins.size() * row) throw Error("visibility needs as many bytes as its rows together");
  std::vector<std::uint8_t> answers(points);
  for (std::size_t i = 0; i < origins.size(); ++i) {
    Viewpoint(scene, origins[i], {options.threads, options.cut_outs, options.max_texture_pixels})
        .visible(targets, answers);
    std::uint8_t* out = bits.data() + i * row;
    std::fill(out, out + row, std::uint8_t{0});
    for (std::size_t j = 0; j < points; ++j) out[j / 8] = static_cast<std::uint8_t>(out[j / 8] | answers[j] << (j % 8));
    if (progress && !progress(static_cast<double>(i + 1) / static_cast<double>(origins.size()))) throw Error("stopped");
  }
}

}  // namespace facemap
