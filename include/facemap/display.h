#pragma once

namespace facemap {

/// How a level stands for light.
enum class Transfer {
  Srgb,    ///< IEC 61966-2-1
  Linear,  ///< in proportion
};

/// How a picture's light is shown by levels, which end at 1: exposure, then a curve, then the transfer.
struct DisplayTransform {
  enum class Curve {
    None,    ///< what is beyond 1 is cut off
    Filmic,  ///< K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016: highlights fade instead, contrast rises
  };

  double exposure = 0;  ///< stops: light is multiplied by 2^exposure; -64..64
  Curve curve = Curve::None;
  Transfer transfer = Transfer::Srgb;

  /// Whether the light itself stays as it is.
  bool keeps_light() const { return exposure == 0 && curve == Curve::None; }
};

}  // namespace facemap
