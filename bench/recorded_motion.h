#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace tera::bench {

/// Motion of a scenario's first machine, step by step, for benchmarks of the soil alone.
struct RecordedMotion {
  struct Moment {
    std::vector<BodyState> links;
    std::vector<double> gear_rate_radps;
  };
  std::vector<Moment> moments;
  double dt_s = 0;
};

RecordedMotion Record(const std::string& scenario, int steps);

}  // namespace tera::bench
