#include <fmt/format.h>

#include <algorithm>

#include "blind/mujoco/cases/effect_parts.h"

namespace tera::blind::mujoco {
namespace {

Effect CommandDelay(std::size_t axis, const Draw& draw) {
  const double late_s = kTolerances.late_s * draw.Times();
  Effect effect =
      OfJoint("command_delay", axis,
              draw.IsSecond() ? "line of eight of MuJoCo's filters in a row"
                              : "queue of messages, each late by some 4 ms more or less",
              {"lever_way", "lever"});
  effect.concealed.truth["delay_s"] = draw.IsSecond() ? late_s : late_s + 0.8 * 0.004;
  return WithDrive(effect, axis, [late_s, second = draw.IsSecond()](DriveForm* drive) {
    drive->bus.delay_s = late_s;
    drive->bus.jitter_s = second ? 0 : 0.004;
    drive->bus.line_stages = second ? 8 : 0;
  });
}

Effect CommandDrops(std::size_t axis, const Draw& draw) {
  const double lost = std::min(0.5, 0.05 * draw.Times());
  const double row = draw.IsSecond() ? 12 : 5;
  Effect effect =
      OfJoint("command_drops", axis, fmt::format("messages lost in rows of {:.0f} on average", row),
              {"lever_way", "lever"});
  effect.concealed.alike = {"input_hold"};
  return WithDrive(effect, axis, [=](DriveForm* drive) {
    drive->bus.lost = lost;
    drive->bus.lost_in_row = row;
  });
}

Effect DeadBand(std::size_t axis, const Draw& draw) {
  const double width = kTolerances.dead_band * draw.Times();
  const double skew = draw.IsSecond() ? 0.4 * draw.draws->Sign() : 0;
  Effect effect = OfJoint("dead_band", axis,
                          draw.IsSecond() ? "spool that overlaps one port more than the other"
                                          : "spool that overlaps its ports, with a rounded edge",
                          {"lever"});
  effect.concealed.truth["width"] = width;
  return WithDrive(effect, axis, [=](DriveForm* drive) {
    drive->overlap = width;
    drive->overlap_skew = skew;
  });
}

Effect AsymmetricGain(std::size_t axis, const Draw& draw) {
  const double part = std::min(0.65, kTolerances.rate * draw.Times());
  const double ratio = draw.IsSecond() ? 1 + part : 1 - part;
  Effect effect = OfJoint(
      "asymmetric_gain", axis,
      draw.IsSecond() ? "more oil for negative levers" : "less oil for negative levers", {"lever"});
  effect.concealed.truth["ratio"] = ratio;
  return WithDrive(effect, axis, [=](DriveForm* drive) { drive->negative = ratio; });
}

Effect RateGain(std::size_t axis, const Draw& draw) {
  const double part = std::min(draw.IsSecond() ? 0.5 : 0.65, kTolerances.rate * draw.Times());
  const double gain = draw.IsSecond() ? 1 + part : 1 - part;
  Effect effect =
      OfJoint("rate_gain", axis, draw.IsSecond() ? "larger pump" : "worn pump", {"lever"});
  effect.concealed.truth["gain"] = gain;
  return WithDrive(effect, axis, [=](DriveForm* drive) { drive->gain = gain; });
}

Effect ActuatorLag(std::size_t axis, const Draw& draw) {
  const double time_s = kTolerances.late_s * draw.Times();
  Effect effect = OfJoint("actuator_lag", axis,
                          draw.IsSecond() ? "two of MuJoCo's filters before the motor, 7 : 3"
                                          : "MuJoCo's filter before the motor",
                          {"lever_way", "lever"});
  if (!draw.IsSecond()) effect.concealed.truth["time_s"] = time_s;
  return WithDrive(effect, axis, [time_s, second = draw.IsSecond()](DriveForm* drive) {
    drive->pilot_s = second ? 0.7 * time_s : time_s;
    drive->second_pilot_s = second ? 0.3 * time_s : 0;
  });
}

Effect DriveFriction(std::size_t axis, const Draw& draw) {
  const double share = kTolerances.dead_band * draw.Times();
  const double motor_s = draw.draws->Between(0.05, 0.1);
  Effect effect =
      OfJoint("drive_friction", axis,
              draw.IsSecond() ? "frictionloss, half as much again at rest, against a velocity motor"
                              : "frictionloss against a velocity motor",
              {"lever", "lever_way"});
  effect.concealed.besides = {"actuator_lag"};
  effect.concealed.truth["lost_radps"] = share * draw.numbers.full_rate_radps[axis];
  return WithDrive(effect, axis, [=, second = draw.IsSecond()](DriveForm* drive) {
    drive->motor_s = motor_s;
    drive->friction = share;
    drive->breakaway = second ? 1.5 : 1;
  });
}

Effect Backlash(std::size_t axis, const Draw& draw) {
  const double gap_rad = 0.0045 * draw.Times();
  Effect effect =
      OfJoint("backlash", axis,
              draw.IsSecond() ? "gap before a pin that rubs and bears weight"
                              : "two bodies and a gap, the second held by a pin that rubs",
              {"lever", "lever_way"});
  effect.concealed.truth["gap_rad"] = gap_rad;
  return WithDrive(effect, axis, [=](DriveForm* drive) { drive->gap_rad = gap_rad; });
}

Effect PressureDroop(std::size_t axis, const Draw& draw) {
  const double share = std::min(0.7, kTolerances.rate * draw.Times());
  Effect effect = OfJoint("pressure_droop", axis,
                          draw.IsSecond() ? "oil that leaks past the piston with the load"
                                          : "rate that falls in proportion to the motor's force",
                          {"load", "lever", "position"});
  if (draw.IsSecond()) effect.concealed.alike = {"sag"};
  return WithDrive(effect, axis, [share, second = draw.IsSecond()](DriveForm* drive) {
    (second ? drive->leak : drive->droop) = share;
  });
}

}  // namespace

double Draw::Times() const {
  switch (strength) {
    case Strength::kFaint:
      return draws->Between(2, 3);
    case Strength::kMedium:
      return draws->Between(4, 8);
    case Strength::kStrong:
      break;
  }
  return draws->Between(9, 12);
}

const std::vector<std::string>& EffectsOfJoints() {
  static const std::vector<std::string> names = {
      "command_delay", "command_drops",  "dead_band", "asymmetric_gain", "rate_gain",
      "actuator_lag",  "drive_friction", "backlash",  "pressure_droop"};
  return names;
}

/// A motor without a spring would not hold what is heavy, and weight keeps a gap closed.
bool CanHold(std::size_t axis, const std::string& name, Variant variant) {
  if (name == "drive_friction") return axis == kSlew;
  if (name == "backlash") return axis == (variant == Variant::kSecond ? kBucket : kSlew);
  if (name == "pressure_droop") return axis == kBoom || axis == kArm;
  return axis >= kSlew;
}

Effect DrawOfJoint(const std::string& name, std::size_t axis, const Draw& draw) {
  if (draw.IsReserved()) return DrawReservedOfJoint(name, axis, draw);
  using Drawn = Effect (*)(std::size_t, const Draw&);
  const std::map<std::string, Drawn> drawn = {
      {"command_delay", CommandDelay},   {"command_drops", CommandDrops},
      {"dead_band", DeadBand},           {"asymmetric_gain", AsymmetricGain},
      {"rate_gain", RateGain},           {"actuator_lag", ActuatorLag},
      {"drive_friction", DriveFriction}, {"backlash", Backlash},
      {"pressure_droop", PressureDroop}};
  return drawn.at(name)(axis, draw);
}

}  // namespace tera::blind::mujoco
