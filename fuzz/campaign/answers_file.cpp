#include "fuzz/campaign/answers_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>

#include "core/base/input_error.h"
#include "oracles/abi/protocol.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/value_codec.h"
#include "scenarios/text/printable.h"

namespace touchstone::fuzz {
namespace {

using protocol::Malformed;
using protocol::Reader;
using protocol::Writer;

constexpr int version = 1;
constexpr std::string_view file_magic = "TSANSWER";
constexpr std::uint32_t block_magic = 0x4b4c4254;  // "TBLK"
constexpr std::size_t header_start = 16, block_start = 28;

// Bounds on what is read, so that a damaged file takes little memory. A chunk has 32 cases of some kilobytes.
constexpr std::uint32_t max_header_bytes = 1 << 20, max_contents = 1 << 28, max_cases = 1 << 12;
// Each takes some hundred bytes in memory.
constexpr std::size_t max_observations = 1 << 18, max_received = 1 << 21;
constexpr JsonLimits case_limits{max_contents, 2'000'000};
// Deflate never makes more of a byte than this.
constexpr std::uint64_t max_expansion = 1032;

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<z_size_t>(bytes.size())));
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::runtime_error("zlib could not compress the answers");
  out.resize(size);
  return out;
}

std::string inflated(std::string_view stream, std::uint32_t length, const std::string& place) {
  std::string out(length, '\0');
  uLongf size = length;
  if (uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(stream.data()),
                 static_cast<uLong>(stream.size())) != Z_OK ||
      size != length)
    throw InputError(place, "is damaged: its zlib stream does not hold what it announces");
  return out;
}

Json shape_kinds() {
  Json kinds = Json::array();
  for (int i = 0; i < shape_kind_count; ++i) kinds.push_back(type_name(static_cast<ShapeKind>(i)));
  return kinds;
}

void put_observations(Writer& w, const CaseObservations& all) {
  protocol::put_received(w, all.received);
  w.count(all.answers.size());
  for (const Observation& o : all.answers) {
    protocol::put_observation(w, o);
    w.text(o.site);
  }
}

// Grouped by question: engines give similar answers, which zlib finds only if they are close together.
void put_later(Writer& w, const std::vector<KeptAnswers>& engines) {
  struct Given {
    std::size_t engine;
    const LaterAnswer* answer;
  };
  std::vector<std::vector<Given>> groups;
  std::map<std::pair<bool, std::uint64_t>, std::size_t> group_of;
  for (std::size_t e = 0; e < engines.size(); ++e)
    for (const LaterAnswer& a : engines[e].later) {
      const auto [it, is_new] = group_of.emplace(std::pair(a.again, a.case_hash), groups.size());
      if (is_new) groups.emplace_back();
      groups[it->second].push_back({e, &a});
    }
  w.count(groups.size());
  for (const auto& group : groups) {
    const LaterAnswer& first = *group.front().answer;
    w.put(static_cast<std::uint8_t>(first.again)).put(first.case_hash).count(group.size());
    for (const Given& g : group) {
      w.put(static_cast<std::uint16_t>(g.engine)).put(static_cast<std::uint8_t>(g.answer->supported));
      put_observations(w, g.answer->observations);
    }
  }
}

class BatchReader {
 public:
  BatchReader(std::string_view bytes, const std::string& place) : r_(bytes), place_(place) {}

  KeptBatch batch(std::uint32_t cases, std::size_t engines) {
    KeptBatch b;
    b.engines.resize(engines);
    for (std::uint32_t i = 0; i < cases; ++i) {
      b.cases.push_back(next_case(fmt::format("{}, case {}", place_, i)));
      const Case& c = b.cases.back();
      for (KeptAnswers& e : b.engines) {
        e.cases.push_back(observations(c.scene));
        if (!fits(e.cases.back(), c)) throw Malformed("answers that do not fit their case");
      }
      // Derived cases have no more shapes and bodies than theirs.
      largest_.shapes.resize(std::max(largest_.shapes.size(), 2 * c.scene.shapes.size()));
      largest_.bodies.resize(std::max(largest_.bodies.size(), 2 * c.scene.bodies.size()));
    }
    constexpr std::size_t least_bytes = 13;
    for (std::size_t n = r_.count(least_bytes); n > 0; --n) read_later(b.engines);
    r_.finish();
    return b;
  }

 private:
  Case next_case(const std::string& place) {
    return campaign_case(parse_json(r_.text(), place, case_limits), place);
  }

