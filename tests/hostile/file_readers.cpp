#include "tests/hostile/file_readers.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "fuzz/ask/evidence.h"
#include "fuzz/campaign/answers_file.h"
#include "fuzz/campaign/shard.h"
#include "fuzz/campaign/store.h"
#include "fuzz/corpus/corpus_json.h"
#include "fuzz/shrink/reductions.h"
#include "fuzz/triage/cause_files.h"
#include "fuzz/triage/triage.h"
#include "oracles/abi/protocol.h"
#include "oracles/checker/checker.h"
#include "oracles/referee/referee.h"
#include "reports/plan/course.h"
#include "reports/plan/plan.h"
#include "reports/record/broad_certificate.h"
#include "reports/record/chart.h"
#include "reports/record/expected.h"
#include "reports/record/result.h"
#include "reports/record/stored.h"
#include "reports/text/causes_text.h"
#include "reports/text/junit.h"
#include "reports/text/record_text.h"
#include "reports/text/text.h"
#include "reports/text/web_page.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/codec/value_codec.h"
#include "scenarios/import/ccd_queries.h"
#include "scenarios/import/mesh_import.h"
#include "scenarios/import/real_scene.h"
#include "tests/reports/cause_sample.h"

namespace touchstone::test {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

void read_case(const fs::path& file) {
  const StoredCase s = load_stored_case(file);
  case_to_json(s.c);
  to_text(s);
  fuzz::measure(s.c);
}
void read_cases(const fs::path& d) { read_case(d / "case.json"); }
void read_moving(const fs::path& d) {
  const fs::path file = d / "moving.json";
  read_case(file);
  try {
    fuzz::course_of(load_case(file).scene);
  } catch (const InputError& e) {
    throw InputError(file.string(), e.what());  // as the command does
  }
}
void read_scene(const fs::path& d) { read_case(d / "scene.json"); }
void read_odd(const fs::path& d) { read_case(d / "odd.json"); }

std::string at_file(const fs::path& file, const InputError& e) {
  return file.string() + (e.place().empty() ? "" : ": " + e.place());
}

// Like `touchstone check`.
template <class Check>
void check_certificate(const fs::path& file, Check&& check) try {
  const Json j = load_json(file);
  check(j.is_object() && j.contains("certificate") ? j["certificate"] : j);
} catch (const InputError& e) {
  throw InputError(at_file(file, e), e.reason());
}

template <int number>
void read_certificate(const fs::path& d) {
  const std::string name = std::to_string(number) + ".json";
  check_certificate(d / ("certificate" + name), [&](const Json& j) {
    const auto c = certificate_from_json(j);
    const Scene s = load_case(d / ("pair" + name)).scene;
    checker::check(c, *fuzz::placed_at(s, 0, -1), *fuzz::placed_at(s, 1, -1));
  });
}

void read_impact(const fs::path& d) {
  check_certificate(d / "impact.json", [&](const Json& j) {
    const auto c = impact_certificate_from_json(j);
    const Scene s = load_case(d / "hits.json").scene;
    const auto motion = [&](std::size_t i) { return s.bodies[i].motion.value_or(Motion{}); };
    checker::check(c, *fuzz::placed_at(s, 0, -1), motion(0), *fuzz::placed_at(s, 1, -1), motion(1));
  });
}

void read_findings(const fs::path& d) {
  const fs::path finding = d / "campaign/findings/one", file = finding / "finding.json";
  const Json j = load_json(file);
  fuzz::finding_from_json(JsonReader(j, file.string())).key();
  load_case(finding / "case.json");
}

void read_causes_to_triage(const fs::path& d) {
  const fs::path campaign = d / "campaign";
  const auto causes = fuzz::stored_causes(campaign, fuzz::digest(fuzz::load_result(campaign)));
  if (!causes) return;
  for (const fuzz::Cause& c : causes->causes)
    if (!c.shown().c.is_null()) json_text(fuzz::finding_json_of(c));
}

void read_corpus(const fs::path& d) {
  for (const auto& c : fuzz::corpus::load_corpus(d / "corpus")) fuzz::corpus::check_certificates(c);
}

void read_expected(const fs::path& d) {
  const fs::path file = d / "expected.json";
  const Json j = load_json(file);
  const auto expected = fuzz::expected_from_json(JsonReader(j, file.string()));
  const fuzz::ShownFailures shown{{expected.empty() ? fuzz::AskedQuestion{} : expected[0].asked}, {}};
  const auto compared = fuzz::compare(expected, shown, "2026-11-23");
  reports::expected_text(compared);
  reports::expected_junit(shown, compared, true);
  json_text(fuzz::to_json(compared));
  json_text(fuzz::to_json(fuzz::as_shown(expected, compared, "r")));
}

void read_merged(const fs::path& d) {
  const fs::path in[] = {d / "campaign"};
  const auto merged = fuzz::merge_campaigns(d / "merged", in);
  fs::remove_all(d / "merged");
  reports::campaign_table(merged.result);
}

void read_result(const fs::path& d) {
  fuzz::load_settings(d / "campaign");
  fuzz::keys_by_case(fuzz::load_result(d / "campaign"));
}

fuzz::CampaignConfig settings_of(const fs::path& d) {
  const Json s = Json::parse(read_file(d / "half.settings"));
  fuzz::CampaignConfig c;
  c.engines = s.at("engines").get<std::vector<std::string>>();
  c.subject = s.at("subject");
  c.family = s.at("family");
  c.seed = s.at("seed");
  c.shard = s.at("shard");
  c.shards = s.at("shards");
  c.relations_every = s.at("relations_every");
  c.guided = s.at("guided");
  c.cases = s.at("cases").get<std::uint64_t>();
  c.out = d / "half";
  return c;
}

void read_resumed(const fs::path& d) {
  static const fuzz::CampaignConfig config = settings_of(d);
  if (const auto state = fuzz::load_state(config)) fuzz::digest(state->result);
}

void read_summary(const fs::path& d) {
  const fs::path file = d / "campaign/summary.json";
  const Json j = load_json(file, campaign_limits);
  const auto r = fuzz::result_from_json(JsonReader(j, file.string()));
  reports::campaign_table(r);
  reports::full_campaign_table(r);
  reports::findings_summary(r, 3);
  reports::campaign_footer(r);
  json_text(reports::findings_columns(j.at("findings")));
}

void read_broad(const fs::path& d) try {
  bool holds = false;
  const auto c = fuzz::broad_certificate_from_json(load_json(d / "broad.json"), holds);
  reports::certificate_text(c, false);
  reports::certificate_line(c);
  json_text(fuzz::to_json(c));
} catch (const InputError& e) {
  throw e.within((d / "broad.json").string());
}

void read_plan(const fs::path& d) {
  const fs::path file = d / "plan.json";
  const Json json = load_json(file);
  const JsonReader j(json, file.string());
  json_text(fuzz::to_json(fuzz::fidelity_from_json(j["run"].json(), file.string() + ": run")));
}

void read_causes(const fs::path& d) {
  const fs::path file = d / "causes.json";
  const Json j = load_json(file, campaign_limits);
  const fuzz::Causes c = fuzz::causes_from_json(JsonReader(j, file.string()));
  reports::causes_text(c, "touchstone causes");
  reports::causes_of_libraries(c, 5, [](const std::string& path) { return path; });
  for (const fuzz::Cause& cause : c.causes) reports::cause_text(cause);
  json_text(reports::causes_page(c));
}

void read_chart(const fs::path& d) {
  const fs::path file = d / "chart.json";
  const auto c = fuzz::chart_from_json(load_json(file), file.string());
  reports::chart_text(c);
  reports::chart_markdown(c);
  fuzz::to_csv(c);
  json_text(fuzz::to_json(c));
}

void read_ledger(const fs::path& d) {
  const fs::path file = d / "ledger.db";
  std::vector<fuzz::Triaged> rows;
  for (const auto& f : fuzz::Ledger(file, fuzz::Ledger::For::reading).all()) {
    rows.emplace_back().cause = f;
    try {
      if (!f.shown.empty()) fuzz::case_of(f);
    } catch (const InputError& e) {
      rows.back().trouble = e.what();
    }
  }
  reports::triage_text(rows);
  reports::triage_junit(rows);
  json_text(reports::triage_json(rows));
}

void write_ledger(const fs::path& d) {
  const fs::path file = d / "ledger.db";
  fuzz::Ledger ledger(file);
  for (const auto& f : ledger.all()) ledger.put(f);
  ledger.commit();
}

void read_recording(const fs::path& d) {
  const RealScene s = load_real_scene(d / "recording");
  for (int f = 0; f < s.frame_count(); ++f) s.frame_with_motion(f);
  if (s.frame_count() == 0) return;
  s.script(0, s.frame_count() - 1);
  try {
    fuzz::course_of(s, 2);
  } catch (const InputError& e) {
    throw InputError((d / "recording").string(), e.what());
  }
}

void read_queries(const fs::path& d) {
  for (const CcdQuery& q : load_ccd_file(d / "queries.csv", true))
    referee::judge_primitive_motion(referee::PrimitivePair::vertex_face, q.start, q.end);
}

void read_card(const fs::path& d) try {
  to_json_text(card_from_json(read_file(d / "card.json")));
} catch (const InputError& e) {
  throw InputError(at_file(d / "card.json", e), e.reason());
}

// Output of a worker, which an engine may have taken over.
void read_frames(const fs::path& d) try {
  const Scene scene = load_case(d / "pair1.json").scene;
  const std::string bytes = read_file(d / "frames.bin");
  protocol::FrameReader frames;
  frames.append(bytes.data(), bytes.size());
  while (const auto frame = frames.next()) {
    switch (frame->type) {
      case protocol::Type::hello:
        for (const std::string& card : protocol::decode_hello(frame->payload).cards) card_from_json(card);
        break;
      case protocol::Type::question:
        validate(protocol::decode_question(frame->payload).scene);
        break;
      case protocol::Type::received:
        json_text(fuzz::to_json(protocol::decode_received(frame->payload, scene).scene));
        break;
      case protocol::Type::answer:
        json_text(fuzz::to_json(protocol::decode_answer(frame->payload).observation));
        break;
    }
  }
} catch (const protocol::Malformed&) {  // malformed output of a worker counts as its crash
} catch (const InputError& e) {
  throw InputError(at_file(d / "frames.bin", e), e.reason());
}

// A damaged file is found by its checksums; `contents` are damaged behind them.
void read_answers(const fs::path& d) {
  const fuzz::AnswersFile file(d / "kept", fs::file_size(d / "kept" / fuzz::answers_file_name));
  for (const auto& block : file.blocks()) file.batch(block);
}
void read_contents(const fs::path& d) {
  const fs::path file = d / "answers.contents";
  fuzz::batch_from_bytes(read_file(file), 1, 2, file.string());
}

// No command reads meshes yet. assimp itself dies on other formats (PLY and OFF: an assertion in its
// triangulation).
template <char kind>
void read_mesh(const fs::path& d) {
  load_mesh(d / (kind == 'o' ? "mesh.obj" : "mesh.stl"));
}

// Four frames of two bodies.
std::string npy() {
  constexpr int frames = 4, bodies = 2;
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (4, 2, 7), }";
  header.resize(117, ' ');
  header += '\n';
  std::string text = "\x93NUMPY\x01" + std::string(1, '\0');
  text += static_cast<char>(header.size());
  text += '\0';
  text += header;
  for (int f = 0; f < frames; ++f)
    for (int b = 0; b < bodies; ++b)
      for (const double v : {0.9 * b, 0.01 * f, 0.0, 0.0, 0.0, 0.0, 1.0})
        text.append(reinterpret_cast<const char*>(&v), sizeof v);
  return text;
}

