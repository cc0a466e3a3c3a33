#include "diagnose/proposal/propose.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/random.h"
#include "diagnose/proposal/curve_proposal.h"
#include "diagnose/proposal/learn.h"
#include "diagnose/proposal/proposal.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/statistics/series/whitening.h"

namespace tera {
namespace {

constexpr std::size_t kMostTerms = 3;
constexpr std::uint64_t kHalves = 60;       ///< random halves of the manoeuvres
constexpr double kLeastStability = 0.7;     ///< share of the halves that choose a term
constexpr double kAlikeCorrelation = 0.95;  ///< of columns that count as the same term
constexpr double kClip = 4;                 ///< robust scales: larger innovations count as this

/// The coefficients of some columns, and the sum of squares that they leave.
struct Solved {
  Eigen::VectorXd beta;
  double left = 0;
};

Solved Solve(const LeastSquares& products, const std::vector<Eigen::Index>& columns) {
  Eigen::MatrixXd information = products.information(columns, columns);
  const Eigen::VectorXd pull = products.pull(columns);
  information.diagonal() *= 1 + 1e-9;
  information.diagonal().array() += 1e-12;
  Solved out;
  out.beta = information.ldlt().solve(pull);
  out.left = products.energy - pull.dot(out.beta);
  return out;
}

class FormulaProposer {
 public:
  FormulaProposer(const ReplayBlock& block, const BlockDiagnosis& diagnosis, std::size_t channel);
  std::optional<Proposal> Run(const Stream& stream) const;

 private:
  std::vector<Eigen::Index> Columns(const std::vector<std::size_t>& terms) const;
  std::vector<std::size_t> Pursue(const LeastSquares& products) const;
  double StabilityOf(std::size_t term, const std::vector<std::vector<std::size_t>>& chosen) const;
  std::vector<std::vector<std::size_t>> OnHalves(const Stream& stream) const;
  Series Left(const std::vector<Eigen::Index>& columns, const Solved& solved) const;

