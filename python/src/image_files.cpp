#include <facemap/image.h>
#include <facemap/image_file.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <string_view>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "image_state.h"
#include "pickling.h"

namespace facemap::python {
namespace {

using Bytes = std::vector<std::uint8_t>;
using SharedImage = std::shared_ptr<Image>;

py::bytes text_of(const Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// Encodes without the interpreter's lock.
template <typename Encode>
py::bytes encoded(const Encode& encode) {
  Bytes bytes;
  call([&] { bytes = encode(); });
  return text_of(bytes);
}

Plane plane_of(const std::string& name) {
  const std::optional<Plane> plane = plane_named(name);
  if (!plane) throw py::value_error("there is no plane " + name);
  return *plane;
}

/// What a plane holds, as an array of the picture's rows; `owner` is the image.
py::array array_of(const PlaneView& plane, const py::handle& owner) {
  std::vector<py::ssize_t> shape = {plane.height, plane.width};
  if (plane.channels != 1) shape.push_back(plane.channels);
  return std::visit([&](const auto& values) { return borrowed(values.data(), shape, owner); }, plane.values);
}

py::array color(const py::object& self) { return array_of(color_plane(self.cast<const Image&>()), self); }

py::array plane(const py::object& self, const std::string& name) {
  return array_of(plane_view(self.cast<const Image&>(), plane_of(name)), self);
}

py::array light_bits(const py::object& self) {
  const Image& image = self.cast<const Image&>();
  return borrowed(image.lights.data(), {image.height, image.width, image.light_bytes()}, self);
}

py::array_t<std::uint8_t> levels(const Image& image, const DisplayTransform& display) {
  Bytes bytes;
  call([&] { bytes = levels_8(display.keeps_light() ? image : displayed(image, display), display.transfer); });
  py::array_t<std::uint8_t> array({py::ssize_t{image.height}, py::ssize_t{image.width}, py::ssize_t{3}});
  std::copy(bytes.begin(), bytes.end(), array.mutable_data());
  return array;
}

py::bytes png_16(const Image& image, const DisplayTransform& display, int threads) {
  return encoded([&] {
    const auto deep =
        levels_16(display.keeps_light() ? image : displayed(image, display, threads), display.transfer, threads);
    return encode_png_16({image.width, image.height, 3, std::span(deep)}, display.transfer, threads);
  });
}

py::bytes jpeg(const Image& image, const DisplayTransform& display, int quality, int threads) {
  return encoded([&] {
    const Bytes bytes = levels_8(display.keeps_light() ? image : displayed(image, display, threads));
    return encode_jpeg({image.width, image.height, 3, std::span(bytes)}, quality);
  });
}

py::bytes exr(const Image& image, bool is_half, const std::vector<std::string>& planes, int threads) {
  PlaneSet wanted;
  for (const std::string& name : planes) wanted.add(plane_of(name));
  return encoded([&] {
    std::vector<ExrLayers> layers = {
        color_layers(image, is_half ? ExrLayers::Storage::Half : ExrLayers::Storage::Exact)};
    for (const Plane each : all_planes()) {
      if (wanted.has(each)) layers.push_back(plane_layers(image, each));
    }
    return encode_exr(layers, threads);
  });
}

py::bytes plane_exr(const Image& image, const std::string& name, int threads) {
  const ExrLayers layers[] = {plane_layers(image, plane_of(name))};
  return encoded([&] { return encode_exr(layers, threads); });
}

SharedImage image_of_size(const py::array& rows) {
  if (rows.ndim() != 3 || rows.shape(2) != 3) throw py::value_error("an array of shape (height, width, 3) is needed");
  auto image = std::make_shared<Image>();
  image->height = static_cast<int>(rows.shape(0));
  image->width = static_cast<int>(rows.shape(1));
  image->pixels.resize(static_cast<std::size_t>(rows.shape(0) * rows.shape(1)));
  return image;
}

/// Linear light.
SharedImage image_from_light(const Rows<float>& light) {
  SharedImage image = image_of_size(light);
  const float* rgb = light.data();
  for (Color& pixel : image->pixels) {
    pixel = {rgb[0], rgb[1], rgb[2]};
    rgb += 3;
  }
  return image;
}

/// Levels of sRGB; a PNG of the image has them again.
SharedImage image_from_levels(const Rows<std::uint8_t>& given_levels) {
  SharedImage image = image_of_size(given_levels);
  const std::uint8_t* rgb = given_levels.data();
  for (Color& pixel : image->pixels) {
    pixel = Color::from_24_bit(std::uint32_t{rgb[0]} << 16 | std::uint32_t{rgb[1]} << 8 | rgb[2]);
    rgb += 3;
  }
  return image;
}

}  // namespace

void bind_image_files(py::module_& module) {
  py::enum_<DisplayTransform::Curve>(module, "Curve")
      .value("none", DisplayTransform::Curve::None)
      .value("filmic", DisplayTransform::Curve::Filmic);
  py::enum_<Transfer>(module, "Transfer").value("srgb", Transfer::Srgb).value("linear", Transfer::Linear);
  py::class_<DisplayTransform>(module, "Display")
      .def(py::init<>())
      .def_readwrite("exposure", &DisplayTransform::exposure)
      .def_readwrite("curve", &DisplayTransform::curve)
      .def_readwrite("transfer", &DisplayTransform::transfer);

  py::class_<Image, SharedImage> bound(module, "Image");
  bound.def_static("from_light", &image_from_light, py::arg("light").noconvert())
      .def_static("from_levels", &image_from_levels, py::arg("levels").noconvert())
      .def_readonly("width", &Image::width)
      .def_readonly("height", &Image::height)
      .def_readonly("light_count", &Image::light_count)
      .def_property_readonly("color", [](const py::object& self) { return color(self); })
      .def_property_readonly("light_bits", [](const py::object& self) { return light_bits(self); })
      .def(
          "plane", [](const py::object& self, const std::string& name) { return plane(self, name); }, py::arg("name"))
      .def(
          "plane_picture",
          [](const Image& i, const std::string& name) {
            return std::make_shared<Image>(plane_picture(i, plane_of(name)));
          },
          py::arg("name"))
      .def("levels", &levels, py::arg("display"))
      .def(
          "png",
          [](const Image& i, const DisplayTransform& d, int threads) {
            return encoded([&] { return encode_png(i, threads, d); });
          },
          py::arg("display"), py::arg("threads"))
      .def("png_16", &png_16, py::arg("display"), py::arg("threads"))
      .def("jpeg", &jpeg, py::arg("display"), py::arg("quality"), py::arg("threads"))
      .def("exr", &exr, py::arg("is_half"), py::arg("planes"), py::arg("threads"))
      .def("plane_exr", &plane_exr, py::arg("name"), py::arg("threads"))
      .def("pfm", [](const Image& i) { return encoded([&] { return encode_pfm(color_plane(i)); }); })
      .def(
          "plane_pfm",
          [](const Image& i, const std::string& name) {
            return encoded([&] { return encode_pfm(plane_view(i, plane_of(name))); });
          },
          py::arg("name"))
      .def("npy", [](const Image& i) { return encoded([&] { return encode_npy(color_plane(i)); }); })
      .def(
          "plane_npy",
          [](const Image& i, const std::string& name) {
            return encoded([&] { return encode_npy(plane_view(i, plane_of(name))); });
          },
          py::arg("name"));
  add_pickling<Image>(bound, &state_of, &image_from);
  module.def(
      "write_file",
      [](const std::filesystem::path& path, const py::bytes& bytes) {
        const std::string_view text = bytes;
        call([&] { write_file(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}); });
      },
      py::arg("path"), py::arg("bytes"));
}

}  // namespace facemap::python
