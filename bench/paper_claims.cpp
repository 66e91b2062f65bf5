// What the paper claims, counted on its four scenes: docs/paper.md quotes this program's output.
// Wang 2022, sec. 4.1 (few faces a ray, Fig. 6 to 8), 4.2 (the published builder), 5 (Table 2), 6 (memory, reuse).
//
//   paper_claims          what is the same on every machine; a test finds each line in docs/paper.md
//   paper_claims times    milliseconds

#include <facemap/facemap.h>
#include <facemap/generators.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace facemap;

constexpr double kPi = 3.14159265358979323846;

constexpr int kSize = 512, kSizeOfTimes = 1024;  // pixels a side

struct Subject {
  std::string name;
  Scene scene;
  View view;
  std::vector<Light> lights;
};

Subject make_subject(const std::string& name) {
  GeneratedScene made = generate_scene(name);
  View view;
  view.position = made.camera_position;
  view.look_at = made.look_at;
  view.up = made.up;
  view.field_angle = made.field_angle_deg * kPi / 180;
  std::vector<Light> lights;
  for (const GeneratedScene::Light& light : made.lights) {
    lights.push_back({light.position, {light.color.x, light.color.y, light.color.z}, light.intensity});
  }
  return {name, Scene(std::move(made.mesh)), view, lights};
}

struct Picture {
  Image image;
  Renderer::Statistics statistics;
};

Picture draw(const Subject& subject, int size, ProjectionKind projection, Builder builder) {
  Renderer::Options options;
  options.width = options.height = size;
  options.builder = builder;
  options.planes = {Plane::Id, Plane::Lights};
  options.strategy = Renderer::Strategy::Lists;  // the paper's: whole pictures have another
  View view = subject.view;
  view.projection = projection;
  Renderer renderer(subject.scene, view, subject.lights, options);
  Picture picture;
  picture.image = renderer.render();
  picture.statistics = renderer.statistics();
  return picture;
}

double per_query(const Counters& tests, std::uint64_t queries) {
  const std::uint64_t count = tests.by_float + tests.by_double + tests.by_exact;
  return queries == 0 ? 0 : static_cast<double>(count) / static_cast<double>(queries);
}

// Pixels of which the two pictures show other faces, and among them those where `a` has an edge nearby.
struct Difference {
  int pixels = 0, at_edges = 0;
};

Difference compare_ids(const Image& a, const Image& b) {
  Difference difference;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const int pixel = y * a.width + x;
      if (a.ids[pixel] == b.ids[pixel]) continue;
      ++difference.pixels;
      bool is_edge = false;
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const int u = x + dx, v = y + dy;
        if (u < 0 || v < 0 || u >= a.width || v >= a.height) continue;
        is_edge = is_edge || a.ids[v * a.width + u] != a.ids[pixel];
      }
      difference.at_edges += is_edge;
    }
  }
  return difference;
}

int count_other_lights(const Image& a, const Image& b) {
  int pixels = 0;
  const auto bytes = static_cast<std::size_t>(a.light_bytes());
  for (std::size_t i = 0; i < a.lights.size(); i += bytes) {
    pixels += !std::equal(a.lights.begin() + i, a.lights.begin() + i + bytes, b.lights.begin() + i);
  }
  return pixels;
}

Camera make_camera(const Subject& subject) {
  Camera::Options options;
  options.width = options.height = kSize;
  options.field_angle = subject.view.field_angle;
  const View& view = subject.view;
  return Camera(subject.scene, SpaceVector::looking_at(view.position, view.look_at, view.up), options);
}

// A whole picture is seen without a camera's map, so that its rays are asked here.
void print_few_faces(const Subject& subject, const Picture& picture) {
  const Camera camera = make_camera(subject);
  Counters camera_tests;
  for (int i = 0; i < kSize * kSize; ++i) {
    camera.nearest(camera.direction_through({i % kSize + 0.5, i / kSize + 0.5}), &camera_tests);
  }
  std::size_t bytes = camera.memory_bytes();
  for (const Light& light : subject.lights) bytes += PointLight(subject.scene, light.position).memory_bytes();
  const Renderer::Statistics& s = picture.statistics;
  std::printf("| %s | %zu | %.2f | %.2f | %.1f |\n", subject.name.c_str(), subject.scene.face_count(),
              per_query(camera_tests, kSize * kSize), per_query(s.light_tests, s.light_queries),
              static_cast<double>(bytes) / (1 << 20));
}

void print_times(const Subject& subject, const Renderer::Statistics& s) {
  std::printf("| %s | %.0f | %.0f | %.0f | %.0f |\n", subject.name.c_str(), s.camera_map_ms, s.light_maps_ms,
              s.shade_ms, s.camera_map_ms + s.light_maps_ms + s.shade_ms);
}

void print_builders(const Subject& subject, const Picture& exact) {
  const Picture published = draw(subject, kSize, ProjectionKind::Surface, Builder::Fill);
  std::printf("| %s | %d | %d |\n", subject.name.c_str(), compare_ids(exact.image, published.image).pixels,
              count_other_lights(exact.image, published.image));
}