  CaseObservations observations(const Scene& scene) {
    CaseObservations all;
    all.received = protocol::get_received(r_, scene);
    if ((received_ += all.received.shapes.size() + all.received.bodies.size()) > max_received)
      throw Malformed("too many bodies");
    constexpr std::size_t least_bytes = 27;
    const std::size_t n = r_.count(least_bytes);
    if ((observed_ += n) > max_observations) throw Malformed("too many answers");
    all.answers.resize(n);
    for (Observation& o : all.answers) {
      o = protocol::get_observation(r_);
      o.site = printable(r_.text());
    }
    return all;
  }

  void read_later(std::vector<KeptAnswers>& engines) {
    LaterAnswer a;
    a.again = r_.flag();
    a.case_hash = r_.get<std::uint64_t>();
    constexpr std::size_t least_bytes = 15;
    for (std::size_t n = r_.count(least_bytes); n > 0; --n) {
      const auto engine = r_.get<std::uint16_t>();
      if (engine >= engines.size()) throw Malformed("an answer of an engine without a card");
      a.supported = r_.flag();
      if (++observed_ > max_observations) throw Malformed("too many answers");
      a.observations = observations(largest_);
      engines[engine].later.push_back(a);
    }
  }

  Reader r_;
  const std::string& place_;
  Scene largest_;  // as many shapes and bodies as any scene of the batch may have
  std::size_t observed_ = 0, received_ = 0;
};

