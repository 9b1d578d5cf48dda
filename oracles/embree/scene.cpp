#include "oracles/embree/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>

#include "oracles/abi/plugin_kit.h"

namespace touchstone::embree {
namespace {

// Embree ignores primitives whose coordinates are not less than 1.844e18 (FLT_LARGE).
constexpr float largest_coordinate = 1.8e18F;

float below(double x) {
  if (std::isinf(x)) return std::copysign(largest_coordinate, static_cast<float>(x));
  const auto f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float above(double x) { return -below(-x); }

void require_range(const RTCBounds& b) {
  for (const float x : {b.lower_x, b.lower_y, b.lower_z, b.upper_x, b.upper_y, b.upper_z})
    if (!(std::abs(x) <= largest_coordinate))
      throw kit::Unsupported("Embree ignores coordinates beyond 1.844e18");
}

Geometry make_geometry(RTCDevice device, void* data, RTCBoundsFunction bounds) {
  Geometry g(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserData(g.get(), data);
  rtcSetGeometryBoundsFunction(g.get(), bounds, nullptr);
  return g;
}

class StaticScene : public Scene {
 public:
  explicit StaticScene(RTCDevice device)
      : Scene(device), geometry_(make_geometry(device, this, [](const RTCBoundsFunctionArguments* args) {
          *args->bounds_o =
              static_cast<const StaticScene*>(args->geometryUserPtr)->present_[args->primID].second;
        })) {
    rtcAttachGeometryByID(scene(), geometry_.get(), 0);
  }
  void put(int body, const RTCBounds& bounds) override {
    boxes_[body] = bounds;
    is_stale_ = true;
  }
  void remove(int body) override {
    boxes_.erase(body);
    is_stale_ = true;
  }

 private:
  void commit() override {
    if (!is_stale_) return;
    is_stale_ = false;
    present_.assign(boxes_.begin(), boxes_.end());
    rtcSetGeometryUserPrimitiveCount(geometry_.get(), static_cast<unsigned>(present_.size()));
    rtcCommitGeometry(geometry_.get());
    rtcCommitScene(scene());
  }
  bool is_empty() const override { return present_.empty(); }
  int body_of(unsigned geometry, unsigned primitive) const override {
    return geometry == 0 && primitive < present_.size() ? present_[primitive].first : -1;
  }

  std::map<int, RTCBounds> boxes_;
  std::vector<std::pair<int, RTCBounds>> present_;  // by primitive
  Geometry geometry_;
  bool is_stale_ = true;
};

class DynamicScene : public Scene {
 public:
  explicit DynamicScene(RTCDevice device) : Scene(device) {
    rtcSetSceneFlags(scene(), RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene(), RTC_BUILD_QUALITY_LOW);
  }
  void put(int body, const RTCBounds& bounds) override {
    Part& part = parts_[body];
    part.bounds = bounds;
    if (!part.geometry) {
      part.geometry = make_geometry(device(), &part, [](const RTCBoundsFunctionArguments* args) {
        *args->bounds_o = static_cast<const Part*>(args->geometryUserPtr)->bounds;
      });
      rtcSetGeometryUserPrimitiveCount(part.geometry.get(), 1);
      rtcAttachGeometryByID(scene(), part.geometry.get(), static_cast<unsigned>(body));
    }
    rtcCommitGeometry(part.geometry.get());
  }
  void remove(int body) override {
    rtcDetachGeometry(scene(), static_cast<unsigned>(body));
    parts_.erase(body);
  }

 private:
  struct Part {
    RTCBounds bounds;
    Geometry geometry;
  };
  void commit() override { rtcCommitScene(scene()); }
  bool is_empty() const override { return parts_.empty(); }
  int body_of(unsigned geometry, unsigned primitive) const override {
    const int body = static_cast<int>(geometry);
    return primitive == 0 && parts_.contains(body) ? body : -1;
  }

  std::map<int, Part> parts_;  // addresses stay valid
};

}  // namespace

RTCBounds outer_floats(const Aabb& box) {
  const RTCBounds b{below(box.lo.x()), below(box.lo.y()), below(box.lo.z()), 0,
                    above(box.hi.x()), above(box.hi.y()), above(box.hi.z()), 0};
  require_range(b);
  return b;
}

Scene::Scene(RTCDevice device) : device_(device), scene_(rtcNewScene(device)) { throw_if_failed(); }

void Scene::throw_if_failed() const {
  const RTCError error = rtcGetDeviceError(device_);
  if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree: error " + std::to_string(error));
}

std::vector<std::pair<int, int>> Scene::pairs() {
  commit();
  throw_if_failed();
  struct Found {
    const Scene& scene;
    std::mutex lock;  // Embree calls back from all of its threads
    std::set<std::pair<int, int>> pairs;
    bool is_valid = true;
  } found{*this, {}, {}, true};
  rtcCollide(
      scene(), scene(),
      [](void* data, RTCCollision* collisions, unsigned count) {
        Found& f = *static_cast<Found*>(data);
        const std::lock_guard guard(f.lock);
        for (const RTCCollision* c = collisions; c != collisions + count; ++c) {
          const int a = f.scene.body_of(c->geomID0, c->primID0), b = f.scene.body_of(c->geomID1, c->primID1);
          f.is_valid = f.is_valid && a >= 0 && b >= 0;
          if (a != b) f.pairs.emplace(std::min(a, b), std::max(a, b));
        }
      },
      &found);
  if (!found.is_valid)
    throw std::runtime_error("rtcCollide reports a primitive that the scene does not hold");
  if (is_empty()) {
    rtcGetDeviceError(device_);  // Embree refuses a scene that never held anything, which has no pairs
    return {};
  }
  throw_if_failed();
  return {found.pairs.begin(), found.pairs.end()};
}

std::unique_ptr<Scene> make_static_scene(RTCDevice device) { return std::make_unique<StaticScene>(device); }
std::unique_ptr<Scene> make_dynamic_scene(RTCDevice device) { return std::make_unique<DynamicScene>(device); }

}  // namespace touchstone::embree
