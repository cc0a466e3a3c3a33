#pragma once

#include <string>
#include <vector>

#include "dataset/import/import_run.h"

namespace tera {

/// Collects times and faults of the frames of one channel during an import.
class ImportedFrames {
 public:
  ImportedFrames(std::string folder, ImportRun* run) : folder_(std::move(folder)), run_(run) {}

  /// With --skip-bad-rows, counts the fault; otherwise throws it.
  void LeaveOut(const InputError& fault);
  /// Converts a stamp to a time of the recording. If it is not later than the previous frame's
  /// time, calls LeaveOut and returns nullopt. `of` is "scan" or "picture", for messages.
  std::optional<TimeNs> Take(TimeNs stamp_ns, double offset_s, const std::string& place,
                             std::string_view of);
  const std::vector<TimeNs>& t_ns() const { return t_ns_; }
  /// Line "rate_hz: 10" from the median interval; empty for fewer than two frames.
  std::string RateYaml() const;
  /// Adds the channel to the report. Throws InputError if more than half of the `pieces` were left
  /// out.
  ImportedChannel* Report(const std::filesystem::path& file, std::int64_t pieces);

 private:
  std::string folder_;
  ImportRun* run_;
  std::vector<TimeNs> t_ns_;
  LeftOutRows left_out_;
};

}  // namespace tera
