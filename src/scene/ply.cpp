#include "scene/ply.h"

#include <facemap/error.h>

#include <memory>
#include <utility>

#include "scene/model_folder.h"
#include "scene/obj_lines.h"
#include "scene/ply_body.h"
#include "scene/ply_faces.h"
#include "scene/ply_header.h"
#include "scene/ply_vertices.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

std::unique_ptr<PlyBody> make_body(std::string_view bytes, const PlyHeader& header, const std::string& name,
                                   ObjWarnings& warnings) {
  const std::string_view body = bytes.substr(header.size);
  if (header.format == PlyFormat::Text) return make_ply_text(body, header.lines + 1, name, warnings);
  return make_ply_binary(body, header.format == PlyFormat::BigEndian, name);
}

bool has_faces(const PlyElement* element) {
  return element != nullptr && element->count > 0 && PlyFaces::has_indices(*element);
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name, const std::filesystem::path& directory,
            const ModelLimits& limits)
      : bytes_(bytes), name_(name), directory_(directory), limits_(limits), warnings_(name) {}

  Model read() {
    header_ = read_ply_header(bytes_, name_, warnings_);
    const PlyElement* const vertices = header_.find("vertex");
    const PlyElement *const polygons = header_.find("face"), *const strips = header_.find("tristrips");
    if (vertices == nullptr || (!has_faces(polygons) && !has_faces(strips))) fail_faces();
    have_corners_coordinates_ = polygons != nullptr && polygons->find("texcoord") != kNoProperty;
    add_textures(*vertices);

    const std::unique_ptr<PlyBody> body = make_body(bytes_, header_, name_, warnings_);
    PlyFaces faces(model_, vertices->count, limits_, warnings_);
    const auto texture_count = static_cast<std::uint32_t>(model_.materials.size());
    for (const PlyElement& element : header_.elements) {
      if (&element == vertices) {
        read_ply_vertices(*body, element, have_corners_coordinates_, model_.mesh, warnings_);
      } else if (&element == polygons && has_faces(polygons)) {
        faces.read_polygons(*body, element, texture_count);
      } else if (&element == strips && has_faces(strips)) {
        faces.read_strips(*body, element, texture_count);
      } else {
        body->skip(element);
      }
    }
    if (model_.mesh.triangles.empty()) fail_faces();
    faces.finish();
    use_vertices_at_corners();
    warnings_.append_to(model_.warnings);
    return std::move(model_);
  }

 private:
  /// A material for each texture file, if anything says how the textures lie.
  void add_textures(const PlyElement& vertices) {
    if (header_.texture_files.empty()) return;
    const bool have_coordinates = have_corners_coordinates_ || has_texture_coordinates(vertices);
    if (!have_coordinates) {
      warnings_.add(0, "a texture without texture coordinates, ignored", header_.texture_files.front());
      return;
    }
    for (const std::string& file : header_.texture_files) {
      Material material;
      material.name = file;
      material.diffuse = Vector(1);
      const UriResult<std::filesystem::path> found = find_in_folder(directory_, file, limits_.allow_outside);
      if (found.value) {
        material.diffuse_map.image = static_cast<std::uint32_t>(model_.images.size());
        model_.images.push_back({file, *found.value, {}});
      } else {
        model_.warnings.push_back(name_ + ": texture \"" + printable(file) + "\": " + found.reason);
      }
      model_.materials.push_back(std::move(material));
    }
  }

  /// A corner has the normal and the texture coordinates of its vertex.
  void use_vertices_at_corners() {
    Mesh& mesh = model_.mesh;
    if (!mesh.normals.empty()) mesh.normal_corners = mesh.triangles;
    if (!mesh.texture_coordinates.empty() && !have_corners_coordinates_) mesh.texture_corners = mesh.triangles;
  }

  [[noreturn]] void fail_faces() const {
    const PlyElement* const vertices = header_.find("vertex");
    throw LoadError(Cause::NoFaces, name_, 0,
                    vertices == nullptr ? "no vertices" : "no faces: " + std::to_string(vertices->count) + " points");
  }

  std::string_view bytes_;
  const std::string& name_;
  const std::filesystem::path& directory_;
  const ModelLimits& limits_;
  ObjWarnings warnings_;
  PlyHeader header_;
  bool have_corners_coordinates_ = false;  ///< each of a face has its own, not its vertex's
  Model model_;
};

}  // namespace

Model read_ply(std::string_view bytes, const std::string& name, const std::filesystem::path& directory,
               const ModelLimits& limits) {
  if (bytes.size() > limits.max_bytes) {
    throw LoadError(Cause::TooLarge, name, 0, "more than " + std::to_string(limits.max_bytes) + " bytes");
  }
  return PlyReader(bytes, name, directory, limits).read();
}

}  // namespace facemap
