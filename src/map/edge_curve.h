#pragma once

#include <facemap/projection.h>

#include <vector>

namespace facemap {

/// A point of an edge, in local axes, and its map point.
struct CurvePoint {
  DVector local;
  MapPoint map;
};

/// Appends the map points of the edge from a to b, neighbours at most a pixel apart: a's own first, b's not (it is
/// the first of the next edge), so that the edges of a face one after the other give its closed curve.
/// Wang 2022, Alg. 2.
///
/// Both ends must be mapped (Projection::is_mapped), and so must all between them. Away from the raster neighbours
/// may be as far apart as half their distance to it. Across the antipode of a 360 degree map an edge has no curve:
/// its two sides end on opposite points of the rim, and those stay neighbours.
void append_edge_curve(const CurvePoint& a, const CurvePoint& b, const Projection& projection,
                       std::vector<MapPoint>& curve);

}  // namespace facemap
