#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "blind/mujoco/cases/tolerances.h"
#include "blind/plant/concealed.h"

namespace tera::blind::mujoco {

/// Requirements on a recording in which the effect can show.
struct Needs {
  std::vector<std::size_t> joints;  ///< joints that must move
  bool drives = false;              ///< the machine travels
  bool level = false;               ///< slope of the ground is slight
  bool is_of_receivers = false;     ///< effect of receivers; the owner's poses come from them, so
                                    ///< the recording has none
};

/// One concealed effect.
struct Effect {
  Concealed concealed;
  Needs needs;
  std::function<void(Forms*)> put;
  bool is_in_plant =
      true;  ///< whether it changes the motion or a sensor's mount; otherwise only a reading
};

/// Form of an effect.
enum class Variant {
  kFirst,
  kSecond,
  kReserved  ///< kept for `--reserve`
};

/// A working form at random, or the reserved one.
Variant DrawVariant(bool reserve, Draws* draws);

/// Circumstances of drawing an effect.
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

/// Effects that the tool is to name, by their target. A name stands for one effect here, though the
/// tool may use it for several sensors.
const std::vector<std::string>& EffectsOfJoints();
const std::vector<std::string>& EffectsOfTracks();
const std::vector<std::string>& EffectsOfSensors();

/// Draws an effect of joint `axis`, for which CanHold is true.
Effect DrawOfJoint(const std::string& name, std::size_t axis, const Draw& draw);
bool CanHold(std::size_t axis, const std::string& name, Variant variant);
Effect DrawOfTracks(const std::string& name, const Draw& draw);
Effect DrawOfSensor(const std::string& name, const Draw& draw);

/// An effect outside the tool's names.
Effect DrawOutside(const Draw& draw);
/// An effect that several names explain, with full levers alone.
Effect DrawConfounded(const Draw& draw);
/// An effect that this recording cannot show.
Effect DrawUntestable(const Draw& draw);

}  // namespace tera::blind::mujoco
