#pragma once

#include <facemap/scene.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "facemap_bench_question.h"

struct RTCSceneTy;  // RTCScene points to it

namespace facemap::bench {

/// How Embree is used: all ways that may pay for rays like ours.
struct EmbreeWay {
  bool low_quality = true;  ///< Morton order build, else surface-area binning
  bool robust = false;
  enum class Camera { Coherent, Incoherent } camera = Camera::Coherent;
  enum class Shadow {
    Coherent,          ///< packets of 4 x 4 pixels from the light
    Incoherent,        ///< the same without the flag
    PackedCoherent,    ///< packets of the next points that face the light, in block order
    PackedIncoherent,  ///< the same without the flag
    Stream,            ///< rtcOccluded1M of 256 such points
  } shadow = Shadow::Coherent;

  std::string name() const;
};

/// The opponent: Embree 3 on the kept faces of a scene. Vertices, indices and answers are shared with it, not copied.
/// Flush-to-zero is on while it builds and traces, and only then.
class Embree {
 public:
  /// The packets' width: 16, or what FACEMAP_TARGET leaves (8 for avx2, 4 below); Embree is held to that set too.
  /// `cpu_time`: phases are timed by what the threads compute, not by the wall clock.
  Embree(const Scene& scene, int threads, bool cpu_time);
  ~Embree();

  int packet_width() const noexcept { return width_; }

  /// Builds the hierarchy, dropping the one before outside the clock. Milliseconds.
  double build(bool low_quality, bool robust);

  /// Drops the hierarchy and its memory.
  void drop();

  /// Bytes that Embree says it holds.
  std::int64_t bytes() const;

  /// The first face that a ray from `from` meets short of `from` + `way`; kNoFace: none.
  FaceId first_face(const Vector& from, const Vector& way) const;

  /// The hierarchy, to be asked by tasks of for_each.
  RTCSceneTy* hierarchy() const noexcept;

  /// Calls task(i) for every i in 0..count-1 on the threads, with flush-to-zero on.
  void for_each(int count, const std::function<void(int)>& task) const;

  /// Fills `answer`; `build` of the phases is left 0.
  Phases trace(const Rays& rays, const std::vector<Light>& lights, const EmbreeWay& way, Answer& answer) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
  const Scene* scene_;
  std::vector<Corners> kept_;  ///< empty if all faces are kept
  int threads_;
  int width_;
  bool cpu_time_;
};

/// The fastest ways of a scene, each phase measured by itself.
struct Opponents {
  EmbreeWay cold, warm;
};
Opponents calibrate(Embree& embree, const Rays& rays, const std::vector<Light>& lights);

}  // namespace facemap::bench
