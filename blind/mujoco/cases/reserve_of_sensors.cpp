#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "blind/mujoco/cases/effect_parts.h"

namespace tera::blind::mujoco {
namespace {

Effect ReservedUnitMount(const Draw& draw) {
  const std::size_t unit = draw.draws->Below(kUnits);
  const double angle_rad = kTolerances.mount_rad * draw.Times() * draw.draws->Sign();
  const bool about_x = draw.draws->Chance(0.5);
  const Mount& mount = draw.numbers.units[unit];
  Effect effect = OfSensor(mount.name, "mount_rotation", "plate that the unit's weight bends");
  effect.needs.joints = JointsUnder(mount.link);
  effect.put = [=](Forms* forms) { forms->sensors.units[unit].bracket = {angle_rad, about_x}; };
  return effect;
}

Effect ReservedUnitBias(const Draw& draw) {
  const bool is_gyro = draw.draws->Chance(0.5);
  const std::size_t unit = is_gyro ? draw.draws->Below(kUnits) : MovingUnit(draw);
  const auto axis = static_cast<Eigen::Index>(draw.draws->Below(3));
  const double bias = (is_gyro ? kTolerances.gyro_radps : kTolerances.accelerometer_mps2) *
                      draw.Times() * draw.draws->Sign();
  const double knocked_s = draw.draws->Between(10, 25);
  const Mount& mount = draw.numbers.units[unit];
  Effect effect = OfSensor(mount.name, "bias", "bias of one axis after a knock");
  effect.concealed.alike = {"temperature_drift"};
  effect.needs.joints = JointsUnder(mount.link);
  effect.put = [=](Forms* forms) {
    UnitForm& form = forms->sensors.units[unit];
    // Until then nothing of what it is off by within its tolerance, either.
    (is_gyro ? form.gyro_radps : form.accelerometer_mps2)[axis] = bias;
    form.knocked_s = knocked_s;
  };
  return effect;
}

/// Late by as much as is drawn after 50 s, a fifth of it at first.
Effect ReservedUnitLate(const Draw& draw) {
  const std::size_t unit = MovingUnit(draw);
  const double late_s = kTolerances.late_s * draw.Times();
  const Mount& mount = draw.numbers.units[unit];
  Effect effect = OfSensor(mount.name, "clock_offset", "clock of a resistor and a capacitor");
  effect.concealed.alike = {"clock_drift", "latency"};
  effect.needs.joints = JointsUnder(mount.link);
  effect.put = [=](Forms* forms) {
    forms->sensors.units[unit].clock = {.offset_s = 0.2 * late_s, .drift = 0.8 * late_s / 50};
  };
  return effect;
}

/// As far aside as is drawn, and lower.
Effect ReservedAntenna(const Draw& draw) {
  const std::size_t receiver = draw.draws->Below(kReceivers);
  const double off_m = kTolerances.antenna_m * draw.Times();
  const double towards_rad = draw.draws->Within(std::numbers::pi);
  const Mount& mount = draw.numbers.antennas[receiver];
  const double mast_m = std::max(1.0, mount.xyz_m.z()), leans_rad = std::asin(off_m / mast_m);
  const Vec3 xyz_m(off_m * std::cos(towards_rad), off_m * std::sin(towards_rad),
                   -mast_m * (1 - std::cos(leans_rad)));
  Effect effect = OfSensor(mount.name, "gnss_lever_arm", "mast that leans");
  effect.is_in_plant = true;
  effect.concealed.truth = {{"x_m", xyz_m.x()}, {"y_m", xyz_m.y()}};
  effect.needs.drives = effect.needs.is_of_receivers = true;
  effect.put = [=](Forms* forms) { forms->plant.antennas[receiver].xyz_m = xyz_m; };
  return effect;
}

Effect ReservedReceiverClock(const Draw& draw) {
  const std::size_t receiver = draw.draws->Below(kReceivers);
  const double late_s = kTolerances.late_s * draw.Times();
  const double set_s = draw.draws->Between(8, 20);
  Effect effect = OfSensor(draw.numbers.antennas[receiver].name, "clock_offset",
                           "clock that a server sets wrong under way");
  effect.concealed.alike = {"latency"};
  effect.needs.drives = effect.needs.is_of_receivers = true;
  effect.put = [=](Forms* forms) {
    forms->sensors.receivers[receiver].clock = {.offset_s = late_s, .set_s = set_s};
  };
  return effect;
}

Effect ReservedReflections(const Draw& draw) {
  const std::size_t receiver = draw.draws->Below(kReceivers);
  const double push_m = std::min(0.4, kTolerances.datum_m * draw.Times());
  Effect effect = OfSensor(draw.numbers.antennas[receiver].name, "multipath",
                           "raised arm that hides satellites and so pushes the place away");
  effect.needs.joints = {kSlew, kBoom, kArm};
  effect.needs.is_of_receivers = true;
  effect.put = [=](Forms* forms) { forms->sensors.receivers[receiver].shaded_m = push_m; };
  return effect;
}

double MiddleOf(const JointNumbers& joint) { return (joint.lower_rad + joint.upper_rad) / 2; }

Effect ReservedEncoderZero(const Draw& draw) {
  const double zero_rad = kTolerances.zero_rad * draw.Times() * draw.draws->Sign();
  auto [axis, effect] = OfEncoder(draw, "bias", "ring off its centre, most amid travel");
  effect.concealed.besides = {"scale"};
  const double at_rad = MiddleOf(draw.numbers.joints[axis]);
  effect.put = [zero_rad, at_rad, axis = axis](Forms* forms) {
    forms->sensors.encoders[axis].ring_rad = zero_rad;
    forms->sensors.encoders[axis].ring_at_rad = at_rad;
  };
  return effect;
}

Effect ReservedEncoderReversed(const Draw& draw) {
  auto [axis, effect] = OfEncoder(draw, "axis_flip", "rate alone counts the other way");
  effect.concealed.alike = {"scale"};
  effect.put = [axis = axis](Forms* forms) { forms->sensors.encoders[axis].rate_factor = -1; };
  return effect;
}

/// Set right amid travel; what is wound up already makes the drum larger.
Effect ReservedEncoderScale(const Draw& draw) {
  const double part = 0.013 * draw.Times() * draw.draws->Sign();
  auto [axis, effect] = OfEncoder(draw, "scale", "cord on a drum of another radius");
  effect.concealed.besides = {"bias"};
  effect.concealed.truth["position_factor"] = effect.concealed.truth["rate_factor"] = 1 + part;
  const double middle_rad = MiddleOf(draw.numbers.joints[axis]);
  effect.put = [part, middle_rad, axis = axis](Forms* forms) {
    EncoderForm& form = forms->sensors.encoders[axis];
    form.angle_factor = form.rate_factor = 1 + part;
    form.zero_rad -= part * middle_rad;
    form.wound_1prad = 0.25 * part;
    form.wound_from_rad = middle_rad;
  };
  return effect;
}

}  // namespace

Effect DrawReservedOfSensor(const std::string& name, const Draw& draw) {
  using Drawn = Effect (*)(const Draw&);
  const std::map<std::string, Drawn> drawn = {
      {"unit_mount", ReservedUnitMount},         {"unit_bias", ReservedUnitBias},
      {"unit_late", ReservedUnitLate},           {"antenna", ReservedAntenna},
      {"receiver_clock", ReservedReceiverClock}, {"reflections", ReservedReflections},
      {"encoder_zero", ReservedEncoderZero},     {"encoder_reversed", ReservedEncoderReversed},
      {"encoder_scale", ReservedEncoderScale}};
  return drawn.at(name)(draw);
}

}  // namespace tera::blind::mujoco
