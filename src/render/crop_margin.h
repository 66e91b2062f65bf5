#pragma once

#include <facemap/renderer.h>

namespace facemap {

/// The pixels to be made so that those of a crop are as in the whole picture: filters, and what is taken for an edge,
/// look beyond a pixel.
PixelBox pixels_about_crop(const Renderer::Options& options);

/// The part `wanted` of an image of the pixels `made`.
Image cut(const Image& image, const PixelBox& made, const PixelBox& wanted);

}  // namespace facemap
