#pragma once

#include <array>

#include "blind/plant/excavator.h"
#include "blind/plant/plant.h"

namespace tera::blind {

/// Style of moving levers.
struct Habit {
  std::array<bool, kAxes> uses{};       ///< which levers at all
  double smallest = 0.06, largest = 1;  ///< of the steps
  bool full_steps_only = false;         ///< only full lever and neutral
};

/// An operator who moves each lever independently: rests, steps, ramps and waves of many sizes,
/// towards the free part of the joint's range. Releases the lever ahead of the stops.
class Operator {
 public:
  Operator(const Excavator& excavator, const Habit& habit, const Stream& stream)
      : excavator_(excavator), habit_(habit), stream_(stream) {}

  AxisValues At(double t_s, const AxisValues& q_rad);

 private:
  enum class Kind { kRest, kStep, kRamp, kWave };
  struct Manoeuvre {
    Kind kind = Kind::kRest;
    double from_s = 0, to_s = 0, size = 0, period_s = 1;
  };
  double Draw(std::size_t axis) { return stream_.Uniform(draws_[axis]++, axis); }
  double Between(std::size_t axis, double low, double high) {
    return low + (high - low) * Draw(axis);
  }
  double Direction(std::size_t axis, double q_rad);
  Manoeuvre Next(std::size_t axis, double t_s, double q_rad);

  Excavator excavator_;
  Habit habit_;
  Stream stream_;
  std::array<Manoeuvre, kAxes> now_;
  std::array<std::uint64_t, kAxes> draws_{};
};

}  // namespace tera::blind