constexpr const char* recorded =
    "cdh-scene 1\nname small\ncounts shapes 2 bodies 3 dynamic 2 static 1 ignore 1 frames 4 cols 7\n"
    "shape 0 hull 5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\nshape 1 box 0.5 0.5 0.5\n"
    "body 0 dynamic a 1\ngeom 0 0 0 0 0 0 0 1\nbody 1 dynamic b 1\ngeom 1 0 0 0 0 0 0 1\n"
    "body 2 static c 1 0.5 0.5 0 0 0 0 1\ngeom 1 0 0 0 0 0 0 1\nignore 0 1\nend\n";

// A vertex that crosses a triangle, and one that passes it by.
constexpr const char* queries =
    "1,4,1,4,1,1,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n"
    "1,4,1,4,-1,1,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n"
    "3,1,3,1,1,1,0\n0,1,0,1,0,1,0\n1,1,0,1,0,1,0\n0,1,1,1,0,1,0\n"
    "3,1,3,1,-1,1,0\n0,1,0,1,0,1,0\n1,1,0,1,0,1,0\n0,1,1,1,0,1,0\n";

constexpr const char* moving =
    R"({"touchstone_case": 1, "scene": {"touchstone_scene": 1, "shapes": [{"type": "sphere", "radius": 0.5},
 {"type": "box", "half_extents": [1, 1, 0.1]}, {"type": "hull", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}],
 "bodies": [{"shape": 0, "pose": {"translation": [0, 0, 2], "rotation": [0, 0, 0, 1]},
 "motion": {"linear": [0, 0, -4], "angular": [0, 0, 1]}}, {"shape": 1, "motion": {"linear": [0, 0, 0], "angular": [0.1, 0, 0]}},
 {"shape": 2, "static": true, "group": 1}], "ignored": [[0, 2]]},
 "queries": [{"question": "time_of_impact", "a": 0, "b": 1}, {"question": "candidates"}]})";

