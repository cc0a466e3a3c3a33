#pragma once

#include <string>
#include <vector>

#include "dataset/import/suggest/guess.h"

namespace tera {

/// A lever or set-point for the mapping.
struct CommandLine {
  std::string name;  ///< its name in the recording
  std::string yaml;  ///< such as "{column: lever_boom, unit: '%'}"
  std::string remark;
  std::vector<const NumbersOfColumn*> columns;
};

/// Finds columns named like levers: lever, joystick, pedal, or the command of a joint. The largest
/// value decides the unit: fractions, per cent, thousandths, pulses of 1000 to 2000 us, or bytes.
/// Two columns for opposite directions become one lever, their difference.
std::vector<CommandLine> GuessLevers(const std::vector<const NumbersOfColumn*>& columns);

/// Finds columns named like set-points (cmd, ref, setpoint, target, soll) of a quantity with a
/// unit.
std::vector<CommandLine> GuessSetpoints(const std::vector<const NumbersOfColumn*>& columns);

}  // namespace tera
