#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "blind/mujoco/cases/tolerances.h"
#include "blind/plant/concealed.h"

namespace tera::blind::mujoco {

/// What a recording must have for an effect to show.
struct Needs {
  std::vector<std::size_t> joints;  ///< that are moved
  bool drives = false;              ///< the machine travels
  bool level = false;               ///< ground hardly slopes
  bool is_of_receivers = false;     ///< which the owner would make poses of: there are none then
};

/// One thing that is concealed, and how.
struct Effect {
  Concealed concealed;
  Needs needs;
  std::function<void(Forms*)> put;
  bool is_in_plant =
      true;  ///< it changes the motion, or where sensors are; else only what they say
};

/// One of the forms that an effect has.
enum class Variant {
  kFirst,
  kSecond,
  kReserved  ///< kept for `--reserve`
};

/// A working form, by lot, or the reserved one.
Variant DrawVariant(bool reserve, Draws* draws);

/// How an effect is drawn.
struct Draw {
  const MachineNumbers& numbers;
  Strength strength;
  Variant variant = Variant::kFirst;
  Draws* draws;

  bool IsSecond() const { return variant == Variant::kSecond; }
  bool IsReserved() const { return variant == Variant::kReserved; }

  /// Multiple of a tolerance: 2 to 3 faint, 4 to 8 medium, 9 to 12 strong.
  double Times() const;
};

/// Effects that the tool is asked to name, by what they are of. A name stands for one effect here,
/// though the tool may use it for several sensors.
const std::vector<std::string>& EffectsOfJoints();
const std::vector<std::string>& EffectsOfTracks();
const std::vector<std::string>& EffectsOfSensors();

/// Of the joint `axis`, which CanHold the effect.
Effect DrawOfJoint(const std::string& name, std::size_t axis, const Draw& draw);
bool CanHold(std::size_t axis, const std::string& name, Variant variant);
Effect DrawOfTracks(const std::string& name, const Draw& draw);
Effect DrawOfSensor(const std::string& name, const Draw& draw);

/// Something that no name of the tool's says.
Effect DrawOutside(const Draw& draw);
/// With full levers alone, several names would do.
Effect DrawConfounded(const Draw& draw);
/// Something that this recording cannot show.
Effect DrawUntestable(const Draw& draw);

}  // namespace tera::blind::mujoco
