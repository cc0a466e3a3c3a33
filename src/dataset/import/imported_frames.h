#pragma once

#include <string>
#include <vector>

#include "dataset/import/import_run.h"

namespace tera {

/// Times and faults of the frames of one channel while they are imported.
class ImportedFrames {
 public:
  ImportedFrames(std::string folder, ImportRun* run) : folder_(std::move(folder)), run_(run) {}

  /// Leaves the fault out and counts it, or throws it without --skip-bad-rows.
  void LeaveOut(const InputError& fault);
  /// The time of a frame in the recording. Nothing, after LeaveOut, if it is no later than the
  /// frame before. `of` is "scan" or "picture".
  std::optional<TimeNs> Take(TimeNs stamp_ns, double offset_s, const std::string& place,
                             std::string_view of);
  const std::vector<TimeNs>& t_ns() const { return t_ns_; }
  /// "rate_hz: 10", by the median interval; empty for fewer than two frames.
  std::string RateYaml() const;
  /// Adds the channel to the report. Throws InputError if more than half of `pieces` were left out.
  ImportedChannel* Report(const std::filesystem::path& file, std::int64_t pieces);

 private:
  std::string folder_;
  ImportRun* run_;
  std::vector<TimeNs> t_ns_;
  LeftOutRows left_out_;
};

}  // namespace tera
