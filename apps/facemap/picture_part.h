#pragma once

#include <facemap/renderer.h>

#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "text_values.h"

namespace facemap::program {

/// What part of its pictures a run is to make.
struct WantedPart {
  std::optional<PixelBox> crop;
  int tile = 0, tiles = 0;  ///< number `tile` of so many, from 1; 0: all rows

  /// For pictures of that size. Throws UsageError if there is none.
  std::optional<PixelBox> pixels(const Size& size) const;
};

/// Rows of the table; they set `part`, which must outlive them.
std::vector<Option> part_options(WantedPart& part);

}  // namespace facemap::program
