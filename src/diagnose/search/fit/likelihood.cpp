#include "diagnose/search/fit/likelihood.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

constexpr int kReweightings = 2;  ///< reweightings of the Student-t regression of nuisances
/// Bound of a nuisance, in standard deviations.
constexpr double kMostDeviations = 2;

/// Central differences. The ends repeat their neighbours.
std::vector<double> Slope(const std::vector<double>& y, double period_s) {
  std::vector<double> slope(y.size(), 0.0);
  for (std::size_t k = 1; k + 1 < y.size(); ++k) slope[k] = (y[k + 1] - y[k - 1]) / (2 * period_s);
  if (y.size() > 2) {
    slope.front() = slope[1];
    slope.back() = slope[y.size() - 2];
  }
  return slope;
}

Eigen::Map<const Eigen::VectorXd> AsVector(const std::vector<double>& x) {
  return {x.data(), static_cast<Eigen::Index>(x.size())};
}

/// The columns of the nuisances, each scaled by its standard deviation.
Eigen::MatrixXd ColumnsOf(const Channel& channel, const std::vector<double>& predicted) {
  const Nuisances& sigma = channel.nuisances;
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(predicted.size()), 3 + channel.nominal.cols());
  columns.col(0).setConstant(sigma.offset);
  columns.col(1) = sigma.gain * AsVector(predicted);
  columns.col(2) = -sigma.delay_s * AsVector(Slope(predicted, channel.measured.period_s));
  if (channel.nominal.cols() > 0) columns.rightCols(channel.nominal.cols()) = channel.nominal;
  return columns;
}

/// Minimum of beta' information beta / 2 - pull' beta within the bound on each coefficient. Active
/// set: while coefficients exceed the bound, the one furthest beyond is fixed at it.
Eigen::VectorXd SolveBounded(const Eigen::MatrixXd& information, Eigen::VectorXd pull) {
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(pull.size());
  std::vector<Eigen::Index> open;
  for (Eigen::Index i = 0; i < pull.size(); ++i) open.push_back(i);
  while (!open.empty()) {
    const Eigen::VectorXd solved =
        Eigen::MatrixXd(information(open, open)).ldlt().solve(Eigen::VectorXd(pull(open)));
    Eigen::Index furthest = 0;
    if (solved.cwiseAbs().maxCoeff(&furthest) <= kMostDeviations) {
      beta(open) = solved;
      return beta;
    }
    const Eigen::Index held = open[static_cast<std::size_t>(furthest)];
    beta[held] = std::copysign(kMostDeviations, solved[furthest]);
    pull -= beta[held] * information.col(held);
    open.erase(open.begin() + furthest);
  }
  return beta;
}

/// Rows that fit into the processor's first-level cache.
constexpr Eigen::Index kCachedRows = 256;

struct NormalEquations {
  Eigen::MatrixXd information;  ///< lower half
  Eigen::VectorXd pull;
};

/// Normal equations of Student-t errors about beta, with a unit normal prior on the coefficients.
NormalEquations EquationsAbout(const Eigen::VectorXd& beta, const Eigen::VectorXd& y,
                               const Eigen::MatrixXd& columns, double dof) {
  const Eigen::Index count = columns.cols();
  NormalEquations sum{Eigen::MatrixXd::Identity(count, count), Eigen::VectorXd::Zero(count)};
  Eigen::MatrixXd weighted(kCachedRows, count);
  for (Eigen::Index first = 0; first < y.size(); first += kCachedRows) {
    const Eigen::Index rows = std::min(kCachedRows, y.size() - first);
    const auto near = columns.middleRows(first, rows);
    const auto aim = y.segment(first, rows);
    const Eigen::ArrayXd error = aim - near * beta;
    weighted.topRows(rows) = ((dof + 1) / (dof + error.square())).matrix().asDiagonal() * near;
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto own = weighted.col(i).head(rows);
      for (Eigen::Index j = 0; j <= i; ++j) sum.information(i, j) += own.dot(near.col(j));
      sum.pull[i] += own.dot(aim);
    }
  }
  return sum;
}

