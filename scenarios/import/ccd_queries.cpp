#include "scenarios/import/ccd_queries.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "scenarios/import/text_lines.h"

namespace touchstone {
namespace {

// A decimal integer that is exactly a double: printf prints the double in full, and the text must be the
// same.
double exact_integer(const TextLines& in, std::size_t i) {
  const std::string text(in.token(i));
  const bool digits =
      !text.empty() && text.find_first_not_of("0123456789", text.front() == '-' ? 1 : 0) == std::string::npos;
  const auto v = digits ? double_from_text(text) : std::nullopt;
  if (!v) in.fail("\"" + text + "\" is not an integer");
  char printed[320];
  std::snprintf(printed, sizeof printed, "%.0f", *v);
  if (text != printed) in.fail("\"" + text + "\" is not exactly a double");
  return *v;
}

double exact_quotient(const TextLines& in, std::size_t i) {
  const double n = exact_integer(in, i), d = exact_integer(in, i + 1);
  if (!(d > 0)) in.fail("a denominator must be > 0");
  const double q = n / d;
  if (std::fma(q, d, -n) != 0) in.fail("a coordinate is not exactly a double");
  return q;
}

bool zero_or_one(const TextLines& in, std::size_t i) { return in.integer(i, 0, 1) == 1; }

CcdTruth read_truth(const TextLines& in) {
  CcdTruth t;
  if (!in.token(3).empty()) t.source_truth = zero_or_one(in, 3);
  t.collides = zero_or_one(in, 4);
  if (t.collides != !in.token(5).empty() || t.collides != !in.token(6).empty())
    in.fail("a time of impact must be given exactly when there is contact");
  if (t.collides) {
    t.toi_lo = in.number(5);
    t.toi_hi = in.number(6);
  }
  if (t.toi_lo > t.toi_hi) in.fail("toi_lo is larger than toi_hi");
  if (!zero_or_one(in, 8)) t.coplanar_times = in.integer(7);
  return t;
}

}  // namespace

std::vector<CcdQuery> load_ccd_file(const std::filesystem::path& file, bool is_vertex_face) {
  TextLines in(file, ',');
  std::vector<CcdQuery> queries;
  while (in.next()) {
    CcdQuery q;
    q.file = file.filename().string();
    q.index = static_cast<int>(queries.size());
    q.is_vertex_face = is_vertex_face;
    for (std::size_t row = 0; row < 8; ++row) {
      if (row > 0) in.need("row " + std::to_string(row + 1) + " of 8 of a query");
      in.need_tokens(7);
      const Vec3 p(exact_quotient(in, 0), exact_quotient(in, 2), exact_quotient(in, 4));
      (row < 4 ? q.start : q.end)[row % 4] = p;
      const bool truth = zero_or_one(in, 6);
      if (row > 0 && truth != q.file_truth) in.fail("the rows of one query disagree in their last column");
      q.file_truth = truth;
    }
    queries.push_back(q);
  }
  return queries;
}

std::vector<CcdQuery> load_ccd_set(const std::filesystem::path& directory) {
  TextLines in(directory / "truth.csv", ',');
  in.need_header("file,query,kind,source_truth,exact_truth,toi_lo,toi_hi,coplanar_times,always_coplanar");
  std::map<std::string, std::vector<CcdQuery>> files;
  std::vector<CcdQuery> all;
  while (in.next()) {
    in.need_tokens(9);
    const std::string file(in.token(0));
    const bool vertex_face = in.token(2) == "vf";
    if (!vertex_face && in.token(2) != "ee") in.fail("kind must be vf or ee");
    auto it = files.find(file);
    if (it == files.end()) it = files.emplace(file, load_ccd_file(directory / file, vertex_face)).first;
    const int index = in.integer(1, 0, static_cast<int>(it->second.size()) - 1);
    CcdQuery q = it->second[static_cast<std::size_t>(index)];
    if (q.is_vertex_face != vertex_face) in.fail("kind differs from the other rows of this file");
    q.file = file;
    q.truth = read_truth(in);
    all.push_back(std::move(q));
  }
  return all;
}

}  // namespace touchstone
