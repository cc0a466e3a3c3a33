#pragma once

#include <string>
#include <vector>

#include "dataset/import/suggest/guess.h"

namespace tera {

/// A column of levers or set-points in a mapping.
struct CommandLine {
  std::string name;  ///< in the recording
  std::string yaml;  ///< "{column: lever_boom, unit: '%'}"
  std::string remark;
  std::vector<const NumbersOfColumn*> columns;
};

/// Columns whose names mean levers (lever, joystick, pedal, or the command of a joint). Their unit
/// makes the largest value full: shares, per cent, thousandths, pulses of 1000 to 2000 us, bytes.
/// Two columns of opposite directions become one lever, their difference.
std::vector<CommandLine> GuessLevers(const std::vector<const NumbersOfColumn*>& columns);

/// Columns whose names mean set-points (cmd, ref, setpoint, target, soll) of a quantity with a
/// unit.
std::vector<CommandLine> GuessSetpoints(const std::vector<const NumbersOfColumn*>& columns);

}  // namespace tera
