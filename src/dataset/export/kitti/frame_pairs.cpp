#include "dataset/export/kitti/frame_pairs.h"

#include <cstdlib>
#include <utility>

namespace tera {
namespace {

/// Index of the lidar in the stream. It is first, so at equal times the scan precedes the image.
constexpr std::size_t kLidar = 0;

}  // namespace

FramePairs::FramePairs(ExportJob* job, const std::string& camera, const std::string& lidar,
                       TimeNs scan_period_ns)
    : job_(job),
      period_ns_(scan_period_ns),
      stream_(job->recording, std::vector<std::string>{lidar, camera}) {}

void FramePairs::Offer(TimeNs picture_ns) {
  if (!scan_ || picture_ns >= scan_->t_ns + period_ns_) return;
  const TimeNs middle_ns = scan_->t_ns + period_ns_ / 2;
  if (!scan_->picture_ns ||
      std::abs(picture_ns - middle_ns) < std::abs(*scan_->picture_ns - middle_ns)) {
    scan_->picture_ns = picture_ns;
  }
}

bool FramePairs::Next(FramePair* pair) {
  const auto give = [&](const std::optional<Scan>& scan) {
    if (!scan || !scan->picture_ns) return false;
    *pair = {*scan->picture_ns, scan->t_ns};
    return true;
  };
  for (Record record; job_->Next(&stream_, &record);) {
    if (record.channel != kLidar) {
      Offer(record.t_ns);
    } else if (give(std::exchange(scan_, Scan{record.t_ns, std::nullopt}))) {
      return true;
    }
  }
  return give(std::exchange(scan_, std::nullopt));
}

}  // namespace tera
