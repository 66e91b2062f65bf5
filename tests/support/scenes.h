#pragma once

#include <facemap/light.h>
#include <facemap/mesh.h>

#include <string>

#include "support/random.h"

/// Small scenes that are hard to answer exactly, and points in awkward places to look at them from.
namespace test_scenes {

using facemap::Mesh;
using facemap::Vector;

struct TestScene {
  std::string name;
  Mesh mesh;
  Vector centre{0};
  double radius = 1;   ///< world units: about how far the scene reaches from its centre
  double lattice = 0;  ///< world units: all coordinates, less the centre's, are multiples of it; 0: no lattice
};

enum class Kind {
  Soup,      ///< random triangles of all sizes
  Patch,     ///< a rough height field: shared edges and vertices
  Slivers,   ///< triangles 2^-6 to 2^-20 times as wide as they are long, many sharing an edge
  Lattice,   ///< random triangles with small integer corners: exact ties abound
  Coplanar,  ///< overlapping triangles in few planes, duplicates and folds
  Boxes,     ///< axis-parallel boxes with integer corners that touch each other
  Ball,      ///< a convex closed mesh
  Shell,     ///< few large faces around the centre: around the axis and across the antipode of what looks from there
  Fan,       ///< all faces share one vertex, in a plane or a cone
  Wild,      ///< from the least floats to the greatest in one scene
};
inline constexpr int kKindCount = 10;

/// About `face_count` faces.
TestScene make_scene(Kind kind, int face_count, Random& random);

/// Random kind, size and placement: as made, times 2^-40 or 2^40, or 1e6 from the world's origin.
TestScene make_any_scene(Random& random, int largest_face_count);

/// Makes a light that has a place a spot, a directional light or one with a range or falloff.
void make_any_kind(const TestScene& scene, Random& random, facemap::Light& light);

/// A copy of the mesh with each coordinate times `factor`, a power of two.
Mesh scaled(const Mesh& mesh, float factor);

/// Where a camera or a light stands: near, far, among the faces, on a vertex, on an edge, on a face's plane.
Vector make_origin(const TestScene& scene, Random& random);

/// A closed sphere of `stacks` x `slices` quads (triangles at the poles), every face turned outwards.
Mesh uv_sphere(int slices, int stacks, const facemap::DVector& centre, double radius);

/// A closed, strictly convex sphere: an icosahedron, its faces split in four `splits` times; turned outwards.
Mesh geodesic_sphere(int splits, const facemap::DVector& centre, double radius);

/// A closed axis-parallel box, every face turned outwards.
Mesh box(const Vector& lower, const Vector& upper);

/// Two meshes as one.
Mesh joined(const Mesh& a, const Mesh& b);

/// Adds one triangle with corners of its own.
void add_triangle(Mesh& mesh, const Vector& a, const Vector& b, const Vector& c);

}  // namespace test_scenes
