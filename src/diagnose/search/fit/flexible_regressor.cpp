#include "diagnose/search/fit/flexible_regressor.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "diagnose/statistics/series/robust.h"
#include "diagnose/statistics/series/whitening.h"

namespace tera {
namespace {

constexpr double kClip =
    3;  ///< robust scales; Huber's function leaves 99 % of normal errors unchanged
/// Ridge of the fit for the noise. It is small, because this fit need not predict.
constexpr double kNoiseRidge = 1e-6;
/// Candidate ridges, relative to each column's energy. The last suppresses a column almost
/// entirely.
constexpr std::array kRidges = {1e-4, 1e-2, 0.1, 1.0, 10.0, 100.0, 1000.0};
constexpr std::size_t kRegressorFolds = 5;
constexpr int kHuberReweightings = 3;      ///< reweightings of Huber's regression
constexpr std::size_t kHighestOrder = 10;  ///< highest order of the noise's autoregression
/// Smallest degrees of freedom of the innovations. A machine that rests half the time leaves
/// residuals of two scales. Heavier tails would treat its motion as outliers, and only rest would
/// count.
constexpr double kLeastDof = 4;
/// Smallest ratio of the innovations' scale to the channel's RMS: no replay is better.
constexpr double kLeastScaleOfRms = 2e-3;
/// Smallest scale of innovations, in rad/s or m/s; smaller values are rounding.
constexpr double kLeastScale = 1e-6;

struct Products {
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;
  double energy = 0;

  Products(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, const Eigen::VectorXd& weight)
      : information(x.transpose() * weight.asDiagonal() * x),
        pull(x.transpose() * weight.cwiseProduct(y)),
        energy(weight.dot(y.cwiseAbs2())) {}

  Products& operator-=(const Products& other) {
    information -= other.information;
    pull -= other.pull;
    energy -= other.energy;
    return *this;
  }
  double Left(const Eigen::VectorXd& beta) const {
    return energy - 2 * pull.dot(beta) + beta.dot(information * beta);
  }
};

Eigen::VectorXd Solve(Eigen::MatrixXd information, const Eigen::VectorXd& pull, double ridge) {
  information.diagonal() *= 1 + ridge;
  information.diagonal().array() += 1e-300;
  return information.ldlt().solve(pull);
}

struct Problem {
  Eigen::MatrixXd x;
  Eigen::VectorXd y;
  std::vector<std::size_t> fold;
};

Eigen::VectorXd HuberWeights(const Eigen::VectorXd& left) {
  const double limit = kClip * RobustScale({left.begin(), left.end()});
  return left.unaryExpr([&](double e) {
    return limit <= 0 ? 1.0 : std::min(1.0, limit / std::max(std::abs(e), 1e-300));
  });
}

Eigen::VectorXd Regress(const Problem& problem, double ridge) {
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(problem.x.cols());
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(problem.y.size());
  for (int pass = 0; pass < kHuberReweightings; ++pass) {
    if (pass > 0) weight = HuberWeights(problem.y - problem.x * beta);
    const Products products(problem.x, problem.y, weight);
    beta = Solve(products.information, products.pull, ridge);
  }
  return beta;
}

/// The ridge that predicts folds outside its fit best. None if zero predicts them as well.
std::optional<double> BestRidge(const Problem& problem) {
  const Eigen::VectorXd weight =
      HuberWeights(problem.y - problem.x * Regress(problem, kRidges.front()));
  const Products all(problem.x, problem.y, weight);
  std::array<double, kRidges.size()> left{};
  for (std::size_t f = 0; f < kRegressorFolds; ++f) {
    std::vector<Eigen::Index> rows;
    for (std::size_t k = 0; k < problem.fold.size(); ++k) {
      if (problem.fold[k] == f) rows.push_back(static_cast<Eigen::Index>(k));
    }
    if (rows.empty()) continue;
    const Products unseen(problem.x(rows, Eigen::all), problem.y(rows), weight(rows));
    Products seen = all;
    seen -= unseen;
    for (std::size_t r = 0; r < kRidges.size(); ++r) {
      left[r] += unseen.Left(Solve(seen.information, seen.pull, kRidges[r]));
    }
  }
  const auto best = std::min_element(left.begin(), left.end());
  if (*best >= all.energy) return std::nullopt;
  return kRidges[static_cast<std::size_t>(best - left.begin())];
}

Eigen::MatrixXd WithConstant(const Eigen::MatrixXd& columns, Eigen::Index rows) {
  Eigen::MatrixXd out(rows, columns.cols() + 1);
  out.col(0).setOnes();
  if (columns.cols() > 0) out.rightCols(columns.cols()) = columns;
  return out;
}

/// The fold of each TRAIN sample. Manoeuvres are dealt to the folds in turn.
std::vector<std::size_t> FoldOfSamples(const std::vector<Manoeuvre>& manoeuvres,
                                       std::size_t samples) {
  std::vector<std::size_t> fold(samples, 0);
  std::size_t count = 0;
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (manoeuvre.part != Part::kTrain) continue;
    for (std::size_t k = manoeuvre.samples.begin; k < manoeuvre.samples.end; ++k) {
      fold[k] = count % kRegressorFolds;
    }
    ++count;
  }
  return fold;
}

/// Columns and a constant column, raw and whitened by the noise model.
class WhitenedColumns {
 public:
  WhitenedColumns(const Eigen::MatrixXd& columns, std::size_t samples,
                  const WhiteningFilter& filter)
      : columns_(WithConstant(columns, static_cast<Eigen::Index>(samples))),
        white_(columns_.rows(), columns_.cols()),
        filter_(filter) {
    for (Eigen::Index c = 0; c < columns_.cols(); ++c)
      white_.col(c) = filter.Apply(columns_.col(c));
  }

