#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "view/served_folder.h"

namespace tera {

/// Header of a CSV file and at most `most_rows` evenly spaced rows, including the first and the
/// last.
std::string ThinnedTable(const std::string& csv, std::size_t most_rows);

/// Frames listed in data.csv of a camera or lidar.
class FrameList {
 public:
  /// `channel` is the folder of the sensor. `pictures` holds the image kinds of a camera; it is
  /// empty for a lidar.
  FrameList(const ServedFolder& folder, const std::string& channel,
            const std::vector<std::string>& pictures);

  std::size_t size() const { return rows_.size(); }
  /// Content of data.csv with only every n-th frame.
  std::string Table(std::size_t n) const;
  /// Paths of the existing files of every n-th frame, relative to the folder.
  std::vector<std::string> Files(std::size_t n) const;
  std::uint64_t Bytes(std::size_t n) const;

 private:
  struct Row {
    std::string line;
    std::vector<std::string> files;
    std::uint64_t bytes = 0;
  };
  std::string head_;
  std::vector<Row> rows_;
};

}  // namespace tera
