#include "render/screen_transform.h"

#include "math/elementary.h"

namespace facemap {
namespace {

glm::dmat4 from_rows(const glm::dvec4& r0, const glm::dvec4& r1, const glm::dvec4& r2, const glm::dvec4& r3) {
  return glm::transpose(glm::dmat4(r0, r1, r2, r3));
}

}  // namespace

glm::dmat4 perspective_matrix(double field_angle, double aspect, double near, double far) {
  // Departs: eq. (1) prints cot(theta) and calls theta the viewing angle. The picture's upper edge is seen at half
  // of that from the sight, so it is the cotangent of the half angle; with cot(theta) 90 degrees would give 0.
  const double cot = 1 / elementary::tan(field_angle / 2);
  const double f = far, n = near;
  return from_rows({cot / aspect, 0, 0, 0},  //
                   {0, cot, 0, 0},           //
                   {0, 0, f / (f - n), 1},   //
                   {0, 0, f * n / (n - f), 0});
}

glm::dmat4 screen_matrix(int width, int height) {
  const double w = width, h = height;
  return from_rows({w / 2, 0, 0, 0},   //
                   {0, -h / 2, 0, 0},  //
                   {0, 0, 1, 0},       //
                   {w / 2, h / 2, 0, 1});
}

DVector screen_from_local(const DVector& local, const glm::dmat4& MS) {
  const glm::dvec4 p = glm::dvec4(local, 1) * MS;
  return DVector(p) / p.w;
}

double sight_distance(double depth, double near, double far) { return near / (1 - depth * (far - near) / far); }

}  // namespace facemap
