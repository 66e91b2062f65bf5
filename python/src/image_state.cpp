#include "image_state.h"

#include "pickling.h"

namespace facemap::python {
namespace {

/// Hands every array of a picture to `visit`, and how many elements belong to a pixel.
template <typename AnyImage, typename Visit>
void for_each_array(AnyImage& image, const Visit& visit) {
  visit(image.pixels, 1);
  visit(image.ids, 1);
  visit(image.depths, 1);
  visit(image.zs, 1);
  visit(image.positions, 1);
  visit(image.normals, 1);
  visit(image.face_normals, 1);
  visit(image.albedos, 1);
  visit(image.uvs, 1);
  visit(image.objects, 1);
  visit(image.materials, 1);
  visit(image.lights, image.light_bytes());
  visit(image.shadows, 1);
}

}  // namespace

py::tuple state_of(const Image& image) {
  py::list arrays;
  for_each_array(image, [&](const auto& array, int) { arrays.append(bytes_of(array)); });
  return py::make_tuple(image.width, image.height, image.light_count, py::tuple(arrays));
}

std::shared_ptr<Image> image_from(const py::tuple& state) {
  if (state.size() != 4) throw py::value_error("a frame's state is of another version");
  auto image = std::make_shared<Image>();
  image->width = state[0].cast<int>();
  image->height = state[1].cast<int>();
  image->light_count = state[2].cast<int>();
  if (image->width < 0 || image->height < 0 || image->light_count < 0) {
    throw py::value_error("a frame's state has a size below 0");
  }
  const py::tuple arrays = state[3];
  const auto pixels = static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height);
  std::size_t next = 0;
  for_each_array(*image, [&](auto& array, int elements) {
    if (next == arrays.size()) throw py::value_error("a frame's state is of another version");
    array = rows_from<typename std::decay_t<decltype(array)>::value_type>(arrays[next++]);
    const std::size_t whole = pixels * static_cast<std::size_t>(elements);
    if (array.size() != whole && (!array.empty() || next == 1)) throw py::value_error("a frame's state has lost bytes");
  });
  return image;
}

}  // namespace facemap::python
