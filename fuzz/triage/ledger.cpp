#include "fuzz/triage/ledger.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <string_view>
#include <system_error>

#include "core/base/input_error.h"
#include "reports/record/stored.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/iso_date.h"
#include "scenarios/text/printable.h"

namespace touchstone::fuzz {
namespace {

constexpr int application_id = 0x54534c32;  // "TSL2", in the header of the file
constexpr int of_findings = 0x54534c31;     // "TSL1": a ledger whose rows are findings
constexpr int busy_ms = 60'000;
constexpr int max_field_bytes = 64 << 20;  // the largest is a case
constexpr std::uintmax_t max_file_bytes = std::uintmax_t{1} << 30;
constexpr std::uintmax_t max_journal_bytes = 2 * max_file_bytes;

// SQLite stores the text of a table definition exactly as written.
constexpr const char* schema =
    "CREATE TABLE cause("
    "id TEXT PRIMARY KEY, path TEXT, title TEXT, documented TEXT, severity TEXT, engines TEXT, shapes TEXT, "
    "first_seen TEXT, last_seen TEXT, first_build TEXT, last_build TEXT, "
    "count INTEGER, bodies INTEGER, steps INTEGER, bits INTEGER, "
    "engine TEXT, key TEXT, shown TEXT, words TEXT, expired TEXT, reason TEXT, until TEXT)";

constexpr const char* columns =
    "id, path, title, documented, severity, engines, shapes, first_seen, last_seen, first_build, last_build, "
    "count, bodies, steps, bits, engine, key, shown, words, expired, reason, until";

constexpr std::array texts_before{&KnownCause::id, &KnownCause::path, &KnownCause::title,
                                  &KnownCause::documented};
constexpr std::array lists{&KnownCause::engines, &KnownCause::shapes};
constexpr std::array sightings{&KnownCause::first_seen, &KnownCause::last_seen, &KnownCause::first_build,
                               &KnownCause::last_build};
constexpr std::array texts_after{&KnownCause::engine, &KnownCause::key,     &KnownCause::shown,
                                 &KnownCause::words,  &KnownCause::expired, &KnownCause::reason,
                                 &KnownCause::until};

}  // namespace

namespace {

// SQLite deletes the file that a journal names as its super-journal. A ledger's own journal never names one,
// because a ledger is never changed together with another database. Format:
// https://www.sqlite.org/fileformat2.html#the_rollback_journal.
void refuse_journal_of_another(const std::filesystem::path& ledger) {
  constexpr std::string_view super_journal_magic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  const std::filesystem::path journal = ledger.string() + "-journal";
  std::error_code ec;
  std::string text;
  try {
    if (std::filesystem::exists(journal, ec)) text = read_file(journal, max_journal_bytes);
  } catch (const InputError&) {
    if (std::filesystem::exists(journal, ec)) throw;  // otherwise another run has just ended
  }
  if (text.ends_with(super_journal_magic))
    throw InputError(journal.string(), "names another file, which the journal of a ledger never does");
}

}  // namespace

struct Ledger::Database {
  std::string file;
  sqlite3* handle = nullptr;

