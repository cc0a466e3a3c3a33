#include "diagnose/replay/effort_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "diagnose/statistics/series/robust.h"
#include "physics/actuation/load_friction.h"
#include "physics/dynamics/gravity_load.h"
#include "physics/dynamics/inertial_effort.h"

namespace tera {
namespace {

constexpr double kWidestBand_hz = 20;  ///< above, machines move little and encoder noise is large
/// Upper limit of the band, over the lower sample rate of effort and encoder.
constexpr double kMostBandOfRate = 0.2;
/// Samples of the comparison per period of the band. The Gaussian still passes a quarter at twice
/// the band, which is half their rate.
constexpr double kSamplesPerPeriod = 4;
constexpr double kReachInSigma = 4;  ///< half the length of the truncated Gaussian
/// A joint below this share of its largest rate is at rest.
constexpr double kMostRestShare = 0.01;
constexpr double kLongestGapSteps = 5;       ///< longer intervals, in sample periods, are gaps
constexpr std::size_t kFewestSamples = 100;  ///< least number of samples of effort and of position
constexpr std::size_t kMostFineSteps = 10'000'000;

struct Samples {
  std::vector<TimeNs> t_ns;
  std::vector<double> value;

  double Step_s() const {
    std::vector<double> step_s;
    for (std::size_t i = 1; i < t_ns.size(); ++i) {
      step_s.push_back(ToSeconds(t_ns[i] - t_ns[i - 1]));
    }
    return Median(step_s);
  }
};

std::optional<Samples> PositionSamples(const std::string& joint,
                                       const std::vector<NamedEncoders>& encoders) {
  auto samples = SamplesOf(joint, encoders);
  if (!samples || samples->t_ns.size() < kFewestSamples) return std::nullopt;
  return Samples{std::move(samples->t_ns), std::move(samples->position_rad)};
}

struct Grid {
  TimeNs start_ns = 0;
  double step_s = 0;
  std::size_t size = 0;

  TimeNs t_ns(std::size_t k) const {
    return start_ns + FromSeconds(static_cast<double>(k) * step_s);
  }
};

struct Spread {
  std::vector<double> value;
  std::vector<bool> known;  ///< true if samples are near on both sides
};

/// Linear interpolation of samples to a grid. `step_s` is the usual sample period.
Spread Over(const Grid& grid, const Samples& samples, double step_s) {
  Spread spread{std::vector<double>(grid.size), std::vector<bool>(grid.size)};
  std::size_t next = 0;
  for (std::size_t k = 0; k < grid.size; ++k) {
    const TimeNs t_ns = grid.t_ns(k);
    while (next < samples.t_ns.size() && samples.t_ns[next] < t_ns) ++next;
    const std::size_t b = std::min(next, samples.t_ns.size() - 1), a = next == 0 ? 0 : next - 1;
    const double gap_s = ToSeconds(samples.t_ns[b] - samples.t_ns[a]);
    const double s =
        gap_s > 0 ? std::clamp(ToSeconds(t_ns - samples.t_ns[a]) / gap_s, 0.0, 1.0) : 0.0;
    spread.value[k] = std::lerp(samples.value[a], samples.value[b], s);
    spread.known[k] = gap_s <= kLongestGapSteps * step_s;
  }
  return spread;
}

/// A Gaussian and its first two derivatives at even steps.
struct Kernels {
  std::vector<double> smooth, slope, curvature;

  Kernels(double sigma_s, double step_s) {
    const auto reach = static_cast<int>(std::ceil(kReachInSigma * sigma_s / step_s));
    double sum = 0;
    for (int i = -reach; i <= reach; ++i) {
      smooth.push_back(std::exp(-0.5 * std::pow(i * step_s / sigma_s, 2)));
      sum += smooth.back();
    }
    // Normalised for exact results: slope and zero curvature of a line, curvature of a parabola.
    double second = 0, fourth = 0;
    for (int i = -reach; i <= reach; ++i) {
      double& g = smooth[static_cast<std::size_t>(i + reach)];
      g /= sum;
      second += g * std::pow(i * step_s, 2);
      fourth += g * std::pow(i * step_s, 4);
    }
    for (int i = -reach; i <= reach; ++i) {
      const double g = smooth[static_cast<std::size_t>(i + reach)], t_s = i * step_s;
      slope.push_back(g * t_s / second);
      curvature.push_back(2 * g * (t_s * t_s - second) / (fourth - second * second));
    }
  }
  std::size_t reach() const { return smooth.size() / 2; }
};

double Convolved(const std::vector<double>& kernel, const std::vector<double>& x, std::size_t at) {
  const std::size_t first = at - kernel.size() / 2;
  double sum = 0;
  for (std::size_t i = 0; i < kernel.size(); ++i) sum += kernel[i] * x[first + i];
  return sum;
}

struct JointMotion {
  std::vector<double> q_rad, qd_radps, qdd_radps2;
};

/// Efforts that accelerate and support the links of a machine with a level, standing base.
///
/// Model   Accelerations of the links are second differences of their poses over a millisecond.
class Dynamics {
 public:
  explicit Dynamics(const MachineModel& model) : model_(model), inertial_(model) {}

