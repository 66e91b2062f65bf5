#pragma once

#include <facemap/mesh.h>

#include "scene/obj_warnings.h"
#include "scene/ply_body.h"

namespace facemap {

/// Whether the element "vertex" has texture coordinates.
bool has_texture_coordinates(const PlyElement& element);

/// Reads the rows of element "vertex" into positions, normals, texture coordinates and colours of `mesh`, one of each
/// a row; those that the element does not have stay empty. Texture coordinates are left out if corners have their own.
/// Throws LoadError.
void read_ply_vertices(PlyBody& body, const PlyElement& element, bool have_corners_coordinates, Mesh& mesh,
                       ObjWarnings& warnings);

}  // namespace facemap
