#pragma once

#include "scene/generators/solids.h"

namespace facemap::generators {

/// A turned chess piece stands on y = 0 about the y axis; a square of the board has side 1. `segments` around
/// (a rook: a multiple of 24, a bishop: of 4, a queen: of 16), curves in steps that grow with `detail`.
struct Turning {
  int segments;
  int detail;
};

Solid make_pawn(const Turning& turning);
Solid make_rook(const Turning& turning);
Solid make_bishop(const Turning& turning);  ///< the slit of its mitre opens towards +x
Solid make_queen(const Turning& turning);
Solid make_king(const Turning& turning);  ///< the arms of its cross point to +x and -x

/// A horse's head looking towards +x on a turned foot. `rings` along the neck and head, `sides` around it.
struct Carving {
  Turning foot;
  int rings_per_span;
  int sides;
};
Solid make_knight(const Carving& carving);

}  // namespace facemap::generators
