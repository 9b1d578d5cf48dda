// An Embree scene of user geometries whose primitives are the boxes of the bodies present. Embree takes
// floats: the bounds function must enclose its primitive, so the boxes are rounded outward, as a program with
// doubles has to.
#pragma once

#include <embree3/rtcore.h>

#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/math/aabb.h"

namespace touchstone::embree {

struct ReleaseDevice {
  void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
};
struct ReleaseScene {
  void operator()(RTCScene s) const { rtcReleaseScene(s); }
};
struct ReleaseGeometry {
  void operator()(RTCGeometry g) const { rtcReleaseGeometry(g); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using Geometry = std::unique_ptr<RTCGeometryTy, ReleaseGeometry>;

/// The bounds of one body. Throws kit::Unsupported for coordinates outside the range that Embree accepts;
/// infinite ones become the ends of that range.
RTCBounds outer_floats(const Aabb& box);

class Scene {
 public:
  virtual ~Scene() = default;
  virtual void put(int body, const RTCBounds& bounds) = 0;  // inserts or moves
  virtual void remove(int body) = 0;
  /// The pairs that rtcCollide reports for the scene with itself, each once, a < b. Throws std::runtime_error
  /// if it reports a primitive that the scene does not hold.
  std::vector<std::pair<int, int>> pairs();

 protected:
  explicit Scene(RTCDevice device);
  virtual void commit() = 0;
  virtual bool is_empty() const = 0;
  /// -1 if the scene holds no such primitive.
  virtual int body_of(unsigned geometry, unsigned primitive) const = 0;
  RTCDevice device() const { return device_; }
  RTCScene scene() const { return scene_.get(); }
  void throw_if_failed() const;

 private:
  RTCDevice device_;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene_;
};

/// One geometry with a primitive for each body, built again after changes.
std::unique_ptr<Scene> make_static_scene(RTCDevice device);
/// A geometry for each body, in a scene with RTC_SCENE_FLAG_DYNAMIC; changes are committed body by body.
std::unique_ptr<Scene> make_dynamic_scene(RTCDevice device);

}  // namespace touchstone::embree
