#pragma once

#include "core/random.h"

namespace tera::blind::mujoco {

/// A lever's messages on a bus that many share.
///
/// Model   Frames begin at whole multiples of a slot. A message waits for the next one, and
///         each time that another node's frame has the lower identifier, for one more; one message
///         a slot, in order. So it waits, on average over its phase in the slot, half a slot (less
///         half a step where times are whole steps), and contested / (1 - contested) slots beside.
/// Omits   that what wins is itself sent at some rhythm.
class Arbitration {
 public:
  /// `contested`: share of the slots that others win.
  Arbitration(double slot_s, double contested, const Stream& draws, std::uint32_t lane)
      : slot_s_(slot_s), contested_(contested), draws_(draws), lane_(lane) {}

  /// When message `number`, ready at `t_s`, has its slot.
  double SlotOf(std::uint64_t number, double t_s);

 private:
  double slot_s_, contested_;
  Stream draws_;
  std::uint32_t lane_;
  long long last_slot_ = -1;
};

}  // namespace tera::blind::mujoco
