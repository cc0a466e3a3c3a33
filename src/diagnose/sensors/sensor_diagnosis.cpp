#include "diagnose/sensors/sensor_diagnosis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "core/units.h"
#include "diagnose/motion/starting_delays.h"
#include "diagnose/sensors/reflection.h"
#include "diagnose/sensors/unit_signal.h"
#include "diagnose/statistics/series/robust.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

constexpr int kIterationsAgain = 8;
constexpr int kRounds = 3;  ///< most rounds of linearisation with the named groups free
/// Parts separated by at most the splines' margin meet in the middle.
constexpr double kJoined_s = 0.5;

/// Numbers of `multipath` from the four linear numbers.
std::vector<FoundNumber> NumbersOfReflection(const std::vector<FoundNumber>& linear) {
  Eigen::Vector4d value, documented, sigma;
  for (int i = 0; i < 4; ++i) {
    const FoundNumber& one = linear[static_cast<std::size_t>(i)];
    value[i] = one.value;
    documented[i] = one.documented;
    sigma[i] = one.sigma;
  }
  const Reflection found = ReflectionOf(value), usual = ReflectionOf(documented);
  const Eigen::Vector2d along(std::cos(found.azimuth_rad), std::sin(found.azimuth_rad));
  const Eigen::Vector2d across(-along.y(), along.x());
  const auto sigma_of = [&](const Eigen::Vector2d& way, int first) {
    return way.cwiseProduct(sigma.segment<2>(first)).norm();
  };
  const double turned_rad = sigma_of(across, 0) / std::max(found.horizontal_m, 1e-6);
  return {{"horizontal_m", "m", found.horizontal_m, sigma_of(along, 0), usual.horizontal_m,
           linear[0].tolerance, linear[0].is_beyond || linear[1].is_beyond},
          {"vertical_m", "m", found.vertical_m, sigma_of(along, 2), usual.vertical_m,
           linear[2].tolerance, linear[2].is_beyond || linear[3].is_beyond},
          {"azimuth_deg", "deg", found.azimuth_rad / kDeg, std::min(180.0, turned_rad / kDeg),
           usual.azimuth_rad / kDeg, 180, false}};
}

SensorFinding FindingOf(const ParameterTable& table, int g,
                        const std::vector<JudgedParameter>& judged) {
  const ParameterGroup& group = table.groups[static_cast<std::size_t>(g)];
  SensorFinding finding{group, {}, 0, 1, {}};
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const SensorParameter& one = table.parameters[static_cast<std::size_t>(group.first) + i];
    if (one.of_share) {
      const auto& [value, sigma, documented] = *one.of_share;
      const bool is_clipped = judged[i].is_beyond;
      finding.numbers.push_back(
          {one.name, one.unit, is_clipped ? value : documented, sigma, documented, 0, is_clipped});
      continue;
    }
    finding.numbers.push_back({one.name, one.unit, judged[i].value / one.si_per_unit,
                               judged[i].sigma / one.si_per_unit, one.documented / one.si_per_unit,
                               one.tolerance / one.si_per_unit, judged[i].is_beyond});
  }
  if (group.mechanism->id == kMultipath) finding.numbers = NumbersOfReflection(finding.numbers);
  return finding;
}

std::vector<int> NamedOf(const GroupJudgement& judgement) {
  std::vector<int> named;
  for (const NamedGroup& one : judgement.named) named.push_back(one.group);
  return named;
}

/// RMS without the largest hundredth: an impact at a stop leaves a few residuals that are a hundred
/// times larger.
double RmsOf(const ChannelResiduals& residuals) {
  std::vector<double> squares;
  for (const auto& segment : residuals.by_segment) {
    for (const double r : segment) squares.push_back(r * r);
  }
  if (squares.empty()) return 0;
  const auto most = squares.end() - static_cast<std::ptrdiff_t>(squares.size() / 100);
  std::nth_element(squares.begin(), most == squares.end() ? squares.end() - 1 : most,
                   squares.end());
  return std::sqrt(std::accumulate(squares.begin(), most, 0.0) /
                   static_cast<double>(most - squares.begin()));
}

