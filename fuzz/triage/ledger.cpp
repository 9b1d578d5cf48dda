#include "fuzz/triage/ledger.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <array>
#include <string_view>
#include <system_error>

#include "core/base/input_error.h"
#include "reports/record/stored.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/printable.h"

namespace touchstone::fuzz {
namespace {

constexpr int application_id = 0x54534c31;  // "TSL1", in the header of the file
constexpr int busy_ms = 60'000;
constexpr int max_field_bytes = 64 << 20;  // the largest is a case
constexpr std::uintmax_t max_file_bytes = std::uintmax_t{1} << 30;
constexpr std::uintmax_t max_journal_bytes = 2 * max_file_bytes;

// SQLite stores the text of a table definition exactly as written.
constexpr const char* schema =
    "CREATE TABLE finding("
    "key TEXT PRIMARY KEY, engine TEXT, question TEXT, fault TEXT, shapes TEXT, blame TEXT, degeneracy TEXT, "
    "magnitude TEXT, first_seen TEXT, last_seen TEXT, first_build TEXT, last_build TEXT, "
    "count INTEGER, bodies INTEGER, steps INTEGER, bits INTEGER, smallest TEXT, words TEXT, expired TEXT)";

constexpr const char* columns =
    "key, engine, question, fault, shapes, blame, degeneracy, magnitude, first_seen, last_seen, first_build, "
    "last_build, count, bodies, steps, bits, smallest, words, expired";

constexpr std::array texts_before{
    &KnownFinding::key,        &KnownFinding::engine,      &KnownFinding::question,
    &KnownFinding::fault,      &KnownFinding::shapes,      &KnownFinding::blame,
    &KnownFinding::degeneracy, &KnownFinding::magnitude,   &KnownFinding::first_seen,
    &KnownFinding::last_seen,  &KnownFinding::first_build, &KnownFinding::last_build};
constexpr std::array texts_after{&KnownFinding::smallest, &KnownFinding::words, &KnownFinding::expired};

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
  void bind(const std::string& v) {
    ok_ = ok_ && sqlite3_bind_text(s_, ++bound_, v.data(), static_cast<int>(v.size()), SQLITE_TRANSIENT) ==
                     SQLITE_OK;
  }
  void bind(std::uint64_t v) {
    ok_ = ok_ && sqlite3_bind_int64(s_, ++bound_, static_cast<sqlite3_int64>(v)) == SQLITE_OK;
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

// Keys name directories (triage --reproducers).
void require_own_key(const KnownFinding& f, const std::string& file) {
  Finding parts;
  parts.engine = f.engine;
  parts.question = f.question;
  parts.fault = f.fault;
  parts.shapes = f.shapes;
  parts.blame = f.blame;
  parts.degeneracy = f.degeneracy;
  parts.magnitude = f.magnitude;
  if (parts.key() != f.key || !has_plain_key(parts))
    throw InputError(file, "ledger: the key of a row does not match its fields: " + printable(f.key));
}

KnownFinding row(const Statement& s, const std::string& file) {
  KnownFinding f;
  int i = 0;
  for (const auto field : texts_before) f.*field = text_of(s, i++, file);
  f.count = count_of(s, i++, file);
  f.size.bodies = count_of(s, i++, file);
  f.size.steps = count_of(s, i++, file);
  f.size.bits = count_of(s, i++, file);
  for (const auto field : texts_after) f.*field = text_of(s, i++, file);
  require_own_key(f, file);
  return f;
}

std::size_t bytes_of(const KnownFinding& f) {
  std::size_t n = 0;
  for (const auto field : texts_before) n += (f.*field).size();
  for (const auto field : texts_after) n += (f.*field).size();
  return n;
}

int pragma(sqlite3* db, const char* name) {
  Statement s(db, std::string("PRAGMA ") + name);
  return s.step() ? static_cast<int>(s.number(0)) : -1;
}

// Stops at the first object that does not belong to a ledger, without reading or running it.
enum class Holds { nothing, findings, something_else };
Holds contents(sqlite3* db, const std::string& file) {
  Statement s(db, "SELECT type, name, tbl_name, sql FROM sqlite_master");
  Holds holds = Holds::nothing;
  while (s.step()) {
    const bool is_table = s.text(0) == "table" && s.text(1) == "finding" && s.text(3) == schema;
    const bool is_its_index = s.text(0) == "index" && s.text(1) == "sqlite_autoindex_finding_1" &&
                              s.text(2) == "finding" && s.text(3).empty();
    if (!is_table && !is_its_index) return Holds::something_else;
    if (is_table) holds = Holds::findings;
  }
  if (!s.ok()) throw InputError(file, std::string("ledger: ") + sqlite3_errmsg(db));
  return holds;
}

}  // namespace

Ledger::Ledger(const std::filesystem::path& file, For purpose)
    : db_(std::make_unique<Database>(file, purpose)) {
  sqlite3_busy_timeout(db_->handle, busy_ms);
  db_->run(purpose == For::reading ? "BEGIN" : "BEGIN IMMEDIATE");
  const int id = pragma(db_->handle, "application_id");
  const Holds holds = contents(db_->handle, db_->file);
  if (holds == Holds::something_else || (holds == Holds::findings) != (id == application_id))
    throw InputError(file.string(), "is a database, but not a ledger of findings of this version");
  is_empty_ = holds == Holds::nothing;
  if (purpose == For::reading || !is_empty_) return;
  db_->run(fmt::format("PRAGMA application_id = {}", application_id).c_str());
  db_->run(schema);
  is_empty_ = false;
}

Ledger::~Ledger() = default;

std::optional<KnownFinding> Ledger::find(const std::string& key) const {
  if (is_empty_) return std::nullopt;
  Statement s(db_->handle, fmt::format("SELECT {} FROM finding WHERE key = ?", columns));
  s.bind(key);
  if (s.step()) return row(s, db_->file);
  if (!s.ok()) db_->fail();
  return std::nullopt;
}

// A damaged file can refer to a page many times. Rejecting keys that do not ascend, and more text than the
// file has bytes, keeps the loop finite.
std::vector<KnownFinding> Ledger::all() const {
  std::vector<KnownFinding> r;
  if (is_empty_) return r;
  Statement s(db_->handle, fmt::format("SELECT {} FROM finding ORDER BY key", columns));
  const auto pages = pragma(db_->handle, "page_count"), size = pragma(db_->handle, "page_size");
  const auto most = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size);
  std::uint64_t bytes = 0;
  while (s.step()) {
    KnownFinding f = row(s, db_->file);
    bytes += bytes_of(f);
    if ((!r.empty() && r.back().key >= f.key) || bytes > most)
      throw InputError(db_->file, "ledger: is damaged: it contains the same pages more than once");
    r.push_back(std::move(f));
  }
  if (!s.ok()) db_->fail();
  return r;
}

void Ledger::put(const KnownFinding& f) {
  Statement s(db_->handle,
              fmt::format("INSERT OR REPLACE INTO finding({}) VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)",
                          columns));
  for (const auto field : texts_before) s.bind(f.*field);
  for (const std::uint64_t n : {f.count, f.size.bodies, f.size.steps, f.size.bits}) s.bind(n);
  for (const auto field : texts_after) s.bind(f.*field);
  s.step();
  if (!s.ok()) db_->fail();
}

void Ledger::commit() { db_->run("COMMIT"); }

}  // namespace touchstone::fuzz
