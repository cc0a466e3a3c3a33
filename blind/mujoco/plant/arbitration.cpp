#include "blind/mujoco/plant/arbitration.h"

#include <algorithm>
#include <cmath>

namespace tera::blind::mujoco {

double Arbitration::SlotOf(std::uint64_t number, double t_s) {
  constexpr double kSame = 1e-6;  // of a slot: a message that is ready as it begins
  const double lost_slots =
      std::floor(std::log(draws_.Uniform(number, lane_)) / std::log(contested_));
  const auto first = static_cast<long long>(std::ceil(t_s / slot_s_ - kSame));
  last_slot_ = std::max(last_slot_ + 1, first + static_cast<long long>(lost_slots));
  return static_cast<double>(last_slot_) * slot_s_;
}

}  // namespace tera::blind::mujoco
