#include <fmt/format.h>

#include <algorithm>

#include "blind/mujoco/cases/effect.h"

namespace tera::blind::mujoco {
namespace {

Effect OfJoint(const std::string& name, std::size_t axis, std::string form,
               std::vector<std::string> variables) {
  Effect effect;
  effect.concealed.target = kAxisNames[axis];
  effect.concealed.name = name;
  effect.concealed.form = std::move(form);
  for (const std::string& variable : variables) {
    const bool is_own = variable != "time" && variable.find('/') == std::string::npos;
    effect.concealed.variables.push_back(is_own ? fmt::format("{}/{}", variable, kAxisNames[axis])
                                                : variable);
  }
  effect.concealed.channels = {fmt::format("encoders/{}_radps", kAxisNames[axis]),
                               fmt::format("encoders/{}_rad", kAxisNames[axis])};
  effect.needs.joints = {axis};
  return effect;
}

/// Lets `change` act on the joint's drive.
Effect With(Effect effect, std::size_t axis, std::function<void(DriveForm*)> change) {
  effect.put = [axis, change = std::move(change)](Forms* forms) {
    change(&forms->plant.drives[axis]);
  };
  return effect;
}

Effect CommandDelay(std::size_t axis, const Draw& draw) {
  const double late_s = kTolerances.late_s * draw.Times();
  Effect effect = OfJoint("command_delay", axis,
                          draw.reserve ? "line of eight of MuJoCo's filters in a row"
                                       : "queue of messages, each late by some 4 ms more or less",
                          {"lever_way", "lever"});
  effect.concealed.truth["delay_s"] = draw.reserve ? late_s : late_s + 0.8 * 0.004;
  return With(effect, axis, [late_s, reserve = draw.reserve](DriveForm* drive) {
    drive->bus.delay_s = late_s;
    drive->bus.jitter_s = reserve ? 0 : 0.004;
    drive->bus.line_stages = reserve ? 8 : 0;
  });
}

Effect CommandDrops(std::size_t axis, const Draw& draw) {
  const double lost = std::min(0.5, 0.05 * draw.Times());
  const double row = draw.reserve ? 12 : 5;
  Effect effect =
      OfJoint("command_drops", axis, fmt::format("messages lost in rows of {:.0f} on average", row),
              {"lever_way", "lever"});
  effect.concealed.alike = {"input_hold"};
  return With(effect, axis, [=](DriveForm* drive) {
    drive->bus.lost = lost;
    drive->bus.lost_in_row = row;
  });
}

Effect DeadBand(std::size_t axis, const Draw& draw) {
  const double width = kTolerances.dead_band * draw.Times();
  const double skew = draw.reserve ? 0.4 * draw.draws->Sign() : 0;
  Effect effect = OfJoint("dead_band", axis,
                          draw.reserve ? "spool that overlaps one port more than the other"
                                       : "spool that overlaps its ports, with a rounded edge",
                          {"lever"});
  effect.concealed.truth["width"] = width;
  return With(effect, axis, [=](DriveForm* drive) {
    drive->overlap = width;
    drive->overlap_skew = skew;
  });
}

Effect AsymmetricGain(std::size_t axis, const Draw& draw) {
  const double part = std::min(0.65, kTolerances.rate * draw.Times());
  const double ratio = draw.reserve ? 1 + part : 1 - part;
  Effect effect = OfJoint(
      "asymmetric_gain", axis,
      draw.reserve ? "more oil for negative levers" : "less oil for negative levers", {"lever"});
  effect.concealed.truth["ratio"] = ratio;
  return With(effect, axis, [=](DriveForm* drive) { drive->negative = ratio; });
}

Effect RateGain(std::size_t axis, const Draw& draw) {
  const double part = std::min(draw.reserve ? 0.5 : 0.65, kTolerances.rate * draw.Times());
  const double gain = draw.reserve ? 1 + part : 1 - part;
  Effect effect = OfJoint("rate_gain", axis, draw.reserve ? "larger pump" : "worn pump", {"lever"});
  effect.concealed.truth["gain"] = gain;
  return With(effect, axis, [=](DriveForm* drive) { drive->gain = gain; });
}

Effect ActuatorLag(std::size_t axis, const Draw& draw) {
  const double time_s = kTolerances.late_s * draw.Times();
  Effect effect = OfJoint("actuator_lag", axis,
                          draw.reserve ? "two of MuJoCo's filters before the motor, 7 : 3"
                                       : "MuJoCo's filter before the motor",
                          {"lever_way", "lever"});
  if (!draw.reserve) effect.concealed.truth["time_s"] = time_s;
  return With(effect, axis, [time_s, reserve = draw.reserve](DriveForm* drive) {
    drive->pilot_s = reserve ? 0.7 * time_s : time_s;
    drive->second_pilot_s = reserve ? 0.3 * time_s : 0;
  });
}

Effect DriveFriction(std::size_t axis, const Draw& draw) {
  const double share = kTolerances.dead_band * draw.Times();
  const double motor_s = draw.draws->Between(0.05, 0.1);
  Effect effect =
      OfJoint("drive_friction", axis,
              draw.reserve ? "frictionloss, half as much again at rest, against a velocity motor"
                           : "frictionloss against a velocity motor",
              {"lever", "lever_way"});
  effect.concealed.besides = {"actuator_lag"};
  effect.concealed.truth["lost_radps"] = share * draw.numbers.full_rate_radps[axis];
  return With(effect, axis, [=, reserve = draw.reserve](DriveForm* drive) {
    drive->motor_s = motor_s;
    drive->friction = share;
    drive->breakaway = reserve ? 1.5 : 1;
  });
}

Effect Backlash(std::size_t axis, const Draw& draw) {
  const double gap_rad = 0.0045 * draw.Times();
  Effect effect = OfJoint("backlash", axis,
                          draw.reserve ? "gap before a pin that rubs and bears weight"
                                       : "two bodies and a gap, the second held by a pin that rubs",
                          {"lever", "lever_way"});
  effect.concealed.truth["gap_rad"] = gap_rad;
  return With(effect, axis, [=](DriveForm* drive) { drive->gap_rad = gap_rad; });
}

Effect PressureDroop(std::size_t axis, const Draw& draw) {
  const double share = std::min(0.7, kTolerances.rate * draw.Times());
  Effect effect = OfJoint("pressure_droop", axis,
                          draw.reserve ? "oil that leaks past the piston with the load"
                                       : "rate that falls in proportion to the motor's force",
                          {"load", "lever", "position"});
  if (draw.reserve) effect.concealed.alike = {"sag"};
  return With(effect, axis, [share, reserve = draw.reserve](DriveForm* drive) {
    (reserve ? drive->leak : drive->droop) = share;
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
bool CanHold(std::size_t axis, const std::string& name, bool reserve) {
  if (name == "drive_friction") return axis == kSlew;
  if (name == "backlash") return axis == (reserve ? kBucket : kSlew);
  if (name == "pressure_droop") return axis == kBoom || axis == kArm;
  return axis >= kSlew;
}

Effect DrawOfJoint(const std::string& name, std::size_t axis, const Draw& draw) {
  using Drawn = Effect (*)(std::size_t, const Draw&);
  const std::map<std::string, Drawn> drawn = {
      {"command_delay", CommandDelay},   {"command_drops", CommandDrops},
      {"dead_band", DeadBand},           {"asymmetric_gain", AsymmetricGain},
      {"rate_gain", RateGain},           {"actuator_lag", ActuatorLag},
      {"drive_friction", DriveFriction}, {"backlash", Backlash},
      {"pressure_droop", PressureDroop}};
  return drawn.at(name)(axis, draw);
}

Effect DrawOutside(const Draw& draw) {
  const std::size_t axis = kBoom + draw.draws->Below(3);
  const std::size_t other = axis == kArm ? kBucket : kArm;
  const bool second = draw.draws->Chance(0.5);
  const double share = draw.draws->Between(0.25, 0.45);
  const std::string others = kAxisNames[other];
  if (!draw.reserve && second) {
    Effect effect =
        OfJoint("", axis, fmt::format("slower while the lever of the {} is out", others),
                {"lever/" + others});
    effect.needs.joints.push_back(other);
    return With(effect, axis, [=](DriveForm* drive) {
      drive->slowed_by = static_cast<int>(other);
      drive->slowed_share = share;
    });
  }
  if (!draw.reserve) {
    Effect effect = OfJoint("", axis, "gain that goes up and down with the angle", {"position"});
    return With(effect, axis, [=](DriveForm* drive) { drive->wave = share; });
  }
  if (second) {
    Effect effect = OfJoint("", axis, "oil that warms within 15 s", {"time"});
    return With(effect, axis, [=](DriveForm* drive) { drive->cold_share = share; });
  }
  Effect effect =
      OfJoint("", axis, "spool that friction drags along at a distance", {"lever", "lever_way"});
  return With(effect, axis, [=](DriveForm* drive) { drive->sticking = share / 2; });
}

Effect DrawConfounded(const Draw& draw) {
  const std::size_t axis = kBoom + draw.draws->Below(3);
  return DrawOfJoint(draw.draws->Chance(0.5) ? "dead_band" : "rate_gain", axis, draw);
}

Effect DrawUntestable(const Draw& draw) {
  const std::size_t kind = draw.draws->Below(3), axis = kSlew + draw.draws->Below(4);
  if (kind == 0) {
    Effect effect = OfJoint("lever_saturation", axis, "valve that ends where no lever goes", {});
    return With(effect, axis, [](DriveForm* drive) { drive->end = 0.75; });
  }
  if (kind == 1) {
    const double kg = draw.draws->Between(100, 300);
    Effect effect =
        OfJoint("payload", kBucket, "mass in the bucket of a machine whose oil is stiff", {});
    effect.put = [kg](Forms* forms) { forms->plant.payload_kg = kg; };
    return effect;
  }
  Effect effect =
      OfJoint("clock_offset", axis, "late clock of the unit of a chassis that stands", {});
  effect.concealed.target = draw.numbers.units[0].name;
  effect.concealed.channels = {draw.numbers.units[0].name};
  effect.is_in_plant = false;
  const double late_s = kTolerances.late_s * draw.Times();
  effect.put = [late_s](Forms* forms) { forms->sensors.units[0].clock.offset_s = late_s; };
  return effect;
}

}  // namespace tera::blind::mujoco