/// Reverses the axes that oppose a motion. Returns true if there are any.
bool TurnAbout(const MotionEstimate& implied, MotionProblem* motion,
               std::vector<OpposedAxis>* opposed) {
  const std::vector<OpposedAxis> more = OpposedAxes(*motion, implied);
  for (const OpposedAxis& one : more) motion->imus[one.unit].signs[one.row] *= -1;
  opposed->insert(opposed->end(), more.begin(), more.end());
  return !more.empty();
}

/// Fits all parameters, starting from the documented delays. Where SetStartingDelays gives other
/// delays, a second fit starts from them. The fit with the smaller LogScale is returned.
MotionEstimate WithAnyDelays(const MotionProblem& motion, const ParameterPrior& wide,
                             MotionEstimate start, const EstimateOptions& options) {
  MotionEstimate best = EstimateMotion(motion, wide, start, options);
  SetStartingDelays(motion, &start);
  if (start.parameters == wide.documented) return best;
  MotionEstimate other = EstimateMotion(motion, wide, std::move(start), options);
  return LogScale(other) < LogScale(best) ? other : best;
}

/// The fit under the wide prior. Axes that oppose the starting motion or the estimated motion are
/// reversed.
MotionEstimate FlexibleEstimate(const ParameterPrior& wide, const EstimateOptions& options,
                                MotionProblem* motion, std::vector<OpposedAxis>* opposed) {
  const MotionEstimate start = StartingEstimate(*motion, wide);
  TurnAbout(start, motion, opposed);
  const MotionEstimate first = WithAnyDelays(*motion, wide, start, options);
  return TurnAbout(first, motion, opposed) ? WithAnyDelays(*motion, wide, start, options) : first;
}

/// Reversed axes as one finding per unit. An axis reversed in both triads is one number.
std::vector<SensorFinding> ReversedOf(const SensorProblem& problem, const MotionEstimate& estimate,
                                      const std::vector<OpposedAxis>& opposed) {
  std::vector<SensorFinding> reversed;
  for (std::size_t u = 0; u < problem.motion.imus.size(); ++u) {
    const UnitChannel& unit = problem.motion.imus[u];
    std::array<bool, 6> is_reversed{};
    SensorFinding finding{{{}, &SensorMechanism("axis_flip", EffectTarget::kImu)}, {}, 0, 0};
    for (const OpposedAxis& one : opposed) {
      if (one.unit != u) continue;
      is_reversed[static_cast<std::size_t>(one.row)] = true;
      finding.p = std::max(finding.p, one.p);
      // A reversed axis has an error of twice its motion.
      const auto c = static_cast<std::size_t>(unit.noise + one.row);
      const double ratio = 2 * estimate.noise[c].motion / estimate.noise[c].sigma;
      for (const auto& segment : estimate.residuals[c].by_segment) {
        finding.gain +=
            0.5 * ratio * ratio * static_cast<double>(segment.size()) / estimate.noise[c].inflation;
      }
    }
    for (std::size_t row = 0; row < 6; ++row) {
      const std::string axis(1, "xyz"[row % 3]);
      const bool both = is_reversed[row % 3] && is_reversed[row % 3 + 3];
      if (!is_reversed[row] || (both && row >= 3)) continue;
      finding.numbers.push_back(
          {both ? axis : (row < 3 ? "gyro_" : "accel_") + axis, "1", 1, 0, 0, 0, true});
    }
    if (finding.numbers.empty()) continue;
    finding.target = UnitOf(problem, u);
    reversed.push_back(std::move(finding));
  }
  return reversed;
}

/// Parameters to linearise about: fitted values for free groups, documented values for the others.
Eigen::VectorXd StartOf(const ParameterTable& table, const std::vector<int>& free,
                        Eigen::VectorXd fitted) {
  for (std::size_t g = 0; g < table.groups.size(); ++g) {
    if (std::find(free.begin(), free.end(), static_cast<int>(g)) != free.end()) continue;
    const ParameterGroup& group = table.groups[g];
    for (int i = group.first; i < group.first + group.count; ++i) {
      fitted[i] = table.parameters[static_cast<std::size_t>(i)].documented;
    }
  }
  return fitted;
}

