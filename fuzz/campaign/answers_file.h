// DIR/answers.bin: the cases of a campaign and every engine's answers to them (`fuzz --keep-answers`), from
// which the campaign can be judged again. All numbers are little-endian.
//
//   header  magic "TSANSWER", u32 length, u32 CRC-32 of the text, text: JSON {"touchstone_answers": version,
//           "protocol": version, "shapes": [kinds, in the order of their numbers], "cards": [engine cards]}
//   block   u32 magic, u32 CRC-32 of the rest, u64 index of the first case, u32 number of cases,
//           u32 length of the contents, u32 length of the zlib stream (RFC 1950) that holds them, stream
//
// One block a chunk of the campaign, in the order of the cases: the same bytes for any number of jobs, unless
// an engine itself answers differently from run to run. Contents: see to_bytes(). Cases are kept whole, as in
// a case file: a later version may draw other cases from the same seed, and a guided campaign draws from its
// own findings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/ask/kept_answers.h"

namespace touchstone::fuzz {

inline constexpr const char* answers_file_name = "answers.bin";

std::string answers_header(const std::vector<EngineCard>& cards);
/// A whole block. Same batch, same bytes.
std::string answers_block(const KeptBatch& batch);

/// The contents of a block, without first_index. Per case: its JSON, then each engine's observations; then
/// the later answers, grouped by question. Observations are coded as in messages
/// (oracles/abi/protocol.h).
std::string to_bytes(const KeptBatch& batch);
/// Throws InputError naming `place`; nothing larger than the bytes justify is allocated.
KeptBatch batch_from_bytes(std::string_view bytes, std::uint32_t cases, std::size_t engines,
                           const std::string& place);

/// Appends blocks to the file of a running campaign.
class AnswersWriter {
 public:
  /// Keeps the first `bytes` of the file, which is created if it is 0. Throws InputError if there are fewer.
  AnswersWriter(const std::filesystem::path& directory, std::uint64_t bytes);
  ~AnswersWriter();
  AnswersWriter(const AnswersWriter&) = delete;
  AnswersWriter& operator=(const AnswersWriter&) = delete;

  /// Writes the header to a new file. Throws InputError if the file has another one: the engines are not
  /// those that it was begun with.
  void start(const std::string& header);
  void append(const std::string& block);
  /// Bytes written so far.
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::filesystem::path file_;
  int fd_ = -1;
  std::uint64_t bytes_ = 0;
};

/// The file of a stored campaign. Every function throws InputError naming file, byte and reason.
class AnswersFile {
 public:
  struct Block {
    std::uint64_t offset = 0;  // of the block in the file
    std::uint64_t first_index = 0;
    std::uint32_t cases = 0, length = 0, stored = 0;
  };
  /// Reads the header and finds the blocks in the first `bytes` of the file.
  AnswersFile(const std::filesystem::path& directory, std::uint64_t bytes);

  const std::string& header() const { return header_; }
  const std::vector<EngineCard>& cards() const { return cards_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  /// The bytes of a block, as they are. Thread-safe, like batch().
  std::string block(const Block& b) const;
  KeptBatch batch(const Block& b) const;

 private:
  std::string place(std::uint64_t offset) const;
  std::string read(std::uint64_t offset, std::uint64_t n) const;
  void read_header();
  void find_blocks();

  std::filesystem::path file_;
  std::uint64_t bytes_ = 0;
  std::string header_;
  std::vector<EngineCard> cards_;
  std::vector<Block> blocks_;
};

}  // namespace touchstone::fuzz
