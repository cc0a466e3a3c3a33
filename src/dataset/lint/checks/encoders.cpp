#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "dataset/import/angle_wrap.h"
#include "dataset/lint/checks/change_vote.h"
#include "dataset/lint/lint_job.h"

// Checks levers and joints.

namespace tera {
namespace {

/// Above the resolution of encoders (a tenth of a degree, tenths of a millimetre) and above the
/// noise of their rates, integrated over a window.
constexpr double kJointFloor_rad = 0.02, kTravelFloor_m = 0.005;
/// No joint exceeds these limits: ten revolutions at the start, and the rate of a 1 m wheel at 100
/// m/s.
constexpr double kMostFirstAngle_rad = 20 * kPi, kMostRate_radps = 100;
/// A cab slews at up to 14 rpm.
constexpr double kMostSwing_radps = 1.5;
/// A larger offset, 10 degrees or 10 cm, means that the zero position is wrong.
constexpr double kTruthTolerance_rad = 10 * kDeg, kTruthTolerance_m = 0.1;

struct Joint {
  std::string column;  ///< position column
  std::size_t position = 0, rate = 0;
  bool linear = false;
};

std::vector<Joint> JointsOf(const ScannedTable& table) {
  std::vector<Joint> joints;
  const std::size_t n = table.columns.size() / 2;
  for (std::size_t c = 0; c < n; ++c) {
    joints.push_back({table.columns[c], c, n + c, table.columns[c].ends_with("_m")});
  }
  return joints;
}

void CheckRates(LintJob* job, const std::string& channel, const ScannedTable& table,
                const Joint& joint) {
  ChangeVote vote(joint.linear ? kTravelFloor_m : kJointFloor_rad);
  for (const RowWindow& window : WindowsOf(table.rows)) {
    job->Applies("encoders.rates");
    double integral = 0;
    for (std::size_t i = window.first; i < window.second; ++i) {
      const ScannedRow &a = table.rows[i], &b = table.rows[i + 1];
      integral += 0.5 * ToSeconds(b.t_ns - a.t_ns) * (a.values[joint.rate] + b.values[joint.rate]);
    }
    const ScannedRow& end = table.rows[window.second];
    const double change =
        end.values[joint.position] - table.rows[window.first].values[joint.position];
    vote.Add(end.line, std::abs(change), std::abs(integral), std::abs(change - integral));
  }
  if (!vote.IsContradicted()) return;
  job->Find("encoders.rates", channel,
            {job->RowsOf(channel), vote.line(),
             vote.Summary(joint.column, table.columns[joint.rate], joint.linear ? "m" : "rad")});
}

/// Rows at which the angle of a joint jumps.
std::vector<std::size_t> JumpsOfJoint(const ScannedTable& table, const Joint& joint) {
  if (joint.linear) return {};
  std::vector<double> angles;
  for (const ScannedRow& row : table.rows) angles.push_back(row.values[joint.position]);
  return JumpsOf(angles, 2 * kPi);
}

void CheckJumps(LintJob* job, const std::string& channel, const ScannedTable& table,
                const Joint& joint) {
  if (joint.linear) return;
  job->Applies("encoders.jump");
  for (const std::size_t row : JumpsOfJoint(table, joint)) {
    job->Find("encoders.jump", channel,
              {job->RowsOf(channel), table.rows[row].line,
               fmt::format("{} goes from {:.4g} to {:.4g} rad", joint.column,
                           table.rows[row - 1].values[joint.position],
                           table.rows[row].values[joint.position])});
  }
}

/// True if a joint may exceed a full turn at the start of a recording, like a wheel or a slewing
/// cab. A joint that rests, or oscillates faster than a cab slews, may not.
bool CanBeBeyondATurn(const ScannedTable& table, const Joint& joint) {
  constexpr double kOnAndOn = 0.8, kLeastTravel_rad = 0.1;
  double path_rad = 0, fastest_radps = 0;
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    path_rad +=
        std::abs(table.rows[i].values[joint.position] - table.rows[i - 1].values[joint.position]);
    fastest_radps = std::max(fastest_radps, std::abs(table.rows[i].values[joint.rate]));
  }
  if (path_rad < kLeastTravel_rad) return false;
  const double way_rad = std::abs(table.rows.back().values[joint.position] -
                                  table.rows.front().values[joint.position]);
  return fastest_radps <= kMostSwing_radps || (way_rad > 4 * kPi && way_rad > kOnAndOn * path_rad);
}

void CheckRadians(LintJob* job, const std::string& channel, const ScannedTable& table,
                  const Joint& joint) {
  if (joint.linear || table.rows.empty()) return;
  job->Applies("encoders.radians");
  const auto find = [&](const ScannedRow& row, std::size_t column, const char* unit) {
    job->Find("encoders.radians", channel,
              {job->RowsOf(channel), row.line,
               fmt::format("{} is {:.4g} {}", table.columns[column], row.values[column], unit)});
  };
  const ScannedRow& first = table.rows.front();
  const double start_rad = std::abs(first.values[joint.position]);
  if (start_rad > kMostFirstAngle_rad || (start_rad > 2 * kPi && !CanBeBeyondATurn(table, joint))) {
    find(first, joint.position, "rad at the first row, beyond a turn");
  }
  // A difference quotient across a jump is not a rate. The jump is reported by encoders.jump.
  const std::vector<std::size_t> jumps = JumpsOfJoint(table, joint);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const bool is_of_jump = std::any_of(jumps.begin(), jumps.end(), [&](std::size_t jump) {
      return i <= jump + 1 && jump <= i + 1;
    });
    const ScannedRow& row = table.rows[i];
    if (is_of_jump || std::abs(row.values[joint.rate]) <= kMostRate_radps) continue;
    find(row, joint.rate, "rad/s");
  }
}

