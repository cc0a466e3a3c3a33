#include <fmt/format.h>

#include "blind/mujoco/cases/effect_parts.h"

namespace tera::blind::mujoco {

Effect DrawOutside(const Draw& draw) {
  if (draw.IsReserved()) return DrawReservedOutside(draw);
  const std::size_t axis = kBoom + draw.draws->Below(3);
  const std::size_t other = axis == kArm ? kBucket : kArm;
  const bool other_form = draw.draws->Chance(0.5);
  const double share = draw.draws->Between(0.25, 0.45);
  const std::string others = kAxisNames[other];
  if (!draw.IsSecond() && other_form) {
    Effect effect =
        OfJoint("", axis, fmt::format("slower while the lever of the {} is out", others),
                {"lever/" + others});
    effect.needs.joints.push_back(other);
    return WithDrive(effect, axis, [=](DriveForm* drive) {
      drive->slowed_by = static_cast<int>(other);
      drive->slowed_share = share;
    });
  }
  if (!draw.IsSecond()) {
    Effect effect = OfJoint("", axis, "gain that goes up and down with the angle", {"position"});
    return WithDrive(effect, axis, [=](DriveForm* drive) { drive->wave = share; });
  }
  if (other_form) {
    Effect effect = OfJoint("", axis, "oil that warms within 15 s", {"time"});
    return WithDrive(effect, axis, [=](DriveForm* drive) { drive->cold_share = share; });
  }
  Effect effect =
      OfJoint("", axis, "spool that friction drags along at a distance", {"lever", "lever_way"});
  return WithDrive(effect, axis, [=](DriveForm* drive) { drive->sticking = share / 2; });
}

Effect DrawConfounded(const Draw& draw) {
  const std::size_t axis = kBoom + draw.draws->Below(3);
  return DrawOfJoint(draw.draws->Chance(0.5) ? "dead_band" : "rate_gain", axis, draw);
}

Effect DrawUntestable(const Draw& draw) {
  const std::size_t kind = draw.draws->Below(3), axis = kSlew + draw.draws->Below(4);
  if (kind == 0) {
    Effect effect = OfJoint("lever_saturation", axis, "valve that ends where no lever goes", {});
    return WithDrive(effect, axis, [](DriveForm* drive) { drive->end = 0.75; });
  }
  if (kind == 1) {
    const double kg = draw.draws->Between(0.8, 2.4) * draw.numbers.links[kBucketLink].mass_kg;
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
