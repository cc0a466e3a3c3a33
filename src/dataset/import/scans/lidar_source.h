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

/// Options and receivers for reading the scans of a lidar.
struct ScanReading {
  bool skips_bad = false;
  LeaveOut leave_out;
  TakeScan take;
  std::int64_t pieces = 0;  ///< number of packets, messages or files read, including faulty ones
};

/// Source of the scans of one lidar of a mapping.
struct LidarSource {
  std::filesystem::path file;  ///< file or folder
  std::string unit;            ///< such as "VLP-16"; empty if the file contains only points
  std::string model_yaml;      ///< beam pattern as in sensor.yaml; empty if unknown
  double offset_s = 0;         ///< time offset from the key `time`
  bool keeps_seconds = false;  ///< second returns become points too
  std::string remark;          ///< remark on data that the points lack according to the mapping
  std::function<void(ScanReading* reading)> read;
};

/// Reads a lidar of the mapping. Keys: `file` and `topic`, `unit`, `metadata`, `port`,
/// `corrections`, `returns`, `time`, `stamp`, `duration_s`, `time_field`, `time_unit`,
/// `full_intensity`, `files` and `times`. Faults are reported at `channel`.
LidarSource ReadLidarSource(const ConfigMap& channel, const ConfigMap& top,
                            UnpackedFiles* unpacked);

}  // namespace tera
