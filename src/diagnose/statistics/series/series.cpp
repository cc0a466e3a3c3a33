#include "diagnose/statistics/series/series.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {

std::vector<Segment> SegmentsOf(const Mask& valid, std::size_t shortest) {
  std::vector<Segment> segments;
  for (std::size_t k = 0; k < valid.size();) {
    if (!valid[k]) {
      ++k;
      continue;
    }
    const std::size_t begin = k;
    while (k < valid.size() && valid[k]) ++k;
    if (k - begin >= shortest) segments.push_back({begin, k});
  }
  return segments;
}

std::size_t CountValid(const Mask& valid) {
  return static_cast<std::size_t>(std::count(valid.begin(), valid.end(), 1));
}

Mask Both(const Mask& a, const Mask& b) {
  TERA_CHECK(a.size() == b.size(), a.size(), b.size());
  Mask both(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) both[k] = a[k] && b[k];
  return both;
}

Series Restricted(const Series& series, const Mask& kept) {
  Series out = series;
  out.valid = Both(series.valid, kept);
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!out.valid[k]) out.value[k] = 0;
  }
  return out;
}

std::vector<double> ValidValues(const Series& series) {
  std::vector<double> values;
  values.reserve(series.size());
  for (std::size_t k = 0; k < series.size(); ++k) {
    if (series.valid[k]) values.push_back(series.value[k]);
  }
  return values;
}

double Rms(const Series& series) {
  double sum = 0;
  const std::vector<double> values = ValidValues(series);
  for (const double value : values) sum += value * value;
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

double MeanSquare(const Series& series, const Mask& mask) {
  TERA_CHECK(mask.size() == series.size(), mask.size(), series.size());
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    if (!mask[k] || !series.valid[k]) continue;
    sum += series.value[k] * series.value[k];
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

double MeanSquare(const Series& series, const Segment& samples) {
  TERA_CHECK(samples.end <= series.size(), samples.end, series.size());
  double sum = 0, count = 0;
  for (std::size_t k = samples.begin; k < samples.end; ++k) {
    if (!series.valid[k]) continue;
    sum += series.value[k] * series.value[k];
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

std::vector<double> BridgedValues(const Series& series) {
  std::vector<double> out = series.value;
  const std::vector<Segment> known = SegmentsOf(series.valid);
  if (known.empty()) return std::vector<double>(series.size(), 0.0);
  std::fill(out.begin(), out.begin() + known.front().begin, out[known.front().begin]);
  std::fill(out.begin() + known.back().end, out.end(), out[known.back().end - 1]);
  for (std::size_t s = 0; s + 1 < known.size(); ++s) {
    const std::size_t left = known[s].end - 1, right = known[s + 1].begin;
    for (std::size_t k = left + 1; k < right; ++k) {
      const double part = static_cast<double>(k - left) / static_cast<double>(right - left);
      out[k] = std::lerp(out[left], out[right], part);
    }
  }
  return out;
}

}  // namespace tera
