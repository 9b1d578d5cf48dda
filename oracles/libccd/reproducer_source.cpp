#include <fmt/format.h>

#include "core/base/input_error.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view code = R"(void support1(const void*, const ccd_vec3_t* d, ccd_vec3_t* out) {
  const Vec p = support_a({d->v[0], d->v[1], d->v[2]});
  ccdVec3Set(out, p[0], p[1], p[2]);
}
void support2(const void*, const ccd_vec3_t* d, ccd_vec3_t* out) {
  const Vec p = support_b({d->v[0], d->v[1], d->v[2]});
  ccdVec3Set(out, p[0], p[1], p[2]);
}
void center_a(const void*, ccd_vec3_t* out) { ccdVec3Set(out, @CENTER_A@); }
void center_b(const void*, ccd_vec3_t* out) { ccdVec3Set(out, @CENTER_B@); }

Answer ask() {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = support1;
  ccd.support2 = support2;
  ccd.center1 = center_a;
  ccd.center2 = center_b;
@TUNED@  Answer x;
@ASK@  return x;
}
)";

constexpr std::string_view tuned =
    "  ccd.max_iterations = 1000;\n  ccd.epa_tolerance = ccd.mpr_tolerance = ccd.dist_tolerance = 1e-10;\n";

constexpr std::string_view ask_contact = R"(  ccd_real_t depth = NAN;
  ccd_vec3_t direction, position;
  ccdVec3Set(&direction, NAN, NAN, NAN);
  ccdVec3Set(&position, NAN, NAN, NAN);
  x.overlap = ccd@METHOD@Penetration(nullptr, nullptr, &ccd, &depth, &direction, &position) == 0;
  if (x.overlap) {
    x.depth = depth;
    x.normal = {direction.v[0], direction.v[1], direction.v[2]};
    x.points = {{position.v[0], position.v[1], position.v[2]}};
  }
)";

// As in the adapter: the origin of a primitive, the mean of a hull's vertices.
std::string center(const Shape& s, const Pose& p) {
  Vec3 mean = Vec3::Zero();
  if (const Hull* h = hull_if(s)) {
    for (const Vec3& v : h->vertices) mean += v;
    mean /= static_cast<double>(h->vertices.size());
  }
  return literals(Vec3(rotation_matrix(p.rotation) * mean + p.translation));
}

EngineSource source(const EngineQuestion& q) {
  if (q.question != Question::overlap && q.question != Question::contact)
    throw InputError("reproduce", "libccd answers overlap and contact only");
  if (!has_support(q.scene.shape_of(q.a)) || !has_support(q.scene.shape_of(q.b)))
    throw InputError("reproduce", "libccd takes bounded convex bodies only");
  const std::string method = q.engine.starts_with("libccd-mpr") ? "MPR" : "GJK";
  const std::string ask =
      q.question == Question::contact
          ? filled(ask_contact, {{"METHOD", method}})
          : fmt::format("  x.overlap = ccd{}Intersect(nullptr, nullptr, &ccd) != 0;\n", method);
  return {"-lccd", "#include <ccd/ccd.h>\n#include <ccd/vec3.h>\n",
          filled(code, {{"CENTER_A", center(q.scene.shape_of(q.a), q.body(q.a).pose)},
                        {"CENTER_B", center(q.scene.shape_of(q.b), q.body(q.b).pose)},
                        {"TUNED", q.tuned() ? std::string(tuned) : ""},
                        {"ASK", ask}})};
}

}  // namespace

SourceWriter libccd_source_writer() { return {{"libccd-"}, source}; }

}  // namespace touchstone::fuzz
