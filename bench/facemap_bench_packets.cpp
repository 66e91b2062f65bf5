#include "facemap_bench_packets.h"

#include <algorithm>
#include <cstring>
#include <limits>

// Loops over whole tiles are compiled for the wide registers too, as a program made for Embree would be.
#define FACEMAP_BENCH_CLONES __attribute__((target_clones("default", "avx2", "arch=skylake-avx512")))

namespace facemap::bench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

FACEMAP_BENCH_CLONES
void find_facing(const Vector& light, const float* x, const float* y, const float* z, const float* nx, const float* ny,
                 const float* nz, std::int32_t* facing, int count) {
  const float lx = light.x, ly = light.y, lz = light.z;
  for (int i = 0; i < count; ++i) {
    facing[i] = nx[i] * (lx - x[i]) + ny[i] * (ly - y[i]) + nz[i] * (lz - z[i]) > 0 ? -1 : 0;
  }
}

FACEMAP_BENCH_CLONES
void add_bit(const std::int32_t* lit, unsigned bit, std::uint8_t* masks, int stride, int count) {
  if (stride == 1) {
    for (int i = 0; i < count; ++i) masks[i] = std::uint8_t(masks[i] | (unsigned(lit[i]) & bit));
  } else {
    for (int i = 0; i < count; ++i) {
      masks[std::size_t(i) * stride] = std::uint8_t(masks[std::size_t(i) * stride] | (unsigned(lit[i]) & bit));
    }
  }
}

}  // namespace

template <class Value>
void TileTracer::copy_run(const Value* from, Value* picture, int first, int values, const Answer& answer) const {
  const InTile place = place_in_tile(first);
  const int x = left_ + place.column, y = top_ + place.row;
  if (x >= answer.columns || y >= answer.rows) return;
  const int count = std::min(kRun, answer.columns - x);
  Value* to = picture + (std::size_t(y) * answer.columns + x) * values;
  if (count == kRun && values == 1) {
    std::memcpy(to, from, kRun * sizeof(Value));
  } else {
    std::memcpy(to, from, std::size_t(count) * values * sizeof(Value));
  }
}

template <class Packet>
void TileTracer::see_packets(RTCScene scene, const float* directions, const Vector& origin,
                             RTCIntersectContext& context) {
  constexpr int kWidth = Packet::kWidth;
  alignas(64) typename Packet::RayHit packet;
  alignas(64) int valid[kWidth];
  set_common(packet.ray, origin, kWidth);
  for (int first = 0; first < kCount; first += kWidth) {
    const float* block = directions + first / kBlock * kBlock * 3 + first % kBlock;
    for (int i = 0; i < kWidth; ++i) {
      const float dx = block[i], dy = block[kBlock + i], dz = block[2 * kBlock + i];
      packet.ray.dir_x[i] = dx;
      packet.ray.dir_y[i] = dy;
      packet.ray.dir_z[i] = dz;
      packet.ray.tfar[i] = kInfinity;
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      valid[i] = -int((dx != 0) | (dy != 0) | (dz != 0));
    }
    Packet::intersect(valid, scene, &context, &packet);
    for (int i = 0; i < kWidth; ++i) {
      const bool hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      const float dx = packet.ray.dir_x[i], dy = packet.ray.dir_y[i], dz = packet.ray.dir_z[i];
      const float t = hit ? packet.ray.tfar[i] : 0;
      const float gx = packet.hit.Ng_x[i], gy = packet.hit.Ng_y[i], gz = packet.hit.Ng_z[i];
      const bool away = gx * dx + gy * dy + gz * dz > 0;
      x_.at[first + i] = origin.x + t * dx;
      y_.at[first + i] = origin.y + t * dy;
      z_.at[first + i] = origin.z + t * dz;
      nx_.at[first + i] = hit ? (away ? -gx : gx) : 0;
      ny_.at[first + i] = hit ? (away ? -gy : gy) : 0;
      nz_.at[first + i] = hit ? (away ? -gz : gz) : 0;
      prims_[first + i] = hit ? std::int32_t(packet.hit.primID[i]) : kNoFace;
    }
  }
}

void TileTracer::see(RTCScene scene, const Rays& rays, int tile, const EmbreeWay& way, int width,
                     const std::uint32_t* face_of, Answer& answer) {
  left_ = tile % rays.tiles_across() * kTile;
  top_ = tile / rays.tiles_across() * kTile;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const bool coherent = way.camera == EmbreeWay::Camera::Coherent;
  context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  if (width == 16) {
    see_packets<Packet16>(scene, rays.tile(tile), rays.origin(), context);
  } else if (width == 8) {
    see_packets<Packet8>(scene, rays.tile(tile), rays.origin(), context);
  } else {
    see_packets<Packet4>(scene, rays.tile(tile), rays.origin(), context);
  }
  if (face_of) {
    for (std::int32_t& prim : prims_) prim = prim < 0 ? prim : std::int32_t(face_of[prim]);
  }
  for (int i = 0; i < kCount; i += kRun) {
    copy_run(prims_ + i, answer.ids.get(), i, 1, answer);
  }
}

