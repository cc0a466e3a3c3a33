#pragma once

#include <optional>

#include "dataset/export/export_job.h"

namespace tera {

/// A scan, and an image taken during it.
struct FramePair {
  TimeNs picture_ns = 0, scan_ns = 0;
};

/// Pairs each scan with the image nearest to its middle, in order of time. Scans without an image
/// during their revolution are skipped, as are all other images. Memory holds one scan and one
/// image.
class FramePairs {
 public:
  FramePairs(ExportJob* job, const std::string& camera, const std::string& lidar,
             TimeNs scan_period_ns);

  /// Reads the next pair; returns false at the end.
  bool Next(FramePair* pair);

 private:
  struct Scan {
    TimeNs t_ns = 0;
    std::optional<TimeNs> picture_ns;
  };
  void Offer(TimeNs picture_ns);

  ExportJob* job_;
  TimeNs period_ns_;
  RecordStream stream_;
  std::optional<Scan> scan_;
};

}  // namespace tera