/// Student-t regression of y on the columns, with bounded coefficients.
Eigen::VectorXd Regress(const Eigen::VectorXd& y, const Eigen::MatrixXd& columns, double dof) {
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(columns.cols());
  for (int pass = 0; pass < kReweightings; ++pass) {
    const NormalEquations sum = EquationsAbout(beta, y, columns, dof);
    beta = SolveBounded(sum.information.selfadjointView<Eigen::Lower>(), sum.pull);
  }
  return beta;
}

}  // namespace

double LogDensityOf(double innovation, double dof) {
  return -0.5 * (dof + 1) * std::log1p(innovation * innovation / dof);
}

Likelihood::Likelihood(const ReplayBlock& block, std::vector<NoiseModel> noise, const Mask& fit_on)
    : block_(block), noise_(std::move(noise)) {
  TERA_CHECK(noise_.size() == block.channels.size(), noise_.size(), block.channels.size());
  for (std::size_t c = 0; c < noise_.size(); ++c) {
    const Channel& channel = block.channels[c];
    parts_.push_back({WhiteningFilter(noise_[c], channel.measured.valid), {}, {}, {}, {}, {}});
    ChannelPart& part = parts_.back();
    part.runs = SegmentsOf(Both(part.filter.rows(), fit_on));
    for (const Segment& run : part.runs) {
      for (std::size_t k = run.begin; k < run.end; ++k) part.samples.push_back(k);
    }
    const auto size = static_cast<Eigen::Index>(channel.measured.size());
    part.measured = Gathered(c, AsVector(channel.measured.value));
    part.offset = Gathered(c, Eigen::VectorXd::Constant(size, channel.nuisances.offset));
    part.nominal.resize(part.offset.size(), channel.nominal.cols());
    for (Eigen::Index n = 0; n < channel.nominal.cols(); ++n) {
      part.nominal.col(n) = Gathered(c, channel.nominal.col(n));
    }
  }
}

Eigen::VectorXd Likelihood::Gathered(std::size_t channel,
                                     const Eigen::Ref<const Eigen::VectorXd>& x) const {
  const ChannelPart& part = parts_[channel];
  Eigen::VectorXd out(static_cast<Eigen::Index>(part.samples.size()));
  Eigen::Index at = 0;
  for (const Segment& run : part.runs) {
    const auto size = static_cast<Eigen::Index>(run.size());
    part.filter.ApplyOver(run, x, out.segment(at, size));
    at += size;
  }
  return out / noise_[channel].scale;
}

Likelihood::ChannelFit Likelihood::FitChannel(std::size_t channel, const Eigen::VectorXd& measured,
                                              const std::vector<double>& predicted) const {
  const Series& series = block_.channels[channel].measured;
  const Nuisances& sigma = block_.channels[channel].nuisances;
  TERA_CHECK(predicted.size() == series.size(), predicted.size());
  const Eigen::VectorXd white = Gathered(channel, AsVector(predicted));
  const Eigen::MatrixXd& nominal = parts_[channel].nominal;
  Eigen::MatrixXd columns(white.size(), 3 + nominal.cols());
  columns.col(0) = parts_[channel].offset;
  columns.col(1) = sigma.gain * white;
  if (sigma.delay_s > 0) {
    columns.col(2) =
        -sigma.delay_s * Gathered(channel, AsVector(Slope(predicted, series.period_s)));
  } else {
    columns.col(2).setZero();
  }
  if (nominal.cols() > 0) columns.rightCols(nominal.cols()) = nominal;
  const Eigen::VectorXd y = measured - white;
  const Eigen::VectorXd beta = Regress(y, columns, noise_[channel].dof);
  return {y - columns * beta, beta};
}

Misfit Likelihood::Evaluate(const std::vector<std::vector<double>>& predicted) const {
  std::vector<std::vector<double>> measured;
  for (const Channel& channel : block_.channels) measured.push_back(channel.measured.value);
  return EvaluateAgainst(measured, predicted);
}

