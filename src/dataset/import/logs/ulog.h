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

/// A topic, such as "vehicle_imu", or "vehicle_imu[1]" for its second instance.
struct UlogTopic {
  std::string name;
  /// Paths of its numbers, such as "gyro_rad[0]" or "esc[2].rpm", without padding.
  std::vector<std::string> fields;
  std::int64_t messages = 0;
};

/// All topics of a log, sorted by name. Reading stops at the first damage.
///
/// Throws  InputError if the file is not a ULog or has an unknown version.
std::vector<UlogTopic> UlogTopics(const std::filesystem::path& file);

/// Messages of a topic, one row each: the numbers at `paths` (a bool is 0 or 1) and `time`. `time`
/// is the message's `timestamp`, in us since the start of the flight computer.
///
/// Throws  InputError for an unknown topic or path, a message shorter than its fields, bytes that
///         are not a message, and a truncated file. With `left_out`, faults in the data are counted
///         there instead, and the file is read up to the damage.
/// Source  PX4 user guide, "ULog File Format", version 1.
std::unique_ptr<const RowTable> ReadUlog(const std::filesystem::path& file,
                                         const std::string& topic,
                                         const std::vector<std::string>& paths,
                                         LeftOutRows* left_out);

}  // namespace tera
