#pragma once

#include <string>
#include <vector>

#include "blind/mujoco/sensors/sensors_form.h"

namespace tera::blind::mujoco {

/// One recorded row.
struct Row {
  std::uint64_t number = 0;  ///< index of the sample, with lost ones counted
  double true_s = 0;
  long long t_ns = 0;  ///< its stamp
};

/// Sample times of a sensor with its logger's stamps: a phase, jitter, and losses of single rows
/// and of runs. Stamps ascend. `name` is the sensor's, part of the stream names.
std::vector<Row> Log(double duration_s, double period_s, const ClockForm& clock,
                     const NoiseForm& noise, std::uint64_t seed, const std::string& name);

/// Coloured noise of one channel: a white and a slow part, occasionally six times as strong.
class Noise {
 public:
  Noise(std::uint64_t seed, const std::string& name, double white, double slow, double tails,
        double memory_s);
  /// Noise at sample `number`, `step_s` after the previous one.
  double Next(std::uint64_t number, double step_s);

 private:
  Stream white_stream_, slow_stream_;
  double white_, slow_, tails_, memory_s_, drift_;
};

}  // namespace tera::blind::mujoco
