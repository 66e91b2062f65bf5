#include "scene/read_model.h"

#include <facemap/error.h>

#include "scene/gltf.h"
#include "scene/ply.h"
#include "scene/stl.h"

namespace facemap {

Model read_model(ModelFormat format, std::string_view bytes, const std::string& name,
                 const std::filesystem::path& directory, const ModelLimits& limits) {
  switch (format) {
    case ModelFormat::Ply:
      return read_ply(bytes, name, directory, limits);
    case ModelFormat::StlText:
    case ModelFormat::StlBinary:
      return read_stl(bytes, name, limits);
    case ModelFormat::GltfJson:
    case ModelFormat::GltfBinary:
      return read_gltf(bytes, name, directory, limits);
    case ModelFormat::Obj:
    case ModelFormat::Unknown:
      break;
  }
  throw LoadError(LoadError::Cause::UnknownFormat, name, 0, std::string("unknown format; known: ") + kKnownFormats);
}

}  // namespace facemap
