#pragma once

#include <facemap/point_light.h>
#include <facemap/surface_point.h>

#include <filesystem>
#include <string>

#include "support/oracle.h"
#include "support/scenes.h"

/// Questions to maps that sit on the fence: aimed at vertices, edges and planes, at most 2 ulp off.
namespace test_queries {

using facemap::FaceId;
using facemap::PointLight;
using facemap::SurfacePoint;
using facemap::Vector;

struct CameraQuery {
  Vector direction{0};
  bool is_aimed = false;  ///< at a vertex, an edge or a plane
};

CameraQuery make_camera_query(const test_scenes::TestScene& scene, const Vector& camera, Random& random);

struct LightQuery {
  bool is_seen = false;  ///< a camera's true point, else a given one
  SurfacePoint seen;
  Vector given{0};
  PointLight::On on;
  bool is_aimed = false;
};

/// `view` is the camera's, from which a seen point is seen; `light` is to be asked.
LightQuery make_light_query(const test_scenes::TestScene& scene, const oracle::Oracle& oracle, const oracle::View& view,
                            const Vector& light, Random& random);

/// For a failed test: hexadecimal floats, so that nothing is lost.
std::string text(const Vector& v);
std::string text(const LightQuery& query);

/// Writes the mesh as OBJ beside a text file that holds `query`, into the folder for temporary files; says where.
std::string write_failure(const facemap::Mesh& mesh, const std::string& query);

}  // namespace test_queries
