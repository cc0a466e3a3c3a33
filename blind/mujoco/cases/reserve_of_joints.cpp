#include <fmt/format.h>

#include <algorithm>

#include "blind/mujoco/cases/effect_parts.h"

namespace tera::blind::mujoco {
namespace {

/// Slots of 7 ms against messages of 20 ms: the phase is one of 7 ms, 3 ms on average; 0.25 / 0.75
/// of a slot beside.
Effect ReservedCommandDelay(std::size_t axis, const Draw& draw) {
  constexpr double kSlot_s = 0.007, kContested = 0.25;
  constexpr double kWaits_s = 0.003 + kSlot_s * kContested / (1 - kContested);
  const double late_s = kTolerances.late_s * draw.Times();
  Effect effect = OfJoint("command_delay", axis, "bus on which others often win, and a slow radio",
                          {"lever_way", "lever"});
  effect.concealed.truth["delay_s"] = late_s;
  return WithDrive(effect, axis, [=](DriveForm* drive) {
    drive->bus.delay_s = late_s - kWaits_s;
    drive->bus.jitter_s = 0;
    drive->bus.slot_s = kSlot_s;
    drive->bus.contested = kContested;
  });
}

Effect ReservedCommandDrops(std::size_t axis, const Draw& draw) {
  const double lost = std::min(0.5, 0.05 * draw.Times());
  const double fades_hz = draw.draws->Between(0.8, 1.6);
  Effect effect =
      OfJoint("command_drops", axis, "radio that fades over many paths", {"lever_way", "lever"});
  effect.concealed.alike = {"input_hold"};
  return WithDrive(effect, axis, [=](DriveForm* drive) {
    drive->bus.lost = lost;
    drive->bus.fades_hz = fades_hz;
  });
}

Effect ReservedDeadBand(std::size_t axis, const Draw& draw) {
  const double width = kTolerances.dead_band * draw.Times();
  Effect effect =
      OfJoint("dead_band", axis, "pilot pressure below a spring's, then a soft start", {"lever"});
  effect.concealed.truth["width"] = width;
  return WithDrive(effect, axis, [=](DriveForm* drive) {
    drive->overlap = width / 2;
    drive->soft = width / 2;
  });
}

/// The owner's rate is the mean of both ways.
Effect ReservedAsymmetricGain(std::size_t axis, const Draw& draw) {
  const double part = std::min(0.65, kTolerances.rate * draw.Times());
  const double slower = 1 - part / (2 - part), faster = 1 + part / (2 - part);
  const bool rod_is_positive = draw.draws->Chance(0.5);
  Effect effect = OfJoint("asymmetric_gain", axis, "one flow over a piston's two areas", {"lever"});
  effect.concealed.besides = {"rate_gain"};
  effect.concealed.truth["ratio"] = rod_is_positive ? slower / faster : faster / slower;
  return WithDrive(effect, axis, [=](DriveForm* drive) {
    drive->positive = rod_is_positive ? faster : slower;
    drive->negative = rod_is_positive ? slower : faster;
  });
}

Effect ReservedRateGain(std::size_t axis, const Draw& draw) {
  const double part = std::min(0.5, kTolerances.rate * draw.Times()) * draw.draws->Sign();
  const double hunts_hz = draw.draws->Between(0.15, 0.35);
  Effect effect =
      OfJoint("rate_gain", axis, "pump's motor at another speed, about which it hunts", {"lever"});
  effect.concealed.truth["gain"] = 1 + part;
  return WithDrive(effect, axis, [=](DriveForm* drive) {
    drive->gain = 1 + part;
    drive->hunts = 0.6 * kTolerances.rate;
    drive->hunts_hz = hunts_hz;
  });
}

Effect ReservedActuatorLag(std::size_t axis, const Draw& draw) {
  const double late_s = kTolerances.late_s * draw.Times();
  Effect effect = OfJoint("actuator_lag", axis, "pilot hose that resists and swells all along",
                          {"lever_way", "lever"});
  return WithDrive(effect, axis, [=](DriveForm* drive) { drive->line_s = late_s; });
}

Effect ReservedDriveFriction(std::size_t axis, const Draw& draw) {
  const double share = kTolerances.dead_band * draw.Times();
  const double motor_s = draw.draws->Between(0.05, 0.1);
  Effect effect = OfJoint("drive_friction", axis, "ring that rubs as the arm's reach tilts it",
                          {"lever", "lever_way", "load/boom", "position/boom", "position/arm"});
  effect.concealed.besides = {"actuator_lag"};
  return WithDrive(effect, axis, [=](DriveForm* drive) {
    drive->motor_s = motor_s;
    drive->friction = share;
    drive->ring_rubs = true;
  });
}

Effect ReservedBacklash(std::size_t axis, const Draw& draw) {
  const double gap_rad = 0.0045 * draw.Times();
  const double worst_rad = draw.draws->Within(1);
  Effect effect = OfJoint("backlash", axis, "ring worn on the side where it works most",
                          {"lever", "lever_way", "position"});
  return WithDrive(effect, axis, [=](DriveForm* drive) {
    drive->gap_rad = gap_rad;
    drive->gap_worn = 0.6;
    drive->gap_worst_rad = worst_rad;
  });
}

Effect ReservedPressureDroop(std::size_t axis, const Draw& draw) {
  const double share = std::min(0.7, kTolerances.rate * draw.Times());
  Effect effect =
      OfJoint("pressure_droop", axis, "rate that falls as it lifts, behind a counterbalance valve",
              {"load", "lever", "position"});
  return WithDrive(effect, axis, [=](DriveForm* drive) { drive->lifting_droop = share; });
}

}  // namespace

Effect DrawReservedOfJoint(const std::string& name, std::size_t axis, const Draw& draw) {
  using Drawn = Effect (*)(std::size_t, const Draw&);
  const std::map<std::string, Drawn> drawn = {
      {"command_delay", ReservedCommandDelay},   {"command_drops", ReservedCommandDrops},
      {"dead_band", ReservedDeadBand},           {"asymmetric_gain", ReservedAsymmetricGain},
      {"rate_gain", ReservedRateGain},           {"actuator_lag", ReservedActuatorLag},
      {"drive_friction", ReservedDriveFriction}, {"backlash", ReservedBacklash},
      {"pressure_droop", ReservedPressureDroop}};
  return drawn.at(name)(axis, draw);
}

}  // namespace tera::blind::mujoco
