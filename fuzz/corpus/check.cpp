#include "fuzz/corpus/corpus_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "oracles/checker/checker.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/value_codec.h"

namespace touchstone::fuzz::corpus {
namespace {

using Kind = Certificate::Kind;

/// By how much a certificate may prove less than the bracket of the gap says, as a share of the scale: the
/// points of certificates are rounded, and cancel. Tested by: tests/fuzz "certificates of a corpus are
/// checked".
constexpr double rounding_of_points = 0x1p-40;

class Checking {
 public:
  explicit Checking(const StoredCorpusCase& c)
      : case_(c),
        truth_(c.truth, c.place, "truth"),
        a_{&c.scene.shape_of(0), c.scene.bodies[0].pose},
        b_{&c.scene.shape_of(1), c.scene.bodies[1].pose} {}

  CheckedCase run() {
    if (questions_about(case_.scene)[0] != Question::time_of_impact)
      pair();
    else if (truth_["certificates"].has("impact"))
      impact();
    return result_;
  }

 private:
  void refuse(const std::string& name, const std::string& why) {
    if (result_.refused.empty()) result_.refused = name + ": " + why;
  }

  // Counts the certificate if it holds and `proves`.
  bool take(const char* name, bool holds, bool proves) {
    if (!holds)
      refuse(name, "does not hold");
    else if (!proves)
      refuse(name, "does not prove what the case says");
    else
      ++result_.certificates;
    return holds && proves;
  }

  void pair() {
    const JsonReader certificates = truth_["certificates"];
    const bool overlap = truth_["verdict"].string() == "overlap";
    const auto gap = truth_["gap"].items(2);
    const double slack = rounding_of_points * scale_of_pair(case_.scene, 0, 1);
    int missing = 3;
    const auto each = [&](const char* name, auto proves) {
      if (!certificates.has(name)) return;
      const Certificate c = certificate_from_json(certificates[name].json());
      missing -= take(name, checker::check(c, a_, b_), proves(c));
    };
    each("verdict", [&](const Certificate& c) {
      return c.kind == (overlap ? Kind::common_point : Kind::separating_plane);
    });
    each("at_least", [&](const Certificate& c) {
      return c.kind == Kind::depth_direction && -c.offset >= gap[0].number() - slack;
    });
    each("at_most", [&](const Certificate& c) {
      return c.kind == Kind::inner_polytope && -c.offset <= gap[1].number() + slack;
    });
    result_.complete = missing == 0;
  }

  void impact() {
    const ImpactCertificate c = impact_certificate_from_json(truth_["certificates"]["impact"].json());
    const auto motion = [&](std::size_t i) { return case_.scene.bodies[i].motion.value_or(Motion{}); };
    const bool hit = truth_["verdict"].string() == "hit";
    const bool holds = checker::check(c, a_, motion(0), b_, motion(1));
    const bool proves = hit ? c.contact.has_value() || !c.tracks.empty() : !c.contact && c.clear_until == 1;
    const bool taken = take("impact", holds, proves);
    const bool starts_clear = hit && truth_["time"].items(2)[0].number() > 0;
    result_.complete = taken && (!hit || c.contact) && (!starts_clear || !c.tracks.empty());
  }

  const StoredCorpusCase& case_;
  JsonReader truth_;
  Placed a_, b_;
  CheckedCase result_;
};

}  // namespace

CheckedCase check_certificates(const StoredCorpusCase& c) try {
  return Checking(c).run();
} catch (const InputError& e) {
  if (e.place().starts_with(c.place)) throw;
  throw InputError(c.place + ": " + e.place(), e.reason());
}

}  // namespace touchstone::fuzz::corpus
