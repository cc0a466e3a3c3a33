#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/noise_model.h"
#include "diagnose/statistics/series/whitening.h"

namespace tera {

struct Misfit {
  /// By channel and sample: innovation divided by the scale of the noise; 0 for a sample without
  /// innovation.
  std::vector<Eigen::VectorXd> innovation;
  /// By channel: offset, gain - 1, delay (s) and nominal numbers, in standard deviations.
  std::vector<Eigen::VectorXd> nuisances;
  std::vector<Series> residual;  ///< measured minus predicted, with fitted nuisance parameters
};

/// Likelihood of a block's measurements for given predictions of its channels.
///
/// Model   measured = (1 + g) predicted + b - d d(predicted)/dt + N n + noise. The noise of each
///         channel is autoregressive with Student-t innovations (noise_model.h). The nuisances b, g
///         and d are normal about 0 with the channel's standard deviations. The factors n of its
///         nominal columns N are standard normal. All are bounded at two standard deviations: a
///         larger error is no nuisance. They are fitted to the samples of a mask by iteratively
///         reweighted least squares on whitened columns. Samples that follow a gap more closely
///         than the memory of the noise model are ignored.
/// Omits   noise common to several channels.
class Likelihood {
 public:
  /// `noise` has one model per channel. Nuisances are fitted to the samples of `fit_on`. The block
  /// must outlive this object.
  Likelihood(const ReplayBlock& block, std::vector<NoiseModel> noise, const Mask& fit_on);

  const std::vector<NoiseModel>& noise() const { return noise_; }
  /// Samples of a channel that have an innovation.
  const Mask& rows(std::size_t channel) const { return parts_[channel].filter.rows(); }

  Misfit Evaluate(const std::vector<std::vector<double>>& predicted) const;
  /// The misfit to other measurements.
  Misfit EvaluateAgainst(const std::vector<std::vector<double>>& measured,
                         const std::vector<std::vector<double>>& predicted) const;
  /// Residuals of the least-squares problem: signed square roots of the deviances of the fitted
  /// samples' innovations. They are ordered by channel; the nuisance parameters of a channel follow
  /// its samples.
  std::vector<double> Deviances(const std::vector<std::vector<double>>& predicted) const;
  /// Minus half the sum of squares of Deviances: the log-likelihood of the fitted samples relative
  /// to innovations of 0, minus half the square of each nuisance.
  double LogLikelihood(const std::vector<std::vector<double>>& predicted) const;
  /// Log-likelihood of a misfit that Evaluate returned.
  double LogLikelihood(const Misfit& judged) const;
  /// Sample indices of one channel's deviances, in order.
  const std::vector<std::size_t>& fitted_samples(std::size_t channel) const {
    return parts_[channel].samples;
  }

  /// Log-likelihood of `truth` over `predicted` if `truth` were measured without noise, beyond
  /// nuisances. It is the upper bound of what a recording can say about the two.
  double NoiselessGain(const std::vector<std::vector<double>>& predicted,
                       const std::vector<std::vector<double>>& truth) const;

  /// Log-likelihood of a segment relative to innovations of 0, over all channels or one.
  double Sum(const Misfit& misfit, const Segment& samples,
             std::optional<std::size_t> channel = {}) const;

 private:
  /// A channel's whitening filter and the whitened samples of the fit.
  struct ChannelPart {
    WhiteningFilter filter;
    std::vector<Segment> runs;
    std::vector<std::size_t> samples;
    Eigen::VectorXd measured, offset;  ///< whitened, divided by the noise's scale
    Eigen::MatrixXd nominal;           ///< whitened, divided by the noise's scale
  };
  /// The fitted nuisance parameters of one channel, and the innovations of the fitted samples.
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

/// Copies innovations and residuals of some samples between misfits; nuisance parameters are not
/// copied.
void CopySamples(const Misfit& from, const Segment& samples, Misfit* out);

/// Log-density of an innovation in units of the noise's scale, relative to the log-density of 0.
double LogDensityOf(double innovation, double dof);

}  // namespace tera
