#include <fmt/format.h>

#include <algorithm>

#include "core/quantile.h"
#include "core/units.h"
#include "dataset/import/inertial_conventions.h"
#include "dataset/lint/checks/change_vote.h"
#include "dataset/lint/checks/sensor_poses.h"
#include "dataset/lint/lint_job.h"

namespace tera {
namespace {

/// Median specific force divided by gravity. Accelerations of a machine are small compared with
/// gravity, whereas a wrong unit (g, mm/s2) is off by a factor of about ten or more.
constexpr double kLeastGravityShare = 0.5, kMostGravityShare = 2;
/// For a window of half a second. Covers a gyro bias of 0.1 rad/s and the noise of poses from lidar
/// registration.
constexpr double kAngleFloor_rad = 0.05;
/// If joints may lie between root and sensor, only a rotation ratio that no joint motion explains
/// counts. Windows in which the root turns less than kRootTurn_rad are skipped.
constexpr double kMostRatio = 20, kRootTurn_rad = 0.05;
/// Tolerance of the mean specific force in the world. Biases, scale errors and mount tilt cause
/// less than a tenth of gravity; a wrong axis causes an error of the size of gravity.
constexpr double kUpTolerance_mps2 = 1;

struct ImuRow {
  Vec3 w_S_radps, f_S_mps2;
};

ImuRow ImuOf(const ScannedRow& row) {
  const std::vector<double>& v = row.values;
  return {Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5])};
}

/// Checks an IMU on its own. Returns false after reporting that gravity is missing. Axes and rates
/// are left to imu.up and imu.rates if poses are known. For simulations they are as the scenario
/// defines.
bool CheckConventions(LintJob* job, const std::string& channel, const ScannedTable& table,
                      const std::optional<SensorPoses>& poses) {
  if (table.rows.empty()) return true;
  const std::optional<SensorSheet> sheet = job->SheetOf(channel);
  Vec3 up_S = Vec3::UnitZ();
  if (sheet && sheet->X_PS) up_S = sheet->X_PS->linear().transpose() * up_S;
  const auto sample = [&](std::size_t row) {
    const ImuRow imu = ImuOf(table.rows[row]);
    return ImuSample{table.rows[row].t_ns, table.rows[row].t_ns, imu.w_S_radps, imu.f_S_mps2};
  };
  job->Applies("imu.units");
  job->Applies("imu.down");
  const bool judges_axes = !job->recording().info().simulated && (!poses || poses->of_root);
  bool has_gravity = true;
  for (const InertialFinding& one : JudgeInertial(table.rows.size(), sample, up_S)) {
    const bool is_down = one.doubt == InertialDoubt::kZDown;
    const bool is_gravity = one.doubt == InertialDoubt::kNoGravity;
    if (is_down ? !judges_axes : poses.has_value() && !is_gravity) continue;
    has_gravity = has_gravity && !is_gravity;
    const RuleId rule = is_down      ? RuleId("imu.down")
                        : is_gravity ? RuleId("imu.gravity")
                                     : RuleId("imu.units");
    job->Find(rule, channel, {job->RowsOf(channel), 0, one.text});
  }
  return has_gravity;
}

void CheckGravity(LintJob* job, const std::string& channel, const ScannedTable& table) {
  if (table.rows.empty()) return;
  job->Applies("imu.gravity");
  std::vector<double> sizes;
  for (const ScannedRow& row : table.rows) sizes.push_back(ImuOf(row).f_S_mps2.norm());
  const double share = Median(sizes) / kStandardGravity_mps2;
  if (share > kLeastGravityShare && share < kMostGravityShare) return;
  job->Find(
      "imu.gravity", channel,
      {job->RowsOf(channel), 0,
       fmt::format("the median specific force is {:.4g} m/s2", share * kStandardGravity_mps2)});
}

/// Rotation over a window by gyro rates. The rate in a row is the mean since the previous row.
Mat3 TurnByGyroscope(const std::vector<ScannedRow>& rows, const RowWindow& window) {
  Mat3 R = Mat3::Identity();
  for (std::size_t i = window.first + 1; i <= window.second; ++i) {
    const Vec3 turn_rad = ToSeconds(rows[i].t_ns - rows[i - 1].t_ns) * ImuOf(rows[i]).w_S_radps;
    if (turn_rad.norm() > 0) {
      R = R * Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()).toRotationMatrix();
    }
  }
  return R;
}

/// Sum of the rotation angles. Unlike the net rotation, it does not wrap if the unit is deg/s.
double PathByGyroscope(const std::vector<ScannedRow>& rows, const RowWindow& window) {
  double path_rad = 0;
  for (std::size_t i = window.first + 1; i <= window.second; ++i) {
    path_rad += ToSeconds(rows[i].t_ns - rows[i - 1].t_ns) * ImuOf(rows[i]).w_S_radps.norm();
  }
  return path_rad;
}

