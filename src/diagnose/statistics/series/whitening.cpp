#include "diagnose/statistics/series/whitening.h"

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
    runs_.push_back({segment.begin + noise.order(), segment.end});
    for (std::size_t k = runs_.back().begin; k < segment.end; ++k) rows_[k] = 1;
    count_ += runs_.back().size();
  }
}

void WhiteningFilter::ApplyOver(const Segment& samples, const Eigen::Ref<const Eigen::VectorXd>& x,
                                Eigen::Ref<Eigen::VectorXd> out) const {
  const auto begin = static_cast<Eigen::Index>(samples.begin);
  const auto size = static_cast<Eigen::Index>(samples.size());
  out = x.segment(begin, size);
  for (std::size_t i = 1; i < taps_.size(); ++i) {
    out += taps_[i] * x.segment(begin - static_cast<Eigen::Index>(i), size);
  }
}

Eigen::VectorXd WhiteningFilter::Apply(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  TERA_CHECK(static_cast<std::size_t>(x.size()) == rows_.size(), x.size(), rows_.size());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(x.size());
  for (const Segment& run : runs_) {
    ApplyOver(
        run, x,
        out.segment(static_cast<Eigen::Index>(run.begin), static_cast<Eigen::Index>(run.size())));
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
