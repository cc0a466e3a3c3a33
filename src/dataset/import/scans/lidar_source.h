#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "core/config/config.h"
#include "dataset/import/bag/unpacked_file.h"
#include "dataset/import/scans/revolution.h"
#include "dataset/import/scans/unit_packet.h"

namespace tera {

/// Options and receivers of a reading.
struct ScanReading {
  bool skips_bad = false;
  LeaveOut leave_out;
  TakeScan take;
  std::int64_t pieces = 0;  ///< packets, messages or files read, good or bad
};

/// Source of the scans of one lidar in a mapping.
struct LidarSource {
  std::filesystem::path file;  ///< or the folder
  std::string unit;            ///< "VLP-16"; empty where the file holds points alone
  std::string model_yaml;      ///< beam pattern as in sensor.yaml, where known
  double offset_s = 0;         ///< from the mapping's `time`
  bool keeps_seconds = false;  ///< second returns are points too
  std::string remark;          ///< data that the points lack, by the mapping
  std::function<void(ScanReading* reading)> read;
};

/// Reads `file` and `topic`, `unit`, `metadata`, `port`, `corrections`, `returns`, `time`, `stamp`,
/// `duration_s`, `time_field`, `time_unit`, `full_intensity`, `files` and `times` of a lidar.
/// Faults go to `channel`.
LidarSource ReadLidarSource(const ConfigMap& channel, const ConfigMap& top,
                            UnpackedFiles* unpacked);

}  // namespace tera
