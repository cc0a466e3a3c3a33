#include "diagnose/recorded_base.h"

#include <algorithm>
#include <utility>

#include "core/units.h"
#include "diagnose/blocks/base_block.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/discrepancy/discrepancy_correction.h"
#include "diagnose/sensors/sensor_parameters.h"

namespace tera {
namespace {

bool MeasuresGears(const DiagnosisInput& input, const Measurements& measured) {
  const auto& gears = input.model->ground_tools.gears;
  const bool all = std::all_of(gears.begin(), gears.end(), [&](const RunningGear& gear) {
    return SamplesOf(gear.name, measured.encoders).has_value();
  });
  return !gears.empty() && all;
}

bool HasBase(const DiagnosisInput& input, const Measurements& measured) {
  return MeasuresGears(input, measured) && !BasePoses(measured).empty();
}

/// Reason why the base of a machine with running gear is not compared, although its running gear or
/// poses were measured.
std::string WithoutBaseText(const DiagnosisInput& input, const Measurements& measured) {
  const std::string base = input.machine + "/base: ";
  if (input.model->ground_tools.gears.empty()) return "";
  if (MeasuresGears(input, measured)) {
    return base +
           "its motion is not known; need poses, two receivers, or a receiver and an "
           "inertial unit";
  }
  if (BasePoses(measured).empty()) return "";
  return base + "what its tracks or wheels did is not known; need encoders of all of them";
}

}  // namespace

std::optional<PoseTimes> ArrivalsOf(const Measurements& measured) {
  if (!measured.poses_were_measured || measured.poses.empty()) return std::nullopt;
  return TimesOfArrivals(measured.poses);
}

std::optional<ReplayBlock> RecordedBase(const DiagnosisInput& input, const Measurements& measured,
                                        std::string* why_not) {
  if (!HasBase(input, measured)) {
    *why_not = WithoutBaseText(input, measured);
    return std::nullopt;
  }
  if (!HaveCommonTime(*input.model, measured.encoders, BasePoses(measured))) {
    *why_not = input.machine +
               "/base: its motion and what its tracks or wheels did have no time in common; need "
               "clocks that count from the same event (`time` of the import)";
    return std::nullopt;
  }
  // The gears' encoders bound the time.
  const BaseLog log = MakeBaseLog(*input.model, measured.encoders, BasePoses(measured),
                                  kBaseInterval_s, ArrivalsOf(measured));
  const bool has_poses = !measured.poses.empty();
  auto block = MakeBaseBlock(*input.model, log, input.machine + "/base",
                             measured.poses_were_measured && has_poses);
  if (!block) return std::nullopt;
  if (measured.poses_were_measured || !has_poses) {
    const ParameterTable table{.stated = input.tolerances};
    LetHeadingErr(table.HalfWidthOf(std::string(kPoses), "mount_rotation", "yaw_deg") * kDeg,
                  &*block);
  }
  block->rest_shows_noise = has_poses;
  return block;
}

std::optional<ReplayDiscrepancy> RecordedBaseDiscrepancy(
    const DiagnosisInput& input, const Measurements& measured,
    const std::vector<NamedEncoders>& simulated, const SimulatedCourse& course) {
  if (!HasBase(input, measured)) return std::nullopt;
  const auto log_of = [&](const auto& encoders, const auto& poses) {
    return MakeBaseLog(*input.model, encoders, poses, kBaseInterval_s);
  };
  const std::vector<TruthPose>& poses = BasePoses(measured);
  const std::vector<TruthPose> simulated_poses = AsSimulated(course, poses);
  if (!HaveCommonTime(*input.model, measured.encoders, poses) ||
      !HaveCommonTime(*input.model, simulated, simulated_poses)) {
    return std::nullopt;
  }
  auto left = MotionDiscrepancy(*input.model, log_of(measured.encoders, poses),
                                log_of(simulated, simulated_poses));
  if (left.empty()) return std::nullopt;
  return ReplayDiscrepancy{input.machine + "/base/forward_mps", std::move(left)};
}

}  // namespace tera
