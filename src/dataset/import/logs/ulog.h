#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dataset/import/left_out_rows.h"
#include "dataset/import/row_table.h"

/// Logs of PX4, form ULog.

namespace tera {

/// A topic as a log offers it: "vehicle_imu", or "vehicle_imu[1]" of its second instance.
struct UlogTopic {
  std::string name;
  /// Paths of its numbers, "gyro_rad[0]", "esc[2].rpm", without the padding.
  std::vector<std::string> fields;
  std::int64_t messages = 0;
};

/// All topics of a log, in order of their names. What stands behind damage is not looked at.
///
/// Throws InputError where the file is no ULog or is of a version that is not known.
std::vector<UlogTopic> UlogTopics(const std::filesystem::path& file);

/// The messages of a topic, a row each: `paths` of its numbers (bools are 0 and 1) beside `time`,
/// which is the message's `timestamp`, us since the vehicle's computer was started.
///
/// Faults are InputErrors: no such topic or path, a message that is shorter than its fields, bytes
/// that are no message, a file that ends within one; with `left_out` these are counted, and what
/// stands behind damage of the file is not read.
/// Source  PX4 user guide, "ULog File Format", version 1.
std::unique_ptr<const RowTable> ReadUlog(const std::filesystem::path& file,
                                         const std::string& topic,
                                         const std::vector<std::string>& paths,
                                         LeftOutRows* left_out);

}  // namespace tera
