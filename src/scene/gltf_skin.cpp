#include "scene/gltf_skin.h"

#include <string>

namespace facemap {

namespace {

using Cause = LoadError::Cause;

Affine matrix_at(const GltfAccessor& matrices, std::uint32_t i) {
  const auto column = [&](int c) {
    return DVector(matrices.number(i, 4 * c), matrices.number(i, 4 * c + 1), matrices.number(i, 4 * c + 2));
  };
  return {column(0), column(1), column(2), column(3)};
}

void add_weighted(Affine& sum, const Affine& term, double weight) {
  sum.x += weight * term.x;
  sum.y += weight * term.y;
  sum.z += weight * term.z;
  sum.origin += weight * term.origin;
}

/// The mean of the joints by their weights, which need not add up to 1; `otherwise` if there are none.
Affine blend(const GltfSurface::Joints& hold, const std::vector<Affine>& joints, const Affine& otherwise,
             const GltfValue& node) {
  double total = 0;
  for (const float weight : hold.weights) total += weight > 0 ? double{weight} : 0.0;
  if (!(total > 0)) return otherwise;
  Affine mean = {DVector(0), DVector(0), DVector(0), DVector(0)};
  for (std::size_t k = 0; k < hold.joints.size(); ++k) {
    if (!(hold.weights[k] > 0)) continue;
    if (hold.joints[k] >= joints.size()) {
      node.fail(Cause::BadIndex, "a vertex of its mesh hangs on joint " + std::to_string(hold.joints[k]) + " of " +
                                     std::to_string(joints.size()));
    }
    add_weighted(mean, joints[hold.joints[k]], hold.weights[k] / total);
  }
  return mean;
}

}  // namespace

GltfSkins::GltfSkins(const GltfFile& file, GltfAccessors& accessors, const std::vector<GltfNode>& nodes)
    : file_(file), accessors_(accessors) {
  for (const GltfNode& node : nodes) worlds_.emplace(node.index, node.world);
}

GltfSurface GltfSkins::pose(const GltfNode& node, const GltfSurface& surface) {
  const std::vector<Affine>& joint_transforms = joints(node);
  GltfSurface posed = surface;
  bool is_mirrored = false;
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    const Affine transform = blend(surface.joints[i], joint_transforms, node.world, node.value);
    posed.positions[i] = transform.point(surface.positions[i]);
    if (i == 0) is_mirrored = transform.is_mirrored();
    if (surface.normals.empty()) continue;
    posed.normals[i] = Vector(unit_or_zero(transform.of_normals().direction(DVector(surface.normals[i]))));
  }
  if (is_mirrored) {
    for (Corners& triangle : posed.triangles) triangle = {triangle[0], triangle[2], triangle[1]};
  }
  return posed;
}

const std::vector<Affine>& GltfSkins::joints(const GltfNode& node) {
  const GltfValue index = node.value.at("skin");
  const auto known = joints_.find(index.as_index());
  if (known != joints_.end()) return known->second;
  return joints_[index.as_index()] = read(node, file_.root.element("skins", index.as_index(), index));
}

/// A joint of another scene has no place: what hangs on it stays where the node is.
std::vector<Affine> GltfSkins::read(const GltfNode& node, const GltfValue& skin) const {
  const std::vector<GltfValue> joints = skin.elements("joints");
  const GltfAccessor* matrices = nullptr;
  if (const auto index = skin.find("inverseBindMatrices")) {
    matrices = &accessors_.open(index->as_index(), *index);
    if (matrices->components() != 16 || matrices->count() < joints.size()) {
      index->fail(Cause::BadValue, "are not a matrix for each of " + std::to_string(joints.size()) + " joints");
    }
  }
  std::vector<Affine> result;
  for (std::uint32_t i = 0; i < joints.size(); ++i) {
    const std::uint32_t joint = joints[i].as_index();
    file_.root.element("nodes", joint, joints[i]);  // throws if there is none
    const auto world = worlds_.find(joint);
    if (world == worlds_.end()) {
      file_.warn(skin, "a joint is not in the scene");
      result.push_back(node.world);
    } else {
      result.push_back(matrices == nullptr ? world->second : world->second * matrix_at(*matrices, i));
    }
  }
  return result;
}

}  // namespace facemap
