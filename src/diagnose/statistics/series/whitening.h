#pragma once

#include <Eigen/Core>

#include "diagnose/statistics/series/noise_model.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// The innovations of a series under a noise model: independent and of unit scale if the model is
/// true.
struct Innovations {
  Series scaled;   ///< e_t / scale
  Mask restarted;  ///< predicted from fewer than order() samples since the last gap
  double log_likelihood = 0;
  std::size_t count = 0;

  /// The innovations without those flagged as restarted.
  Series Steady() const;
};

/// The innovations of a series under a noise model.
///
/// Model   each valid sample is predicted from the valid samples right before it, at most order()
///         of them. After a gap, a shorter predictor is used and its larger error scaled down. A
///         segment of Gaussian noise is thus whitened exactly from its first sample. log_likelihood
///         is that of Student-t innovations.
/// Omits   information of samples before a gap about those after it.
Innovations Whiten(const NoiseModel& noise, const Series& series);

/// The whitening filter A of a noise model as a linear map: (A x)_t = x_t - sum_i ar_i x_(t-i) for
/// the samples that have full memory (`rows`), else 0. A' A is then, up to scale, the inverse
/// covariance that generalised least squares needs.
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
  /// A x at the samples of a segment that lies within a run.
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