Misfit Likelihood::EvaluateAgainst(const std::vector<std::vector<double>>& measured,
                                   const std::vector<std::vector<double>>& predicted) const {
  Misfit out;
  for (std::size_t c = 0; c < noise_.size(); ++c) {
    const Channel& channel = block_.channels[c];
    const auto y = AsVector(measured[c]);
    const Eigen::VectorXd beta = FitChannel(c, Gathered(c, y), predicted[c]).nuisances;
    const Eigen::VectorXd left =
        y - AsVector(predicted[c]) - ColumnsOf(channel, predicted[c]) * beta;
    out.nuisances.push_back(beta);
    out.innovation.push_back(parts_[c].filter.Apply(left) / noise_[c].scale);
    Series residual = channel.measured;
    for (std::size_t k = 0; k < residual.size(); ++k) {
      residual.value[k] = residual.valid[k] ? left[static_cast<Eigen::Index>(k)] : 0;
    }
    out.residual.push_back(std::move(residual));
  }
  return out;
}

std::vector<double> Likelihood::Deviances(const std::vector<std::vector<double>>& predicted) const {
  std::vector<double> rows;
  for (std::size_t c = 0; c < noise_.size(); ++c) {
    const double dof = noise_[c].dof;
    const ChannelFit weighed = FitChannel(c, parts_[c].measured, predicted[c]);
    for (const double e : weighed.innovation) {
      rows.push_back(std::copysign(std::sqrt(-2 * LogDensityOf(e, dof)), e));
    }
    for (const double nuisance : weighed.nuisances) rows.push_back(nuisance);
  }
  return rows;
}

double Likelihood::LogLikelihood(const std::vector<std::vector<double>>& predicted) const {
  double sum = 0;
  for (std::size_t c = 0; c < noise_.size(); ++c) {
    const ChannelFit weighed = FitChannel(c, parts_[c].measured, predicted[c]);
    sum -= 0.5 * weighed.nuisances.squaredNorm();
    for (const double e : weighed.innovation) sum += LogDensityOf(e, noise_[c].dof);
  }
  return sum;
}

double Likelihood::LogLikelihood(const Misfit& judged) const {
  double sum = 0;
  for (std::size_t c = 0; c < noise_.size(); ++c) {
    sum -= 0.5 * judged.nuisances[c].squaredNorm();
    for (const std::size_t k : parts_[c].samples) {
      sum += LogDensityOf(judged.innovation[c][static_cast<Eigen::Index>(k)], noise_[c].dof);
    }
  }
  return sum;
}

double Likelihood::NoiselessGain(const std::vector<std::vector<double>>& predicted,
                                 const std::vector<std::vector<double>>& truth) const {
  double sum = 0;
  for (std::size_t c = 0; c < noise_.size(); ++c) {
    const ChannelFit weighed = FitChannel(c, Gathered(c, AsVector(truth[c])), predicted[c]);
    sum += 0.5 * weighed.nuisances.squaredNorm();
    for (const double e : weighed.innovation) sum -= LogDensityOf(e, noise_[c].dof);
  }
  return sum;
}

double Likelihood::Sum(const Misfit& misfit, const Segment& samples,
                       std::optional<std::size_t> channel) const {
  double sum = 0;
  for (std::size_t c = 0; c < noise_.size(); ++c) {
    if (channel && c != *channel) continue;
    for (std::size_t k = samples.begin; k < samples.end; ++k) {
      if (!rows(c)[k]) continue;
      sum += LogDensityOf(misfit.innovation[c][static_cast<Eigen::Index>(k)], noise_[c].dof);
    }
  }
  return sum;
}

void CopySamples(const Misfit& from, const Segment& samples, Misfit* out) {
  const auto begin = static_cast<std::ptrdiff_t>(samples.begin);
  const auto end = static_cast<std::ptrdiff_t>(samples.end);
  for (std::size_t c = 0; c < out->innovation.size(); ++c) {
    const auto first = static_cast<Eigen::Index>(samples.begin);
    const auto size = static_cast<Eigen::Index>(samples.size());
    out->innovation[c].segment(first, size) = from.innovation[c].segment(first, size);
    const std::vector<double>& left = from.residual[c].value;
    std::copy(left.begin() + begin, left.begin() + end, out->residual[c].value.begin() + begin);
  }
}

}  // namespace tera
