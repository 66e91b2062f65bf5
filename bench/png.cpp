// Speed of encode_png: the four generated scenes at 1024 x 1024, or the PNG files that are given, by 1 and 2 threads.
//
//     png_encode [--benchmark_...] [FILE.png ...]
//
// Measured is the way from linear float colours to the bytes of the file, wall-clock; `bytes` is the file's size.

#include <benchmark/benchmark.h>
#include <facemap/error.h>
#include <facemap/facemap.h>
#include <facemap/generators.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace {

using facemap::Image;

void encode(benchmark::State& state, const std::shared_ptr<const Image>& image) {
  std::size_t bytes = 0;
  for (auto _ : state) bytes = facemap::encode_png(*image, static_cast<int>(state.range(0))).size();
  state.counters["bytes"] = static_cast<double>(bytes);
}

Image read_image(const std::string& path) {
  const facemap::Picture24 picture = facemap::read_png(path);
  Image image;
  image.width = picture.width;
  image.height = picture.height;
  for (const std::uint32_t rgb : picture.pixels) image.pixels.push_back(facemap::Color::from_24_bit(rgb));
  return image;
}

Image draw(const std::string& name) {
  facemap::GeneratedScene made = facemap::generate_scene(name);
  const facemap::Scene scene(std::move(made.mesh));
  facemap::View view;
  view.position = made.camera_position;
  view.look_at = made.look_at;
  view.up = made.up;
  view.field_angle = static_cast<double>(made.field_angle_deg) * 0.017453292519943295;
  std::vector<facemap::Light> lights;
  for (const facemap::GeneratedScene::Light& light : made.lights) {
    lights.push_back({light.position, {light.color.x, light.color.y, light.color.z}, light.intensity});
  }
  return facemap::Renderer(scene, view, lights, {}).render();
}

void add(const std::string& name, Image image) {
  const auto shared = std::make_shared<const Image>(std::move(image));
  benchmark::RegisterBenchmark(("encode_png/" + name).c_str(), encode, shared)
      ->ArgName("threads")
      ->Arg(1)
      ->Arg(2)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    benchmark::Initialize(&argc, argv);
    for (int i = 1; i < argc; ++i) add(argv[i], read_image(argv[i]));
    if (argc == 1) {
      for (const std::string& name : facemap::generator_names()) add(name, draw(name));
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
}
