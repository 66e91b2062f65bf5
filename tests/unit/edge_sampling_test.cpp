// Pictures whose pixels are divided where they may hold an edge, and filtered ones.

#include <facemap/error.h>
#include <facemap/generators.h>
#include <facemap/renderer.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace facemap {
namespace {

using Filter = Renderer::Filter;
using Strategy = Renderer::Strategy;

Renderer::Options edges(int size, int samples) {
  Renderer::Options options;
  options.width = options.height = size;
  options.samples = samples;
  options.sampling = Renderer::Sampling::Edges;
  return options;
}

struct Made {
  Image image;
  std::uint64_t divided;
};

Made make(const Scene& scene, const Renderer::Options& options) {
  Renderer renderer(scene, make_up_view(scene), make_up_lights(scene), options);
  Image image = renderer.render();
  return {std::move(image), renderer.statistics().upsampled_pixels};
}

// A sphere of `rings` rings of faces about the origin, smooth or not, on a floor of many coplanar squares.
Mesh ball_on_floor(int rings, bool smooth) {
  Mesh mesh;
  const int columns = 2 * rings;
  for (int j = 0; j <= rings; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double polar = M_PI * j / rings, turn = M_PI * i / rings;
      mesh.positions.push_back({static_cast<float>(std::sin(polar) * std::cos(turn)),
                                static_cast<float>(std::cos(polar)),
                                static_cast<float>(std::sin(polar) * std::sin(turn))});
    }
  }
  mesh.normals = mesh.positions;
  const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>(j * columns + i % columns); };
  for (int j = 0; j < rings; ++j) {
    for (int i = 0; i < columns; ++i) {
      if (j > 0) mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
      if (j + 1 < rings) mesh.triangles.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  if (smooth) mesh.normal_corners = mesh.triangles;
  constexpr int kSquares = 8;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int j = 0; j <= kSquares; ++j) {
    for (int i = 0; i <= kSquares; ++i) mesh.positions.push_back(Vector(i - 4, -1.5, j - 4));
  }
  for (std::uint32_t j = 0; j < kSquares; ++j) {
    for (std::uint32_t i = 0; i < kSquares; ++i) {
      const std::uint32_t a = first + j * (kSquares + 1) + i, b = a + kSquares + 1;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({a + 1, b, b + 1});
    }
  }
  if (smooth) mesh.normal_corners.resize(mesh.triangles.size(), {kNoIndex, kNoIndex, kNoIndex});
  return mesh;
}

// Sample by sample (edges of one sample a pixel are) and all together.
TEST(EdgeSampling, FiltersAreTheSameSampleBySample) {
  const Scene scene(ball_on_floor(8, true));
  Renderer::Options options = edges(61, 1);
  options.filter = Filter::BlackmanHarris;
  options.filter_width = 3.5;
  for (const bool is_part : {false, true}) {
    if (is_part) options.crop = PixelBox{7, 20, 30, 25};
    options.sampling = Renderer::Sampling::Edges;
    const Image one_by_one = make(scene, options).image;
    options.sampling = Renderer::Sampling::Grid;
    EXPECT_EQ(one_by_one.pixels, make(scene, options).image.pixels);
  }
}

TEST(EdgeSampling, OrthographicPicturesAreFiltered) {
  const Scene scene(ball_on_floor(8, false));
  View view;
  view.is_parallel = true;
  view.height = 5;
  view.position = {3, 4, 5};
  view.look_at = {0, -0.5, 0};
  for (const auto sampling : {Renderer::Sampling::Edges, Renderer::Sampling::Grid}) {
    Renderer::Options options = edges(48, 3);
    options.sampling = sampling;
    const auto make_one = [&](int threads) {
      options.threads = threads;
      return Renderer(scene, view, make_up_lights(scene), options).render();
    };
    const Image box = make_one(1);
    options.filter = Filter::BlackmanHarris;
    options.filter_width = 2;
    const Image whole = make_one(1);
    EXPECT_NE(whole.pixels, box.pixels);
    EXPECT_EQ(whole.pixels, make_one(3).pixels);
    for (const std::size_t corner : {std::size_t{0}, whole.pixels.size() - 1}) {
      EXPECT_NEAR(whole.pixels[corner].r, box.pixels[corner].r, 1e-4) << "an even floor stays as it is";
    }
    options.crop = PixelBox{11, 5, 20, 30};
    const Image part = make_one(2);
    ASSERT_EQ(part.pixels.size(), 600u);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 20; ++x) {
        ASSERT_EQ(part.pixels[static_cast<std::size_t>(y * 20 + x)],
                  whole.pixels[static_cast<std::size_t>((y + 5) * 48 + x + 11)])
            << x << ", " << y;
      }
    }
  }
}