constexpr const char* odd =
    R"({"touchstone_case": 1, "scene": {"touchstone_scene": 1, "shapes": [{"type": "box", "half_extents": [1, 1, 1]}],
 "bodies": [{"shape": 0}, {"shape": 0, "pose": {"translation": [3, 0, 0], "rotation": [0, 0, 0, 1]}}],
 "script": [{"op": "insert", "body": 0}, {"op": "insert", "body": 1}, {"op": "query"},
 {"op": "move", "body": 1, "pose": {"translation": [1, 0, 0], "rotation": [0, 0, 0, 1]}}, {"op": "query"}]},
 "queries": [{"question": "candidates"}], "invalid_numbers": {"/bodies/1/pose/translation/1": "NaN"}})";

constexpr const char* expected =
    R"({"touchstone_expected": 1, "failures": [
 {"case": "a", "engine": "core", "question": "contact", "fault": "infeasible", "reason": "one", "until": "2026-12-31"},
 {"case": "a", "engine": "core", "question": "overlap", "fault": "any", "reason": "two"}]})";

Body body_at(int shape, const Vec3& t) {
  Body b;
  b.shape = shape;
  b.pose.translation = t;
  return b;
}

Case pair_of(const Shape& a, const Shape& b, const Vec3& at) {
  Case c;
  c.scene.shapes = {a, b};
  c.scene.bodies = {body_at(0, Vec3::Zero()), body_at(1, at)};
  c.queries = {{Question::overlap, 0, 1}};
  return c;
}

