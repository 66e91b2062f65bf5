#pragma once

#include <facemap/color.h>
#include <facemap/image.h>
#include <facemap/renderer.h>
#include <facemap/scene.h>

#include <vector>

namespace facemap {

/// Settings of the raster method.
struct RasterOptions {
  int width = 1024;                            ///< pixels
  int height = 1024;                           ///< pixels
  int edge_samples = 1;                        ///< a side of the grid in an edge pixel, 1..16; 1: no up-sampling
  double near_plane = 0;                       ///< world units along the sight; 0: 2^-20 of the far plane's distance
  double far_plane = 0;                        ///< world units along the sight; 0: just behind the farthest vertex
  Color background{0, 0, 0};                   ///< linear RGB
  bool want_ids = false, want_depths = false;  ///< planes to fill: those of the ray through the pixel's centre
};

/// The picture of the raster method, without a FaceMap: matrices, scan lines and a depth buffer.
/// Wang 2022, sec. 2: eq. (1) to (3), Alg. 1, Fig. 3. Plane projection alone. White mode, flat normals; radiance is the
/// sum over lights of colour * intensity * cos, and there are no shadows: the method has none. Without a light the
/// camera carries one of colour 1.
///
/// An edge pixel is one whose right, left, upper or lower neighbour shows another face; its colour is the mean over a
/// grid of edge_samples x edge_samples. Rounded, not exact: it agrees with a Camera but for pixels at edges and for
/// faces at equal depth, of which the lower id is shown. What is nearer than the near plane is clipped off.
///
/// Throws Error if the view's projection is not Plane, its axes cannot be made, or a size, an angle or an option is
/// out of range.
Image render_raster(const Scene& scene, const View& view, const std::vector<Light>& lights,
                    const RasterOptions& options);

}  // namespace facemap
