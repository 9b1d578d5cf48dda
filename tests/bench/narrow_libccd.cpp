// libccd: GJK/EPA and MPR with the adapter's support functions. Tolerances as shipped.
#include <ccd/ccd.h>

#include "oracles/libccd/object.h"
#include "tests/bench/narrow_cases.h"

namespace touchstone::bench {
namespace {

ts_shape make_shape(const Shape& s, std::vector<std::vector<double>>& store) {
  ts_shape r{};
  r.kind = static_cast<ts_shape_kind>(s.index());
  int n = 0;
  std::visit(
      [&](const auto& x) {
        for_each_field(x, [&](std::string_view, const auto& v, Domain) {
          using T = std::decay_t<decltype(v)>;
          if constexpr (std::is_same_v<T, double>) r.size[n++] = v;
          if constexpr (std::is_same_v<T, Vec3>)
            for (int k = 0; k < 3; ++k) r.size[n++] = v[k];
          if constexpr (std::is_same_v<T, std::vector<Vec3>>) {
            auto& flat = store.emplace_back();
            for (const Vec3& p : v) flat.insert(flat.end(), p.data(), p.data() + 3);
            r.vertices = flat.data();
            r.vertex_count = v.size();
          }
        });
      },
      s);
  return r;
}

class Libccd final : public NarrowContestant {
 public:
  Libccd(Task task, bool mpr, const std::vector<PairCase>& cases) : task_(task), mpr_(mpr) {
    shapes_.reserve(2 * cases.size());
    store_.reserve(2 * cases.size());
    for (const PairCase& c : cases) {
      const auto object = [&](const Shape& s, const Pose& p) {
        shapes_.push_back(make_shape(s, store_));
        return libccd::Object{&shapes_.back(), rotation_matrix(p.rotation), p.translation};
      };
      pairs_.push_back({object(c.a, c.pose_a), object(c.b, c.pose_b)});
    }
    CCD_INIT(&ccd_);
    ccd_.support1 = ccd_.support2 = &libccd::support;
    ccd_.center1 = ccd_.center2 = &libccd::center;
    ccd_.max_iterations = 500;
  }
  void ask(std::size_t i, Found& out) override {
    const Pair& p = pairs_[i];
    if (task_ == Task::overlap) {
      out.overlap = (mpr_ ? ccdMPRIntersect(&p.a, &p.b, &ccd_) : ccdGJKIntersect(&p.a, &p.b, &ccd_)) != 0;
      return;
    }
    ccd_real_t depth = 0;
    ccd_vec3_t normal{}, at{};
    out.overlap = (mpr_ ? ccdMPRPenetration(&p.a, &p.b, &ccd_, &depth, &normal, &at)
                        : ccdGJKPenetration(&p.a, &p.b, &ccd_, &depth, &normal, &at)) == 0;
    if (!out.overlap) return;
    out.gap = -depth;
    out.normal = Vec3(normal.v[0], normal.v[1], normal.v[2]);
    out.points = 1;
  }

 private:
  struct Pair {
    libccd::Object a, b;
  };
  Task task_;
  bool mpr_;
  std::vector<std::vector<double>> store_;
  std::vector<ts_shape> shapes_;
  std::vector<Pair> pairs_;
  ccd_t ccd_;
};

}  // namespace

NarrowContestantPtr make_narrow_libccd_gjk(Task task, const PairKind&, const std::vector<PairCase>& cases) {
  if (task == Task::distance) return nullptr;
  return std::make_unique<Libccd>(task, false, cases);
}
NarrowContestantPtr make_narrow_libccd_mpr(Task task, const PairKind&, const std::vector<PairCase>& cases) {
  if (task == Task::distance) return nullptr;
  return std::make_unique<Libccd>(task, true, cases);
}

}  // namespace touchstone::bench