  Database(const std::filesystem::path& path, For purpose) : file(path.string()) {
    std::error_code ec;
    if (purpose == For::reading || std::filesystem::exists(path, ec)) require_regular_file(path);
    if (std::filesystem::file_size(path, ec) > max_file_bytes && !ec)
      throw InputError(file, "is too large for a ledger");
    refuse_journal_of_another(path);
    const int flags =
        purpose == For::reading ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    const int code = sqlite3_open_v2(file.c_str(), &handle, flags, nullptr);
    if (code != SQLITE_OK) {
      const std::string why = handle ? sqlite3_errmsg(handle) : sqlite3_errstr(code);
      sqlite3_close(handle);
      throw InputError(file, "cannot be opened as a ledger: " + why);
    }
    harden();
  }
  // Rolls back an open transaction.
  ~Database() { sqlite3_close(handle); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  [[noreturn]] void fail() const { throw InputError(file, std::string("ledger: ") + sqlite3_errmsg(handle)); }
  void run(const char* sql) const {
    if (sqlite3_exec(handle, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
  }

 private:
  // As https://www.sqlite.org/security.html recommends for untrusted files.
  void harden() const {
    for (const int feature :
         {SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_TRUSTED_SCHEMA})
      sqlite3_db_config(handle, feature, 0, nullptr);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, max_field_bytes);
    sqlite3_exec(handle, "PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0", nullptr, nullptr, nullptr);
  }
};

namespace {

class Statement {
 public:
  Statement(sqlite3* db, const std::string& sql) {
    ok_ = sqlite3_prepare_v2(db, sql.c_str(), -1, &s_, nullptr) == SQLITE_OK;
  }
  ~Statement() { sqlite3_finalize(s_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  bool ok() const { return ok_; }
  void bind(const std::string& text) {
    const std::string v = valid_utf8(text);
    ok_ = ok_ && sqlite3_bind_text(s_, ++bound_, v.data(), static_cast<int>(v.size()), SQLITE_TRANSIENT) ==
                     SQLITE_OK;
  }
  /// The database has signed numbers.
  void bind(std::uint64_t v) {
    const auto n =
        static_cast<sqlite3_int64>(std::min(v, std::uint64_t{std::numeric_limits<sqlite3_int64>::max()}));
    ok_ = ok_ && sqlite3_bind_int64(s_, ++bound_, n) == SQLITE_OK;
  }
  /// Returns true if there is a row, false at the end or after an error (see ok()).
  bool step() {
    if (!ok_) return false;
    const int code = sqlite3_step(s_);
    ok_ = code == SQLITE_ROW || code == SQLITE_DONE;
    return code == SQLITE_ROW;
  }
  std::string text(int column) const {
    const auto* p = reinterpret_cast<const char*>(sqlite3_column_text(s_, column));
    return p ? std::string(p, static_cast<std::size_t>(sqlite3_column_bytes(s_, column))) : std::string();
  }
  std::int64_t number(int column) const { return sqlite3_column_int64(s_, column); }
  /// SQLITE_TEXT, SQLITE_INTEGER, ...: any column may hold any of them.
  int type(int column) const { return sqlite3_column_type(s_, column); }

 private:
  sqlite3_stmt* s_ = nullptr;
  int bound_ = 0;
  bool ok_ = false;
};

std::string text_of(const Statement& s, int column, const std::string& file) {
  std::string text = s.text(column);
  if (s.type(column) != SQLITE_TEXT || valid_utf8(text) != text)
    throw InputError(file, fmt::format("ledger: column {} of a row is not text", column));
  return printable(text, "\n\t");
}

std::uint64_t count_of(const Statement& s, int column, const std::string& file) {
  if (s.type(column) != SQLITE_INTEGER || s.number(column) < 0)
    throw InputError(file, fmt::format("ledger: column {} of a row is not a count", column));
  return static_cast<std::uint64_t>(s.number(column));
}

Severity severity_in(const Statement& s, int column, const std::string& file) {
  const std::string name = text_of(s, column, file);
  const auto at = std::find(severity_names.begin(), severity_names.end(), name);
  if (at == severity_names.end())
    throw InputError(file, "ledger: a row has an unknown severity: " + printable(name));
  return static_cast<Severity>(at - severity_names.begin());
}

std::vector<std::string> list_of(const Statement& s, int column, const std::string& file) {
  const std::string place = file + ": ledger: a list of a row";
  const Json j = parse_json(text_of(s, column, file), place);
  std::vector<std::string> list;
  for (const JsonReader& item : JsonReader(j, place).items()) list.push_back(item.string());
  return list;
}

bool is_list(const std::vector<std::string>& list) {
  return std::all_of(list.begin(), list.end(), [](const std::string& s) { return printable(s) == s; }) &&
         std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
}

// Why a row cannot be one of a ledger, or "". Ids name directories (triage --reproducers).
std::string complaint(const KnownCause& k) {
  if (!is_cause_id(k.id)) return "the id of a row is not the id of a cause: " + printable(k.id);
  if (!is_list(k.engines) || !is_list(k.shapes))
    return "a list of row " + k.id + " is not one of sorted words";
  const bool has_no_case = k.engine.empty() && k.key.empty() && k.shown.empty();
  if (!has_no_case && (k.shown.empty() || !finding_of_key(k.engine, k.key)))
    return "the key of row " + k.id + " is not one of its engine: " + printable(k.key);
  const bool is_not_suppressed = k.reason.empty() && k.until.empty();
  if (!is_not_suppressed && (k.reason.empty() || !is_iso_date(k.until)))
    return "row " + k.id + " is suppressed without a reason or a date";
  return "";
}

KnownCause row(const Statement& s, const std::string& file) {
  KnownCause k;
  int i = 0;
  for (const auto field : texts_before) k.*field = text_of(s, i++, file);
  k.severity = severity_in(s, i++, file);
  for (const auto field : lists) k.*field = list_of(s, i++, file);
  for (const auto field : sightings) k.*field = text_of(s, i++, file);
  k.count = count_of(s, i++, file);
  k.size.bodies = count_of(s, i++, file);
  k.size.steps = count_of(s, i++, file);
  k.size.bits = count_of(s, i++, file);
  for (const auto field : texts_after) k.*field = text_of(s, i++, file);
  if (const std::string why = complaint(k); !why.empty()) throw InputError(file, "ledger: " + why);
  return k;
}

std::size_t bytes_of(const KnownCause& k) {
  std::size_t n = 0;
  for (const auto field : texts_before) n += (k.*field).size();
  for (const auto field : lists)
    for (const std::string& item : k.*field) n += item.size();
  for (const auto field : sightings) n += (k.*field).size();
  for (const auto field : texts_after) n += (k.*field).size();
  return n;
}

int pragma(sqlite3* db, const char* name) {
  Statement s(db, std::string("PRAGMA ") + name);
  return s.step() ? static_cast<int>(s.number(0)) : -1;
}

// Stops at the first object that does not belong to a ledger, without reading or running it.
enum class Holds { nothing, causes, findings, something_else };
Holds contents(sqlite3* db, const std::string& file) {
  Statement s(db, "SELECT type, name, tbl_name, sql FROM sqlite_master");
  Holds holds = Holds::nothing;
  while (s.step()) {
    const bool is_table = s.text(0) == "table" && s.text(1) == "cause" && s.text(3) == schema;
    const bool is_its_index = s.text(0) == "index" && s.text(1) == "sqlite_autoindex_cause_1" &&
                              s.text(2) == "cause" && s.text(3).empty();
    if (s.text(0) == "table" && s.text(1) == "finding") return Holds::findings;
    if (!is_table && !is_its_index) return Holds::something_else;
    if (is_table) holds = Holds::causes;
  }
  if (!s.ok()) throw InputError(file, std::string("ledger: ") + sqlite3_errmsg(db));
  return holds;
}

// The keys of findings do not tell which of them had the same cause, so the rows cannot be converted.
[[noreturn]] void refuse_ledger_of_findings(const std::string& file) {
  throw InputError(
      file,
      "is a ledger of findings, from an earlier version; this version keeps causes. Give --ledger "
      "another file, which is created: the causes of the next campaign are all new in it. The old "
      "file may be deleted");
}

}  // namespace

Ledger::Ledger(const std::filesystem::path& file, For purpose)
    : db_(std::make_unique<Database>(file, purpose)) {
  sqlite3_busy_timeout(db_->handle, busy_ms);
  db_->run(purpose == For::reading ? "BEGIN" : "BEGIN IMMEDIATE");
  const int id = pragma(db_->handle, "application_id");
  const Holds holds = contents(db_->handle, db_->file);
  if (holds == Holds::findings && id == of_findings) refuse_ledger_of_findings(db_->file);
  const bool is_ledger = holds == Holds::causes && id == application_id;
  if (!is_ledger && !(holds == Holds::nothing && id == 0))
    throw InputError(file.string(), "is a database, but not a ledger of causes of this version");
  is_empty_ = holds == Holds::nothing;
  if (purpose == For::reading || !is_empty_) return;
  db_->run(fmt::format("PRAGMA application_id = {}", application_id).c_str());
  db_->run(schema);
  is_empty_ = false;
}

Ledger::~Ledger() = default;

std::optional<KnownCause> Ledger::find(const std::string& id) const {
  if (is_empty_) return std::nullopt;
  Statement s(db_->handle, fmt::format("SELECT {} FROM cause WHERE id = ?", columns));
  s.bind(id);
  if (s.step()) return row(s, db_->file);
  if (!s.ok()) db_->fail();
  return std::nullopt;
}

// A damaged file can refer to a page many times. Rejecting ids that do not ascend, and more text than the
// file has bytes, keeps the loop finite.
std::vector<KnownCause> Ledger::all() const {
  std::vector<KnownCause> r;
  if (is_empty_) return r;
  Statement s(db_->handle, fmt::format("SELECT {} FROM cause ORDER BY id", columns));
  const auto pages = pragma(db_->handle, "page_count"), size = pragma(db_->handle, "page_size");
  const auto most = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size);
  std::uint64_t bytes = 0;
  while (s.step()) {
    KnownCause k = row(s, db_->file);
    bytes += bytes_of(k);
    if ((!r.empty() && r.back().id >= k.id) || bytes > most)
      throw InputError(db_->file, "ledger: is damaged: it contains the same pages more than once");
    r.push_back(std::move(k));
  }
  if (!s.ok()) db_->fail();
  return r;
}

void Ledger::put(const KnownCause& k) {
  if (const std::string why = complaint(k); !why.empty()) throw InputError(db_->file, "ledger: " + why);
  Statement s(
      db_->handle,
      fmt::format("INSERT OR REPLACE INTO cause({}) VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)",
                  columns));
  for (const auto field : texts_before) s.bind(k.*field);
  s.bind(std::string(to_string(k.severity)));
  for (const auto field : lists) s.bind(json_text(Json(k.*field)));
  for (const auto field : sightings) s.bind(k.*field);
  for (const std::uint64_t n : {k.count, k.size.bodies, k.size.steps, k.size.bits}) s.bind(n);
  for (const auto field : texts_after) s.bind(k.*field);
  s.step();
  if (!s.ok()) db_->fail();
}

void Ledger::commit() { db_->run("COMMIT"); }

}  // namespace touchstone::fuzz
