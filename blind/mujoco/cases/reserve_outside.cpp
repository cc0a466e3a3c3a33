#include <algorithm>

#include "blind/mujoco/cases/effect_parts.h"

namespace tera::blind::mujoco {
namespace {

Effect Regenerating(const Draw& draw, double share) {
  const std::size_t axis = draw.draws->Chance(0.5) ? kArm : kBucket;
  Effect effect = OfJoint("", axis, "drawn in faster without load, by the rod's own oil",
                          {"load", "lever", "position"});
  return WithDrive(effect, axis, [=](DriveForm* drive) { drive->regenerates = share; });
}

Effect RunningAhead(double share) {
  Effect effect = OfJoint("", kArm, "arm that falls ahead of its oil and waits for it",
                          {"load", "lever", "lever_way", "position"});
  effect.needs.joints = {kBoom, kArm};
  return WithDrive(effect, kArm, [=](DriveForm* drive) { drive->runs_ahead = share; });
}

Effect Braked(double opens_s) {
  Effect effect = OfJoint("", kSlew, "brake that holds after a second at rest and opens late",
                          {"lever", "lever_way", "time"});
  return WithDrive(effect, kSlew, [=](DriveForm* drive) { drive->brake_opens_s = opens_s; });
}

Effect PassedBy(const Draw& draw) {
  const std::size_t receiver = draw.draws->Below(kReceivers);
  const ReceiverForm::Truck truck = {.pull_m = draw.draws->Between(0.15, 0.3),
                                     .first_s = draw.draws->Between(6, 18),
                                     .towards_rad = draw.draws->Within(std::numbers::pi)};
  Effect effect =
      OfSensor(draw.numbers.antennas[receiver].name, "", "trucks that pass and reflect");
  effect.concealed.variables = {"time"};
  effect.needs.is_of_receivers = true;
  effect.put = [=](Forms* forms) { forms->sensors.receivers[receiver].truck = truck; };
  return effect;
}

}  // namespace

Effect DrawReservedOutside(const Draw& draw) {
  const double share = draw.draws->Between(0.25, 0.45);
  switch (draw.draws->Below(4)) {
    case 0:
      return Regenerating(draw, share);
    case 1:
      return RunningAhead(share);
    case 2:
      return Braked(share);
    default:
      return PassedBy(draw);
  }
}

}  // namespace tera::blind::mujoco
