#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "diagnose/learned/learn.h"
#include "diagnose/search/toy_block.h"

namespace tera {

inline constexpr std::size_t kSamples = 8000;
inline constexpr double kNoise = 0.05;

/// The toy's rate plus a term that none of its candidates produces.
struct Odd {
  Odd(std::uint64_t seed, const std::function<double(double lever, double temperature)>& added)
      : lever(ToyLever(kSamples, seed)),
        block(ToyBlock(lever, ToyMeasured(lever, kNoise, seed), {2, 3})) {
    const Series& temperature = block.channels[0].variables[1].series;
    Series& measured = block.channels[0].measured;
    for (std::size_t k = 0; k < measured.size(); ++k) {
      if (measured.valid[k]) measured.value[k] += added(lever[k], temperature.value[k]);
    }
    diagnosis = DiagnoseBlock(block, {}, Stream(seed, "diagnose"));
  }
  std::optional<Learned> Learnt(std::uint64_t seed = 1) const {
    return Learn(block, diagnosis, 0, Stream(seed, "learn"));
  }

  std::vector<double> lever;
  ReplayBlock block;
  BlockDiagnosis diagnosis;
};

}  // namespace tera