std::vector<EstimatedMotion> MotionOf(const MotionProblem& problem,
                                      const MotionEstimate& estimate) {
  std::vector<EstimatedMotion> motion;
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    const MotionSegment& segment = problem.segments[s];
    if (segment.observations.empty()) continue;
    const double end_s = segment.spline.end_s(), shift_s = estimate.motion[s].shift_s;
    double from_s = end_s, to_s = 0;
    for (const Observation& observation : segment.observations) {
      from_s = std::min(from_s, std::max(0.0, observation.from_s + shift_s));
      to_s = std::max(to_s, std::min(end_s, observation.to_s + shift_s));
    }
    EstimatedMotion one;
    one.spline_start_ns = segment.start_ns - FromSeconds(shift_s);
    one.start_ns = one.spline_start_ns + FromSeconds(from_s);
    one.end_ns = one.spline_start_ns + FromSeconds(to_s);
    one.spline = segment.spline;
    one.coefficients = estimate.motion[s].coefficients;
    motion.push_back(std::move(one));
  }
  for (std::size_t s = 1; s < motion.size(); ++s) {
    const double apart_s = ToSeconds(motion[s].start_ns - motion[s - 1].end_ns);
    if (std::abs(apart_s) > kJoined_s) continue;
    const TimeNs between_ns = (motion[s - 1].end_ns + motion[s].start_ns) / 2;
    motion[s - 1].end_ns = motion[s].start_ns = between_ns;
  }
  return motion;
}

SensorFinding FindingOf(const ParameterTable& table, const NamedGroup& one) {
  SensorFinding finding = FindingOf(table, one.group, one.parameters);
  finding.gain = one.gain;
  finding.p = one.p;
  for (const int g : one.rivals) {
    finding.rivals.push_back(table.groups[static_cast<std::size_t>(g)]);
  }
  return finding;
}

void Report(const ParameterTable& table, const GroupJudgement& judgement,
            SensorDiagnosis* diagnosis) {
  diagnosis->left_to_gain = judgement.left_to_gain;
  for (const NamedGroup& one : judgement.named) {
    diagnosis->findings.push_back(FindingOf(table, one));
  }
  for (const NamedGroup& one : judgement.unproven) {
    diagnosis->unproven.push_back(FindingOf(table, one));
  }
  std::stable_sort(diagnosis->findings.begin(), diagnosis->findings.end(),
                   [](const auto& a, const auto& b) { return a.gain > b.gain; });
  const auto list = [&](const std::vector<int>& groups, std::vector<SensorFinding>* out) {
    for (const int g : groups) {
      out->push_back(FindingOf(table, g, judgement.by_group[static_cast<std::size_t>(g)]));
    }
  };
  list(judgement.within, &diagnosis->within_tolerance);
  list(judgement.untestable, &diagnosis->untestable);
  for (const auto& groups : judgement.not_told_apart) {
    diagnosis->not_told_apart.emplace_back();
    for (const int g : groups) {
      diagnosis->not_told_apart.back().push_back(table.groups[static_cast<std::size_t>(g)]);
    }
  }
}

}  // namespace

Eigen::Matrix<double, kBaseNumbers, 1> EstimatedMotion::BaseNumbersAt(TimeNs t_ns) const {
  const SplineWeights weights = spline.At(ToSeconds(t_ns - spline_start_ns));
  return coefficients.block<4, kBaseNumbers>(weights.first, 0).transpose() *
         weights.by_derivative.row(0).head<4>().transpose();
}

Pose EstimatedMotion::BaseAt(TimeNs t_ns) const {
  const auto at = BaseNumbersAt(t_ns);
  return MakePose(at.head<3>(), at[kRoll], at[kRoll + 1], at[kYaw]);
}