void write_json(const fs::path& file, const Json& j) { write_file(file, json_text(j)); }

// Scenes whose certificates are of different kinds.
void write_certificates(const fs::path& d) {
  const Box box{Vec3(0.5, 0.5, 0.5)};
  const Case pairs[] = {pair_of(box, box, {1.5, 0.25, 0}), pair_of(box, box, {0.75, 0.25, 0}),
                        pair_of(Sphere{1}, box, {0.9, 0.3, 0.1}),
                        pair_of(Cylinder{0.5, 0.5}, Cone{0.5, 1}, {0.3, 0.4, 0.1})};
  for (std::size_t i = 0; i < std::size(pairs); ++i) {
    const std::string name = std::to_string(i + 1) + ".json";
    const Scene& scene = pairs[i].scene;
    const Placed a{&scene.shapes[0], scene.bodies[0].pose}, b{&scene.shapes[1], scene.bodies[1].pose};
    const auto truth = referee::judge_pair(a, b);
    write_json(d / ("pair" + name), case_to_json(pairs[i]));
    write_json(
        d / ("certificate" + name),
        touchstone::to_json(i == 0 ? truth.verdict_certificate : referee::depth_certificate(truth, a, b)));
  }
  Case hits = pair_of(box, box, {3, 0.25, 0.1});
  hits.scene.bodies[0].motion = Motion{Vec3(4, 0, 0), Vec3(0, 0.1, 0)};
  hits.queries = {{Question::time_of_impact, 0, 1}};
  write_json(d / "hits.json", case_to_json(hits));
  write_json(d / "impact.json", fuzz::exact_certificate(hits.scene, Question::time_of_impact, 0, 1));
}

