#pragma once

#include <string>
#include <vector>

#include "blind/mujoco/sensors/sensors_form.h"

namespace tera::blind::mujoco {

/// One row that came through.
struct Row {
  std::uint64_t number = 0;  ///< of the sample, lost ones counted
  double true_s = 0;
  long long t_ns = 0;  ///< its stamp
};

/// When a sensor samples, and how its logger stamps that: its own phase, jitter, rows that are lost
/// one by one and in runs. Stamps rise. `name` is the sensor's, for its streams.
std::vector<Row> Log(double duration_s, double period_s, const ClockForm& clock,
                     const NoiseForm& noise, std::uint64_t seed, const std::string& name);

/// Noise that remembers itself, for one channel: white and slow, now and then six times as much.
class Noise {
 public:
  Noise(std::uint64_t seed, const std::string& name, double white, double slow, double tails,
        double memory_s);
  /// At sample `number`, `step_s` after that before.
  double Next(std::uint64_t number, double step_s);

 private:
  Stream white_stream_, slow_stream_;
  double white_, slow_, tails_, memory_s_, drift_;
};

}  // namespace tera::blind::mujoco
