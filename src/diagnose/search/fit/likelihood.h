#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/noise_model.h"
#include "diagnose/statistics/series/whitening.h"

namespace tera {

/// What predictions leave of the channels.
struct Misfit {
  /// One list a channel, one entry a sample: innovation over the noise's scale; 0 where none.
  std::vector<Eigen::VectorXd> innovation;
  /// Offset, gain - 1, delay (s) and nominal numbers of each channel, over their standard
  /// deviations.
  std::vector<Eigen::VectorXd> nuisances;
  std::vector<Series> residual;  ///< measured less predicted, nuisances included
};

/// How likely the measurements of a block are, given predictions of its channels.
///
/// Model   measured = (1 + g) predicted + b - d d(predicted)/dt + N n + noise, the noise of each
///         channel autoregressive with Student-t innovations (noise_model.h); b, g and d normal
///         about 0 with the channel's standard deviations, n of its nominal columns N likewise with
///         1, none beyond two of them, so that what is more is no nuisance; fitted to the samples
///         of a mask by iteratively reweighted least squares on whitened columns. Samples without
///         full memory since the last gap say nothing.
/// Omits   noise common to several channels.
class Likelihood {
 public:
  /// One noise model a channel; `fit_on`: samples that nuisances are fitted to. The block must
  /// outlive it.
  Likelihood(const ReplayBlock& block, std::vector<NoiseModel> noise, const Mask& fit_on);

  const std::vector<NoiseModel>& noise() const { return noise_; }
  /// Samples of a channel that have an innovation.
  const Mask& rows(std::size_t channel) const { return parts_[channel].filter.rows(); }

  Misfit Judge(const std::vector<std::vector<double>>& predicted) const;
  /// The same of other measurements than the block's.
  Misfit JudgeAgainst(const std::vector<std::vector<double>>& measured,
                      const std::vector<std::vector<double>>& predicted) const;
  /// What least squares is to make small: signed square roots of the deviance of each innovation of
  /// the samples fitted to, the channels in turn, and at the end of each channel's its nuisances.
  std::vector<double> Deviances(const std::vector<std::vector<double>>& predicted) const;
  /// Half the sum of squares of these, negative: log-likelihood of the samples fitted to, less that
  /// of innovations of 0, less half the square of each nuisance.
  double LogLikelihood(const std::vector<std::vector<double>>& predicted) const;
  /// The same of what this one has judged, with nothing taken off since.
  double LogLikelihood(const Misfit& judged) const;
  /// The samples that the deviances of one channel belong to, in order.
  const std::vector<std::size_t>& fitted_samples(std::size_t channel) const {
    return parts_[channel].samples;
  }

  /// How much likelier one would be than the other if it were true, were there no noise to hide the
  /// difference: what a recording can say at best, beyond nuisances.
  double Discernible(const std::vector<std::vector<double>>& predicted,
                     const std::vector<std::vector<double>>& truth) const;

  /// Log-likelihood of the samples [from, to), all channels or one, less that of innovations of 0.
  double Sum(const Misfit& misfit, const Segment& samples,
             std::optional<std::size_t> channel = {}) const;

 private:
  /// A channel's whitening filter, and what it makes of the samples fitted to.
  struct ChannelPart {
    WhiteningFilter filter;
    std::vector<Segment> runs;
    std::vector<std::size_t> samples;
    Eigen::VectorXd measured, offset;  ///< whitened, over the noise's scale
    Eigen::MatrixXd nominal;           ///< likewise
  };
  /// Innovations of the samples fitted to, and the nuisances.
  struct Weighed {
    Eigen::VectorXd innovation;
    Eigen::VectorXd nuisances;
  };

  Eigen::VectorXd Gathered(std::size_t channel, const Eigen::Ref<const Eigen::VectorXd>& x) const;
  Weighed Weigh(std::size_t channel, const Eigen::VectorXd& measured,
                const std::vector<double>& predicted) const;

  const ReplayBlock& block_;
  std::vector<NoiseModel> noise_;
  std::vector<ChannelPart> parts_;
};

/// Takes over what another misfit leaves of some samples; nuisances stay.
void TakeOver(const Misfit& from, const Segment& samples, Misfit* out);

/// Log-density of an innovation, less that of 0.
double LogDensityOf(double innovation, double dof);

}  // namespace tera
