#pragma once

namespace facemap {

/// Three numbers of any ring: doubles, Tracked or integers of any width. Products of two types are of the type that
/// their components' product has.
template <class T>
struct Vec3 {
  T x, y, z;
};

template <class T>
Vec3(T, T, T) -> Vec3<T>;

template <class A, class B>
auto operator+(const Vec3<A>& a, const Vec3<B>& b) {
  return Vec3{a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class A, class B>
auto operator-(const Vec3<A>& a, const Vec3<B>& b) {
  return Vec3{a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class A>
Vec3<A> operator-(const Vec3<A>& a) {
  return {-a.x, -a.y, -a.z};
}

template <class S, class A>
auto operator*(const S& s, const Vec3<A>& a) {
  return Vec3{s * a.x, s * a.y, s * a.z};
}

template <class A, class B>
auto dot(const Vec3<A>& a, const Vec3<B>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

template <class A, class B>
auto cross(const Vec3<A>& a, const Vec3<B>& b) {
  return Vec3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace facemap
