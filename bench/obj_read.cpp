// Speed of the OBJ reader beside tinyobjloader: on the files that are given, or else on models and large grids.
//
//     obj_read [--benchmark_...] [FILE.obj ...]
//
// Measured is OBJ::load from the path to the finished mesh: polygons cut, smoothed normals made, MTL files read, all
// memory taken anew each time, by 1 and 2 threads. bytes_per_second is the size of the OBJ file over wall-clock time;
// the file is warm from the second run on. Grids are made in the folder for temporary files and removed at the end.
//
//     obj_read --make-grid plain|full|quads MEGABYTES FILE
//     obj_read --load FILE [THREADS]
//
// make a grid and read a file once: for `time -v obj_read --load FILE`, which shows the peak of memory.

#include <benchmark/benchmark.h>
#include <facemap/error.h>
#include <facemap/obj.h>
#include <tiny_obj_loader.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

enum class GridKind { Plain, Full, Quads };  // f v v v; f v/t/n v/t/n v/t/n; f v v v v

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Writes a wavy square of cells, as many as make about `megabytes`.
void write_grid(const std::filesystem::path& path, GridKind kind, double megabytes) {
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "w"));
  if (!file) throw std::runtime_error("cannot write " + path.string());
  // Bytes of a cell's lines: one vertex (and vt, vn), two triangles or one quad.
  const double bytes_a_cell = kind == GridKind::Plain ? 82 : kind == GridKind::Full ? 236 : 64;
  const int n = static_cast<int>(std::sqrt(megabytes * 1e6 / bytes_a_cell));
  std::FILE* const out = file.get();
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double x = 2.0 * i / n - 1, y = 2.0 * j / n - 1;
      std::fprintf(out, "v %.6f %.6f %.6f\n", x, y, 0.3 * x * x * y - 0.2 * y * y);
      if (kind == GridKind::Full) {
        std::fprintf(out, "vt %.6f %.6f\nvn %.4f %.4f %.4f\n", 0.5 * x + 0.5, 0.5 * y + 0.5, x / 3, y / 3, 0.75);
      }
    }
  }
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i + 1, b = a + 1, c = a + n + 1, d = a + n;
      if (kind == GridKind::Plain) {
        std::fprintf(out, "f %d %d %d\nf %d %d %d\n", a, b, c, a, c, d);
      } else if (kind == GridKind::Full) {
        std::fprintf(out, "f %d/%d/%d %d/%d/%d %d/%d/%d\nf %d/%d/%d %d/%d/%d %d/%d/%d\n", a, a, a, b, b, b, c, c, c, a,
                     a, a, c, c, c, d, d, d);
      } else {
        std::fprintf(out, "f %d %d %d %d\n", a, b, c, d);
      }
    }
  }
}

void set_counters(benchmark::State& state, const std::string& path, std::size_t triangles) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(std::filesystem::file_size(path)));
  state.counters["triangles"] = static_cast<double>(triangles);
}

facemap::OBJ::Limits with_threads(int threads) {
  facemap::OBJ::Limits limits;
  limits.threads = threads;
  return limits;
}

void read_facemap(benchmark::State& state, const std::string& path) {
  std::size_t triangles = 0;
  for (auto _ : state) {
    const facemap::OBJ obj = facemap::OBJ::load(path, with_threads(static_cast<int>(state.range(0))));
    triangles = obj.mesh().face_count();
    benchmark::DoNotOptimize(obj.mesh().positions.data());
  }
  set_counters(state, path, triangles);
}

void read_tinyobj(benchmark::State& state, const std::string& path) {
  const std::string directory = std::filesystem::path(path).parent_path().string();
  std::size_t triangles = 0;
  for (auto _ : state) {
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, path.c_str(), directory.c_str())) {
      state.SkipWithError(error.c_str());
      return;
    }
    triangles = 0;
    for (const tinyobj::shape_t& shape : shapes) triangles += shape.mesh.num_face_vertices.size();
    benchmark::DoNotOptimize(attributes.vertices.data());
  }
  set_counters(state, path, triangles);
}

void add_file(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  benchmark::RegisterBenchmark(("facemap/" + name).c_str(), read_facemap, path)
      ->ArgName("threads")
      ->Arg(1)
      ->Arg(2)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("tinyobjloader/" + name).c_str(), read_tinyobj, path)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

GridKind kind_from_name(const std::string& name) {
  if (name == "plain") return GridKind::Plain;
  if (name == "full") return GridKind::Full;
  if (name == "quads") return GridKind::Quads;
  throw std::runtime_error("no such grid: " + name);
}

/// The largest of the test models, if they are there.
std::vector<std::string> model_files() {
  const char* const variable = std::getenv("FACEMAP_MODELS");
  const std::filesystem::path models = variable != nullptr ? variable : FACEMAP_SOURCE_DIR "/../shared/models";
  std::vector<std::string> found;
  for (const char* name : {"scenes/hotel_room/hotel_room.obj", "scenes/copperBeech/copperBeech.obj",
                           "scenes/chessboard/chessboard.obj", "classic/armadillo/armadillo.obj"}) {
    if (std::filesystem::exists(models / name)) found.push_back((models / name).string());
  }
  return found;
}

int run(int argc, char** argv) {
  if (argc == 5 && std::strcmp(argv[1], "--make-grid") == 0) {
    write_grid(argv[4], kind_from_name(argv[2]), std::atof(argv[3]));
    return 0;
  }
  if ((argc == 3 || argc == 4) && std::strcmp(argv[1], "--load") == 0) {
    const int threads = argc == 4 ? std::atoi(argv[3]) : 0;
    std::printf("%zu triangles\n", facemap::OBJ::load(argv[2], with_threads(threads)).mesh().face_count());
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  std::vector<std::string> files(argv + 1, argv + argc), grids;
  if (files.empty()) {
    files = model_files();
    for (const char* kind : {"plain", "full", "quads"}) {
      constexpr double kMegabytes = 130;
      grids.push_back(std::filesystem::temp_directory_path() / ("facemap_grid_" + std::string(kind) + ".obj"));
      write_grid(grids.back(), kind_from_name(kind), kMegabytes);
    }
  }
  for (const std::string& file : files) add_file(file);
  for (const std::string& file : grids) add_file(file);
  benchmark::RunSpecifiedBenchmarks();
  for (const std::string& file : grids) std::filesystem::remove(file);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
}
