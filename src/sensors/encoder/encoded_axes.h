#pragma once

#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "physics/description/machine.h"
#include "sensors/encoder/encoder.h"

namespace tera {

/// Measured axes of an encoder, joints before gears, as indices into the machine's lists.
struct EncodedAxes {
  std::vector<int> joints, gears;
  std::vector<std::string> unknown;  ///< names absent from the machine
};

/// The axes that `encoder` names; all movable axes if it names none.
EncodedAxes AxesOf(const EncoderModel& encoder, const MachineModel& machine);

/// Names and kinds of the axes, in the same order.
std::vector<EncoderAxis> NamesOf(const EncodedAxes& axes, const MachineModel& machine);

}  // namespace tera
