#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "view/served_folder.h"

namespace tera {

/// Header and at most so many rows, evenly spaced and with the first and the last, of a CSV file.
std::string ThinnedTable(const std::string& csv, std::size_t most_rows);

/// A camera's or lidar's frames as its data.csv lists them.
class FrameList {
 public:
  /// `channel` is the sensor's folder; `pictures` the kinds of a camera, none of a lidar.
  FrameList(const ServedFolder& folder, const std::string& channel,
            const std::vector<std::string>& pictures);

  std::size_t size() const { return rows_.size(); }
  /// data.csv with each n-th frame alone.
  std::string Table(std::size_t n) const;
  /// Paths of the files of each n-th frame, relative to the folder, that are there.
  std::vector<std::string> Files(std::size_t n) const;
  /// Of all those files.
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
