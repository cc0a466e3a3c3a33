#include <fmt/format.h>

#include <algorithm>

#include "blind/mujoco/cases/effect_parts.h"
#include "core/check.h"

namespace tera::blind::mujoco {
namespace {

Effect UnitMount(const Draw& draw) {
  const std::size_t unit = draw.draws->Below(kUnits);
  const double angle_rad = kTolerances.mount_rad * draw.Times() * draw.draws->Sign();
  const std::size_t first = draw.draws->Below(3);
  Vec3 rpy_rad = Vec3::Zero();
  rpy_rad[static_cast<Eigen::Index>(first)] = angle_rad;
  if (draw.IsSecond()) {
    rpy_rad[static_cast<Eigen::Index>((first + 1) % 3)] = 0.7 * angle_rad * draw.draws->Sign();
  }
  const Mount& mount = draw.numbers.units[unit];
  Effect effect =
      OfSensor(mount.name, "mount_rotation",
               draw.IsSecond() ? "site turned about two axes" : "site turned about one axis");
  effect.is_in_plant = true;
  effect.needs.joints = JointsUnder(mount.link);
  const char* names[] = {"roll_deg", "pitch_deg", "yaw_deg"};
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (rpy_rad[i] != 0) effect.concealed.truth[names[i]] = rpy_rad[i] / kDegree;
  }
  effect.put = [=](Forms* forms) { forms->plant.units[unit].rpy_rad = rpy_rad; };
  return effect;
}

/// Bias of a gyro's axis, or of an accelerometer's on a link that joints tilt. At a constant
/// attitude, a mount would explain an accelerometer's bias equally.
Effect UnitBias(const Draw& draw) {
  const bool is_gyro = draw.draws->Chance(0.5);
  const std::size_t unit = is_gyro ? draw.draws->Below(kUnits) : MovingUnit(draw);
  const auto axis = static_cast<Eigen::Index>(draw.draws->Below(3));
  const double bias = (is_gyro ? kTolerances.gyro_radps : kTolerances.accelerometer_mps2) *
                      draw.Times() * draw.draws->Sign();
  const double warms_s = draw.IsSecond() ? 12 : 0;
  const Mount& mount = draw.numbers.units[unit];
  Effect effect = OfSensor(mount.name, "bias",
                           draw.IsSecond() ? "bias that comes within 12 s" : "bias of one axis");
  const char letter = "xyz"[axis];
  if (draw.IsSecond()) {
    effect.concealed.alike = {"temperature_drift"};
  } else if (is_gyro) {
    effect.concealed.truth[fmt::format("gyro_{}_degps", letter)] = bias / kDegree;
  } else {
    effect.concealed.truth[fmt::format("accel_{}_mps2", letter)] = bias;
  }
  effect.needs.joints = JointsUnder(mount.link);
  effect.put = [=](Forms* forms) {
    UnitForm& form = forms->sensors.units[unit];
    (is_gyro ? form.gyro_radps : form.accelerometer_mps2)[axis] = bias;
    form.warms_s = warms_s;
  };
  return effect;
}

Effect UnitLate(const Draw& draw) {
  const std::size_t unit = MovingUnit(draw);
  const double late_s = kTolerances.late_s * draw.Times();
  const Mount& mount = draw.numbers.units[unit];
  Effect effect = OfSensor(
      mount.name, "clock_offset",
      draw.IsSecond() ? "stamps late by a time that is random beside" : "stamps late by one time");
  effect.concealed.alike = {"latency"};
  if (!draw.IsSecond()) effect.concealed.truth["offset_s"] = late_s;
  effect.needs.joints = JointsUnder(mount.link);
  effect.put = [late_s, unit, second = draw.IsSecond()](Forms* forms) {
    forms->sensors.units[unit].clock = {second ? 0.8 * late_s : late_s, second ? 0.2 * late_s : 0};
  };
  return effect;
}

Effect Antenna(const Draw& draw) {
  const std::size_t receiver = draw.draws->Below(kReceivers);
  const auto axis = static_cast<Eigen::Index>(draw.IsSecond() ? 2 : draw.draws->Below(2));
  const double off_m = kTolerances.antenna_m * draw.Times() * draw.draws->Sign();
  Effect effect =
      OfSensor(draw.numbers.antennas[receiver].name, "gnss_lever_arm",
               draw.IsSecond() ? "antenna higher or lower" : "antenna beside its place");
  effect.is_in_plant = true;
  if (draw.IsSecond()) effect.concealed.alike = {"height_datum"};
  effect.concealed.truth[fmt::format("{}_m", "xyz"[axis])] = off_m;
  effect.needs.drives = effect.needs.is_of_receivers = true;
  effect.put = [=](Forms* forms) {
    forms->plant.antennas[receiver].xyz_m = off_m * Vec3::Unit(axis);
  };
  return effect;
}

Effect ReceiverClock(const Draw& draw) {
  constexpr double kLeapSeconds_s = 18;
  const std::size_t receiver = draw.draws->Below(kReceivers);
  double late_s = kTolerances.late_s * draw.Times();
  if (draw.strength == Strength::kStrong) late_s = draw.IsSecond() ? 1 : kLeapSeconds_s;
  if (draw.IsSecond()) late_s = -late_s;
  Effect effect = OfSensor(draw.numbers.antennas[receiver].name, "clock_offset",
                           draw.IsSecond() ? "stamps too early" : "stamps of another time");
  effect.concealed.alike = {"latency"};
  effect.concealed.truth["offset_s"] = late_s;
  effect.needs.drives = effect.needs.is_of_receivers = true;
  effect.put = [=](Forms* forms) { forms->sensors.receivers[receiver].clock = {late_s, 0}; };
  return effect;
}

Effect Reflections(const Draw& draw) {
  const std::size_t receiver = draw.draws->Below(kReceivers);
  // The phases of a fixed solution are off by a fifth of a metre at most.
  const double pull_m = std::min(0.2, kTolerances.datum_m * draw.Times());
  const double fringe_m = draw.IsSecond() ? 0.8 : 0;
  Effect effect = OfSensor(draw.numbers.antennas[receiver].name, "multipath",
                           draw.IsSecond() ? "raised arm that pulls and pushes by its distance"
                                           : "raised arm that pulls the place towards itself");
  effect.needs.joints = {kSlew, kBoom, kArm};
  effect.needs.is_of_receivers = true;
  effect.put = [=](Forms* forms) {
    forms->sensors.receivers[receiver].reflected_m = pull_m;
    forms->sensors.receivers[receiver].fringe_m = fringe_m;
  };
  return effect;
}

Effect EncoderZero(const Draw& draw) {
  const double zero_rad = kTolerances.zero_rad * draw.Times() * draw.draws->Sign();
  auto [axis, effect] =
      OfEncoder(draw, "bias", draw.IsSecond() ? "zero that moves within 12 s" : "zero off");
  if (draw.IsSecond()) {
    effect.concealed.alike = {"temperature_drift"};
  } else {
    effect.concealed.truth["angle_deg"] = zero_rad / kDegree;
  }
  effect.put = [zero_rad, axis = axis, second = draw.IsSecond()](Forms* forms) {
    forms->sensors.encoders[axis].zero_rad = zero_rad;
    forms->sensors.encoders[axis].warms_s = second ? 12 : 0;
  };
  return effect;
}

Effect EncoderReversed(const Draw& draw) {
  auto [axis, effect] = OfEncoder(
      draw, "axis_flip",
      draw.IsSecond() ? "counts the other way about the middle of travel" : "counts the other way");
  const JointNumbers& joint = draw.numbers.joints[axis];
  const double zero_rad = draw.IsSecond() ? joint.lower_rad + joint.upper_rad : 0;
  if (draw.IsSecond()) effect.concealed.besides = {"bias"};
  effect.put = [zero_rad, axis = axis](Forms* forms) {
    forms->sensors.encoders[axis] = {zero_rad, 0, -1, -1, 0};
  };
  return effect;
}

Effect EncoderScale(const Draw& draw) {
  const double part = 0.013 * draw.Times() * draw.draws->Sign();
  auto [axis, effect] = OfEncoder(
      draw, "scale", draw.IsSecond() ? "counts of a rate by another clock" : "other counts a turn");
  if (!draw.IsSecond()) effect.concealed.truth["position_factor"] = 1 + part;
  effect.concealed.truth["rate_factor"] = 1 + part;
  effect.put = [part, axis = axis, second = draw.IsSecond()](Forms* forms) {
    EncoderForm& form = forms->sensors.encoders[axis];
    if (!second) form.angle_factor = 1 + part;
    form.rate_factor = 1 + part;
  };
  return effect;
}

}  // namespace

const std::vector<std::string>& EffectsOfSensors() {
  static const std::vector<std::string> names = {
      "unit_mount",  "unit_bias",    "unit_late",        "antenna",      "receiver_clock",
      "reflections", "encoder_zero", "encoder_reversed", "encoder_scale"};
  return names;
}

Effect DrawOfSensor(const std::string& name, const Draw& draw) {
  if (draw.IsReserved()) return DrawReservedOfSensor(name, draw);
  using Drawn = Effect (*)(const Draw&);
  const std::map<std::string, Drawn> drawn = {
      {"unit_mount", UnitMount},         {"unit_bias", UnitBias},
      {"unit_late", UnitLate},           {"antenna", Antenna},
      {"receiver_clock", ReceiverClock}, {"reflections", Reflections},
      {"encoder_zero", EncoderZero},     {"encoder_reversed", EncoderReversed},
      {"encoder_scale", EncoderScale}};
  return drawn.at(name)(draw);
}

}  // namespace tera::blind::mujoco