  /// The regression over the samples of `fit_on`. None if they are too few.
  std::optional<Problem> Over(const Mask& fit_on, const std::vector<std::size_t>& fold,
                              const Series& residual) const {
    std::vector<Eigen::Index> rows;
    Problem problem;
    for (std::size_t k = 0; k < residual.size(); ++k) {
      if (!fit_on[k] || !filter_.rows()[k]) continue;
      rows.push_back(static_cast<Eigen::Index>(k));
      problem.fold.push_back(fold[k]);
    }
    if (static_cast<Eigen::Index>(rows.size()) <= 2 * columns_.cols()) return std::nullopt;
    problem.x = white_(rows, Eigen::all);
    problem.y = filter_.Apply(Eigen::Map<const Eigen::VectorXd>(
        residual.value.data(), static_cast<Eigen::Index>(residual.size())))(rows);
    return problem;
  }

  Series Less(const Eigen::VectorXd& beta, Series residual) const {
    const Eigen::VectorXd explained = columns_ * beta;
    for (std::size_t k = 0; k < residual.size(); ++k) {
      if (residual.valid[k]) residual.value[k] -= explained[static_cast<Eigen::Index>(k)];
    }
    return residual;
  }
  Eigen::Index count() const { return columns_.cols(); }

 private:
  Eigen::MatrixXd columns_, white_;
  const WhiteningFilter& filter_;
};

Mask NotFinal(const std::vector<Manoeuvre>& manoeuvres, std::size_t samples) {
  Mask mask = MaskOf(manoeuvres, Part::kTrain, samples);
  const Mask select = MaskOf(manoeuvres, Part::kSelect, samples);
  for (std::size_t k = 0; k < samples; ++k) mask[k] = mask[k] || select[k];
  return mask;
}

NoiseModel NoiseOf(const Channel& channel, const std::vector<double>& predicted,
                   const Mask& fit_on) {
  Series residual = channel.measured;
  for (std::size_t k = 0; k < residual.size(); ++k) {
    if (residual.valid[k]) residual.value[k] -= predicted[k];
  }
  const WhiteningFilter as_it_is({}, residual.valid);
  const WhitenedColumns columns(channel.flexible_regressor, residual.size(), as_it_is);
  double freedom_share = 0;  // degrees of freedom of the columns over the number of rows
  if (const auto problem =
          columns.Over(fit_on, std::vector<std::size_t>(residual.size(), 0), residual)) {
    residual = columns.Less(Regress(*problem, kNoiseRidge), std::move(residual));
    freedom_share = static_cast<double>(columns.count()) / static_cast<double>(problem->y.size());
  }
  NoiseModel noise =
      FitNoise(Restricted(residual, fit_on),
               {.highest_order = kHighestOrder, .least_dof = kLeastDof, .estimate_mean = false});
  noise.scale /= std::sqrt(1 - freedom_share);
  noise.scale = std::max(
      {noise.scale, kLeastScaleOfRms * Rms(Restricted(channel.measured, fit_on)), kLeastScale});
  return noise;
}

/// Subtracts the prediction of columns, fitted to TRAIN, from a channel's residual.
void SubtractColumns(const Eigen::MatrixXd& columns, const NoiseModel& noise,
                     const std::vector<Manoeuvre>& manoeuvres, Series* residual,
                     Eigen::VectorXd* innovation) {
  const std::size_t samples = residual->size();
  const WhiteningFilter filter(noise, residual->valid);
  const WhitenedColumns whitened(columns, samples, filter);
  const auto problem = whitened.Over(MaskOf(manoeuvres, Part::kTrain, samples),
                                     FoldOfSamples(manoeuvres, samples), *residual);
  const auto ridge = problem ? BestRidge(*problem) : std::nullopt;
  if (!ridge) return;
  *residual = whitened.Less(Regress(*problem, *ridge), *residual);
  *innovation = filter.Apply(Eigen::Map<const Eigen::VectorXd>(
                    residual->value.data(), static_cast<Eigen::Index>(samples))) /
                noise.scale;
}

/// Cross-fits `beyond`: each manoeuvre of a misfit is judged by a fit to the manoeuvres of other
/// folds.
template <typename Beyond>
Misfit CrossFitted(const Misfit& misfit, const std::vector<Manoeuvre>& manoeuvres, Beyond beyond) {
  Misfit out = misfit;
  for (std::size_t f = 0; f < kRegressorFolds; ++f) {
    std::vector<Manoeuvre> parted = manoeuvres;
    for (std::size_t m = 0; m < parted.size(); ++m) {
      parted[m].part = m % kRegressorFolds == f ? Part::kFinal : Part::kTrain;
    }
    const Misfit judged = beyond(parted);
    for (const Manoeuvre& manoeuvre : parted) {
      if (manoeuvre.part == Part::kFinal) CopySamples(judged, manoeuvre.samples, &out);
    }
  }
  return out;
}

}  // namespace

