#pragma once

#include <string>
#include <vector>

#include "dataset/import/suggest/guess.h"

namespace tera {

/// A column of levers or of set-points as a mapping has it.
struct CommandLine {
  std::string name;  ///< in the recording
  std::string yaml;  ///< "{column: lever_boom, unit: '%'}"
  std::string remark;
  std::vector<const NumbersOfColumn*> columns;
};

/// Columns whose names say that they are levers (lever, joystick, pedal, or the command of a
/// joint), in the unit that makes the furthest one full: shares, per cent, thousandths, pulses of
/// 1000 to 2000 us, bytes. Two of opposite directions are one lever, their difference.
std::vector<CommandLine> GuessLevers(const std::vector<const NumbersOfColumn*>& columns);

/// Columns whose names say that they are set-points (cmd, ref, setpoint, target, soll) of something
/// that has a unit.
std::vector<CommandLine> GuessSetpoints(const std::vector<const NumbersOfColumn*>& columns);

}  // namespace tera
