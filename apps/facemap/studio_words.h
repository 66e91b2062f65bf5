#pragma once

#include <facemap/studio.h>

#include "words.h"

namespace facemap::program {

/// The studio as flags. Of what `given` says of the view or of lights, nothing is said anew.
Words studio_words(const Studio& studio, const Words& given);

}  // namespace facemap::program
