#pragma once

#include <functional>
#include <vector>

#include "scene/generators/solids.h"

namespace facemap::generators {

/// Shapes as fields: the value at a point is about the distance to the surface, negative inside. Blends and
/// ellipsoids make it an estimate; wrap() asks only for its sign and for steps that do not leap too far.
using Field = std::function<double(const DVector&)>;

double ball(const DVector& p, const DVector& centre, double radius);
double ellipsoid(const DVector& p, const DVector& centre, const DVector& radii);

/// The hull of two balls, roughly: a capsule whose radius runs from one to the other.
double limb(const DVector& p, const DVector& a, double radius_a, const DVector& b, double radius_b);

/// Union, intersection and difference with seams rounded over a width `k`.
double joined(double a, double b, double k);
double common(double a, double b, double k);
double carved(double a, double tool, double k);

/// A row of the net laid over a sculpture: rays leave (0, y, z) all around. They rise above the level by `front_deg`
/// towards +z and by `back_deg` to the sides and behind.
struct NetRow {
  double y, z, front_deg, back_deg;
};

/// The turn of each column of the net about the vertical, from 0 (towards +z) counter-clockwise seen from above.
using NetColumns = std::vector<double>;

/// A closed net of rows.size() loops and two poles (above the first row and below the last) on the surface of
/// `field`: each point is where its ray first leaves the inside. 2 * rows * columns faces in smoothing group 1.
Solid wrap(const Field& field, const std::vector<NetRow>& rows, const NetColumns& columns);

}  // namespace facemap::generators