Observation full_observation() {
  Observation o;
  o.outcome = Outcome::answered;
  o.overlap = true;
  o.depth = 0.5;
  o.normal = Vec3(1, 0, 0);
  o.toi = 0.25;
  o.manifold = {{Vec3(1, 2, 3), 0.5}};
  o.candidate_pairs = {{{0, 1}}, {}};
  o.contacts = {{0, 1, Vec3(0, 0, 1), 0.1}};
  o.detail = "words";
  return o;
}

ReceivedScene received_of(const Scene& sent) {
  ReceivedScene received;
  received.bodies.resize(2);
  received.shapes.resize(2);
  received.bodies[0] = Placement{};
  received.shapes[1] = sent.shapes[1];
  return received;
}

void write_contents(const fs::path& d) {
  fuzz::KeptBatch b;
  b.cases = {load_case(d / "pair1.json")};
  const CaseObservations all{received_of(b.cases[0].scene), {full_observation()}};
  b.engines.resize(2, {{all}, {{false, true, 1, all}, {true, true, 2, all}, {true, false, 3, {}}}});
  write_file(d / "answers.contents", fuzz::to_bytes(b));
}

void write_frames(const fs::path& d) {
  const Case c = load_case(d / "pair1.json");
  std::string bytes;
  EngineCard card;
  card.name = "e";
  card.library = "l";
  card.version = "1";
  write_file(d / "card.json", to_json_text(card));
  append(bytes, protocol::Hello{{to_json_text(card)}, 0, "", "none"});
  append(bytes, protocol::QuestionRef{1, 0, c.scene, c.queries});
  append(bytes, protocol::ReceivedMessage{1, received_of(c.scene)});
  const Observation o = full_observation();
  append(bytes, protocol::AnswerMessage{1, 0, o});
  write_file(d / "frames.bin", bytes);
}