SensorDiagnosis DiagnoseSensors(const DiagnosisInput& input, const Measurements& measured,
                                const SensorDiagnosisOptions& options, StageClock* clock) {
  SensorProblem problem = clock->Time(
      "sensors: problem", [&] { return MakeSensorProblem(input, measured, options.place); });
  SensorDiagnosis diagnosis;
  diagnosis.not_compared = problem.not_compared;
  const MotionProblem& motion = problem.motion;
  const std::size_t places = motion.receivers.size() + motion.poses.size();
  const bool is_alone = motion.imus.empty() && motion.axes.empty() && places < 2;
  if ((motion.imus.empty() && motion.receivers.empty()) || is_alone) return diagnosis;
  diagnosis.knows_base =
      motion.receivers.size() >= 2 || (!motion.receivers.empty() && !motion.imus.empty());
  EstimateOptions estimate_options{.threads = options.threads};
  const ParameterPrior wide = problem.table.FlexiblePrior();
  std::vector<OpposedAxis> opposed;
  const MotionEstimate flexible = clock->Time("sensors: motion", [&] {
    MotionEstimate first = FlexibleEstimate(wide, estimate_options, &problem.motion, &opposed);
    const auto admits = [&](const char* id) {
      return !options.library || Admits(*options.library, id);
    };
    if (admits("filter_delay")) {
      first = WithLowPasses(input, estimate_options, std::move(first), &problem);
    }
    return admits("saturation") ? WithClipping(input, estimate_options, std::move(first), &problem)
                                : first;
  });
  if (options.library) problem.table.LimitTo(*options.library);
  const std::vector<ParameterGroup>& groups = problem.table.groups;
  std::copy_if(groups.begin(), groups.end(), std::back_inserter(diagnosis.estimated),
               [](const ParameterGroup& group) { return group.mechanism != nullptr; });
  diagnosis.candidates = static_cast<std::size_t>(
      std::count_if(problem.table.groups.begin(), problem.table.groups.end(),
                    [](const ParameterGroup& group) { return group.may_be_named; }));
  diagnosis.iterations = flexible.iterations;
  GroupJudgement judgement = clock->Time("sensors: judging", [&] {
    return JudgeGroups(problem.table, flexible.quadratics, options.judge);
  });
  estimate_options.estimates_noise = false;
  estimate_options.most_iterations = kIterationsAgain;
  const auto with_free = [&](const std::vector<int>& free) {
    return clock->Time("sensors: motion again", [&] {
      const ParameterPrior prior = problem.table.PriorWith(free);
      MotionEstimate start = flexible;
      SetParameters(problem.motion.delays, StartOf(problem.table, free, flexible.parameters),
                    &start);
      return EstimateMotion(problem.motion, prior, start, estimate_options);
    });
  };
  const MotionEstimate before = with_free({});
  MotionEstimate after = before;
  for (int round = 0; round < kRounds && !judgement.named.empty(); ++round) {
    const std::vector<int> named = NamedOf(judgement);
    after = with_free(named);
    judgement = clock->Time("sensors: judging", [&] {
      return JudgeGroups(problem.table, after.quadratics, options.judge);
    });
    if (NamedOf(judgement) == named) break;
  }
  for (std::size_t c = 0; c < flexible.noise.size(); ++c) {
    const NoiseChannel& channel = flexible.noise[c];
    diagnosis.channels.push_back(
        {channel.name, channel.unit, channel.sigma, channel.inflation,
         std::max(channel.least, WhiteNoise(after.residuals[c].by_segment)), channel.motion,
         channel.tolerance, RmsOf(before.residuals[c]), RmsOf(after.residuals[c])});
  }
  diagnosis.motion = MotionOf(problem.motion, after);
  Report(problem.table, judgement, &diagnosis);
  const std::vector<SensorFinding> reversed = ReversedOf(problem, flexible, opposed);
  diagnosis.findings.insert(diagnosis.findings.begin(), reversed.begin(), reversed.end());
  return diagnosis;
}

}  // namespace tera
