#pragma once

#include <cstdint>

#include "simd/light_source.h"
#include "simd/shade_faces.h"

/// Shader::shade (render/shade.h) for a batch of points: the same operations in the same order, so the same bits.
namespace facemap::simd {

struct ShadedPoints {
  double weights[3][kSeenBatch];   ///< of the corners
  double position[3][kSeenBatch];  ///< of the true point, rounded
  double normal[3][kSeenBatch];    ///< unit
  double moved[3][kSeenBatch];     ///< lifted position, to be rounded to float32
  std::int32_t lift[kSeenBatch];   ///< a Lift
  double radiance[3][kSeenBatch];
};

enum Lift : std::int32_t {
  kNoLift = 0,
  kLifted = 1,
  kUnsureLift = 2,  ///< lifted if, exactly, the point rounded to float32 is on the camera's side of its face
};

/// Fills weights, position and normal. `K`: the camera. `rays` need their slots and directions.
void find_surfaces(const PlaneBatch& planes, const ShadedFaces& faces, const RayBatch& rays, const float K[3],
                   bool smooth, ShadedPoints& points);

/// After find_surfaces, for faces with normals: fills moved and lift. `least_lift` is relative to a face's largest
/// coordinate. Returns whether any point may be lifted.
bool find_lifts(const PlaneBatch& planes, const ShadedFaces& faces, const RayBatch& rays, double least_lift,
                ShadedPoints& points);

/// After find_surfaces: fills normal with smooth ones, as find_surfaces does if asked for them.
void find_smooth_normals(const ShadedFaces& faces, const RayBatch& rays, ShadedPoints& points);

/// Bit l of bits[i]: lights[l], of at most 8, is in front of the point's shading normal, so that add_lights may add
/// something.
void find_lights_before(const LightSource* lights, int light_count, std::size_t count, const ShadedPoints& points,
                        std::int64_t* bits);

/// Bit l of bits[i]: the point is within the cone and the range of lights[l], of at most 8.
void find_lights_reaching(const LightSource* lights, int light_count, std::size_t count, const ShadedPoints& points,
                          std::int64_t* bits);

/// Adds to radiance what lights[0..light_count), at most 8, send to the points: light l where bit l of lit[i] is set.
void add_lights(const LightSource* lights, int light_count, const std::int64_t* lit, std::size_t count,
                ShadedPoints& points);

}  // namespace facemap::simd
