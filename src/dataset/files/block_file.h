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

/// Byte streams that are compressed separately, because their statistics differ.
using Block = std::vector<std::string>;

/// Writes a file with a header and compressed blocks.
///
/// Model   The file is "TERA blocks 1\n", the header, the blocks and an end mark. Numbers have 32
///         bits, low byte first. The header follows its length. A block is a stream count and its
///         streams; a count of 0 is the end mark. A stream is its compressed length and a zstd
///         frame, which contains the uncompressed length and a checksum.
/// Source  RFC 8878 (Zstandard), by libzstd.
class BlockFileWriter {
 public:
  /// Throws InputError if the file cannot be written, like every other function of the class.
  BlockFileWriter(const std::filesystem::path& path, std::string_view header);

  /// Appends a block with at least one stream.
  void Append(const Block& block);
  /// Writes the end mark and gives the file its final name.
  void Commit();
  std::int64_t bytes() const { return file_.bytes(); }

 private:
  CheckedFile file_;
};

/// Reads the blocks of a file written by BlockFileWriter. Throws InputError if the file has another
/// format, is damaged, or does not end at its end mark.
class BlockFileReader {
 public:
  explicit BlockFileReader(const std::filesystem::path& path);

  const std::string& header() const { return header_; }
  /// The next block; nullopt at the end.
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
