#include "diagnose/sensors/signal_to_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tera {
namespace {

constexpr double kTenth_s = 0.1;
constexpr std::size_t kInSegments = 3;

/// How long a segment was observed.
double LengthOf_s(const MotionSegment& segment) {
  double from_s = std::numeric_limits<double>::max(), to_s = 0;
  for (const Observation& observation : segment.observations) {
    from_s = std::min(from_s, observation.from_s);
    to_s = std::max(to_s, observation.to_s);
  }
  return std::max(kTenth_s, to_s - from_s);
}

}  // namespace

double SignalToNoise(const MotionProblem& motion, const std::vector<ParameterQuadratic>& segments,
                     const ParameterTable& table, const NamedGroup& found) {
  const ParameterGroup& group = table.groups[static_cast<std::size_t>(found.group)];
  Eigen::VectorXd off = Eigen::VectorXd::Zero(group.count);
  for (int i = 0; i < group.count; ++i) {
    const JudgedParameter& number = found.parameters[static_cast<std::size_t>(i)];
    if (!number.is_beyond) continue;
    off[i] = number.value - table.parameters[static_cast<std::size_t>(group.first + i)].documented;
  }
  std::vector<double> ratios;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const auto own =
        segments[s].information.block(group.first, group.first, group.count, group.count);
    const double power = std::max(0.0, off.dot(own * off));
    ratios.push_back(std::sqrt(power * kTenth_s / LengthOf_s(motion.segments[s])));
  }
  if (ratios.empty()) return 0;
  std::sort(ratios.begin(), ratios.end(), std::greater<>());
  return ratios[std::min(ratios.size(), kInSegments) - 1];
}

}  // namespace tera
