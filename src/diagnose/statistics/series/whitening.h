#pragma once

#include <Eigen/Core>

#include "diagnose/statistics/series/noise_model.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// Innovations of a series under a noise model. They are independent and of unit scale if the model
/// is true.
struct Innovations {
  Series scaled;   ///< e_t / scale
  Mask restarted;  ///< predicted from fewer than order() samples since the last gap
  double log_likelihood = 0;
  std::size_t count = 0;

  /// The innovations without restarted ones.
  Series Steady() const;
};

/// The innovations of a series under a noise model.
///
/// Model   each valid sample is predicted from at most order() valid samples directly before it.
///         After a gap, a shorter predictor is used, and its larger error is scaled down. Gaussian
///         noise is thus whitened exactly from the first sample of a segment. `log_likelihood`
///         assumes Student-t innovations.
/// Omits   the information of samples before a gap about samples after it.
Innovations Whiten(const NoiseModel& noise, const Series& series);

/// The whitening filter A of a noise model as a linear map. (A x)_t = x_t - sum_i ar_i x_(t-i) for
/// samples with order() valid ones before them (`rows`), else 0. Up to scale, A' A is the inverse
/// covariance of generalised least squares.
class WhiteningFilter {
 public:
  WhiteningFilter(const NoiseModel& noise, const Mask& valid);

  const Mask& rows() const { return rows_; }
  std::size_t row_count() const { return count_; }
  /// 1, -ar_1, -ar_2 ..
  const std::vector<double>& taps() const { return taps_; }

  /// Runs of `rows`.
  const std::vector<Segment>& runs() const { return runs_; }

  Eigen::VectorXd Apply(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  /// A x at the samples of a segment within one run.
  void ApplyOver(const Segment& samples, const Eigen::Ref<const Eigen::VectorXd>& x,
                 Eigen::Ref<Eigen::VectorXd> out) const;
  Eigen::VectorXd Transposed(const Eigen::VectorXd& e) const;

 private:
  std::vector<double> taps_;
  Mask rows_;
  std::vector<Segment> runs_;
  std::size_t count_ = 0;
};

}  // namespace tera
