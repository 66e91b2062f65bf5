#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace facemap {

/// The objects of an OBJ file: what its `o` statements name, or, in a file without any, its `g` statements. Triangles
/// under the same name are of the same object.
class ObjObjects {
 public:
  /// For the triangles from `first` on; calls ascend.
  void begin_object(std::string_view name, std::size_t first) { objects_.begin(name, first); }
  void begin_group(std::string_view name, std::size_t first) { groups_.begin(name, first); }

  /// Gives them away.
  void take(std::vector<std::string>& names, std::vector<ObjectRun>& runs);

 private:
  /// Names in the order of their first use, and where each begins.
  struct Names {
    std::vector<std::string> names;
    std::map<std::string, std::uint32_t, std::less<>> numbers;
    std::vector<ObjectRun> runs;

    void begin(std::string_view name, std::size_t first);
  };

  Names objects_, groups_;
};

}  // namespace facemap
