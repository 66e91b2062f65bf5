#include "scene/gltf_nodes.h"

#include <algorithm>
#include <array>
#include <string>

namespace facemap {

namespace {

using Cause = LoadError::Cause;

DVector vector_of(const std::array<double, 3>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

/// Of sixteen numbers, column by column. A projection is not a place of an object.
Affine matrix_of(const GltfValue& node) {
  const auto m = node.numbers<16>("matrix", {});
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
    node.at("matrix").fail(Cause::BadValue, "its last row is not 0, 0, 0, 1");
  }
  return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

Affine local_transform(const GltfFile& file, const GltfValue& node) {
  if (node.find("matrix")) return matrix_of(node);
  const DVector translation = vector_of(node.numbers<3>("translation", {0, 0, 0}));
  const DVector scale = vector_of(node.numbers<3>("scale", {1, 1, 1}));
  const auto r = node.numbers<4>("rotation", {0, 0, 0, 1});
  if (r == std::array<double, 4>{}) file.warn(node, "a rotation by a quaternion of zero length: none");
  return compose(translation, rotation_of({r[0], r[1], r[2], r[3]}), scale);
}

/// The nodes as trees: each has one parent at most, and none is below itself.
class Forest {
 public:
  explicit Forest(const GltfFile& file)
      : file_(file), nodes_(file.root.elements("nodes")), children_(nodes_.size()), has_parent_(nodes_.size()) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) read_children(i);
    refuse_cycles();
  }

  /// In the order of the file, parents first.
  std::vector<GltfNode> list() const {
    std::vector<GltfNode> result;
    struct Step {
      std::uint32_t node;
      Affine parent;
    };
    std::vector<Step> steps;
    const std::vector<std::uint32_t> roots = scene_roots();
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) steps.push_back({*root, {}});
    while (!steps.empty()) {
      const Step step = steps.back();
      steps.pop_back();
      const Affine world = step.parent * local_transform(file_, nodes_[step.node]);
      result.push_back({step.node, nodes_[step.node], world});
      const std::vector<std::uint32_t>& children = children_[step.node];
      for (auto child = children.rbegin(); child != children.rend(); ++child) steps.push_back({*child, world});
    }
    return result;
  }

 private:
  void read_children(std::size_t node) {
    for (const GltfValue& child : nodes_[node].elements("children")) {
      const std::uint32_t index = child.as_index();
      file_.root.element("nodes", index, child);  // throws if there is none
      if (has_parent_[index]) child.fail(Cause::BadIndex, "node " + std::to_string(index) + " has two parents");
      has_parent_[index] = true;
      children_[node].push_back(index);
    }
  }

  /// Since no node has two parents, those that no root leads to are in or below a cycle.
  void refuse_cycles() const {
    std::vector<bool> is_reached(nodes_.size());
    std::vector<std::uint32_t> steps = roots();
    while (!steps.empty()) {
      const std::uint32_t node = steps.back();
      steps.pop_back();
      is_reached[node] = true;
      steps.insert(steps.end(), children_[node].begin(), children_[node].end());
    }
    const auto lost = std::find(is_reached.begin(), is_reached.end(), false);
    if (lost != is_reached.end()) nodes_[lost - is_reached.begin()].fail(Cause::BadIndex, "is its own ancestor");
  }

  std::vector<std::uint32_t> roots() const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (!has_parent_[i]) result.push_back(i);
    }
    return result;
  }

  std::vector<std::uint32_t> scene_roots() const {
    const std::optional<GltfValue> chosen = file_.root.find("scene");
    const std::size_t scene_count = file_.root.count("scenes");
    if (!chosen && scene_count == 0) return roots();
    if (scene_count > 1) file_.warnings.add(0, "one scene is read of", std::to_string(scene_count));
    const GltfValue scene = file_.root.element("scenes", chosen ? chosen->as_index() : 0, chosen.value_or(file_.root));
    std::vector<bool> is_named(nodes_.size());
    std::vector<std::uint32_t> result;
    for (const GltfValue& root : scene.elements("nodes")) {
      const std::uint32_t index = root.as_index();
      file_.root.element("nodes", index, root);
      if (has_parent_[index]) root.fail(Cause::BadIndex, "node " + std::to_string(index) + " is not a root");
      if (is_named[index]) root.fail(Cause::BadIndex, "node " + std::to_string(index) + " is named twice");
      is_named[index] = true;
      result.push_back(index);
    }
    return result;
  }

  const GltfFile& file_;
  std::vector<GltfValue> nodes_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<bool> has_parent_;
};

}  // namespace

Affine rotation_of(const double (&quaternion)[4]) {
  const double largest = std::max(
      {std::fabs(quaternion[0]), std::fabs(quaternion[1]), std::fabs(quaternion[2]), std::fabs(quaternion[3])});
  if (!(largest > 0 && largest - largest == 0)) return {};
  const double x = quaternion[0] / largest, y = quaternion[1] / largest, z = quaternion[2] / largest,
               w = quaternion[3] / largest;
  const double s = 2 / (x * x + y * y + z * z + w * w);  // a file's decimals are never quite of unit length
  return {{1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)},
          {s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w)},
          {s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y)},
          DVector(0)};
}

Affine compose(const DVector& translation, const Affine& rotation, const DVector& scale) {
  return {rotation.x * scale.x, rotation.y * scale.y, rotation.z * scale.z, translation};
}

std::vector<GltfNode> list_gltf_nodes(const GltfFile& file) { return Forest(file).list(); }

}  // namespace facemap