/// Value of a column in the row nearest in time; nullopt outside the table.
std::optional<double> NearestValue(const ScannedTable& table, std::size_t column, TimeNs t_ns) {
  const auto after = std::lower_bound(table.rows.begin(), table.rows.end(), t_ns,
                                      [](const ScannedRow& row, TimeNs t) { return row.t_ns < t; });
  if (after == table.rows.end()) return std::nullopt;
  if (after == table.rows.begin() || after->t_ns - t_ns < t_ns - std::prev(after)->t_ns) {
    return after->values[column];
  }
  return std::prev(after)->values[column];
}

void CheckByTruth(LintJob* job, const std::string& channel, const ScannedTable& table,
                  const Joint& joint, const ScannedTable& truth) {
  const auto found = std::find(truth.columns.begin(), truth.columns.end(), joint.column);
  if (found == truth.columns.end()) return;
  const auto column = static_cast<std::size_t>(found - truth.columns.begin());
  std::vector<double> differences;
  for (const ScannedRow& row : table.rows) {
    if (const auto value = NearestValue(truth, column, row.t_ns)) {
      differences.push_back(row.values[joint.position] - *value);
    }
  }
  if (differences.empty()) return;
  job->Applies("encoders.truth");
  std::sort(differences.begin(), differences.end());
  const double median = differences[differences.size() / 2];
  if (std::abs(median) <= (joint.linear ? kTruthTolerance_m : kTruthTolerance_rad)) return;
  job->Find("encoders.truth", channel,
            {job->RowsOf(channel), 0,
             fmt::format("{} is {:.4g} {} from the truth, in the median", joint.column, median,
                         joint.linear ? "m" : "rad")});
}

void CheckEncoder(LintJob* job, const std::string& channel) {
  const ScannedTable table = ReadTable(*job, channel);
  const std::string joints = "truth/" + MachineOfChannel(channel) + "/joints.csv";
  const bool has_truth = job->recording().Has(joints) && !job->IsLeftOut(joints);
  const ScannedTable truth = has_truth ? ReadTable(*job, joints) : ScannedTable();
  for (const Joint& joint : JointsOf(table)) {
    CheckRates(job, channel, table, joint);
    CheckJumps(job, channel, table, joint);
    CheckRadians(job, channel, table, joint);
    if (has_truth) CheckByTruth(job, channel, table, joint, truth);
  }
}

void CheckLevers(LintJob* job, const std::string& channel) {
  job->Applies("commands.range");
  RowScan scan(job->Path(channel), {});
  for (ScannedRow row; scan.Next(&row);) {
    for (std::size_t c = 0; c < row.values.size(); ++c) {
      if (std::abs(row.values[c]) <= 1) continue;
      job->Find("commands.range", channel,
                {channel, row.line, fmt::format("{} is {:.6g}", scan.columns()[c], row.values[c])});
    }
  }
}

}  // namespace

void CheckCommands(LintJob* job) {
  for (const std::string& channel : job->recording().ChannelsOf(kTableChannel)) {
    if (!channel.ends_with("/commands.csv")) continue;
    job->Try(channel, [&] { CheckLevers(job, channel); });
  }
}

void CheckEncoders(LintJob* job) {
  for (const std::string& channel : job->recording().ChannelsOf(kEncoderChannel)) {
    job->Try(channel, [&] { CheckEncoder(job, channel); });
  }
}

}  // namespace tera
