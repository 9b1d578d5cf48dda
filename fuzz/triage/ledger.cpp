#include "fuzz/triage/ledger.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <array>

#include "core/base/input_error.h"

namespace touchstone::fuzz {
namespace {

constexpr int application_id = 0x54534c31;  // "TSL1", in the header of the file
constexpr int busy_ms = 60'000;

constexpr const char* schema =
    "CREATE TABLE IF NOT EXISTS finding("
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

struct Ledger::Database {
  std::string file;
  sqlite3* handle = nullptr;

  explicit Database(const std::filesystem::path& path) : file(path.string()) {
    const int code =
        sqlite3_open_v2(file.c_str(), &handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
    if (code != SQLITE_OK) {
      const std::string why = handle ? sqlite3_errmsg(handle) : sqlite3_errstr(code);
      sqlite3_close(handle);
      throw InputError(file, "cannot be opened as a ledger: " + why);
    }
  }
  // An open transaction is rolled back.
  ~Database() { sqlite3_close(handle); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  [[noreturn]] void fail() const { throw InputError(file, std::string("ledger: ") + sqlite3_errmsg(handle)); }
  void run(const char* sql) const {
    if (sqlite3_exec(handle, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
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
  /// True: a row. False: the end, or ok() is false.
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
  std::uint64_t number(int column) const {
    return static_cast<std::uint64_t>(sqlite3_column_int64(s_, column));
  }

 private:
  sqlite3_stmt* s_ = nullptr;
  int bound_ = 0;
  bool ok_ = false;
};

KnownFinding row(const Statement& s) {
  KnownFinding f;
  int i = 0;
  for (const auto field : texts_before) f.*field = s.text(i++);
  f.count = s.number(i++);
  f.size.bodies = s.number(i++), f.size.steps = s.number(i++), f.size.bits = s.number(i++);
  for (const auto field : texts_after) f.*field = s.text(i++);
  return f;
}

int pragma(sqlite3* db, const char* name) {
  Statement s(db, std::string("PRAGMA ") + name);
  return s.step() ? static_cast<int>(s.number(0)) : -1;
}

bool has_tables(sqlite3* db) {
  Statement s(db, "SELECT count(*) FROM sqlite_master");
  return s.step() && s.number(0) > 0;
}

}  // namespace

Ledger::Ledger(const std::filesystem::path& file) : db_(std::make_unique<Database>(file)) {
  sqlite3_busy_timeout(db_->handle, busy_ms);
  db_->run("BEGIN IMMEDIATE");
  const int id = pragma(db_->handle, "application_id");
  if (id != application_id && (id != 0 || has_tables(db_->handle)))
    throw InputError(file.string(), "is a database, but not a ledger of findings of this version");
  db_->run(fmt::format("PRAGMA application_id = {}", application_id).c_str());
  db_->run(schema);
}

Ledger::~Ledger() = default;

std::optional<KnownFinding> Ledger::find(const std::string& key) const {
  Statement s(db_->handle, fmt::format("SELECT {} FROM finding WHERE key = ?", columns));
  s.bind(key);
  if (s.step()) return row(s);
  if (!s.ok()) db_->fail();
  return std::nullopt;
}

std::vector<KnownFinding> Ledger::all() const {
  Statement s(db_->handle, fmt::format("SELECT {} FROM finding ORDER BY key", columns));
  std::vector<KnownFinding> r;
  while (s.step()) r.push_back(row(s));
  if (!s.ok()) db_->fail();
  return r;
}

void Ledger::put(const KnownFinding& f) {
  Statement s(db_->handle,
              fmt::format("INSERT OR REPLACE INTO finding({}) VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)",
                          columns));
  for (const auto field : texts_before) s.bind(f.*field);
  s.bind(f.count), s.bind(f.size.bodies), s.bind(f.size.steps), s.bind(f.size.bits);
  for (const auto field : texts_after) s.bind(f.*field);
  s.step();
  if (!s.ok()) db_->fail();
}

void Ledger::commit() { db_->run("COMMIT"); }

}  // namespace touchstone::fuzz
