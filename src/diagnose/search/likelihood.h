#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnose/search/replay_block.h"
#include "diagnose/statistics/noise_model.h"
#include "diagnose/statistics/whitening.h"

namespace tera {

/// What predictions leave of the channels.
struct Misfit {
  /// One list a channel, one entry a sample: innovation over the noise's scale; 0 where none.
  std::vector<Eigen::VectorXd> innovation;
  /// Offset, gain - 1 and delay (s) of each channel, over their standard deviations.
  std::vector<Eigen::Vector3d> nuisances;
  std::vector<Series> residual;  ///< measured less predicted, nuisances included
};

/// How likely the measurements of a block are, given predictions of its channels.
///
/// Model   measured = (1 + g) predicted + b - d d(predicted)/dt + noise, the noise of each channel
///         autoregressive with Student-t innovations (noise_model.h); b, g and d normal about 0
///         with the channel's standard deviations, fitted to the samples of a mask by iteratively
///         reweighted least squares on whitened columns. Samples without full memory since the last
///         gap say nothing.
/// Omits   noise common to several channels.
class Likelihood {
 public:
  /// One noise model a channel. The block must outlive it.
  Likelihood(const ReplayBlock& block, std::vector<NoiseModel> noise);

  const std::vector<NoiseModel>& noise() const { return noise_; }
  /// Samples of a channel that have an innovation.
  const Mask& rows(std::size_t channel) const { return filter_[channel].rows(); }

  /// `fit_on`: samples that the nuisances are fitted to.
  Misfit Judge(const std::vector<std::vector<double>>& predicted, const Mask& fit_on) const;

  /// How much likelier one would be than the other if it were true, were there no noise to hide the
  /// difference: what a recording can say at best, beyond nuisances.
  double Discernible(const std::vector<std::vector<double>>& predicted,
                     const std::vector<std::vector<double>>& truth, const Mask& mask) const;

  /// Log-likelihood of the samples [from, to), all channels, less that of innovations of 0.
  double Sum(const Misfit& misfit, const Segment& samples) const;
  /// The same over a mask, and less half the square of each nuisance.
  double SumWithPenalty(const Misfit& misfit, const Mask& mask) const;

 private:
  Misfit Leave(const std::vector<Eigen::VectorXd>& measured,
               const std::vector<std::vector<double>>& predicted, const Mask& fit_on) const;

  const ReplayBlock& block_;
  std::vector<NoiseModel> noise_;
  std::vector<WhiteningFilter> filter_;
};

/// Log-density of an innovation, less that of 0.
double LogDensityOf(double innovation, double dof);

}  // namespace tera