double AngleOf(const Mat3& R) { return Eigen::AngleAxisd(R).angle(); }

void CheckTurns(LintJob* job, const std::string& channel, const ScannedTable& table,
                const SensorPoses& sensor) {
  ChangeVote vote(kAngleFloor_rad);
  std::vector<double> ratios;
  for (const RowWindow& window : WindowsOf(table.rows)) {
    const auto begin = PoseAt(sensor.poses, table.rows[window.first].t_ns);
    const auto end = PoseAt(sensor.poses, table.rows[window.second].t_ns);
    if (!begin || !end) continue;
    job->Applies("imu.rates");
    const Mat3 by_poses = begin->linear().transpose() * end->linear();
    const Mat3 by_unit = TurnByGyroscope(table.rows, window);
    const double turn_rad = AngleOf(by_poses), path_rad = PathByGyroscope(table.rows, window);
    // Beyond half a revolution, the difference of rotations wraps, but the difference of angles
    // does not.
    const double wrong_rad =
        path_rad > kPi ? path_rad - turn_rad : AngleOf(by_poses.transpose() * by_unit);
    vote.Add(table.rows[window.second].line, turn_rad, path_rad > kPi ? path_rad : AngleOf(by_unit),
             wrong_rad);
    if (turn_rad > kRootTurn_rad) ratios.push_back(path_rad / turn_rad);
  }
  const std::string file = job->RowsOf(channel);
  if (!sensor.of_root && vote.IsContradicted()) {
    job->Find("imu.rates", channel, {file, vote.line(), vote.Summary("poses", "the unit", "rad")});
  }
  if (!sensor.of_root || ratios.empty()) return;
  const double ratio = Median(ratios);
  if (ratio < kMostRatio && ratio > 1 / kMostRatio) return;
  job->Find(
      "imu.rates", channel,
      {file, 0,
       fmt::format("the unit turns {:.4g} times as far as its machine, in the median", ratio)});
}

double MostSpeed(const std::vector<PoseRow>& poses) {
  double most_mps = 0;
  for (std::size_t first = 0, i = 1; i < poses.size(); ++i) {
    const TimeNs span_ns = poses[i].pose.t_ns - poses[first].pose.t_ns;
    if (span_ns < kWindow_ns) continue;
    most_mps = std::max(
        most_mps, (poses[i].pose.X_WB.translation() - poses[first].pose.X_WB.translation()).norm() /
                      ToSeconds(span_ns));
    first = i;
  }
  return most_mps;
}

/// Checks that the mean specific force in W equals gravity plus the mean acceleration of the poses.
void CheckUp(LintJob* job, const std::string& channel, const ScannedTable& table,
             const SensorPoses& sensor) {
  if (sensor.of_root) return;
  Vec3 sum_W_mps2 = Vec3::Zero();
  int count = 0;
  TimeNs first_ns = 0, last_ns = 0;
  for (const ScannedRow& row : table.rows) {
    const auto X_WS = PoseAt(sensor.poses, row.t_ns);
    if (!X_WS) continue;
    if (count++ == 0) first_ns = row.t_ns;
    last_ns = row.t_ns;
    sum_W_mps2 += X_WS->linear() * ImuOf(row).f_S_mps2;
  }
  if (last_ns - first_ns < kWindow_ns) return;
  job->Applies("imu.up");
  const Vec3 mean_W_mps2 = sum_W_mps2 / count;
  const double tolerance_mps2 =
      kUpTolerance_mps2 + 2 * MostSpeed(sensor.poses) / ToSeconds(last_ns - first_ns);
  if ((mean_W_mps2 - Vec3(0, 0, kStandardGravity_mps2)).norm() <= tolerance_mps2) return;
  job->Find("imu.up", channel,
            {job->RowsOf(channel), 0,
             fmt::format("the mean is ({:.3g}, {:.3g}, {:.3g}) m/s2 east, north and up",
                         mean_W_mps2.x(), mean_W_mps2.y(), mean_W_mps2.z())});
}

}  // namespace

void CheckInertialUnits(LintJob* job) {
  for (const std::string& channel : job->recording().ChannelsOf(kImuChannel)) {
    job->Try(channel, [&] {
      const ScannedTable table = ReadTable(*job, channel);
      const std::optional<SensorPoses> sensor = FindSensorPoses(*job, channel);
      if (CheckConventions(job, channel, table, sensor)) CheckGravity(job, channel, table);
      if (!sensor) return;
      CheckTurns(job, channel, table, *sensor);
      CheckUp(job, channel, table, *sensor);
    });
  }
}

}  // namespace tera
