#include "core/error.h"

namespace tera {
namespace {

std::string MessageOf(const std::vector<InputFault>& faults) {
  std::string message;
  for (const InputFault& fault : faults) {
    if (!message.empty()) message += '\n';
    message += fault.Message();
  }
  return message;
}

/// Adds `place` in front of the place that the fault has, separated by a colon.
InputFault At(std::string place, InputFault fault) {
  if (!fault.place.empty()) place += ": " + fault.place;
  fault.place = std::move(place);
  return fault;
}

}  // namespace

std::string InputFault::Message() const { return place.empty() ? finding : place + ": " + finding; }

InputError::InputError(std::string place, InputFault fault)
    : InputError(std::vector<InputFault>{At(std::move(place), std::move(fault))}) {}

InputError::InputError(std::vector<InputFault> faults)
    : std::runtime_error(MessageOf(faults)), faults_(std::move(faults)) {}

}  // namespace tera
