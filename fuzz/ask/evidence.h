// Finds the certificates that prove a finding.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>

#include "reports/record/result.h"

namespace touchstone::fuzz {

/// About the motion during the step, rather than about poses.
constexpr bool is_of_motion(Question q) { return is_motion_question(q); }

/// Certificates found so far, by (index of the case, motion?, A, B, step): engines that fail in the same way
/// on a case share them, since one may take seconds of exact arithmetic.
using CaseCertificates = std::map<std::tuple<std::uint64_t, bool, int, int, int>, Json>;

/// Whether certificates that need exact arithmetic are made at once, or left to deferred_certificate.
enum class ExactCertificates : std::uint8_t { now, later };

/// Fills in Finding::evidence_json, unless that is done already or there is no evidence. The certificate is
/// one that the checker accepts, if there is one, and names its "bodies" [A, B] and "step". One that is left
/// for later has the kind "deferred", the question, and the certificate of the answer that was found wrong.
void write_evidence(Finding& f, CaseCertificates& found, ExactCertificates when = ExactCertificates::now);
void write_evidence(Finding& f);
/// Of all findings of the result.
void write_evidence(CampaignResult& r);

/// Makes the certificate that `deferred` stands for, from the case and the observation of the same finding.
/// Throws InputError, which names `file`, when `deferred` is damaged or does not fit the case.
Json deferred_certificate(const Case& c, const Json& observation, const Json& deferred,
                          const std::string& file);
bool is_deferred(const Json& certificate);

/// The body at its own pose (step < 0), or at its pose in that query of the script; nullopt when it is not
/// there.
std::optional<Placed> placed_at(const Scene& s, int body, int step);

/// The referee's certificate of the verdict on two bodies (for time_of_impact: of the first contact) in a
/// form that the checker accepts, with its "bodies" and "step"; null when there is no such form.
Json exact_certificate(const Scene& s, Question q, int a, int b, int step = -1);

}  // namespace touchstone::fuzz
