#pragma once

#include "core/random.h"

namespace tera::blind::mujoco {

/// A lever's messages on a shared bus.
///
/// Model   Frames begin at whole multiples of a slot. A message waits for the next slot, and for
///         one more each time that another node's frame has the lower identifier. Each slot takes
///         one message, in order. Averaged over the phase, a message waits half a slot (minus half
///         a step where times are whole steps) plus contested / (1 - contested) slots.
/// Omits   rhythms of the competing messages.
class Arbitration {
 public:
  /// `contested`: share of the slots that others win.
  Arbitration(double slot_s, double contested, const Stream& draws, std::uint32_t lane)
      : slot_s_(slot_s), contested_(contested), draws_(draws), lane_(lane) {}

  /// Time of the slot for message `number`, ready at `t_s`.
  double SlotOf(std::uint64_t number, double t_s);

 private:
  double slot_s_, contested_;
  Stream draws_;
  std::uint32_t lane_;
  long long last_slot_ = -1;
};

}  // namespace tera::blind::mujoco
