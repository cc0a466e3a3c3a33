#include "diagnose/proposal/proposal.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// Share of FINAL's RMSE that a proposal must remove.
constexpr double kLeastGain = 0.05;

}  // namespace

double RmsOver(const Series& series, const Mask& mask) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    if (!mask[k] || !series.valid[k]) continue;
    sum += series.value[k] * series.value[k];
    ++count;
  }
  return std::sqrt(sum / std::max(count, 1.0));
}

bool Holds(double rmse_before, double rmse_after) {
  return rmse_before > 0 && rmse_after <= (1 - kLeastGain) * rmse_before;
}

}  // namespace tera
