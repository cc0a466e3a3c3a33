#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/noise_model.h"
#include "diagnose/statistics/series/whitening.h"

namespace tera {

/// The misfit of a prediction to the measured channels.
struct Misfit {
  /// One list for each channel, one entry for each sample: the innovation over the noise's scale; 0
  /// where there is none.
  std::vector<Eigen::VectorXd> innovation;
  /// Offset, gain - 1, delay (s) and nominal numbers of each channel, over their standard
  /// deviations.
  std::vector<Eigen::VectorXd> nuisances;
  std::vector<Series> residual;  ///< measured less predicted, nuisances included
};

/// The likelihood of a block's measurements given predictions of its channels.
///
/// Model   measured = (1 + g) predicted + b - d d(predicted)/dt + N n + noise, the noise of each
///         channel autoregressive with Student-t innovations (noise_model.h); b, g and d normal
///         about 0 with the channel's standard deviations, n of its nominal columns N likewise with
///         1. None is beyond two standard deviations: more is no nuisance. They are fitted to the
///         samples of a mask by iteratively reweighted least squares on whitened columns. Samples
///         with less memory since the last gap than the noise model has say nothing.
/// Omits   noise common to several channels.
class Likelihood {
 public:
  /// `noise` has one model for each channel; `fit_on` are the samples that nuisances are fitted to.
  /// The block must outlive it.
  Likelihood(const ReplayBlock& block, std::vector<NoiseModel> noise, const Mask& fit_on);

  const std::vector<NoiseModel>& noise() const { return noise_; }
  /// Samples of a channel that have an innovation.
  const Mask& rows(std::size_t channel) const { return parts_[channel].filter.rows(); }

  /// The misfit of a prediction to the block's measurements.
  Misfit Evaluate(const std::vector<std::vector<double>>& predicted) const;
  /// The misfit of a prediction to other measurements than the block's.
  Misfit EvaluateAgainst(const std::vector<std::vector<double>>& measured,
                         const std::vector<std::vector<double>>& predicted) const;
  /// The residuals of the least-squares problem: signed square roots of the deviance of each
  /// innovation of the samples fitted to, channel by channel, each channel's followed by its
  /// nuisances.
  std::vector<double> Deviances(const std::vector<std::vector<double>>& predicted) const;
  /// Minus half the sum of squares of Deviances: log-likelihood of the samples fitted to, relative
  /// to innovations of 0, less half the square of each nuisance.
  double LogLikelihood(const std::vector<std::vector<double>>& predicted) const;
  /// The log-likelihood of a misfit that Evaluate returned and that was not changed since.
  double LogLikelihood(const Misfit& judged) const;
  /// The samples that the deviances of one channel belong to, in order.
  const std::vector<std::size_t>& fitted_samples(std::size_t channel) const {
    return parts_[channel].samples;
  }

  /// Log-likelihood by which `truth` would lead `predicted` if it were measured without noise,
  /// beyond nuisances: the most that a recording can say of the two.
  double NoiselessGain(const std::vector<std::vector<double>>& predicted,
                       const std::vector<std::vector<double>>& truth) const;

  /// Log-likelihood of a segment of samples, of all channels or one, relative to innovations of 0.
  double Sum(const Misfit& misfit, const Segment& samples,
             std::optional<std::size_t> channel = {}) const;

 private:
  /// A channel's whitening filter, and the whitened samples that are fitted to.
  struct ChannelPart {
    WhiteningFilter filter;
    std::vector<Segment> runs;
    std::vector<std::size_t> samples;
    Eigen::VectorXd measured, offset;  ///< whitened, over the noise's scale
    Eigen::MatrixXd nominal;           ///< whitened, over the noise's scale
  };
  /// The fit of one channel's nuisances, and the innovations that it leaves of the samples fitted
  /// to.
  struct ChannelFit {
    Eigen::VectorXd innovation;
    Eigen::VectorXd nuisances;
  };

  Eigen::VectorXd Gathered(std::size_t channel, const Eigen::Ref<const Eigen::VectorXd>& x) const;
  ChannelFit FitChannel(std::size_t channel, const Eigen::VectorXd& measured,
                        const std::vector<double>& predicted) const;

  const ReplayBlock& block_;
  std::vector<NoiseModel> noise_;
  std::vector<ChannelPart> parts_;
};

/// Copies innovations and residuals of some samples from one misfit to another; nuisances stay.
void CopySamples(const Misfit& from, const Segment& samples, Misfit* out);

/// Log-density of an innovation over the noise's scale, relative to that of 0.
double LogDensityOf(double innovation, double dof);

}  // namespace tera