  double Inertial_nm(const JointMotion& motion, std::size_t joint) {
    constexpr double kStep_s = 1e-3;
    std::vector<std::vector<Pose>> X_BL;
    for (const double t_s : {-kStep_s, 0.0, kStep_s}) {
      std::vector<double> q_rad = motion.q_rad;
      for (std::size_t j = 0; j < q_rad.size(); ++j) {
        q_rad[j] += t_s * motion.qd_radps[j] + 0.5 * t_s * t_s * motion.qdd_radps2[j];
      }
      X_BL.push_back(ForwardKinematics(model_, Pose::Identity(), q_rad));
    }
    MachineState state;
    for (std::size_t l = 0; l < model_.links.size(); ++l) {
      const Pose &a = X_BL[0][l], &b = X_BL[1][l], &c = X_BL[2][l];
      const Eigen::AngleAxisd before(Mat3(b.linear() * a.linear().transpose()));
      const Eigen::AngleAxisd after(Mat3(c.linear() * b.linear().transpose()));
      BodyState& link = state.links.emplace_back();
      link.X_WB = b;
      link.a_WB_mps2 =
          (c.translation() - 2 * b.translation() + a.translation()) / (kStep_s * kStep_s);
      link.v_WB_mps = (c.translation() - a.translation()) / (2 * kStep_s);
      link.w_WB_radps =
          (after.angle() * after.axis() + before.angle() * before.axis()) / (2 * kStep_s);
      link.alpha_WB_radps2 =
          (after.angle() * after.axis() - before.angle() * before.axis()) / (kStep_s * kStep_s);
    }
    inertial_.Update(state);
    return inertial_.joints_nm()[joint];
  }

  double Weight_nm(const JointMotion& motion, std::size_t joint) const {
    return GravityLoads_nm(model_, Pose::Identity(), motion.q_rad)[joint];
  }

 private:
  const MachineModel& model_;
  InertialEfforts inertial_;
};

/// The measurements for one log.
struct Sides {
  Samples effort;
  std::vector<std::optional<Samples>> position;  ///< one per joint
};

/// Fine grid over the common time of effort and position of the joint.
Grid GridOf(const Sides& sides, std::size_t joint) {
  const Samples& position = *sides.position[joint];
  const TimeNs from_ns = std::max(position.t_ns.front(), sides.effort.t_ns.front());
  const TimeNs to_ns = std::min(position.t_ns.back(), sides.effort.t_ns.back());
  Grid grid{from_ns, position.Step_s(), 0};
  if (to_ns <= from_ns || grid.step_s <= 0) return grid;
  const double steps = ToSeconds(to_ns - from_ns) / grid.step_s;
  if (steps > kMostFineSteps) {
    throw InputError(
        "", {FaultKind::kOutOfRange, fmt::format("efforts and positions reach over {:.0f} steps of "
                                                 "{:.6f} s; need {} at most (--from and "
                                                 "--to look at a part)",
                                                 steps, grid.step_s, kMostFineSteps)});
  }
  grid.size = static_cast<std::size_t>(steps) + 1;
  return grid;
}

/// Motion of all joints at one fine step.
JointMotion MotionAt(const MachineModel& model, const std::vector<std::optional<Spread>>& positions,
                     const Kernels& kernels, std::size_t at) {
  JointMotion motion;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (!positions[j]) {
      motion.q_rad.push_back(model.joints[j].initial_rad);
      motion.qd_radps.push_back(0);
      motion.qdd_radps2.push_back(0);
      continue;
    }
    const std::vector<double>& q_rad = positions[j]->value;
    motion.q_rad.push_back(Convolved(kernels.smooth, q_rad, at));
    motion.qd_radps.push_back(Convolved(kernels.slope, q_rad, at));
    motion.qdd_radps2.push_back(Convolved(kernels.curvature, q_rad, at));
  }
  return motion;
}

void SetFineRate(const Spread& position, const Kernels& kernels, EffortLog* log) {
  log->fine_rate_radps.assign(position.value.size(), 0.0);
  for (std::size_t k = kernels.reach(); k + kernels.reach() < position.value.size(); ++k) {
    log->fine_rate_radps[k] = Convolved(kernels.slope, position.value, k);
  }
}

/// True if the whole window of fine steps is measured and the joint moves in it.
bool IsUsable(const EffortLog& log, const Spread& effort,
              const std::vector<std::optional<Spread>>& positions, double rest_radps,
              std::size_t at) {
  const std::size_t reach = log.kernel.size() / 2;
  bool moves = false;
  for (std::size_t k = at - reach; k <= at + reach; ++k) {
    if (!effort.known[k]) return false;
    for (const auto& position : positions) {
      if (position && !position->known[k]) return false;
    }
    moves = moves || std::abs(log.fine_rate_radps[k]) > rest_radps;
  }
  return moves;
}

std::optional<EffortLog> MakeLog(const MachineModel& model, const std::string& channel,
                                 std::size_t joint, const Sides& sides) {
  const Grid grid = GridOf(sides, joint);
  EffortLog log;
  log.channel = channel;
  log.joint = joint;
  log.fine_s = grid.step_s;
  const double effort_step_s = sides.effort.Step_s();
  log.band_hz = std::min(kWidestBand_hz, kMostBandOfRate / std::max(grid.step_s, effort_step_s));
  const double sigma_s = std::sqrt(std::numbers::ln2) / (2 * std::numbers::pi * log.band_hz);
  const Kernels kernels(sigma_s, grid.step_s);
  if (grid.size <= 4 * kernels.smooth.size()) return std::nullopt;
  log.kernel = kernels.smooth;
  const Spread effort = Over(grid, sides.effort, effort_step_s);
  std::vector<std::optional<Spread>> positions;
  for (const auto& position : sides.position) {
    positions.push_back(position ? std::optional(Over(grid, *position, position->Step_s()))
                                 : std::nullopt);
  }
  SetFineRate(*positions[joint], kernels, &log);
  const double rest_radps = kMostRestShare * LargestMagnitude(log.fine_rate_radps);
  const auto stride =
      static_cast<std::size_t>(std::lround(1 / (kSamplesPerPeriod * log.band_hz * grid.step_s)));
  log.measured.period_s = static_cast<double>(stride) * grid.step_s;
  // The rate needs one window of positions, and its smoothing another.
  const std::size_t margin = kernels.smooth.size();
  log.first_ns = grid.t_ns(margin);
  Dynamics dynamics(model);
  for (std::size_t k = margin; k + margin < grid.size; k += stride) {
    const JointMotion motion = MotionAt(model, positions, kernels, k);
    log.at_fine.push_back(k);
    log.inertial_nm.push_back(dynamics.Inertial_nm(motion, joint));
    log.weight_nm.push_back(dynamics.Weight_nm(motion, joint));
    log.position_rad.push_back(motion.q_rad[joint]);
    log.rate_radps.push_back(motion.qd_radps[joint]);
    log.acceleration_radps2.push_back(motion.qdd_radps2[joint]);
    const bool usable = IsUsable(log, effort, positions, rest_radps, k);
    log.measured.valid.push_back(usable);
    log.measured.value.push_back(usable ? Convolved(log.kernel, effort.value, k) : 0);
  }
  return log;
}

/// Index of a column's joint; -1 without one.
int JointOf(const MachineModel& model, const std::string& column) {
  const bool is_torque = column.ends_with("_nm");
  if (!is_torque && !column.ends_with("_n")) return -1;
  const int joint = model.JointIndex(column.substr(0, column.rfind('_')));
  if (joint < 0) return -1;
  const bool slides = model.joints[joint].type == JointType::kPrismatic;
  if (slides == is_torque) {
    throw InputError("efforts.csv", fmt::format("{} is of a joint that {}; need {}", column,
                                                slides ? "slides" : "turns",
                                                slides ? "a force, _n" : "a torque, _nm"));
  }
  return joint;
}

}  // namespace