void print_raster(const Subject& subject) {
  View view = subject.view;
  view.projection = ProjectionKind::Plane;
  RasterOptions options;
  options.width = options.height = kSize;
  options.want_ids = true;
  const Image exact = draw(subject, kSize, ProjectionKind::Plane, Builder::Cover).image;
  const Difference d = compare_ids(exact, render_raster(subject.scene, view, subject.lights, options));
  std::printf("| %s | %d | %d |\n", subject.name.c_str(), d.pixels, d.at_edges);
}

// A Camera that kept one face a texel, that of the texel's centre, would answer so many rays wrongly.
void print_one_face(const Subject& subject) {
  const Camera camera = make_camera(subject);
  std::int64_t rays = 0, wrong = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const FaceId centre = camera.nearest(camera.direction_through({x + 0.5, y + 0.5})).face;
      for (const auto& [dx, dy] : {std::pair{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}) {
        const FaceId face = camera.nearest(camera.direction_through({x + dx, y + dy})).face;
        rays += face != kNoFace || centre != kNoFace;
        wrong += face != centre;
      }
    }
  }
  std::printf("| %s | %.1f %% |\n", subject.name.c_str(),
              100.0 * static_cast<double>(wrong) / static_cast<double>(rays));
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// One light, asked about what two cameras see.
void print_reuse(const Subject& subject) {
  const auto start = std::chrono::steady_clock::now();
  const PointLight light(subject.scene, subject.lights[0].position);
  const double build_ms = milliseconds_since(start);
  std::printf("| %s | %.0f |", subject.name.c_str(), build_ms);
  for (const Vector& position : {subject.view.position, make_up_view(subject.scene).position}) {
    Camera::Options options;
    options.width = options.height = kSize;
    const Camera camera(subject.scene, SpaceVector::looking_at(position, subject.view.look_at), options);
    std::vector<SurfacePoint> points;
    for (int i = 0; i < kSize * kSize; ++i) {
      const Vector d = camera.direction_through({i % kSize + 0.5, i / kSize + 0.5});
      if (const Camera::Hit hit = camera.nearest(d)) points.push_back(camera.surface_point(d, hit));
    }
    const auto asked = std::chrono::steady_clock::now();
    int lit = 0;
    for (const SurfacePoint& point : points) lit += light.get_lighten_up(point);
    std::printf(" %.1f for %zu, %d lit |", milliseconds_since(asked), points.size(), lit);
  }
  std::printf("\n");
}

// How much larger than in the middle a small thing is drawn at the picture's edge: along the radius, across it.
void print_deformation() {
  std::printf("\n| Field angle | Plane: along, across | Surface: along, across |\n|---|---|---|\n");
  for (const double degrees : {50.0, 90.0, 120.0, 170.0}) {
    const double beta = degrees / 2 * kPi / 180;
    const double cosine = std::cos(beta);
    std::printf("| %.0f | %.2f, %.2f | 1.00, %.2f |\n", degrees, 1 / (cosine * cosine), 1 / cosine,
                beta / std::sin(beta));
  }
}

void print_all_counts(const std::vector<Subject>& subjects) {
  std::vector<Picture> exact;
  for (const Subject& s : subjects) exact.push_back(draw(s, kSize, ProjectionKind::Surface, Builder::Cover));
  std::printf("| Scene | Faces | Tested a camera ray | Tested a shadow ray | Maps, MB |\n|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < subjects.size(); ++i) print_few_faces(subjects[i], exact[i]);
  std::printf("\n| Scene | Builder as published: other face | other lights |\n|---|---|---|\n");
  for (std::size_t i = 0; i < subjects.size(); ++i) print_builders(subjects[i], exact[i]);
  std::printf("\n| Scene | One face a texel: wrong beside its centre |\n|---|---|\n");
  for (const Subject& s : subjects) print_one_face(s);
  std::printf("\n| Scene | Raster method: other face | of these at an edge |\n|---|---|---|\n");
  for (const Subject& s : subjects) print_raster(s);
  print_deformation();
}

void print_all_times(const std::vector<Subject>& subjects) {
  std::printf("| Scene | Camera's map, ms | Lights' maps, ms | Shading, ms | Sum, ms |\n|---|---|---|---|---|\n");
  for (const Subject& s : subjects) {
    print_times(s, draw(s, kSizeOfTimes, ProjectionKind::Surface, Builder::Cover).statistics);
  }
  std::printf(
      "\n| Scene | One light's map, ms | First camera's points, ms | Second camera's, ms |\n|---|---|---|---|\n");
  for (const Subject& s : subjects) print_reuse(s);
}

}  // namespace

int main(int argc, char** argv) {
  const bool wants_times = argc > 1 && std::string(argv[1]) == "times";
  std::vector<Subject> subjects;
  for (const std::string& name : generator_names()) subjects.push_back(make_subject(name));
  wants_times ? print_all_times(subjects) : print_all_counts(subjects);
}
