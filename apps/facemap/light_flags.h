#pragma once

#include <facemap/light.h>

#include <string>
#include <vector>

namespace facemap::program {

/// Values of --light, --spot and --sun. Colours are linear and may be left out. At the end of the first two may stand
/// "range=R" (world units) and "falloff". Throw UsageError.
///
/// "X,Y,Z[,R,G,B]"
Light parse_light(const std::string& text);
/// "X,Y,Z,DX,DY,DZ,ANGLE[,INNER][,R,G,B]": position, direction, and the angles of the whole cone and of the one with
/// full intensity, in degrees, from side to side.
Light parse_spot(const std::string& text);
/// "DX,DY,DZ[,R,G,B]": the way the light goes.
Light parse_sun(const std::string& text);

/// The flag that gives such a light, its intensity multiplied into its colour.
std::string flag_of(const Light& light);
std::string flags_of(const std::vector<Light>& lights);

}  // namespace facemap::program
