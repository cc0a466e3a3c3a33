#include "dataset/import/imported_frames.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/quantile.h"

namespace tera {

void ImportedFrames::LeaveOut(const InputError& fault) {
  if (!run_->options().skips_bad_rows) throw fault;
  left_out_.Add(fault.what());
}

std::optional<TimeNs> ImportedFrames::Take(TimeNs stamp_ns, double offset_s,
                                           const std::string& place, std::string_view of) {
  const TimeNs t_ns = stamp_ns + FromSeconds(offset_s) - run_->zero_ns();
  if (!t_ns_.empty() && t_ns <= t_ns_.back()) {
    LeaveOut(InputError(
        place,
        {FaultKind::kInconsistent,
         fmt::format("its {} is at {:.6f} s, the previous one at {:.6f} s; need a later time: was "
                     "a clock set, or a log joined wrongly? skip such entries with "
                     "--skip-bad-rows, or choose another clock with time: {{column: ...}}",
                     of, ToSeconds(t_ns), ToSeconds(t_ns_.back()))}));
    return std::nullopt;
  }
  t_ns_.push_back(t_ns);
  return t_ns;
}

std::string ImportedFrames::RateYaml() const {
  std::vector<TimeNs> intervals_ns;
  for (std::size_t k = 1; k < t_ns_.size(); ++k) intervals_ns.push_back(t_ns_[k] - t_ns_[k - 1]);
  if (intervals_ns.empty()) return "";
  return fmt::format("rate_hz: {:.6g}\n", 1 / ToSeconds(Median(std::move(intervals_ns))));
}

ImportedChannel* ImportedFrames::Report(const std::filesystem::path& file, std::int64_t pieces) {
  if (left_out_.count > pieces / 2) {
    throw InputError(folder_,
                     {FaultKind::kMalformed,
                      fmt::format("{} of {} packets, messages or files cannot be read, more than "
                                  "--skip-bad-rows may skip (half); the first: {}",
                                  left_out_.count, pieces, left_out_.first)});
  }
  return run_->AddFrames(folder_, file.filename().string(), t_ns_, left_out_);
}

}  // namespace tera
