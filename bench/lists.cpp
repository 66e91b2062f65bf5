// What the lists of faces cost: milliseconds to build a light's and a camera's map, bytes, and nanoseconds a point
// asked. The medians of several runs of one process on one core.
//
//   lists [SCENE]...    names of generated scenes, or OBJ files; all generated ones without an argument

#include <facemap/facemap.h>
#include <facemap/generators.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace facemap;

constexpr int kRounds = 5;
constexpr std::size_t kPoints = 1000000;

double milliseconds(const std::function<void()>& run) {
  std::vector<double> times;
  for (int i = 0; i < kRounds; ++i) {
    const auto start = std::chrono::steady_clock::now();
    run();
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  return times[kRounds / 2];
}

// A number in 0..1 (pcg's multiplier; the seed is the first state).
double next_unit(std::uint64_t& state) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return static_cast<double>(state >> 11) * 0x1p-53;
}

// Points in the scene's box, in no order.
std::vector<Vector> points_among(const Scene& scene) {
  std::uint64_t state = 7;
  std::vector<Vector> points(kPoints);
  for (Vector& p : points) {
    for (int i = 0; i < 3; ++i) {
      const double share = next_unit(state);
      p[i] = static_cast<float>(scene.lower()[i] + share * (double(scene.upper()[i]) - scene.lower()[i]));
    }
  }
  return points;
}

void measure_light(const Scene& scene, const std::vector<Vector>& points, const Vector& position, const char* kind) {
  const double build_ms = milliseconds([&] { const PointLight light(scene, position); });
  const PointLight light(scene, position);
  std::printf("  light %-8s %7.1f ms to build, %5.1f MB, %d^2 texels, %zu entries;", kind, build_ms,
              static_cast<double>(light.memory_bytes()) / (1 << 20), light.width(), light.entry_count());
  std::size_t lit = 0;
  const double single_ms = milliseconds([&] {
    lit = 0;
    for (const Vector& p : points) lit += light.get_lighten_up(p);
  });
  std::vector<std::uint8_t> flags(points.size());
  const double batch_ms = milliseconds([&] { light.get_lighten_up(points, flags); });
  const double ns = 1e6 / static_cast<double>(points.size());
  std::printf(" %.1f ns a point singly, %.1f together, %.0f %% lit\n", single_ms * ns, batch_ms * ns,
              100.0 * static_cast<double>(lit) / static_cast<double>(points.size()));
}

void measure_camera(const Scene& scene) {
  const View view = make_up_view(scene);
  const SpaceVector frame = SpaceVector::looking_at(view.position, view.look_at, view.up);
  for (const ProjectionKind projection : {ProjectionKind::Surface, ProjectionKind::Plane}) {
    Camera::Options options;
    options.projection = projection;
    const double build_ms = milliseconds([&] { const Camera camera(scene, frame, options); });
    const Camera camera(scene, frame, options);
    std::vector<Vector> directions;
    for (int y = 0; y < options.height; ++y) {
      for (int x = 0; x < options.width; ++x) directions.push_back(camera.direction_through({x + 0.5, y + 0.5}));
    }
    const double ask_ms = milliseconds([&] {
      for (const Vector& d : directions) camera.nearest(d);
    });
    std::printf("  camera %-7s %7.1f ms to build, %5.1f MB, %zu entries; %.1f ns a ray\n",
                projection == ProjectionKind::Plane ? "plane" : "surface", build_ms,
                static_cast<double>(camera.memory_bytes()) / (1 << 20), camera.entry_count(),
                ask_ms * 1e6 / static_cast<double>(directions.size()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = generator_names();
  for (const std::string& name : names) {
    const Scene scene = name.ends_with(".obj") ? Scene::load(name) : Scene(generate_scene(name).mesh);
    std::printf("%s, %zu faces\n", name.c_str(), scene.face_count());
    const std::vector<Vector> points = points_among(scene);
    measure_light(scene, points, make_up_lights(scene)[0].position, "outside");
    measure_light(scene, points, Vector(scene.centre() + DVector(0, 0.3 * scene.bounding_radius(), 0)), "inside");
    measure_camera(scene);
  }
}
