#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/types/effects.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/simulated.h"

/// A block without physics: one channel that repeats a lever. Candidates add a square, a hysteresis
/// or a delay of the lever.

namespace tera {

/// Mechanisms of the toy, each with one number. `twin` equals `square`.
inline const std::vector<Mechanism>& ToyMechanisms() {
  static const std::vector<Mechanism> mechanisms = {
      {"square", Slot::kLeverMap, {}, {{"size", "1", -2, 2, {}}}},
      {"twin", Slot::kLoadFriction, {}, {{"size", "1", -2, 2, {}}}},
      {"step", Slot::kActuator, {}, {{"size", "1", -2, 2, {}}}},
      {"lag", Slot::kCommandTiming, {}, {{"time_s", "s", 0, 1, {}}}}};
  return mechanisms;
}

/// Response of each of the toy's candidates to a lever.
inline std::vector<double> ToyResponse(const std::vector<double>& lever, double square, double step,
                                       double lag_s) {
  std::vector<double> y(lever.size());
  double lagged = 0;
  const double share = lag_s > 0 ? 1 - std::exp(-0.01 / lag_s) : 1;
  for (std::size_t k = 0; k < lever.size(); ++k) {
    lagged += share * (lever[k] - lagged);
    y[k] = lagged + square * lagged * lagged + step * std::tanh(20 * lever[k]);
  }
  return y;
}

/// The toy's lever, the same for the same seed.
inline std::vector<double> ToyLever(std::size_t size, std::uint64_t seed) {
  return LeverSeries(size, Stream(seed, "lever")).value;
}

/// A block with the measurement `measured` under that lever; candidates are indices into
/// ToyMechanisms.
inline ReplayBlock ToyBlock(const std::vector<double>& lever, const Series& measured,
                            const std::vector<std::size_t>& candidates) {
  ReplayBlock block;
  block.name = "toy";
  const Series command = MakeSeries(measured.period_s, lever);
  std::vector<double> drift(lever.size());
  for (std::size_t k = 0; k < drift.size(); ++k) {
    drift[k] = std::sin(0.005 * static_cast<double>(k)) + 0.3 * std::sin(0.0317 * k);
  }
  const Series temperature = MakeSeries(measured.period_s, drift);
  Eigen::MatrixXd free(static_cast<Eigen::Index>(lever.size()), 14);
  for (Eigen::Index k = 0; k < free.rows(); ++k) {
    for (int i = 0; i < 4; ++i) {
      const auto past = static_cast<std::size_t>(std::max<Eigen::Index>(0, k - 12 * i));
      free(k, 3 * i) = lever[past];
      free(k, 3 * i + 1) = lever[past] * lever[past];
      free(k, 3 * i + 2) = std::tanh(20 * lever[past]);
    }
    const double t = drift[static_cast<std::size_t>(k)];
    free(k, 12) = t;
    free(k, 13) = t * t;
  }
  block.channels.push_back({"toy/rate",
                            "1",
                            measured,
                            {.offset = 0.01, .gain = 0.02},
                            {{"lever", command}, {"temperature", temperature}},
                            free,
                            {}});
  block.commands = {command};
  for (const std::size_t s : candidates) {
    const bool is_lag = s == 3;
    block.candidates.push_back({&ToyMechanisms()[s],
                                "toy",
                                {{0, is_lag ? 0.0 : -2.0, is_lag ? 1.0 : 2.0}},
                                is_lag ? std::vector<std::vector<double>>{{0.05}, {0.3}}
                                       : std::vector<std::vector<double>>{{0.1}, {-0.1}, {0.5}}});
  }
  block.replay = WholeReplay([lever](const Structure& terms) {
    double square = 0, step = 0, lag_s = 0;
    for (const Term& term : terms) {
      const std::string_view id = term.candidate->mechanism->id;
      if (id == "square" || id == "twin") square += term.values[0];
      if (id == "step") step += term.values[0];
      if (id == "lag") lag_s += term.values[0];
    }
    return std::vector<std::vector<double>>{ToyResponse(lever, square, step, lag_s)};
  });
  return block;
}

/// `clean` under stubborn noise of standard deviation about `sigma`, 2 % lost.
inline Series ToyMeasured(const std::vector<double>& clean, double sigma, std::uint64_t seed) {
  NoiseModel noise = {.ar = {0.7}, .scale = 1, .dof = 4};
  noise.scale = sigma * std::sqrt(1 - 0.7 * 0.7) / std::sqrt(2.0);  // t(4) has variance 2
  const std::vector<double> error = SimulateNoise(noise, clean.size(), Stream(seed, "noise"));
  std::vector<double> measured(clean.size());
  for (std::size_t k = 0; k < clean.size(); ++k) measured[k] = clean[k] + error[k];
  return WithDropouts(MakeSeries(0.01, measured), 0.02, Stream(seed, "lost"));
}

/// Equal manoeuvres, every fourth of them FINAL.
inline std::vector<Manoeuvre> EqualManoeuvres(std::size_t count, std::size_t length) {
  std::vector<Manoeuvre> manoeuvres;
  for (std::size_t m = 0; m < count; ++m) {
    Manoeuvre one{{m * length, (m + 1) * length}, 1};
    one.part = m % 4 == 3 ? Part::kFinal : (m % 2 == 0 ? Part::kTrain : Part::kSelect);
    manoeuvres.push_back(one);
  }
  return manoeuvres;
}

inline std::vector<std::string> NamesOf(const std::vector<Finding>& findings) {
  std::vector<std::string> names;
  for (const Finding& finding : findings) names.emplace_back(finding.term.candidate->mechanism->id);
  return names;
}

}  // namespace tera
