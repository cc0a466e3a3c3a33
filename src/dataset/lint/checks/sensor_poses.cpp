#include "dataset/lint/checks/sensor_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/config/config.h"
#include "core/error.h"
#include "dataset/lint/checks/change_vote.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

/// Longest interval for interpolation.
constexpr TimeNs kLongestGap_ns = kNsPerSecond / 2;

/// The link that is not the child of a joint; empty if scenario.yaml does not define it.
std::string RootOf(const LintJob& job, const std::string& machine) {
  try {
    const Config config = Config::FromFile(job.Path("scenario.yaml"));
    if (!config.root().IsList("machines")) return "";
    for (const ConfigMap& item : config.root().List("machines")) {
      if (item.Text("name", "") != machine || !item.Has("machine")) continue;
      const ConfigMap model = item.Map("machine");
      std::set<std::string> children;
      const ConfigMap joints = model.Map("joints");
      for (const std::string& joint : joints.Keys()) {
        children.insert(joints.Map(joint).Text("child", ""));
      }
      for (const std::string& link : model.Map("links").Keys()) {
        if (!children.contains(link)) return link;
      }
    }
  } catch (const InputError&) {
    return "";  // the scenario.yaml of an imported recording is a mapping or absent
  }
  return "";
}

void Mount(const Pose& X_PS, std::vector<PoseRow>* poses) {
  for (PoseRow& row : *poses) row.pose.X_WB = row.pose.X_WB * X_PS;
}

}  // namespace

std::vector<PoseRow> ReadPoses(const LintJob& job, const std::string& channel) {
  std::vector<PoseRow> poses;
  for (const ScannedRow& row : ReadTable(job, channel).rows) {
    const std::vector<double>& v = row.values;
    const Quat q(v[3], v[4], v[5], v[6]);
    if (q.norm() == 0) continue;  // reported by poses.quaternion
    PoseRow pose{row.line,
                 {row.t_ns, MakePose(Vec3(v[0], v[1], v[2]), q.normalized().toRotationMatrix())}};
    if (v.size() > 7) {
      pose.pose.v_WB_mps = Vec3(v[7], v[8], v[9]);
      pose.pose.w_WB_B_radps = Vec3(v[10], v[11], v[12]);
    }
    poses.push_back(pose);
  }
  return poses;
}

void CheckNear(LintJob* job, const std::string& channel, int line, const Vec3& p_W_m) {
  constexpr double kFarthest_m = 100e3;
  job->Applies("places.far");
  if (p_W_m.norm() <= kFarthest_m) return;
  job->Find("places.far", channel,
            {job->RowsOf(channel), line,
             fmt::format("({:.0f}, {:.0f}, {:.0f}) m is {:.0f} km from the origin", p_W_m.x(),
                         p_W_m.y(), p_W_m.z(), p_W_m.norm() / 1e3)});
}

std::optional<Pose> PoseAt(const std::vector<PoseRow>& poses, TimeNs t_ns) {
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), t_ns,
                       [](const PoseRow& row, TimeNs t) { return row.pose.t_ns < t; });
  if (after == poses.end()) return std::nullopt;
  if (after->pose.t_ns == t_ns) return after->pose.X_WB;
  if (after == poses.begin()) return std::nullopt;
  const PoseRow& before = *std::prev(after);
  const TimeNs gap_ns = after->pose.t_ns - before.pose.t_ns;
  if (gap_ns > kLongestGap_ns) return std::nullopt;
  return Interpolate(before.pose.X_WB, after->pose.X_WB,
                     static_cast<double>(t_ns - before.pose.t_ns) / static_cast<double>(gap_ns));
}

std::optional<SensorPoses> FindSensorPoses(const LintJob& job, const std::string& sensor) {
  const Recording& recording = job.recording();
  const std::string machine = MachineOfChannel(sensor);
  const auto usable = [&](const std::string& channel) {
    return recording.Has(channel) && recording.TypeOf(channel) == kPoseChannel &&
           !job.IsLeftOut(channel);
  };
  const std::string own =
      fmt::format("truth/{}/sensors/{}.csv", machine, fs::path(sensor).filename().string());
  if (usable(own)) return SensorPoses{ReadPoses(job, own), false};
  const std::optional<SensorSheet> sheet = job.SheetOf(sensor);
  const bool is_mounted = sheet && sheet->X_PS && !sheet->parent_link.empty();
  if (is_mounted) {
    const std::string link = fmt::format("truth/{}/links/{}.csv", machine, sheet->parent_link);
    if (usable(link)) {
      SensorPoses found{ReadPoses(job, link), false};
      Mount(*sheet->X_PS, &found.poses);
      return found;
    }
  }
  const std::string root = fmt::format("truth/{}/pose.csv", machine);
  if (!usable(root)) return std::nullopt;
  SensorPoses found{ReadPoses(job, root), true};
  if (is_mounted && sheet->parent_link == RootOf(job, machine)) {
    Mount(*sheet->X_PS, &found.poses);
    found.of_root = false;
  }
  return found;
}

}  // namespace tera
