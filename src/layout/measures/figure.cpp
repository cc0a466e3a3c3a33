#include "layout/measures/figure.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/check.h"

namespace tera {
namespace {

double Mean(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double MeanOf(const Figure& figure) { return Mean(figure.at); }

double WorstOf(const Figure& figure) { return figure.at[WorstMomentOf(figure)]; }

std::size_t WorstMomentOf(const Figure& figure) {
  TERA_CHECK(!figure.at.empty(), NameOf(figure.id));
  const auto worst = IsMoreBetter(figure.id.measure)
                         ? std::min_element(figure.at.begin(), figure.at.end())
                         : std::max_element(figure.at.begin(), figure.at.end());
  return static_cast<std::size_t>(worst - figure.at.begin());
}

double ErrorOf(const Figure& figure) { return Mean(figure.error); }

double EvenSigma(double width) { return width / std::sqrt(12.0); }

double ShareError(double share, double count) {
  if (count <= 0) return 0;
  // Adds one seen and one unseen place, so that a share of 0 or 1 has an error.
  const double n = count + 2, p = (share * count + 1) / n;
  return std::sqrt(p * (1 - p) / n);
}

double LikeCount(const std::vector<double>& weights) {
  double sum = 0, squares = 0;
  for (const double weight : weights) {
    sum += weight;
    squares += weight * weight;
  }
  return squares > 0 ? sum * sum / squares : 0;
}

}  // namespace tera
