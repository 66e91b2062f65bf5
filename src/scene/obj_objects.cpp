#include "scene/obj_objects.h"

namespace facemap {

void ObjObjects::Names::begin(std::string_view name, std::size_t first) {
  auto found = numbers.find(name);
  if (found == numbers.end()) {
    found = numbers.emplace(std::string(name), static_cast<std::uint32_t>(names.size())).first;
    names.emplace_back(name);
  }
  if (!runs.empty() && runs.back().first_triangle == first) runs.pop_back();
  if (runs.empty() || runs.back().object != found->second) runs.push_back({first, found->second});
}

void ObjObjects::take(std::vector<std::string>& names, std::vector<ObjectRun>& runs) {
  Names& from = objects_.names.empty() ? groups_ : objects_;
  names = std::move(from.names);
  runs = std::move(from.runs);
}

}  // namespace facemap
