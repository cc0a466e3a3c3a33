#pragma once

#include <optional>

#include "dataset/export/export_job.h"

namespace tera {

/// A scan and the picture that was taken while it was.
struct FramePair {
  TimeNs picture_ns = 0, scan_ns = 0;
};

/// The frames of an export, in order of time: each scan during which there was a picture, with the
/// one nearest to its middle. Scans without one, and pictures beside, are left out. One of each is
/// in memory.
class FramePairs {
 public:
  FramePairs(ExportJob* job, const std::string& camera, const std::string& lidar,
             TimeNs scan_period_ns);

  /// False at the end.
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
