#pragma once

#include <facemap/camera.h>
#include <facemap/color.h>
#include <facemap/error.h>
#include <facemap/face.h>
#include <facemap/face_map.h>
#include <facemap/image.h>
#include <facemap/mesh.h>
#include <facemap/obj.h>
#include <facemap/point_light.h>
#include <facemap/projection.h>
#include <facemap/raster.h>
#include <facemap/renderer.h>
#include <facemap/scene.h>
#include <facemap/space_vector.h>
#include <facemap/surface_point.h>
#include <facemap/vector.h>