template <class Packet>
void TileTracer::ask_packets(RTCScene scene, const Vector& light, RTCIntersectContext& context) {
  constexpr int kWidth = Packet::kWidth;
  alignas(64) typename Packet::Ray rays;
  set_common(rays, light, kWidth);
  for (int first = 0; first < kCount; first += kWidth) {
    int any = 0;
    for (int i = 0; i < kWidth; ++i) any |= facing_[first + i];
    if (!any) continue;
    for (int i = 0; i < kWidth; ++i) {
      rays.dir_x[i] = x_.at[first + i] - light.x;
      rays.dir_y[i] = y_.at[first + i] - light.y;
      rays.dir_z[i] = z_.at[first + i] - light.z;
      rays.tfar[i] = 1 - kShort;
    }
    Packet::occluded(facing_ + first, scene, &context, &rays);
    for (int i = 0; i < kWidth; ++i) lit_[first + i] = rays.tfar[i] >= 0 ? facing_[first + i] : 0;
  }
}

int TileTracer::list_facing() {
  int count = 0;
  for (int i = 0; i < kCount; ++i) {
    listed_[count] = std::uint16_t(i);
    count -= facing_[i];
  }
  return count;
}

template <class Packet>
void TileTracer::ask_packed(RTCScene scene, const Vector& light, RTCIntersectContext& context) {
  constexpr int kWidth = Packet::kWidth;
  alignas(64) typename Packet::Ray rays;
  alignas(64) int valid[kWidth];
  set_common(rays, light, kWidth);
  const int count = list_facing();
  for (int i = 0; i < kWidth; ++i) listed_[count + i] = 0;
  for (int first = 0; first < count; first += kWidth) {
    for (int i = 0; i < kWidth; ++i) {
      const int at = listed_[first + i];
      rays.dir_x[i] = x_.at[at] - light.x;
      rays.dir_y[i] = y_.at[at] - light.y;
      rays.dir_z[i] = z_.at[at] - light.z;
      rays.tfar[i] = 1 - kShort;
      valid[i] = first + i < count ? -1 : 0;
    }
    Packet::occluded(valid, scene, &context, &rays);
    for (int i = 0; i < kWidth && first + i < count; ++i) lit_[listed_[first + i]] = rays.tfar[i] >= 0 ? -1 : 0;
  }
}

void TileTracer::ask_streams(RTCScene scene, const Vector& light, RTCIntersectContext& context) {
  constexpr int kStream = 256;
  alignas(64) RTCRay rays[kStream];
  const int count = list_facing();
  for (int first = 0; first < count; first += kStream) {
    const int length = std::min(kStream, count - first);
    for (int i = 0; i < length; ++i) {
      const int at = listed_[first + i];
      rays[i] = {light.x,    light.y,     light.z, 0, x_.at[at] - light.x, y_.at[at] - light.y, z_.at[at] - light.z, 0,
                 1 - kShort, 0xffffffffu, 0,       0};
    }
    rtcOccluded1M(scene, &context, rays, unsigned(length), sizeof(RTCRay));
    for (int i = 0; i < length; ++i) lit_[listed_[first + i]] = rays[i].tfar >= 0 ? -1 : 0;
  }
}

template <class Packet>
void TileTracer::ask(RTCScene scene, const Vector& light, EmbreeWay::Shadow shadow, RTCIntersectContext& context) {
  using Shadow = EmbreeWay::Shadow;
  if (shadow == Shadow::Coherent || shadow == Shadow::Incoherent) {
    ask_packets<Packet>(scene, light, context);
  } else if (shadow == Shadow::Stream) {
    ask_streams(scene, light, context);
  } else {
    ask_packed<Packet>(scene, light, context);
  }
}

void TileTracer::ask_lights(RTCScene scene, const std::vector<Light>& lights, const EmbreeWay& way, int width,
                            int light_bytes) {
  using Shadow = EmbreeWay::Shadow;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const bool coherent = way.shadow == Shadow::Coherent || way.shadow == Shadow::PackedCoherent;
  context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  light_bytes_ = light_bytes;
  masks_.assign(std::size_t(kCount) * light_bytes, 0);
  for (std::size_t l = 0; l < lights.size(); ++l) {
    const Vector& light = lights[l].position;
    find_facing(light, x_.at, y_.at, z_.at, nx_.at, ny_.at, nz_.at, facing_, kCount);
    std::fill(lit_, lit_ + kCount, 0);
    if (width == 16) {
      ask<Packet16>(scene, light, way.shadow, context);
    } else if (width == 8) {
      ask<Packet8>(scene, light, way.shadow, context);
    } else {
      ask<Packet4>(scene, light, way.shadow, context);
    }
    add_bit(lit_, 1u << l % 8, masks_.data() + l / 8, light_bytes, kCount);
  }
}

void TileTracer::write_lights(Answer& answer) const {
  for (int i = 0; i < kCount; i += kRun) {
    copy_run(masks_.data() + std::size_t(i) * light_bytes_, answer.lights.get(), i, light_bytes_, answer);
  }
}

}  // namespace facemap::bench
