#include "diagnose/statistics/whitening.h"

#include <cmath>

#include "core/check.h"

namespace tera {

Series Innovations::Steady() const {
  Mask kept(restarted.size());
  for (std::size_t k = 0; k < kept.size(); ++k) kept[k] = !restarted[k];
  return Restricted(scaled, kept);
}

Innovations Whiten(const NoiseModel& noise, const Series& series) {
  const ShorterPredictors shorter = PredictorsOf(noise.ar);
  Innovations out;
  out.scaled = {series.period_s, std::vector<double>(series.size(), 0.0), series.valid};
  out.restarted.assign(series.size(), 0);
  for (const Segment& segment : SegmentsOf(series.valid)) {
    for (std::size_t k = segment.begin; k < segment.end; ++k) {
      const std::size_t memory = std::min(k - segment.begin, noise.order());
      double error = series.value[k] - noise.mean;
      for (std::size_t i = 0; i < memory; ++i) {
        error -= shorter.ar[memory][i] * (series.value[k - 1 - i] - noise.mean);
      }
      const double scale = noise.scale * std::sqrt(shorter.variance_ratio[memory]);
      out.scaled.value[k] = error / scale;
      out.restarted[k] = memory < noise.order();
      out.log_likelihood += StudentLogDensity(error / scale, noise.dof) - std::log(scale);
      ++out.count;
    }
  }
  return out;
}

WhiteningFilter::WhiteningFilter(const NoiseModel& noise, const Mask& valid)
    : taps_{1.0}, rows_(valid.size(), 0) {
  for (const double a : noise.ar) taps_.push_back(-a);
  for (const Segment& segment : SegmentsOf(valid, taps_.size())) {
    for (std::size_t k = segment.begin + noise.order(); k < segment.end; ++k) {
      rows_[k] = 1;
      ++count_;
    }
  }
}

Eigen::VectorXd WhiteningFilter::Apply(const Eigen::VectorXd& x) const {
  TERA_CHECK(static_cast<std::size_t>(x.size()) == rows_.size(), x.size(), rows_.size());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(x.size());
  for (Eigen::Index t = 0; t < x.size(); ++t) {
    if (!rows_[static_cast<std::size_t>(t)]) continue;
    for (std::size_t i = 0; i < taps_.size(); ++i) {
      out[t] += taps_[i] * x[t - static_cast<Eigen::Index>(i)];
    }
  }
  return out;
}

Eigen::VectorXd WhiteningFilter::Transposed(const Eigen::VectorXd& e) const {
  TERA_CHECK(static_cast<std::size_t>(e.size()) == rows_.size(), e.size(), rows_.size());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(e.size());
  for (Eigen::Index t = 0; t < e.size(); ++t) {
    if (!rows_[static_cast<std::size_t>(t)]) continue;
    for (std::size_t i = 0; i < taps_.size(); ++i) {
      out[t - static_cast<Eigen::Index>(i)] += taps_[i] * e[t];
    }
  }
  return out;
}

}  // namespace tera
