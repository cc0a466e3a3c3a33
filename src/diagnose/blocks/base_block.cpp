#include "diagnose/blocks/base_block.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/motion.h"
#include "diagnose/blocks/candidate_list.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/blocks/sample_grid.h"
#include "diagnose/replay/base_replay.h"
#include "physics/dynamics/joint_inertia.h"
#include "physics/traction/ground_mechanisms.h"
#include "physics/traction/track_drive.h"
#include "physics/traction/turning_centre.h"

namespace tera {
namespace {

constexpr std::size_t kFewestIntervals = 100;
constexpr int kLags = 4;  ///< number of lags of the sides' speeds in the flexible regressor
constexpr double kLongestLag_s = 0.5;
/// Friction coefficients. Firm: asphalt, gravel and dry earth (Wong, Theory of Ground Vehicles, 4th
/// ed. 2008, ch. 1). Loose: half of it, an estimate for loose or wet ground.
constexpr double kFrictionOfFirm = 0.7, kFrictionOfLoose = 0.35;
/// Largest tolerated lag of the yaw rate on loose ground, relative to the RMS yaw rate while
/// turning. Samples with a larger lag are excluded.
constexpr double kMostHeldBackShare = 0.1;
constexpr double kLeastTurning_radps = 0.02;  ///< below it the machine stands or drives straight
/// A machine drives if a side reaches this speed.
constexpr double kLeastDriven_mps = 0.1;

std::vector<Candidate> CandidatesOf(const MachineModel& model) {
  const Effects& present = model.effects.base;
  const Expected centre{0, TurningCentreReach_m(model)};
  CandidateList out("base", EffectTarget::kBase, present, GroundMechanisms());
  out.Add("track_scale", {{0, 0.7, 1.3}}, {{0.97}, {1.03}, {0.9}, {1.1}});
  out.Add("track_asymmetry", {{0, -0.3, 0.3}}, {{0.02}, {-0.02}, {0.08}, {-0.08}});
  out.Add("track_slip", {{0, -0.2, 0.7}, {.index = 3, .upper = 1, .refines = true}},
          {{0.04, 0, 0.7, 0}, {0.12, 0, 0.7, 0}, {0.06, 0, 0.7, 0.5}, {0.3, 0, 0.7, 0}});
  out.Add("slope_slip", {{0, -0.2, 0.5}, {1, -2, 2}}, {{0, 0.2}, {0, 0.6}, {0.1, 0.5}});
  out.Add("side_slip", {{0, -2, 2}}, {{0.1}, {0.4}, {-0.2}});
  out.Add("effective_gauge", {{0, 0.7, 4, true}}, {{1.1}, {1.4}, {1.8}, {0.9}});
  out.Add("icr_shift",
          {{.index = 0, .lower = -1.5, .upper = 1.5, .expected = centre},
           {.index = 1, .lower = -1, .upper = 1, .expected = centre}},
          {{0.1, 0}, {-0.1, 0}, {0.4, 0}, {0, 0.2}});
  return out.Take();
}

/// Input of the base's replay per interval: speeds of both sides from their gears, and slopes.
struct Course {
  std::vector<double> left_mps, right_mps, roll_rad, pitch_rad, time_s;
};

Course CourseOf(const MachineModel& model, const BaseLog& log) {
  Course course;
  for (const BaseInterval& interval : log.intervals) {
    double left = 0, right = 0, lefts = 0, rights = 0;
    Vec3 rpy_rad = Vec3::Zero();
    for (std::size_t i = interval.first; i < interval.first + interval.count; ++i) {
      const BaseInstant& instant = log.instants[i];
      rpy_rad += RpyFromRotation(instant.R_WB) / static_cast<double>(interval.count);
      for (std::size_t g = 0; g < instant.gear_rate_radps.size(); ++g) {
        const RunningGear& gear = model.ground_tools.gears[g];
        const bool is_left = gear.patches.front().p_B_m.y() > 0;
        (is_left ? left : right) += instant.gear_rate_radps[g] * gear.drive_radius_m;
        (is_left ? lefts : rights) += 1;
      }
    }
    course.left_mps.push_back(lefts > 0 ? left / lefts : 0);
    course.right_mps.push_back(rights > 0 ? right / rights : 0);
    course.roll_rad.push_back(rpy_rad.x());
    course.pitch_rad.push_back(rpy_rad.y());
    course.time_s.push_back(ToSeconds(interval.to_ns - log.intervals.front().from_ns));
  }
  return course;
}

Eigen::MatrixXd FlexibleRegressor(const Course& course, const SampleGrid& grid) {
  const std::vector<double> left = grid.Spread(course.left_mps);
  const std::vector<double> right = grid.Spread(course.right_mps);
  const std::vector<double> roll = grid.Spread(course.roll_rad);
  const std::vector<double> pitch = grid.Spread(course.pitch_rad);
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(grid.size), 8 * kLags);
  for (std::size_t k = 0; k < grid.size; ++k) {
    Eigen::Index c = 0;
    for (int i = 0; i < kLags; ++i) {
      const auto lag =
          static_cast<std::size_t>(std::llround(kLongestLag_s * i / (kLags - 1.0) / grid.period_s));
      const std::size_t at = k >= lag ? k - lag : 0;
      const double v = 0.5 * (left[at] + right[at]), w = 0.5 * (right[at] - left[at]);
      for (const double x : {v, w, std::abs(v), std::abs(w), v * pitch[at], w * pitch[at],
                             std::abs(v) * roll[at], w * std::abs(v)}) {
        columns(static_cast<Eigen::Index>(k), c++) = x;
      }
    }
  }
  return columns;
}

std::vector<RegimeVariable> VariablesOf(const Course& course, const SampleGrid& grid) {
  const std::vector<bool> all(course.time_s.size(), true);
  std::vector<double> forward, turning;
  for (std::size_t i = 0; i < course.time_s.size(); ++i) {
    forward.push_back(0.5 * (course.left_mps[i] + course.right_mps[i]));
    turning.push_back(course.right_mps[i] - course.left_mps[i]);
  }
  return {{"speed", grid.SpreadSeries(forward, all)},
          {"turning", grid.SpreadSeries(turning, all)},
          {"pitch", grid.SpreadSeries(course.pitch_rad, all)},
          {"roll", grid.SpreadSeries(course.roll_rad, all)},
          {"time", grid.SpreadSeries(course.time_s, all)}};
}

/// A side's speed divided by its maximum, as a command. The divisor is at least kLeastDriven_mps,
/// so that encoder noise of a standing machine gives no command.
Series CommandOf(const std::vector<double>& speed_mps, const SampleGrid& grid) {
  double fastest = kLeastDriven_mps;
  for (const double v : speed_mps) fastest = std::max(fastest, std::abs(v));
  std::vector<double> share;
  for (const double v : speed_mps) share.push_back(v / fastest);
  return grid.SpreadSeries(share, std::vector<bool>(share.size(), true));
}

std::vector<double> PartOf(const std::vector<PlanarTwist>& twists, double PlanarTwist::*part) {
  std::vector<double> values;
  for (const PlanarTwist& twist : twists) values.push_back(twist.*part);
  return values;
}

/// Changes of the forward speed where the ground limits the machine's acceleration, one column per
/// grip. A coefficient of one standard deviation gives the whole change.
Eigen::MatrixXd HeldBack(const MachineModel& model, const BaseLog& log, const SampleGrid& grid,
                         const std::vector<Grip>& grips) {
  const BaseReplay replay(model, log);
  const auto with = [&](const std::optional<Grip>& grip) -> Eigen::VectorXd {
    const std::vector<double> y = grid.Spread(
        PartOf(replay.Predict(model.effects.base, {}, grip), &PlanarTwist::forward_mps));
    return Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
  };
  const Eigen::VectorXd at_once = with({});
  Eigen::MatrixXd columns(at_once.size(), static_cast<Eigen::Index>(grips.size()));
  for (std::size_t g = 0; g < grips.size(); ++g) {
    columns.col(static_cast<Eigen::Index>(g)) = with(grips[g]) - at_once;
  }
  return columns;
}

/// RMS of the yaw rate over the time in which the machine turns. Infinite if it never turns.
double RmsWhileTurning_radps(const std::vector<double>& yaw_radps) {
  double sum = 0, count = 0;
  for (const double rate_radps : yaw_radps) {
    if (std::abs(rate_radps) < kLeastTurning_radps) continue;
    sum += rate_radps * rate_radps;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : INFINITY;
}

/// Grid points at which loose ground cannot provide the yaw rate at once. There the machine's
/// inertia makes it lag behind its tracks.
std::vector<bool> LaggingTurns(const MachineModel& model, const BaseLog& log,
                               const SampleGrid& grid, const Grip& loose) {
  const BaseReplay replay(model, log);
  const std::vector<double> at_once =
      grid.Spread(PartOf(replay.Predict(model.effects.base), &PlanarTwist::yaw_radps));
  const std::vector<double> late =
      grid.Spread(PartOf(replay.Predict(model.effects.base, {}, loose), &PlanarTwist::yaw_radps));
  const double most_radps = kMostHeldBackShare * RmsWhileTurning_radps(at_once);
  std::vector<bool> is_lagging;
  for (std::size_t k = 0; k < late.size(); ++k) {
    is_lagging.push_back(std::abs(late[k] - at_once[k]) > most_radps);
  }
  return is_lagging;
}

/// Changes of the motion of the contact area's middle if the machine turns about another point with
/// the measured yaw rate. One column is forward, two are to the left.
///
/// Model   turning_centre.h gives the point. On a side slope, the point also moves along the tracks
///         until lateral friction holds the machine. This shift is L tan(roll) / (2 mu), with the
///         contact length L and the friction mu of firm ground.
struct TurningAside {
  Eigen::VectorXd forward_mps;
  Eigen::MatrixXd left_mps;
};

TurningAside TurningAsideOf(const MachineModel& model, const BaseLog& log, const Course& course,
                            const SampleGrid& grid) {
  const double per_slope_m = TrackDrive(model).geometry().contact_length_m / (2 * kFrictionOfFirm);
  std::vector<double> forward_mps, left_mps, down_mps;
  for (std::size_t k = 0; k < log.intervals.size(); ++k) {
    const BaseInterval& interval = log.intervals[k];
    Vec2 centre_m = Vec2::Zero();
    for (std::size_t i = interval.first; i < interval.first + interval.count; ++i) {
      centre_m += log.instants[i].turning_centre_m / static_cast<double>(interval.count);
    }
    const double yaw_radps = interval.twist.yaw_radps;
    forward_mps.push_back(yaw_radps * centre_m.y());
    left_mps.push_back(-yaw_radps * centre_m.x());
    down_mps.push_back(-std::abs(yaw_radps) * per_slope_m * std::tan(course.roll_rad[k]));
  }
  const auto spread = [&](const std::vector<double>& values) -> Eigen::VectorXd {
    const std::vector<double> on_grid = grid.Spread(values);
    return Eigen::Map<const Eigen::VectorXd>(on_grid.data(),
                                             static_cast<Eigen::Index>(on_grid.size()));
  };
  TurningAside aside{spread(forward_mps), Eigen::MatrixXd(grid.size, 2)};
  aside.left_mps << spread(left_mps), spread(down_mps);
  return aside;
}

double YawInertiaAtFirst_kgm2(const MachineModel& model) {
  std::vector<double> q_rad;
  for (const Joint& joint : model.joints) q_rad.push_back(joint.initial_rad);
  return YawInertia_kgm2(model, q_rad);
}

}  // namespace

std::optional<ReplayBlock> MakeBaseBlock(const MachineModel& model, const BaseLog& log,
                                         const std::string& name, bool poses_were_measured) {
  if (log.intervals.size() < kFewestIntervals) return std::nullopt;
  std::vector<TimeNs> t_ns;
  std::vector<PlanarTwist> measured;
  for (const BaseInterval& interval : log.intervals) {
    t_ns.push_back(interval.to_ns);
    measured.push_back(interval.twist);
  }
  const SampleGrid grid = SampleGrid::Under(t_ns);
  const Course course = CourseOf(model, log);
  const std::vector<bool> all(t_ns.size(), true);
  ReplayBlock block;
  block.name = name;
  block.first_ns = t_ns.front();
  const double inertia_kgm2 = YawInertiaAtFirst_kgm2(model);
  const Grip firm{kFrictionOfFirm, inertia_kgm2}, loose{kFrictionOfLoose, inertia_kgm2};
  const auto add = [&](const char* suffix, const char* unit, double PlanarTwist::*part,
                       const Eigen::MatrixXd& nominal) {
    block.channels.push_back({name + suffix,
                              unit,
                              grid.SpreadSeries(PartOf(measured, part), all),
                              {.offset = 1e-3, .gain = 0.02, .delay_s = 0.5 * grid.period_s},
                              VariablesOf(course, grid),
                              FlexibleRegressor(course, grid),
                              nominal});
  };
  const TurningAside aside = TurningAsideOf(model, log, course, grid);
  Eigen::MatrixXd forward(aside.forward_mps.size(), 3);
  forward << HeldBack(model, log, grid, {firm, loose}), aside.forward_mps;
  add("/forward_mps", "m/s", &PlanarTwist::forward_mps, forward);
  add("/left_mps", "m/s", &PlanarTwist::left_mps, aside.left_mps);
  // Nominal columns for yaw would hide arrival stamps of real recordings.
  add("/yaw_radps", "rad/s", &PlanarTwist::yaw_radps, {});
  // Lagging samples stay if stamps may be arrival times, because they show when the poses were
  // measured.
  if (!log.may_be_arrivals)
    block.channels.back().is_lagging = LaggingTurns(model, log, grid, loose);
  block.commands = {CommandOf(course.left_mps, grid), CommandOf(course.right_mps, grid)};
  block.candidates = CandidatesOf(model);
  if (poses_were_measured) block.candidates.push_back(PoseLatencyCandidate());
  if (log.may_be_arrivals) block.candidates.push_back(ArrivalStampsCandidate());
  block.replay = WholeReplay([model, log, grid](const Structure& terms) {
    const std::vector<PlanarTwist> twists =
        BaseReplay(model, log)
            .Predict(WithTerms(model.effects.base, WithoutPoseTerms(terms)),
                     {HasArrivalStamps(terms), PoseLatency_s(terms)});
    return std::vector<std::vector<double>>{grid.Spread(PartOf(twists, &PlanarTwist::forward_mps)),
                                            grid.Spread(PartOf(twists, &PlanarTwist::left_mps)),
                                            grid.Spread(PartOf(twists, &PlanarTwist::yaw_radps))};
  });
  return block;
}

std::vector<std::vector<double>> MotionDiscrepancy(const MachineModel& model, const BaseLog& log,
                                                   const BaseLog& simulated) {
  if (log.intervals.size() < kFewestIntervals) return {};
  std::vector<TimeNs> t_ns;
  for (const BaseInterval& interval : log.intervals) t_ns.push_back(interval.to_ns);
  const std::vector<PlanarTwist> replayed =
      BaseReplay(model, simulated).Predict(model.effects.base);
  std::vector<PlanarTwist> left(t_ns.size());
  for (std::size_t i = 0, s = 0; i < left.size(); ++i) {
    while (s < replayed.size() && simulated.intervals[s].to_ns < t_ns[i]) ++s;
    if (s == replayed.size()) break;
    if (simulated.intervals[s].to_ns != t_ns[i]) continue;
    const PlanarTwist& moved = simulated.intervals[s].twist;
    left[i] = {moved.forward_mps - replayed[s].forward_mps, moved.left_mps - replayed[s].left_mps,
               moved.yaw_radps - replayed[s].yaw_radps};
  }
  const SampleGrid grid = SampleGrid::Under(t_ns);
  return {grid.Spread(PartOf(left, &PlanarTwist::forward_mps)),
          grid.Spread(PartOf(left, &PlanarTwist::left_mps)),
          grid.Spread(PartOf(left, &PlanarTwist::yaw_radps))};
}

void LetHeadingErr(double tolerance_rad, ReplayBlock* base) {
  const Series& forward_mps = base->channels[0].measured;
  Eigen::MatrixXd& nominal = base->channels[1].nominal;
  nominal.conservativeResize(static_cast<Eigen::Index>(forward_mps.size()), nominal.cols() + 1);
  for (std::size_t k = 0; k < forward_mps.size(); ++k) {
    nominal(static_cast<Eigen::Index>(k), nominal.cols() - 1) =
        forward_mps.valid[k] ? -0.5 * tolerance_rad * forward_mps.value[k] : 0;
  }
}

}  // namespace tera