// A tetrahedron and a triangle.
void write_meshes(const fs::path& d) {
  write_file(d / "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  std::string stl(80, ' ');
  const auto put = [&](const auto& v) { stl.append(reinterpret_cast<const char*>(&v), sizeof v); };
  put(std::uint32_t{1});
  for (const float v : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) put(v);
  put(std::uint16_t{0});
  write_file(d / "mesh.stl", stl);
}

// One case at rest and one in motion.
void write_corpus(const fs::path& d) {
  Json corpus = Json::parse(read_file(TS_SOURCE_DIR "/corpus/cases/handmade.json"));
  Json chosen = Json::array();
  for (const char* questions : {"overlap", "time_of_impact"})
    for (const Json& c : corpus["cases"])
      if (c["questions"][0] == questions) {
        chosen.push_back(c);
        break;
      }
  corpus["cases"] = chosen;
  fs::create_directories(d / "corpus/cases");
  write_json(d / "corpus/cases/one.json", corpus);
}

void write_chart(const fs::path& d) {
  Json chart = Json::parse(read_file(TS_SOURCE_DIR "/docs/chart.json"));
  Json& rows = chart["rows"];
  rows.erase(rows.begin() + std::min<std::ptrdiff_t>(12, static_cast<std::ptrdiff_t>(rows.size())),
             rows.end());
  write_json(d / "chart.json", chart);
  write_json(d / "causes.json", fuzz::to_json(sample_causes()));
}

}  // namespace

const std::vector<FileReader>& file_readers() {
  static const std::vector<FileReader> all{
      {"case", {"case.json"}, read_cases},
      {"moving case", {"moving.json"}, read_moving},
      {"scene", {"scene.json"}, read_scene},
      {"case with odd numbers", {"odd.json"}, read_odd},
      {"plane", {"certificate1.json"}, read_certificate<1>},
      {"depth of polytopes", {"certificate2.json"}, read_certificate<2>},
      {"depth of a sphere", {"certificate3.json"}, read_certificate<3>},
      {"depth of round shapes", {"certificate4.json"}, read_certificate<4>},
      {"impact", {"impact.json"}, read_impact},
      {"finding", {"campaign/findings/one/finding.json", "campaign/findings/one/case.json"}, read_findings},
      {"causes to triage", {"campaign/causes.json"}, read_causes_to_triage},
      {"corpus", {"corpus/cases/one.json"}, read_corpus},
      {"expected failures", {"expected.json"}, read_expected},
      {"state to merge", {"campaign/state.json"}, read_merged},
      {"state to read", {"campaign/state.json"}, read_result},
      {"state to resume", {"half/state.json"}, read_resumed},
      {"summary", {"campaign/summary.json"}, read_summary},
      {"kept answers", {"kept/answers.bin"}, read_answers},
      {"contents of kept answers", {"answers.contents"}, read_contents},
      {"certificate of a broad phase", {"broad.json"}, read_broad},
      {"plan", {"plan.json"}, read_plan},
      {"chart", {"chart.json"}, read_chart},
      {"causes", {"causes.json"}, read_causes},
      {"ledger", {"ledger.db"}, read_ledger},
      {"ledger, written", {"ledger.db"}, write_ledger},
      {"recording", {"recording/scene.txt", "recording/frames.npy", "recording/frames.csv"}, read_recording},
      {"queries of deforming primitives", {"queries.csv"}, read_queries},
      {"card", {"card.json"}, read_card},
      {"frames of a worker", {"frames.bin"}, read_frames},
      {"mesh, OBJ", {"mesh.obj"}, read_mesh<'o'>},
      {"mesh, STL", {"mesh.stl"}, read_mesh<'s'>}};
  return all;
}

void write_plain_originals(const fs::path& d) {
  fs::create_directories(d / "recording");
  write_file(d / "recording/scene.txt", recorded);
  write_file(d / "recording/frames.npy", npy());
  write_file(d / "recording/frames.csv", "frame,segment,kind\n0,0,a\n1,0,a\n2,0,a\n3,1,b\n");
  write_file(d / "queries.csv", queries);
  write_file(d / "moving.json", moving);
  write_file(d / "odd.json", odd);
  write_file(d / "expected.json", expected);
  write_json(d / "scene.json", Json::parse(moving)["scene"]);
  write_certificates(d);
  write_frames(d);
  write_contents(d);
  write_meshes(d);
  write_chart(d);
  write_corpus(d);
}

}  // namespace touchstone::test
