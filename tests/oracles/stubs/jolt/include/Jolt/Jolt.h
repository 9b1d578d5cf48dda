// Stand-in for Jolt Physics: spheres can be collided and cast.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#define JPH_VERSION_MAJOR 0
#define JPH_VERSION_MINOR 0
#define JPH_VERSION_PATCH 1

namespace JPH {

using Real = float;

class Vec3 {
 public:
  Vec3() = default;
  Vec3(float x, float y, float z) : x_(x), y_(y), z_(z) {}
  static Vec3 sReplicate(float v) { return {v, v, v}; }
  static Vec3 sZero() { return {0, 0, 0}; }
  float GetX() const { return x_; }
  float GetY() const { return y_; }
  float GetZ() const { return z_; }
  float Dot(const Vec3& o) const { return x_ * o.x_ + y_ * o.y_ + z_ * o.z_; }
  float Length() const { return std::sqrt(Dot(*this)); }
  Vec3 operator+(const Vec3& o) const { return {x_ + o.x_, y_ + o.y_, z_ + o.z_}; }
  Vec3 operator-(const Vec3& o) const { return {x_ - o.x_, y_ - o.y_, z_ - o.z_}; }
  Vec3 operator*(float s) const { return {s * x_, s * y_, s * z_}; }

 private:
  float x_ = 0, y_ = 0, z_ = 0;
};
using Vec3Arg = const Vec3&;
using RVec3 = Vec3;

class Quat {
 public:
  Quat(float x, float y, float z, float w) : x_(x), y_(y), z_(z), w_(w) {}
  float GetX() const { return x_; }
  float GetY() const { return y_; }
  float GetZ() const { return z_; }
  float GetW() const { return w_; }

 private:
  float x_, y_, z_, w_;
};

/// Shapes of the stand-in have their centre of mass at their origin, so only the translation matters.
class RMat44 {
 public:
  static RMat44 sRotationTranslation(const Quat&, const RVec3& translation) { return RMat44(translation); }
  RMat44 PreTranslated(Vec3Arg) const { return *this; }
  RVec3 GetTranslation() const { return translation_; }

 private:
  explicit RMat44(const RVec3& translation) : translation_(translation) {}
  RVec3 translation_;
};

class BodyID {};

template <class T>
class RefConst {
 public:
  RefConst() = default;
  RefConst(std::shared_ptr<const T> p) : p_(std::move(p)) {}
  const T* GetPtr() const { return p_.get(); }
  const T* operator->() const { return p_.get(); }

 private:
  std::shared_ptr<const T> p_;
};

inline void RegisterDefaultAllocator() {}
inline void RegisterTypes() {}
struct Factory {
  static inline Factory* sInstance = nullptr;
};

}  // namespace JPH