  const BlockDiagnosis& diagnosis_;
  std::size_t channel_;
  const Series& residual_;
  std::vector<LibraryTerm> library_;
  Eigen::Index nuisances_ = 0;
  Eigen::MatrixXd columns_;                 ///< nuisances, then terms, each over its RMS
  Eigen::VectorXd scale_;                   ///< the columns' RMS
  std::vector<LeastSquares> of_manoeuvre_;  ///< nuisances first, then terms
  LeastSquares all_, train_;
};

FormulaProposer::FormulaProposer(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                 std::size_t channel)
    : diagnosis_(diagnosis),
      channel_(channel),
      residual_(diagnosis.search.found.misfit.residual[channel]) {
  const Channel& measured = block.channels[channel];
  const auto rows = static_cast<Eigen::Index>(block.samples());
  const std::vector<double> predicted = block.predict(diagnosis.search.found.terms)[channel];
  library_ = TermLibraryOf(measured, predicted);
  const Eigen::VectorXd rate = Eigen::Map<const Eigen::VectorXd>(predicted.data(), rows);
  nuisances_ = 3 + measured.nominal.cols();
  Eigen::MatrixXd columns(rows, nuisances_ + static_cast<Eigen::Index>(library_.size()));
  columns.col(0).setOnes();
  columns.col(1) = rate;
  columns.col(2).setZero();
  if (rows > 2) columns.col(2).segment(1, rows - 2) = rate.tail(rows - 2) - rate.head(rows - 2);
  columns.middleCols(3, measured.nominal.cols()) = measured.nominal;
  for (std::size_t t = 0; t < library_.size(); ++t) {
    columns.col(nuisances_ + static_cast<Eigen::Index>(t)) = library_[t].column;
  }
  scale_ = (columns.colwise().norm() / std::sqrt(static_cast<double>(rows))).cwiseMax(1e-300);
  columns_ = columns * scale_.cwiseInverse().asDiagonal();

  const NoiseModel& noise = diagnosis.noise[channel];
  const WhiteningFilter filter(noise, residual_.valid);
  Eigen::MatrixXd white(rows, columns_.cols());
  for (Eigen::Index c = 0; c < columns_.cols(); ++c) {
    white.col(c) = filter.Apply(columns_.col(c)) / noise.scale;
  }
  const Eigen::VectorXd left = Eigen::Map<const Eigen::VectorXd>(residual_.value.data(), rows);
  const Eigen::VectorXd y =
      (filter.Apply(left) / noise.scale).cwiseMax(-kClip * kClip).cwiseMin(kClip * kClip);
  for (const Manoeuvre& manoeuvre : diagnosis.manoeuvres) {
    if (manoeuvre.part == Part::kFinal) continue;
    const auto first = static_cast<Eigen::Index>(manoeuvre.samples.begin);
    const auto size = static_cast<Eigen::Index>(manoeuvre.samples.size());
    const auto x = white.middleRows(first, size);
    const auto d = y.segment(first, size);
    of_manoeuvre_.push_back(
        {x.transpose() * x, x.transpose() * d, d.squaredNorm(), static_cast<double>(size)});
    all_.Add(of_manoeuvre_.back());
    if (manoeuvre.part == Part::kTrain) train_.Add(of_manoeuvre_.back());
  }
}

std::vector<Eigen::Index> FormulaProposer::Columns(const std::vector<std::size_t>& terms) const {
  std::vector<Eigen::Index> columns;
  for (Eigen::Index c = 0; c < nuisances_; ++c) columns.push_back(c);
  for (const std::size_t t : terms) columns.push_back(nuisances_ + static_cast<Eigen::Index>(t));
  return columns;
}

/// The terms that the criterion accepts, in the order in which the pursuit finds them.
std::vector<std::size_t> FormulaProposer::Pursue(const LeastSquares& products) const {
  std::vector<std::size_t> chosen;
  double left = Solve(products, Columns(chosen)).left;
  while (chosen.size() < kMostTerms) {
    std::size_t best = library_.size();
    double least = left;
    for (std::size_t t = 0; t < library_.size(); ++t) {
      if (std::find(chosen.begin(), chosen.end(), t) != chosen.end()) continue;
      std::vector<std::size_t> with = chosen;
      with.push_back(t);
      const double now = Solve(products, Columns(with)).left;
      if (now >= least) continue;
      least = now;
      best = t;
    }
    const double cost =
        std::log(products.rows) + 2 * std::log(static_cast<double>(library_.size()));
    if (best == library_.size() || !(least > 0) || products.rows * std::log(left / least) < cost) {
      return chosen;
    }
    chosen.push_back(best);
    left = least;
  }
  return chosen;
}

std::vector<std::vector<std::size_t>> FormulaProposer::OnHalves(const Stream& stream) const {
  std::vector<std::vector<std::size_t>> chosen;
  std::vector<std::size_t> order(of_manoeuvre_.size());
  for (std::uint64_t half = 0; half < kHalves; ++half) {
    for (std::size_t m = 0; m < order.size(); ++m) order[m] = m;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return stream.Uniform(half << 20 | a) < stream.Uniform(half << 20 | b);
    });
    LeastSquares products;
    for (std::size_t m = 0; 2 * m < order.size(); ++m) products.Add(of_manoeuvre_[order[m]]);
    chosen.push_back(Pursue(products));
  }
  return chosen;
}

double FormulaProposer::StabilityOf(std::size_t term,
                                    const std::vector<std::vector<std::size_t>>& chosen) const {
  const auto centred = [&](std::size_t t) -> Eigen::VectorXd {
    const Eigen::VectorXd& column = library_[t].column;
    return (column.array() - column.mean()).matrix().normalized();
  };
  const Eigen::VectorXd own = centred(term);
  std::vector<int> alike(library_.size(), -1);
  double count = 0;
  for (const auto& terms : chosen) {
    count += std::any_of(terms.begin(), terms.end(),
                         [&](std::size_t t) {
                           if (alike[t] < 0)
                             alike[t] = std::abs(own.dot(centred(t))) >= kAlikeCorrelation ? 1 : 0;
                           return alike[t] == 1;
                         })
                 ? 1
                 : 0;
  }
  return count / static_cast<double>(chosen.size());
}

/// The residual that some columns leave unexplained.
Series FormulaProposer::Left(const std::vector<Eigen::Index>& columns, const Solved& solved) const {
  const Eigen::VectorXd explained = columns_(Eigen::all, columns) * solved.beta;
  Series left = residual_;
  for (std::size_t k = 0; k < left.size(); ++k) {
    left.value[k] -= explained[static_cast<Eigen::Index>(k)];
  }
  return left;
}

