#include <fmt/format.h>

#include <cmath>

#include "dataset/lint/checks/change_vote.h"
#include "dataset/lint/checks/sensor_poses.h"
#include "dataset/lint/lint_job.h"

namespace tera {
namespace {

/// Contact moves a machine by steps that its velocity, a mean of the steps beside a row, does not
/// tell; they stay far below these.
constexpr double kPositionFloor_m = 0.03, kTurnFloor_rad = 0.02;

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

/// What velocities and rates make of the first pose, a mean of two rows at a time.
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
  if (poses.size() != table.rows.size()) return;  // poses.quaternion tells
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

}  // namespace

void CheckPoses(LintJob* job) {
  for (const std::string& channel : job->recording().ChannelsOf(kPoseChannel)) {
    job->Try(channel, [&] {
      const ScannedTable table = ReadTable(*job, channel);
      CheckQuaternions(job, channel, table);
      CheckVelocities(job, channel, table);
    });
  }
}

}  // namespace tera