// A wire a third of a pixel wide before the sky, which passes few pixels' centres: every sample that meets it counts.
TEST(EdgeSampling, ThinWiresAreWholeWithoutListsOfPixels) {
  constexpr float kPixel = 4.0f / 64, kWide = kPixel / 3;
  Mesh wire;
  wire.positions = {{-3, -1, 0}, {3, 0.25f, 0}, {3, 0.25f + kWide, 0}, {-3, -1 + kWide, 0}};
  wire.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Scene scene(wire);
  View parallel;
  parallel.is_parallel = true;
  parallel.height = 4;
  parallel.position = {0, 0, 2};
  parallel.look_at = {0, 0, 0};
  View panorama = parallel;
  panorama.is_parallel = false;
  panorama.lens = Lens::equirectangular(128, 64);
  for (const View& view : {parallel, panorama}) {
    Renderer::Options options = edges(64, 4);
    if (view.lens) options.width = 128;
    options.builder = view.lens ? Builder::Fill : Builder::Cover;
    options.ambient = {1, 1, 1};
    Renderer by_edges(scene, view, {}, options);
    const Image some = by_edges.render();
    options.sampling = Renderer::Sampling::Grid;
    const Image all = Renderer(scene, view, {}, options).render();
    EXPECT_TRUE(some.pixels == all.pixels);
    EXPECT_GT(by_edges.statistics().upsampled_pixels, 50u);
    EXPECT_LT(by_edges.statistics().upsampled_pixels, all.pixels.size() / 4);
  }
}

// Faces that lie side by side in a row do so one above the other in a column: nothing of one gets into another.
TEST(EdgeSampling, FacesOfACubeMapDoNotDependOnTheLayout) {
  constexpr int kSide = 24;
  const Scene scene(ball_on_floor(12, true));
  View view = make_up_view(scene);
  view.position = {1.5f, 0.25f, 0.5f};
  view.look_at = {0, 0, 0};
  const auto render = [&](CubeLayout layout, Renderer::Options options) {
    view.lens = Lens::cube_map(layout, kSide);
    options.width = view.lens->width();
    options.height = view.lens->height();
    return Renderer(scene, view, make_up_lights(scene), options).render();
  };
  const auto face_of = [](const Image& image, int face) {
    const bool is_row = image.width > image.height;
    const int left = is_row ? face * kSide : 0, top = is_row ? 0 : face * kSide;
    std::vector<Color> pixels;
    for (int y = top; y < top + kSide; ++y) {
      for (int x = left; x < left + kSide; ++x)
        pixels.push_back(image.pixels[static_cast<std::size_t>(y * image.width + x)]);
    }
    return pixels;
  };
  for (const Builder builder : {Builder::Cover, Builder::Fill}) {
    for (const Filter filter : {Filter::Box, Filter::BlackmanHarris}) {
      for (const auto sampling : {Renderer::Sampling::Edges, Renderer::Sampling::Grid}) {
        Renderer::Options options = edges(kSide, 4);
        options.background = {0.9f, 0.2f, 0.1f};
        options.builder = builder;
        options.sampling = sampling;
        options.filter = filter;
        options.filter_width = 3;
        const Image row = render(CubeLayout::Row6x1, options), column = render(CubeLayout::Column1x6, options);
        for (int face = 0; face < 6; ++face) {
          EXPECT_TRUE(face_of(row, face) == face_of(column, face)) << static_cast<int>(filter) << " face " << face;
        }
      }
    }
  }
}

TEST(EdgeSampling, ThreadsMemoryAndStrategyChangeNothing) {
  for (const bool smooth : {false, true}) {
    const Scene scene(ball_on_floor(12, smooth));
    for (const Filter filter : {Filter::Box, Filter::BlackmanHarris}) {
      for (const auto sampling : {Renderer::Sampling::Edges, Renderer::Sampling::Grid}) {
        Renderer::Options options = edges(97, 3);
        options.sampling = sampling;
        options.filter = filter;
        options.threads = 1;
        const Made expected = make(scene, options);
        for (const Strategy strategy : {Strategy::Lists, Strategy::Transposed}) {
          for (const int threads : {1, 2, 3}) {
            for (const std::size_t memory : {std::size_t{0}, std::size_t{1}}) {
              options.strategy = strategy;
              options.threads = threads;
              options.map_memory = memory;
              options.planes = threads == 2 ? PlaneSet{Plane::Lights, Plane::Id} : PlaneSet{};
              const Made made = make(scene, options);
              EXPECT_TRUE(made.image.pixels == expected.image.pixels)
                  << static_cast<int>(filter) << " " << static_cast<int>(strategy) << " " << threads << " " << memory;
              EXPECT_EQ(made.divided, expected.divided);
            }
          }
        }
      }
    }
  }
}

TEST(EdgeSampling, APictureOfSeveralBandsIsThatOfOne) {
  const Scene scene(ball_on_floor(12, true));
  Renderer::Options options = edges(1056, 2);  // more samples than faces are found for at a time
  const Made one = make(scene, options);
  options.map_memory = std::size_t{1} << 26;
  const Made several = make(scene, options);
  EXPECT_TRUE(several.image.pixels == one.image.pixels);
  EXPECT_EQ(several.divided, one.divided);
}

