#include "blind/cases/joints_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tera::blind {
namespace {

Table CommandsOf(const Motion& motion) {
  Table table{{kJoints.begin(), kJoints.end()}};
  for (std::size_t k = 0; k < motion.lever.size(); ++k) {
    table.t_ns.push_back(std::llround(static_cast<double>(k) * motion.command_s * 1e9));
    table.rows.emplace_back(motion.lever[k].begin(), motion.lever[k].end());
  }
  return table;
}

Table EncodersOf(const EncoderRows& rows) {
  Table table;
  for (const std::size_t i : rows.axes) table.columns.push_back(fmt::format("{}_rad", kJoints[i]));
  for (const std::size_t i : rows.axes) {
    table.columns.push_back(fmt::format("{}_radps", kJoints[i]));
  }
  table.t_ns = rows.t_ns;
  for (std::size_t k = 0; k < rows.t_ns.size(); ++k) {
    std::vector<double> row;
    for (const std::size_t i : rows.axes) row.push_back(rows.q_rad[k][i]);
    for (const std::size_t i : rows.axes) row.push_back(rows.w_radps[k][i]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

double NoiseOf(const EncoderRows& rows, const Motion& motion, std::size_t axis) {
  double sum = 0;
  for (std::size_t k = 0; k < rows.w_radps.size(); ++k) {
    const double error = rows.w_radps[k][axis] - motion.w_radps[rows.sample[k]][axis];
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(rows.w_radps.size()));
}

Change ChangeOf(const Motion& with, const Motion& without, std::size_t axis,
                const EncoderNoise& noise) {
  Change change{with.t_s, {}};
  for (std::size_t k = 0; k < with.t_s.size(); ++k) {
    change.over_noise.push_back((with.w_radps[k][axis] - without.w_radps[k][axis]) /
                                noise.rate_radps);
  }
  return change;
}

}  // namespace

double Change::Shows_s() const {
  if (t_s.size() < 2) return 0;
  const auto loud = std::count_if(over_noise.begin(), over_noise.end(),
                                  [](double x) { return std::abs(x) >= 1; });
  return static_cast<double>(loud) / static_cast<double>(t_s.size()) * (t_s.back() - t_s.front());
}

double Change::Rms() const {
  double sum = 0;
  for (const double x : over_noise) sum += x * x;
  return over_noise.empty() ? 0 : std::sqrt(sum / static_cast<double>(over_noise.size()));
}

CaseRecording RecordJoints(const JointsCase& joints, double duration_s, std::uint64_t seed,
                           const std::string& name) {
  const Stream queue(seed, name + "/queue"), noise(seed, name + "/measurement");
  const Course course{joints.start_rad, duration_s,
                      SampleTimes(duration_s, joints.noise, Stream(seed, name + "/times"))};
  Operator someone(joints.excavator, joints.habit, Stream(seed, name + "/operator"));
  const Motion motion = Move(
      joints.excavator, joints.forms, course,
      [&](double t_s, const AxisValues& q_rad) { return someone.At(t_s, q_rad); }, queue);
  CaseRecording recording;
  recording.commands = CommandsOf(motion);
  const EncoderRows rows = Measure(motion, joints.measured, joints.noise, noise);
  recording.encoders = EncodersOf(rows);
  for (const std::size_t axis : joints.measured) {
    const std::string channel = fmt::format("{}/encoders/{}_radps", kName, kJoints[axis]);
    recording.noise_rms[channel] = NoiseOf(rows, motion, axis);
  }
  for (const HiddenInJoint& hidden : joints.hidden) {
    const Motion without = Move(joints.excavator, hidden.without, course, Replayed(motion), queue);
    recording.changes.push_back(ChangeOf(motion, without, hidden.axis, joints.noise));
  }
  return recording;
}

}  // namespace tera::blind
