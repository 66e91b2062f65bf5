#pragma once

#include <facemap/mesh.h>
#include <facemap/vector.h>

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace facemap {

/// A scene made by a program: a mesh, a view of it and eight point lights. Wang 2022, table 1, compares four
/// models by name and number of faces; these are models of the same names and numbers, of our own making.
/// World: right-handed, +y up; the same bits on every machine and compiler.
struct GeneratedScene {
  struct Light {
    Vector position;
    Vector color;         ///< linear RGB in 0..1
    float intensity = 1;  ///< multiplies the color; the light does not fall off with distance
  };

  /// A named run of triangles, from first_face up to the next part's.
  struct Part {
    std::string name;
    std::size_t first_face = 0;
  };

  Mesh mesh;                                   ///< positions and triangles alone; counter-clockwise seen from outside
  std::vector<std::uint8_t> smoothing_groups;  ///< one a triangle, as in an OBJ file; 0: flat
  std::vector<Part> parts;                     ///< in order of first_face, the first of them 0
  Vector camera_position{0};
  Vector look_at{0};
  Vector up{0, 1, 0};
  float field_angle_deg = 45;
  std::vector<Light> lights;
};

/// The names generate_scene knows: chessboard, grass, bust, typewriter.
std::vector<std::string> generator_names();

/// Makes the scene called `name`. At detail 1 it has the number of triangles of Wang 2022, table 1: chessboard
/// 123,314, grass 86,864, bust 44,590, typewriter 145,558. Every tessellation parameter grows in proportion to
/// `detail`, the faces about with its square: the chessboard passes 1 million faces at 4 and 10 million at 11,
/// grass at 4 and at 11. The bust takes about half a second times that square, the others a few
/// milliseconds. Throws Error if the name is unknown or detail is not in 1..kMaxSceneDetail.
GeneratedScene generate_scene(std::string_view name, int detail = 1);

/// The largest detail: the biggest scene stays below 100 million faces.
inline constexpr int kMaxSceneDetail = 24;

/// The scene's view as flags of the program, light colors already multiplied by the intensity:
/// --camera x,y,z --look-at x,y,z --up x,y,z --field-angle DEG --light x,y,z,r,g,b (once a light).
/// Numbers are the shortest that read back as the same float32.
std::string view_flags(const GeneratedScene& scene);

/// Writes the mesh as OBJ text: `o` a part, `s` a smoothing group, positions that read back as the same float32.
/// A comment before it, `# facemap render FILE_NAME FLAGS`, is the command that shows the scene as meant.
/// Throws Error if writing fails.
void write_obj(std::ostream& out, const GeneratedScene& scene, std::string_view file_name);

/// The same into a file, which is replaced. Throws Error if it cannot be written.
void write_obj(const std::filesystem::path& path, const GeneratedScene& scene);

}  // namespace facemap
