#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "view/served_folder.h"

namespace tera {

/// Header and at most `most_rows` evenly spaced rows of a CSV file, including the first and the
/// last.
std::string ThinnedTable(const std::string& csv, std::size_t most_rows);

/// Frames of a camera or lidar, as listed in its data.csv.
class FrameList {
 public:
  /// `channel` is the sensor's folder; `pictures` holds a camera's image kinds, empty for a lidar.
  FrameList(const ServedFolder& folder, const std::string& channel,
            const std::vector<std::string>& pictures);

  std::size_t size() const { return rows_.size(); }
  /// data.csv restricted to each n-th frame.
  std::string Table(std::size_t n) const;
  /// Paths of existing files of each n-th frame, relative to the folder.
  std::vector<std::string> Files(std::size_t n) const;
  /// Total size of these files.
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