std::optional<Proposal> FormulaProposer::Run(const Stream& stream) const {
  if (library_.empty() || of_manoeuvre_.size() < 4) return std::nullopt;
  std::vector<std::size_t> terms = Pursue(all_);
  if (terms.empty()) return std::nullopt;
  const auto halves = OnHalves(stream);
  std::vector<double> stability;
  std::vector<std::size_t> stable;
  for (const std::size_t term : terms) {
    const double share = StabilityOf(term, halves);
    if (share < kLeastStability) continue;
    stable.push_back(term);
    stability.push_back(share);
  }
  if (stable.empty()) return std::nullopt;
  const std::vector<Eigen::Index> columns = Columns(stable);
  const Solved solved = Solve(all_, columns);
  // Huber 1967: the scatter of scores over manoeuvres between two inverses of the information.
  const Eigen::MatrixXd inverse =
      Eigen::MatrixXd(all_.information(columns, columns))
          .ldlt()
          .solve(Eigen::MatrixXd::Identity(solved.beta.size(), solved.beta.size()));
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(solved.beta.size(), solved.beta.size());
  for (const LeastSquares& one : of_manoeuvre_) {
    const Eigen::VectorXd score =
        one.pull(columns) - one.information(columns, columns) * solved.beta;
    scatter += score * score.transpose();
  }
  const Eigen::MatrixXd covariance = inverse * scatter * inverse;
  Proposal proposal;
  proposal.channel = channel_;
  for (std::size_t i = 0; i < stable.size(); ++i) {
    const auto c = nuisances_ + static_cast<Eigen::Index>(i);
    const double scale = scale_[nuisances_ + static_cast<Eigen::Index>(stable[i])];
    proposal.terms.push_back({library_[stable[i]].factors, solved.beta[c] / scale,
                              std::sqrt(covariance(c, c)) / scale, stability[i]});
  }
  const auto part = [&](Part one) { return MaskOf(diagnosis_.manoeuvres, one, residual_.size()); };
  const Series left = Left(columns, solved);
  proposal.rmse_before = RmsOver(residual_, part(Part::kFinal));
  proposal.rmse_after = RmsOver(left, part(Part::kFinal));
  proposal.rmse_select = RmsOver(Left(columns, Solve(train_, columns)), part(Part::kSelect));
  return Holds(proposal.rmse_before, proposal.rmse_after) ? std::optional(std::move(proposal))
                                                          : std::nullopt;
}

/// A short formula that explains a channel's residual, if one generalises.
///
/// Model   orthogonal matching pursuit of the whitened residual on the term library
///         (proposal.h), jointly with offset, gain, delay and nominal numbers, on TRAIN and
///         SELECT. At most three terms, each accepted by the extended Bayesian information
///         criterion. Stability: the selection is repeated on 60 random halves of the manoeuvres.
///         Seven of ten must select a term, or one whose correlation with it is 0.95. The remaining
///         terms are refitted, with standard deviations from the scatter over manoeuvres. None
///         where FINAL's RMSE falls by less than a twentieth.
/// Omits   terms with memory; dependences outside the library.
/// Source  Pati, Rezaiifar, Krishnaprasad 1993; Meinshausen and Buehlmann 2010, "Stability
///         selection"; Chen and Chen 2008 (the criterion); Brunton, Proctor, Kutz 2016 (sparse
///         regression on a library).
std::optional<Proposal> ProposeFormula(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                       std::size_t channel, const Stream& stream) {
  return FormulaProposer(block, diagnosis, channel).Run(stream);
}

/// RMSE of a curve on SELECT over that of a formula, at most, for the curve to be proposed.
constexpr double kMostCurveRatio = 0.9;

}  // namespace

std::optional<Proposal> Propose(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                std::size_t channel, const Stream& stream) {
  std::optional<Proposal> formula = ProposeFormula(block, diagnosis, channel, stream);
  std::optional<Proposal> curve =
      ProposeCurve({.channel = channel,
                    .manoeuvres = diagnosis.manoeuvres,
                    .variables = block.channels[channel].variables,
                    .residual = diagnosis.search.found.misfit.residual[channel],
                    .predicted = block.predict(diagnosis.search.found.terms)[channel]},
                   stream);
  const bool takes_curve =
      curve && (!formula || curve->rmse_select < kMostCurveRatio * formula->rmse_select);
  std::optional<Proposal> proposal = takes_curve ? std::move(curve) : std::move(formula);
  if (proposal) Learn(block, diagnosis, stream, &*proposal);
  return proposal;
}

}  // namespace tera
