#pragma once

#include <facemap/projection.h>
#include <facemap/scene.h>
#include <facemap/space_vector.h>

#include <vector>

#include "map/face_planes.h"
#include "map/texel_entry.h"

namespace facemap {

/// The exact builder: every texel that a face touches, never one too few.
///
/// Why it is a superset. A query direction D is handed to the map with an angular error of at most
/// kDirectionError; its computed map point, but for the rounding of coordinates (2^-39 texels), is the exact image
/// of a direction at most Projection::kMapError farther. Both inverse projections never lengthen a path, so that
/// direction lies within texel_angle sqrt(2)/2 of the texel's centre direction c, and D within block_cap_radius()
/// of it. A texel is kept unless no direction of that cap hits the face (Cone::may_meet). Blocks of texels are the
/// same with a larger cap.
///
/// On a plane projection nothing is curved on the map either. A face well in front of it is the triangle of its
/// corners' images there (PlaneFace): its texels are those whose square, grown by the error of map points, the triangle
/// meets.
struct Coverage {
  std::vector<TexelEntry> entries;  ///< each texel and face once, in no order
  std::vector<float> cuts;  ///< a texel: upper bound (map units) of the distance of a face that covers all of its cap
};

/// What a face is added to: the cuts of texels, the entries (of which those hidden behind a cut are left out), or both,
/// for faces that come front to back.
enum class Pass { Cuts, Entries, Both };

/// Texels by which the last step of the projection, adding the centre, may round a map point: half a unit in the last
/// place of a coordinate below 2^15, 2^-39 in x and y, and room for the sums made of it. It is an angle of its own:
/// where rasters are very oblong or a plane's field is near 180 degrees, a texel spans radians.
inline constexpr double kCoordinateRounding = 0x1p-36;

/// Faces that begin beyond a texel's cut are left out of it as they come, unless `keep_all`; cuts are empty then.
Coverage cover_faces(const Scene& scene, const SpaceVector& frame, const Projection& projection,
                     const FacePlanesTable& planes, bool keep_all);

/// Angular radius of the cap that holds every direction whose computed map point lies in a block of
/// `side_texels` squared texels, seen from the block's centre direction.
double block_cap_radius(const Projection& projection, double side_texels);

/// Largest distance, in radians of the map's scale, between the image of a great-circle edge of `angle` radians
/// and the straight line between its ends' images, for an edge within `beta` (< pi) of the axis.
double bulge(double angle, double beta);

}  // namespace facemap
