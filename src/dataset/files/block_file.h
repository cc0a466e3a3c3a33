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

/// A block: byte streams that are compressed separately, since each has its own statistics.
using Block = std::vector<std::string>;

/// Writes a file of compressed blocks after a header.
///
/// Model   "TERA blocks 1\n", the header, then the blocks, then an end. Numbers are 32 bit,
///         little-endian. A length precedes the header; a stream count precedes each block; a
///         compressed length precedes each stream; a count of 0 is the end. A stream is a zstd
///         frame with its length and its checksum.
/// Source  RFC 8878 (Zstandard), by libzstd.
class BlockFileWriter {
 public:
  /// Throws InputError if the file cannot be written, as every call does.
  BlockFileWriter(const std::filesystem::path& path, std::string_view header);

  /// The block needs at least one stream.
  void Append(const Block& block);
  /// Writes the end; the file appears under its name.
  void Commit();
  std::int64_t bytes() const { return file_.bytes(); }

 private:
  CheckedFile file_;
};

/// Reads a file of BlockFileWriter, block by block. Throws InputError if the file has another
/// format, is damaged, or does not stop at its end mark.
class BlockFileReader {
 public:
  explicit BlockFileReader(const std::filesystem::path& path);

  const std::string& header() const { return header_; }
  /// Returns nothing at the end.
  std::optional<Block> Next();

 private:
  std::string Read(std::uint64_t bytes);
  std::uint32_t ReadNumber();
  [[noreturn]] void Fail(std::string_view finding) const;

  std::filesystem::path path_;
  std::uint64_t left_ = 0;  ///< unread bytes of the file
  bool at_end_ = false;
  std::ifstream stream_;
  std::string header_;
};

}  // namespace tera
