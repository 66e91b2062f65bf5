#pragma once

namespace facemap {

/// Three numbers of any ring: Tracked or GMP integers. Predicates are written once over it.
template <class T>
struct Vec3 {
  T x, y, z;
};

template <class T>
Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {T(a.x + b.x), T(a.y + b.y), T(a.z + b.z)};
}

template <class T>
Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {T(a.x - b.x), T(a.y - b.y), T(a.z - b.z)};
}

template <class T>
Vec3<T> operator*(const T& s, const Vec3<T>& a) {
  return {T(s * a.x), T(s * a.y), T(s * a.z)};
}

template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return T(T(a.x * b.x) + T(a.y * b.y)) + T(a.z * b.z);
}

template <class T>
Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {T(T(a.y * b.z) - T(a.z * b.y)), T(T(a.z * b.x) - T(a.x * b.z)), T(T(a.x * b.y) - T(a.y * b.x))};
}

}  // namespace facemap