std::vector<EffortLog> MakeEffortLogs(const MachineModel& model, const std::string& channel,
                                      const TableRecording& efforts,
                                      const std::vector<NamedEncoders>& encoders) {
  std::vector<EffortLog> logs;
  if (efforts.t_ns.size() < kFewestSamples) return logs;
  Sides sides;
  for (const Joint& joint : model.joints)
    sides.position.push_back(PositionSamples(joint.name, encoders));
  for (std::size_t c = 0; c < efforts.columns.size(); ++c) {
    const int joint = JointOf(model, efforts.columns[c]);
    if (joint < 0 || !sides.position[joint]) continue;
    sides.effort = {efforts.t_ns, {}};
    for (const std::vector<double>& row : efforts.rows) sides.effort.value.push_back(row[c]);
    auto log =
        MakeLog(model, channel + "/" + efforts.columns[c], static_cast<std::size_t>(joint), sides);
    if (log) logs.push_back(std::move(*log));
  }
  return logs;
}

std::vector<double> EffortReplay::Predict(const Effects& effects) const {
  const LoadFriction slot(
      LoadFrictionOf(effects, ActuatorEffort::Constant(model_.joints[log_.joint].max_effort_nm)));
  std::vector<double> against_nm;
  against_nm.reserve(log_.fine_rate_radps.size());
  for (const double rate_radps : log_.fine_rate_radps) {
    const AxisFriction friction = slot.Friction(rate_radps);
    const double dry_nm = rate_radps > 0   ? friction.against_positive_nm
                          : rate_radps < 0 ? -friction.against_negative_nm
                                           : 0.0;
    against_nm.push_back(dry_nm + friction.viscous_nmsprad * rate_radps + slot.Offset_nm());
  }
  std::vector<double> effort_nm;
  const std::size_t reach = log_.kernel.size() / 2;
  for (std::size_t k = 0; k < log_.at_fine.size(); ++k) {
    double sum_nm = log_.inertial_nm[k] + log_.weight_nm[k];
    const double* window = &against_nm[log_.at_fine[k] - reach];
    for (std::size_t i = 0; i < log_.kernel.size(); ++i) sum_nm += log_.kernel[i] * window[i];
    effort_nm.push_back(sum_nm);
  }
  return effort_nm;
}

}  // namespace tera