TEST(EdgeSampling, DividedPixelsAreThoseOfTheGridAndOthersAreNear) {
  constexpr double kUnseen = 16.0 / 255;  // levels of square roots that count as one colour (edge_pixels.cpp)
  const Scene scene(ball_on_floor(24, true));
  Renderer::Options options = edges(160, 4);
  const Made some = make(scene, options);
  options.sampling = Renderer::Sampling::Grid;
  const Image all = make(scene, options).image;
  std::size_t same = 0;
  for (std::size_t i = 0; i < all.pixels.size(); ++i) {
    same += all.pixels[i] == some.image.pixels[i];
    EXPECT_NEAR(std::sqrt(all.pixels[i].g), std::sqrt(some.image.pixels[i].g), kUnseen) << i;
  }
  EXPECT_GE(same, some.divided);
  EXPECT_GT(some.divided, 1000u);
  EXPECT_LT(some.divided, all.pixels.size() / 3);
}

TEST(EdgeSampling, EdgesThatDoNotShowAreNotDivided) {
  // Without lights but with an even glow nothing but the outline shows; of flat faces neither.
  Renderer::Options options = edges(96, 4);
  options.ambient = {0.5f, 0.5f, 0.5f};
  const Scene coarse(ball_on_floor(24, true));
  Renderer renderer(coarse, make_up_view(coarse), {}, options);
  const Image image = renderer.render();
  EXPECT_GT(renderer.statistics().upsampled_pixels, 100u);
  EXPECT_LT(renderer.statistics().upsampled_pixels, 96u * 12);
  options.normals = Renderer::Normals::Flat;
  Renderer flat(coarse, make_up_view(coarse), {}, options);
  flat.render();
  EXPECT_GT(flat.statistics().upsampled_pixels, renderer.statistics().upsampled_pixels);
}

TEST(EdgeSampling, WhenEveryPixelIsDividedItIsTheGrid) {
  Mesh mesh = ball_on_floor(64, false);  // faces smaller than pixels
  mesh.triangles.resize(mesh.triangles.size() - 128);
  const Scene scene(mesh);
  Renderer::Options options = edges(16, 4);
  options.filter = Filter::BlackmanHarris;
  const Image some = make(scene, options).image;
  options.sampling = Renderer::Sampling::Grid;
  const Image all = make(scene, options).image;
  EXPECT_TRUE(some.pixels == all.pixels);
}

TEST(EdgeSampling, CropsAreWhatTheWholePictureHasThere) {
  const Scene scene(ball_on_floor(12, true));
  const View view = make_up_view(scene);
  const std::vector<Light> lights = make_up_lights(scene);
  for (const Filter filter : {Filter::Box, Filter::BlackmanHarris}) {
    for (const auto sampling : {Renderer::Sampling::Edges, Renderer::Sampling::Grid}) {
      Renderer::Options options = edges(80, 3);
      options.sampling = sampling;
      options.filter = filter;
      options.filter_width = 3.5;
      options.planes = {Plane::Id, Plane::Lights};
      const Image whole = Renderer(scene, view, lights, options).render();
      for (const PixelBox& box : {PixelBox{0, 0, 17, 30}, PixelBox{31, 22, 20, 33}, PixelBox{60, 79, 20, 1}}) {
        options.crop = box;
        const Image part = Renderer(scene, view, lights, options).render();
        ASSERT_EQ(part.width, box.width);
        ASSERT_EQ(part.height, box.height);
        int different = 0;
        for (int y = 0; y < box.height; ++y) {
          for (int x = 0; x < box.width; ++x) {
            const auto i = static_cast<std::size_t>(y * box.width + x);
            const auto j = static_cast<std::size_t>((box.y + y) * whole.width + box.x + x);
            different +=
                part.pixels[i] != whole.pixels[j] || part.ids[i] != whole.ids[j] || part.lights[i] != whole.lights[j];
          }
        }
        EXPECT_EQ(different, 0) << box.x;
      }
    }
  }
}

TEST(PictureFilter, ABackgroundStaysAsItIs) {
  const Scene scene(ball_on_floor(4, false));
  View away;
  away.position = {0, 20, 0};
  away.look_at = {0, 30, 0};
  away.up = {0, 0, 1};
  Renderer::Options options = edges(20, 4);
  options.background = {0.1f, 0.2f, 0.3f};
  options.filter = Filter::BlackmanHarris;
  for (const auto sampling : {Renderer::Sampling::Edges, Renderer::Sampling::Grid}) {
    options.sampling = sampling;
    const Image image = Renderer(scene, away, {}, options).render();
    for (const Color& pixel : image.pixels) EXPECT_EQ(pixel, options.background);
  }
}

TEST(PictureFilter, OutOfRangeIsAnError) {
  const Scene scene(ball_on_floor(4, false));
  Renderer::Options options;
  options.filter = Filter::BlackmanHarris;
  for (const double width : {0.0, -1.0, 16.5, std::nan("")}) {
    options.filter_width = width;
    EXPECT_THROW(Renderer(scene, View(), {}, options), Error) << width;
  }
  options.filter_width = 16;
  EXPECT_NO_THROW(Renderer(scene, View(), {}, options));
}

}  // namespace
}  // namespace facemap
