#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "core/units.h"
#include "dataset/lint/checks/change_vote.h"
#include "dataset/lint/checks/sensor_poses.h"
#include "dataset/lint/lint_job.h"

namespace tera {
namespace {

/// Ground contact moves a machine by small steps that its recorded velocities do not include. They
/// stay far below these limits.
constexpr double kPositionFloor_m = 0.03, kTurnFloor_rad = 0.02;

/// The root of a machine is on the ground, or at most as high above it as the machine is tall.
constexpr double kBelowGround_m = 5;
/// A free fall from rest over 0.8 s and three metres. No machine moves this way: the middle of the
/// path is 0.8 m away from the line between its ends.
constexpr TimeNs kFall_ns = 800'000'000;
constexpr double kFallTolerance_m = 0.1;
constexpr std::size_t kLeastRowsOfFall = 5;
constexpr std::size_t kHeightColumn = 2;

void CheckQuaternions(LintJob* job, const std::string& channel, const ScannedTable& table) {
  job->Applies("poses.quaternion");
  for (const ScannedRow& row : table.rows) {
    const Quat q(row.values[3], row.values[4], row.values[5], row.values[6]);
    const auto find = [&](const std::string& what) {
      job->Find("poses.quaternion", channel, {job->RowsOf(channel), row.line, what});
    };
    if (std::abs(q.norm() - 1) > kQuaternionTolerance) {
      find(fmt::format("the quaternion's norm is {:.6g}", q.norm()));
    } else if (q.w() < 0) {
      find(fmt::format("qw is {:.6g}", q.w()));
    }
  }
}

/// Integrates mean velocities and rates of consecutive rows from the first pose on.
Pose Integrated(const std::vector<PoseRow>& poses, const RowWindow& window) {
  Pose X_WB = poses[window.first].pose.X_WB;
  for (std::size_t i = window.first; i < window.second; ++i) {
    const TruthPose &a = poses[i].pose, &b = poses[i + 1].pose;
    const double dt_s = ToSeconds(b.t_ns - a.t_ns);
    const Vec3 turn_rad = 0.5 * dt_s * (a.w_WB_B_radps + b.w_WB_B_radps);
    const Vec3 shift_m = 0.5 * dt_s * (a.v_WB_mps + b.v_WB_mps);
    X_WB.translation() += shift_m;
    if (turn_rad.norm() > 0) X_WB.rotate(Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()));
  }
  return X_WB;
}

double AngleBetween(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(Mat3(a.linear().transpose() * b.linear())).angle();
}

void CheckVelocities(LintJob* job, const std::string& channel, const ScannedTable& table) {
  if (table.columns.size() <= 7) return;
  const std::vector<PoseRow> poses = ReadPoses(*job, channel);
  if (poses.size() != table.rows.size()) return;  // reported by poses.quaternion
  ChangeVote moved(kPositionFloor_m), turned(kTurnFloor_rad);
  for (const RowWindow& window : WindowsOf(table.rows)) {
    job->Applies("poses.velocity");
    const Pose &begin = poses[window.first].pose.X_WB, &end = poses[window.second].pose.X_WB;
    const Pose integrated = Integrated(poses, window);
    const int line = poses[window.second].line;
    moved.Add(line, (end.translation() - begin.translation()).norm(),
              (integrated.translation() - begin.translation()).norm(),
              (integrated.translation() - end.translation()).norm());
    turned.Add(line, AngleBetween(begin, end), AngleBetween(begin, integrated),
               AngleBetween(end, integrated));
  }
  const auto tell = [&](const ChangeVote& vote, const char* first, const char* second,
                        const char* unit) {
    if (!vote.IsContradicted()) return;
    job->Find("poses.velocity", channel,
              {job->RowsOf(channel), vote.line(), vote.Summary(first, second, unit)});
  };
  tell(moved, "positions", "velocities", "m");
  tell(turned, "quaternions", "rates", "rad");
}

/// Lowest ground height in the recording; nullopt if there is none.
std::optional<double> LowestGround_m(const LintJob& job) {
  const std::filesystem::path folder = job.Path("truth/terrain");
  std::error_code none;
  if (!job.options().lowest_m || !std::filesystem::is_directory(folder, none)) return std::nullopt;
  std::optional<double> lowest_m;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("height_") || entry.path().extension() != ".tif") continue;
    const double height_m = job.options().lowest_m(entry.path());
    lowest_m = std::min(lowest_m.value_or(height_m), height_m);
  }
  return lowest_m;
}

/// True if the rows from `first` on are a free fall for kFall_ns.
bool IsFall(const std::vector<ScannedRow>& rows, std::size_t first) {
  const TimeNs from_ns = rows[first].t_ns;
  std::size_t last = first;
  while (last < rows.size() && rows[last].t_ns < from_ns + kFall_ns) ++last;
  if (last == rows.size() || last - first + 1 < kLeastRowsOfFall) return false;
  const double length_s = ToSeconds(rows[last].t_ns - from_ns);
  const double from_m = rows[first].values[kHeightColumn], to_m = rows[last].values[kHeightColumn];
  for (std::size_t i = first; i <= last; ++i) {
    const double t_s = ToSeconds(rows[i].t_ns - from_ns);
    const double falling_m = std::lerp(from_m, to_m, t_s / length_s) +
                             0.5 * kStandardGravity_mps2 * t_s * (length_s - t_s);
    if (std::abs(rows[i].values[kHeightColumn] - falling_m) > kFallTolerance_m) return false;
  }
  return true;
}

void CheckGround(LintJob* job, const std::string& channel, const ScannedTable& table,
                 const std::optional<double>& lowest_m) {
  job->Applies("poses.ground");
  const auto find = [&](const ScannedRow& row, const std::string& what) {
    job->Find("poses.ground", channel, {job->RowsOf(channel), row.line, what});
  };
  for (const ScannedRow& row : table.rows) {
    const double height_m = row.values[kHeightColumn];
    if (!lowest_m || height_m > *lowest_m - kBelowGround_m) continue;
    find(row,
         fmt::format("at {:.2f} m, {:.1f} m below all ground", height_m, *lowest_m - height_m));
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (!IsFall(table.rows, i)) continue;
    find(table.rows[i], fmt::format("falls freely for {} s from this row", ToSeconds(kFall_ns)));
    return;
  }
}

}  // namespace

void CheckPoses(LintJob* job) {
  std::optional<double> lowest_m;
  job->Try("", [&] { lowest_m = LowestGround_m(*job); });
  for (const std::string& channel : job->recording().ChannelsOf(kPoseChannel)) {
    job->Try(channel, [&] {
      const ScannedTable table = ReadTable(*job, channel);
      for (const ScannedRow& row : table.rows) {
        CheckNear(job, channel, row.line, Vec3(row.values[0], row.values[1], row.values[2]));
      }
      CheckQuaternions(job, channel, table);
      CheckVelocities(job, channel, table);
      CheckGround(job, channel, table, lowest_m);
    });
  }
}

}  // namespace tera
