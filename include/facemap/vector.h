#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace facemap {

/// A point or direction in world space. Wang 2022, sec. 4.3: the Vector class. Its components are the
/// exact inputs of every predicate: no answer depends on anything but these float32 values.
using Vector = glm::vec3;

/// The same in double precision: for frames, map coordinates and bounds, never the input of an answer.
using DVector = glm::dvec3;

/// A point of a map or image: x to the right, y downwards, pixel (i, j) has its centre at (i + 0.5, j + 0.5).
using MapPoint = glm::dvec2;

}  // namespace facemap
