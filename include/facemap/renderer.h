#pragma once

#include <facemap/camera.h>
#include <facemap/color.h>
#include <facemap/image.h>
#include <facemap/lens.h>
#include <facemap/light.h>
#include <facemap/plane.h>
#include <facemap/point_light.h>
#include <facemap/scene.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace facemap {

class Eye;

/// Where a camera stands and looks.
struct View {
  Vector position{0, 0, 0};
  Vector look_at{0, 0, -1};
  Vector up{0, 1, 0};
  double field_angle = 0.87266462599716477;  ///< radians (50 degrees)
  ProjectionKind projection = ProjectionKind::Surface;
  std::optional<Lens> lens = std::nullopt;  ///< in place of these two; it must be for the picture's size

  /// Orthographic: all rays along the sight, from the plane through `position` on; in place of the three above. What
  /// lies behind that plane is seen too, at a depth below 0.
  bool is_parallel = false;
  double height = 2;  ///< world units that such a picture shows, bottom to top
};

/// Some pixels of a picture, from its upper left corner.
struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;

  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// A view in which the scene's bounding sphere just fits the field angle (50 degrees) or the lens, from direction
/// (0.5, 0.6, 1) where `up` is (0, 1, 0), and from there turned along with `up` elsewhere; the height of an
/// orthographic one is the sphere's diameter.
View make_up_view(const Scene& scene, const View& wanted = View());
View make_up_view(const BoundingBall& ball, const Vector& up, const View& wanted);

/// Eight lights on two rings about the scene, intensity 1/4 each.
std::vector<Light> make_up_lights(const Scene& scene);
std::vector<Light> make_up_lights(const BoundingBall& ball, const Vector& up);

/// Controls the whole rendering. Wang 2022, sec. 4.3: the Renderer class: model, camera, lights, image.
class Renderer {
 public:
  enum class Normals { Flat, Smooth };
  enum class Falloff { Constant, InverseSquare };
  enum class Sampling {
    Grid,   ///< samples x samples fixed points a pixel
    Edges,  ///< the paper's idea (Fig. 3): one sample, and samples x samples where the pixel may hold an edge of a
            ///< face or of a shadow (docs/quality.md)
  };

  /// How the samples about a pixel make its colour.
  enum class Filter {
    Box,             ///< the mean of those in the pixel
    BlackmanHarris,  ///< weighted by a window that falls off smoothly and may reach into the neighbours
  };

  /// How the questions of a picture are answered; the answers are the same.
  enum class Strategy {
    Auto,        ///< by the cost model
    Lists,       ///< the paper's: a map of faces a light, each point asked by itself
    Transposed,  ///< points sorted into a map about the light, faces run over them: no lists are made
  };

  /// Whether maps of the lights are made that are kept for further pictures of the scene; the answers are the same.
  enum class LightMaps {
    Auto,  ///< once earlier pictures would have saved what making them costs
    Keep,  ///< with the first picture
    None,
  };

  struct Options {
    int width = 1024;   ///< pixels
    int height = 1024;  ///< pixels
    Sampling sampling = Sampling::Grid;
    int samples = 1;                              ///< a side of the grid in a pixel, 1..16
    std::optional<PixelBox> crop = std::nullopt;  ///< only these of the picture's pixels are made: the image is theirs
    Filter filter = Filter::Box;
    double filter_width = 1.5;          ///< of the Blackman-Harris window, in pixels, above 0 and at most 16
    Normals normals = Normals::Smooth;  ///< smooth where the file gives normals or smoothing groups
    bool shadow_terminator_fix = true;  ///< Hanika 2021; matters with smooth normals only
    Falloff falloff = Falloff::Constant;
    Color background{0, 0, 0};  ///< linear RGB
    bool materials = true;      ///< the model's materials, textures and vertex colours; else all is white
    Color ambient{0, 0, 0};     ///< light from everywhere, which nothing hides
    Color sky_up{0, 0, 0}, sky_down{0, 0, 0};  ///< the same from above and below, mixed by the shading normal
    Vector up{0, 1, 0};                        ///< where above is
    std::uint64_t max_texture_pixels = std::uint64_t{1} << 26;  ///< an image of more is left out, with a warning
    Builder builder = Builder::Cover;
    PlaneSet planes;  ///< to fill; they cost nothing if none is wanted
    Strategy strategy = Strategy::Auto;
    LightMaps light_maps = LightMaps::Auto;
    int threads = 0;             ///< 0: as many as the process may run at once
    std::size_t map_memory = 0;  ///< bytes that maps and working memory may take, as far as possible; 0: no limit
  };

  struct Statistics {
    /// Wall-clock milliseconds: what the camera sees; what is made of the lights and may be kept; the rest.
    double camera_map_ms = 0, light_maps_ms = 0, shade_ms = 0;
    std::uint64_t camera_queries = 0, light_queries = 0;
    std::uint64_t upsampled_pixels = 0;
    Counters camera_tests, light_tests;
    std::size_t map_bytes = 0;           ///< lists and planes of all maps, and working memory
    Strategy strategy = Strategy::Auto;  ///< the one taken: Lists or Transposed
    std::string reason;                  ///< why
    std::string target;                  ///< instruction set of the kernels
    int threads = 1;
    std::vector<std::string> warnings;  ///< textures that could not be read: "file: reason"
  };

  /// Fraction done (0..1) and the phase's name; called now and then, by one thread at a time, not always the caller's.
  /// Return false to stop: render() then throws Error.
  using Progress = std::function<bool(double, const char*)>;

  /// The scene must outlive the renderer. Throws Error for options out of range.
  Renderer(const Scene& scene, const View& view, std::vector<Light> lights, const Options& options);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// The same pixels and planes every time. Pixels without a face have the background's colour.
  Image render(const Progress& progress = {});

  /// What render() sees, without colours: the planes `ids` and `lights` of every sample, so that the image is
  /// Options::samples times as wide and as high. Points are the true points of the faces (Normals::Flat).
  Image look(const Progress& progress = {});

  /// Another camera on the same scene and lights: what was made for them is kept. Throws Error as the constructor does.
  void set_view(const View& view);

  const Statistics& statistics() const noexcept { return statistics_; }

 private:
  struct Kept;     // maps and working memory, from picture to picture
  struct Request;  // what is to be made

  Image make(const Request& request);
  Image paint_by_lists(const Request& request);
  Image paint_by_lists(const Request& request, const Eye& eye, std::size_t map_bytes, double made_ms);
  void build_lists(const Request& request, bool of_all);
  void find_cut_outs();
  void load_materials();
  void fill_planes(Image& image);
  void warn_once(const std::string& warning);

  const Scene* scene_;
  View view_;
  std::vector<Light> lights_;
  Options options_;
  Statistics statistics_;
  std::unique_ptr<Kept> kept_;
};

}  // namespace facemap
