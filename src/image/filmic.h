#pragma once

namespace facemap {

/// The share of full level at which a curve like that of film shows light: x (2.51 x + 0.03) / (x (2.43 x + 0.59) +
/// 0.14), at most 1. K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016: a fit of the reference transforms of ACES.
/// Never falls as light rises; 0 for NaN.
double filmic(double light);

}  // namespace facemap