Misfit ResidualBeyondFlexible(const ReplayBlock& block, const Likelihood& likelihood,
                              const Misfit& misfit, const std::vector<Manoeuvre>& manoeuvres) {
  Misfit out = misfit;
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    SubtractColumns(block.channels[c].flexible_regressor, likelihood.noise()[c], manoeuvres,
                    &out.residual[c], &out.innovation[c]);
  }
  return out;
}

Misfit CrossFittedResidual(const ReplayBlock& block, const Likelihood& likelihood,
                           const Misfit& misfit, const std::vector<Manoeuvre>& manoeuvres) {
  return CrossFitted(misfit, manoeuvres, [&](const std::vector<Manoeuvre>& parted) {
    return ResidualBeyondFlexible(block, likelihood, misfit, parted);
  });
}

Misfit CrossFittedOver(const Eigen::MatrixXd& columns, std::size_t channel,
                       const Likelihood& likelihood, const Misfit& misfit,
                       const std::vector<Manoeuvre>& manoeuvres) {
  return CrossFitted(misfit, manoeuvres, [&](const std::vector<Manoeuvre>& parted) {
    Misfit out = misfit;
    SubtractColumns(columns, likelihood.noise()[channel], parted, &out.residual[channel],
                    &out.innovation[channel]);
    return out;
  });
}

std::vector<NoiseModel> NoiseOfBlock(const ReplayBlock& block,
                                     const std::vector<Manoeuvre>& manoeuvres,
                                     const Structure& found) {
  const auto predicted = block.predict(found);
  const Mask fit_on = NotFinal(manoeuvres, block.samples());
  std::vector<NoiseModel> noise;
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    noise.push_back(NoiseOf(block.channels[c], predicted[c], fit_on));
  }
  return noise;
}

}  // namespace tera