[[noreturn]] void fail_to_write(const std::filesystem::path& file) {
  throw InputError(file.string(), std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace

std::string answers_header(const std::vector<EngineCard>& cards) {
  Json j = {{"touchstone_answers", version}, {"protocol", protocol::version}, {"shapes", shape_kinds()}};
  j["cards"] = Json::array();
  for (const EngineCard& c : cards) j["cards"].push_back(Json::parse(to_json_text(c)));
  const std::string text = json_text(j);
  std::string out(file_magic);
  Writer(out).put(static_cast<std::uint32_t>(text.size())).put(crc_of(text));
  return out + text;
}

std::string to_bytes(const KeptBatch& b) {
  std::string out;
  Writer w(out);
  for (std::size_t i = 0; i < b.cases.size(); ++i) {
    w.text(json_text(case_to_json(b.cases[i])));
    for (const KeptAnswers& e : b.engines) put_observations(w, e.cases[i]);
  }
  put_later(w, b.engines);
  return out;
}

KeptBatch batch_from_bytes(std::string_view bytes, std::uint32_t cases, std::size_t engines,
                           const std::string& place) try {
  return BatchReader(bytes, place).batch(cases, engines);
} catch (const Malformed& e) {
  throw InputError(place, std::string("is damaged: ") + e.what());
}

std::string answers_block(const KeptBatch& batch) {
  const std::string contents = to_bytes(batch);
  if (contents.size() > max_contents)
    throw InputError("--keep-answers",
                     fmt::format("the answers to {} cases take {} MiB; at most {} are kept",
                                 batch.cases.size(), contents.size() >> 20, max_contents >> 20));
  const std::string stream = deflated(contents);
  std::string rest;
  Writer(rest)
      .put(batch.first_index)
      .put(static_cast<std::uint32_t>(batch.cases.size()))
      .put(static_cast<std::uint32_t>(contents.size()))
      .put(static_cast<std::uint32_t>(stream.size()));
  rest += stream;
  std::string out;
  Writer(out).put(block_magic).put(crc_of(rest));
  return out + rest;
}

AnswersWriter::AnswersWriter(const std::filesystem::path& directory, std::uint64_t bytes)
    : file_(directory / answers_file_name), bytes_(bytes) {
  fd_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  struct stat status {};
  if (fd_ < 0 || fstat(fd_, &status) != 0) fail_to_write(file_);
  if (!S_ISREG(status.st_mode)) throw InputError(file_.string(), "is not a file");
  if (static_cast<std::uint64_t>(status.st_size) < bytes)
    throw InputError(file_.string(), fmt::format("has {} bytes, but the campaign has written {}: truncated",
                                                 status.st_size, bytes));
  if (ftruncate(fd_, static_cast<off_t>(bytes)) != 0) fail_to_write(file_);
}

AnswersWriter::~AnswersWriter() {
  if (fd_ >= 0) close(fd_);
}

void AnswersWriter::start(const std::string& header) {
  if (bytes_ == 0) return append(header);
  std::string there(header.size(), '\0');
  if (pread(fd_, there.data(), there.size(), 0) != static_cast<ssize_t>(there.size()) || there != header)
    throw InputError(file_.string(),
                     "was begun with other engines, or by another version; give another --out, or --fresh");
}

void AnswersWriter::append(const std::string& block) {
  for (std::size_t done = 0; done < block.size();) {
    const ssize_t n =
        pwrite(fd_, block.data() + done, block.size() - done, static_cast<off_t>(bytes_ + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_to_write(file_);
    done += static_cast<std::size_t>(n);
  }
  bytes_ += block.size();
}

AnswersFile::AnswersFile(const std::filesystem::path& directory, std::uint64_t bytes)
    : file_(directory / answers_file_name), bytes_(bytes) {
  require_regular_file(file_);
  const auto size = std::filesystem::file_size(file_);
  if (size < bytes)
    throw InputError(file_.string(),
                     fmt::format("has {} bytes, but the campaign has written {}: truncated", size, bytes));
  read_header();
  find_blocks();
}

std::string AnswersFile::place(std::uint64_t offset) const {
  return fmt::format("{}: byte {}", file_.string(), offset);
}

// `n` is bounded by the caller.
std::string AnswersFile::read(std::uint64_t offset, std::uint64_t n) const {
  if (offset > bytes_ || n > bytes_ - offset) throw InputError(place(offset), "the file ends early");
  std::ifstream in(file_, std::ios::binary);
  std::string bytes(n, '\0');
  in.seekg(static_cast<std::streamoff>(offset));
  if (!in.read(bytes.data(), static_cast<std::streamsize>(n)))
    throw InputError(place(offset), "cannot be read");
  return bytes;
}

void AnswersFile::read_header() {
  header_ = read(0, header_start);
  if (!header_.starts_with(file_magic)) throw InputError(place(0), "is not a file of kept answers");
  Reader r(std::string_view(header_).substr(file_magic.size()));
  const auto length = r.get<std::uint32_t>(), crc = r.get<std::uint32_t>();
  if (length > max_header_bytes) throw InputError(place(file_magic.size()), "announces too long a header");
  const std::string text = read(header_start, length);
  if (crc_of(text) != crc)
    throw InputError(place(header_start), "the header is damaged: its checksum differs");
  header_ += text;
  const Json json = parse_json(text, place(header_start), {});
  const JsonReader j(json, place(header_start));
  if (j["touchstone_answers"].integer() != version || j["protocol"].integer() != protocol::version)
    j.fail(fmt::format("was written by another version; this build reads version {} with protocol {}",
                       version, protocol::version));
  // Kinds that were added since do not change the numbers of those before.
  const Json known = shape_kinds();
  const auto kinds = j["shapes"].items();
  if (kinds.size() > known.size() ||
      !std::equal(kinds.begin(), kinds.end(), known.begin(),
                  [](const JsonReader& kind, const Json& name) { return kind.json() == name; }))
    j["shapes"].fail("are not those of this build");
  for (const JsonReader& card : j["cards"].items()) try {
      cards_.push_back(card_from_json(card.json().dump()));
    } catch (const InputError& e) {
      throw InputError(card.place(), e.what());
    }
}

void AnswersFile::find_blocks() {
  for (std::uint64_t at = header_.size(), next_index = 0; at < bytes_;) {
    const std::string bytes = read(at, block_start);
    Reader r(bytes);
    const auto magic = r.get<std::uint32_t>();
    r.get<std::uint32_t>();
    Block b;
    b.offset = at;
    b.first_index = r.get<std::uint64_t>();
    b.cases = r.get<std::uint32_t>();
    b.length = r.get<std::uint32_t>();
    b.stored = r.get<std::uint32_t>();
    if (magic != block_magic) throw InputError(place(at), "is not the start of a block");
    if (b.cases == 0 || b.cases > max_cases || b.first_index < next_index || b.first_index > UINT64_MAX / 2)
      throw InputError(place(at), "a block of impossible cases");
    if (b.length > max_contents || b.length > max_expansion * b.stored)
      throw InputError(place(at), fmt::format("a block announces {} bytes of contents", b.length));
    if (b.stored > bytes_ - at - block_start) throw InputError(place(at), "the file ends inside of a block");
    next_index = b.first_index + b.cases;
    at += block_start + b.stored;
    blocks_.push_back(b);
  }
}

std::string AnswersFile::block(const Block& b) const {
  std::string bytes = read(b.offset, block_start + b.stored);
  Reader r(std::string_view(bytes).substr(4));
  if (crc_of(std::string_view(bytes).substr(8)) != r.get<std::uint32_t>())
    throw InputError(place(b.offset), "the block is damaged: its checksum differs");
  return bytes;
}

KeptBatch AnswersFile::batch(const Block& b) const {
  const std::string at = place(b.offset);
  KeptBatch batch = batch_from_bytes(inflated(std::string_view(block(b)).substr(block_start), b.length, at),
                                     b.cases, cards_.size(), at);
  batch.first_index = b.first_index;
  return batch;
}

}  // namespace touchstone::fuzz
