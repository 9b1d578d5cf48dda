// What examining representatives found, in a file: a search for causes that was interrupted goes on where it
// stopped. One JSON document a line: first what the file is about, then a representative each.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "fuzz/causes/representative.h"

namespace touchstone::fuzz {

/// What the examined representative holds beside its class and its findings.
Json examination_json(const Representative& r);
/// Writes it back. Throws InputError when it is damaged.
void restore_examination(Representative& r, const JsonReader& j);

class Examinations {
 public:
  /// Takes over what the file holds, if it is about the same: the same campaign, asked in the same way. Else
  /// the file is begun anew with the first representative. A last line that was not written to its end is
  /// left out. Throws InputError when another line is damaged.
  Examinations(std::filesystem::path file, Json about);

  /// How many are in the file.
  std::size_t size() const { return known_.size() + added_; }
  /// True when the representative was examined earlier, and now is as it was then. Throws InputError when
  /// that is damaged. May be called by several threads.
  bool restore(Representative& r) const;
  /// Appends it. By one thread at a time.
  void add(const Representative& r);
  /// Why not all of them are in the file; empty: they are.
  const std::string& not_kept() const { return not_kept_; }
  /// All causes are found: the file is of no use any more.
  void remove();

 private:
  void append(const Json& line);

  std::filesystem::path file_;
  Json about_;
  std::map<std::string, Json> known_;  // by the key of the representative's finding
  std::size_t added_ = 0;
  bool is_begun_ = false;  // its first line is in the file
  std::string not_kept_;
};

}  // namespace touchstone::fuzz
