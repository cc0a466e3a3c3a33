#pragma once

#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "physics/description/machine.h"
#include "sensors/encoder/encoder.h"

namespace tera {

/// Axes that an encoder reads, joints before gears, as indices into the machine's lists.
struct EncodedAxes {
  std::vector<int> joints, gears;
  std::vector<std::string> unknown;  ///< names that the machine lacks
};

/// The axes that `encoder` names, or all that move where it names none.
EncodedAxes AxesOf(const EncoderModel& encoder, const MachineModel& machine);

/// Their names and kinds, in that order.
std::vector<EncoderAxis> NamesOf(const EncodedAxes& axes, const MachineModel& machine);

}  // namespace tera
