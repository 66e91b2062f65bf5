#include "picture/face_texels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "math/dvector.h"
#include "math/exact_sign.h"
#include "picture/gnomonic.h"
#include "simd/shadow_faces.h"
#include "support/random.h"
#include "support/scenes.h"

namespace facemap {
namespace {

// Faces in planes through the light, or next to one: the side is the exact one or not known.
TEST(FaceTexels, NeverMistakeASide) {
  constexpr std::uint64_t kSeed = 0x5eed007a;
  std::printf("seed 0x%llx\n", (unsigned long long)kSeed);
  Random random(kSeed);
  std::size_t known = 0, unknown = 0;
  for (int round = 0; round < 20000; ++round) {
    const DVector a = random.in_cube(), b = random.in_cube(), c = random.in_cube();
    const DVector along = normalized(random.unit() * (b - a) + random.between(-1.0, 1.0) * (c - a));
    const DVector off = std::exp2(random.between(-30.0, -10.0)) * DVector(random.direction());
    const Vector light((a + b + c) / 3.0 + random.between(4.0, 20.0) * along + off);
    Mesh mesh;
    test_scenes::add_triangle(mesh, Vector(a), Vector(b), Vector(c));
    const OffsetBox box{DVector(-1) - DVector(light), DVector(1) - DVector(light)};
    const auto frame = frame_towards(light, box, 0);
    if (!frame) continue;
    std::vector<float> places(3 * (mesh.positions.size() + 16));
    simd::project_vertices(*frame, &mesh.positions[0].x, mesh.positions.size(), places.data());
    const int found = FaceTexels(&places[0], &places[3], &places[6], 64).side();
    ++(found == 0 ? unknown : known);
    if (found != 0) {
      const Triangle triangle{mesh.positions[0], mesh.positions[1], mesh.positions[2]};
      ASSERT_EQ(found, side(triangle, light)) << round;
    }
  }
  EXPECT_GT(known, 1000u);
  EXPECT_GT(unknown, 1000u);
}

// A face's texels hold all of it, and its w there is within the bounds.
TEST(FaceTexels, HoldTheFace) {
  constexpr std::uint64_t kSeed = 0x5eed0078;
  std::printf("seed 0x%llx\n", (unsigned long long)kSeed);
  Random random(kSeed);
  for (int round = 0; round < 3000; ++round) {
    const int size = 1 << random.between(2, 7);
    const double extent = std::exp2(random.between(-7.0, 0.0));
    const DVector middle(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(0.4, 1.0));
    float corners[3][3];
    for (auto& corner : corners) {
      const DVector place = middle + extent * DVector(random.direction());
      for (int axis = 0; axis < 3; ++axis) corner[axis] = static_cast<float>(place[axis]);
      corner[2] = std::max(corner[2], 0.01f);
      corner[0] = std::clamp(corner[0], -1.2f, 1.2f);
      corner[1] = std::clamp(corner[1], -1.2f, 1.2f);
    }
    const FaceTexels face(corners[0], corners[1], corners[2], size);
    std::vector<FaceTexels::Piece> pieces(static_cast<std::size_t>(size * size), {0, 1, 0, false});
    face.for_each([&](const FaceTexels::Piece& piece) { pieces[piece.texel] = piece; });
    for (int k = 0; k < 200; ++k) {
      double s = random.between(0.0, 1.0), t = random.between(0.0, 1.0);
      if (s + t > 1) s = 1 - s, t = 1 - t;
      double place[3];
      for (int axis = 0; axis < 3; ++axis) {
        place[axis] = (1 - s - t) * corners[0][axis] + s * corners[1][axis] + t * corners[2][axis];
      }
      if (std::fabs(place[0]) > 1 || std::fabs(place[1]) > 1) continue;
      const int column = texel_of(static_cast<float>(place[0]), size),
                row = texel_of(static_cast<float>(place[1]), size);
      const FaceTexels::Piece& piece = pieces[static_cast<std::size_t>(row * size + column)];
      ASSERT_LE(piece.least, place[2]) << round;
      ASSERT_GE(piece.greatest, place[2]) << round;
    }
  }
}

}  // namespace
}  // namespace facemap
