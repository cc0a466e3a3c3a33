#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dataset/import/left_out_rows.h"
#include "dataset/import/row_table.h"

/// Logs of PX4 in ULog format.

namespace tera {

/// A topic of a log: "vehicle_imu", or "vehicle_imu[1]" for its second instance.
struct UlogTopic {
  std::string name;
  /// Paths of its numbers, "gyro_rad[0]", "esc[2].rpm", without the padding.
  std::vector<std::string> fields;
  std::int64_t messages = 0;
};

/// All topics of a log, sorted by name, up to the first damage.
///
/// Throws  InputError if the file is no ULog or has an unknown version.
std::vector<UlogTopic> UlogTopics(const std::filesystem::path& file);

/// The messages of a topic, one row each: the numbers at `paths` (bools are 0 and 1), and `time`,
/// the message's `timestamp`, us since the start of the vehicle's computer.
///
/// Faults are InputErrors: no such topic or path, a message shorter than its fields, bytes that are
/// no message, a truncated file. With `left_out` these are counted, and the file is read up to the
/// damage.
///
/// Source  PX4 user guide, "ULog File Format", version 1.
std::unique_ptr<const RowTable> ReadUlog(const std::filesystem::path& file,
                                         const std::string& topic,
                                         const std::vector<std::string>& paths,
                                         LeftOutRows* left_out);

}  // namespace tera
