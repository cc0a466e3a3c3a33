#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/files/checked_file.h"

namespace tera {

/// A block: byte streams that are compressed each by itself, because each has its own statistics.
using Block = std::vector<std::string>;

/// Writes a file of compressed blocks behind a header.
///
/// Model   "TERA blocks 1\n", the header, then each block, then an end. Numbers are 32 bit,
///         little-endian: the header's length before it; before a block the number of its streams,
///         before each stream its compressed length; 0 streams are the end. A stream is a zstd
///         frame with its length and its checksum.
/// Source  RFC 8878 (Zstandard), by libzstd.
class BlockFileWriter {
 public:
  /// Throws InputError where the file cannot be written, as every call does.
  BlockFileWriter(const std::filesystem::path& path, std::string_view header);

  /// Of one stream at least.
  void Append(const Block& block);
  /// Writes the end; the file appears under its name.
  void Commit();
  std::int64_t bytes() const { return file_.bytes(); }

 private:
  CheckedFile file_;
};

/// Reads what BlockFileWriter wrote, block by block. Throws InputError where the file is none, is
/// damaged, or does not end where its end is.
class BlockFileReader {
 public:
  explicit BlockFileReader(const std::filesystem::path& path);

  const std::string& header() const { return header_; }
  /// Nothing at the end.
  std::optional<Block> Next();

 private:
  std::string Read(std::uint64_t bytes);
  std::uint32_t ReadNumber();
  [[noreturn]] void Fail(std::string_view finding) const;

  std::filesystem::path path_;
  std::uint64_t left_ = 0;  ///< bytes of the file not yet read
  bool at_end_ = false;
  std::ifstream stream_;
  std::string header_;
};

}  // namespace tera
