#include "diagnose/proposal/curve_proposal.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/statistics/hypothesis_tests/block_bootstrap.h"
#include "diagnose/statistics/regime/regime_axis.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr Eigen::Index kSplines = 20;
/// Penalty of the curve itself, in parts of the mean information: it is 0 where nothing was seen.
constexpr double kRidge = 1e-3;
constexpr std::uint64_t kReplicates = 200;  ///< of the band
constexpr std::size_t kFolds = 5;           ///< of the manoeuvres, each predicted by the others

/// The energy that coefficients leave.
double LeftOf(const LeastSquares& normal, const Eigen::VectorXd& of_splines) {
  return normal.energy - of_splines.dot(2 * normal.pull - normal.information * of_splines);
}

/// Whether the few values of a discrete variable are all that it can have.
bool IsWay(const RegimeVariable& variable) { return variable.name.starts_with("lever_way/"); }

/// A residual as a function of one variable, or as the prediction times such a function.
class CurveOver {
 public:
  CurveOver(const RegimeVariable& variable, const Series& residual)
      : residual_(residual),
        axis_(variable),
        splines_(axis_.Splines(kSplines)),
        roughness_(axis_.Roughness(kSplines)) {}

  const Eigen::VectorXd& at() const { return axis_.centre(); }

  LeastSquares Over(const Segment& samples) const {
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(axis_.bins()), pull = weight;
    double energy = 0;
    for (std::size_t k = samples.begin; k < samples.end; ++k) {
      if (!residual_.valid[k]) continue;
      const double times = axis_.times()[static_cast<Eigen::Index>(k)];
      weight[axis_.bin()[k]] += times * times;
      pull[axis_.bin()[k]] += times * residual_.value[k];
      energy += residual_.value[k] * residual_.value[k];
    }
    return {splines_.transpose() * weight.asDiagonal() * splines_, splines_.transpose() * pull,
            energy, static_cast<double>(samples.size())};
  }

  /// The splines' coefficients. The penalty is in parts of the information's trace.
  Eigen::VectorXd Solve(const LeastSquares& normal, double penalty) const {
    Eigen::MatrixXd left = normal.information;
    const double trace = left.trace();
    left += penalty * trace / roughness_.trace() * roughness_;
    left.diagonal().array() += kRidge * trace / static_cast<double>(left.rows()) + 1e-300;
    return left.ldlt().solve(normal.pull);
  }
  Eigen::VectorXd Curve(const Eigen::VectorXd& of_splines) const { return splines_ * of_splines; }

  Series Left(const Eigen::VectorXd& curve) const {
    Series left = residual_;
    for (std::size_t k = 0; k < left.size(); ++k) {
      left.value[k] -= axis_.times()[static_cast<Eigen::Index>(k)] * curve[axis_.bin()[k]];
    }
    return left;
  }

 private:
  const Series& residual_;
  RegimeAxis axis_;
  Eigen::MatrixXd splines_, roughness_;
};

class CurveProposer {
 public:
  explicit CurveProposer(const CurveProblem& problem) : problem_(problem) {}

  std::optional<Proposal> Run(const Stream& stream) const;

 private:
  struct Choice {
    const RegimeVariable* variable = nullptr;
    bool is_share = false;
    double penalty = 0;
  };
  Choice Choose() const;
  CurveOver Over(const RegimeVariable& variable, bool is_share) const;
  std::vector<LeastSquares> Normals(const CurveOver& over) const;
  double RmseSelect(const Choice& choice) const;
  void SetBand(const CurveOver& over, const std::vector<LeastSquares>& normals, double penalty,
               const Stream& stream, ProposedCurve* curve) const;
  Mask Of(Part part) const { return MaskOf(problem_.manoeuvres, part, problem_.residual.size()); }

  const CurveProblem& problem_;
};

CurveOver CurveProposer::Over(const RegimeVariable& variable, bool is_share) const {
  RegimeVariable asked = variable;
  if (is_share) asked.times = problem_.predicted;
  return CurveOver(asked, problem_.residual);
}

/// The energy that is left of manoeuvres by curves that were fitted to the others.
double LeftOfUnseen(const CurveOver& over, const std::vector<LeastSquares>& normals,
                    double penalty) {
  double left = 0;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    LeastSquares seen, unseen;
    for (std::size_t m = 0; m < normals.size(); ++m) {
      (m % kFolds == fold ? unseen : seen).Add(normals[m]);
    }
    if (seen.pull.size() > 0 && unseen.pull.size() > 0) {
      left += LeftOf(unseen, over.Solve(seen, penalty));
    }
  }
  return left;
}

CurveProposer::Choice CurveProposer::Choose() const {
  Choice best;
  double least = std::numeric_limits<double>::infinity();
  for (const RegimeVariable& variable : problem_.variables) {
    if (!problem_.may_depend(variable)) continue;
    if (RegimeAxis(variable).discrete() && !IsWay(variable)) continue;
    for (const bool is_share : {false, true}) {
      const CurveOver over = Over(variable, is_share);
      const std::vector<LeastSquares> normals = Normals(over);
      for (double exponent = -5; exponent <= 1; ++exponent) {
        const double penalty = std::pow(10.0, exponent);
        const double left = LeftOfUnseen(over, normals, penalty);
        if (left >= least) continue;
        least = left;
        best = {&variable, is_share, penalty};
      }
    }
  }
  return best;
}

/// RMSE on SELECT of the choice fitted to TRAIN.
double CurveProposer::RmseSelect(const Choice& choice) const {
  const CurveOver over = Over(*choice.variable, choice.is_share);
  LeastSquares train;
  for (const Segment& samples : SegmentsOf(problem_.manoeuvres, Part::kTrain)) {
    train.Add(over.Over(samples));
  }
  return RmsOver(over.Left(over.Curve(over.Solve(train, choice.penalty))), Of(Part::kSelect));
}

/// The normal equations of each manoeuvre of TRAIN and SELECT.
std::vector<LeastSquares> CurveProposer::Normals(const CurveOver& over) const {
  std::vector<LeastSquares> normals;
  for (const Segment& samples : SeenSegmentsOf(problem_.manoeuvres))
    normals.push_back(over.Over(samples));
  return normals;
}

void CurveProposer::SetBand(const CurveOver& over, const std::vector<LeastSquares>& normals,
                            double penalty, const Stream& stream, ProposedCurve* curve) const {
  std::vector<std::vector<double>> values(static_cast<std::size_t>(curve->at.size()));
  for (std::uint64_t r = 0; r < kReplicates; ++r) {
    const std::vector<int> times = DrawBlocks(normals.size(), r, stream);
    LeastSquares drawn;
    for (std::size_t m = 0; m < normals.size(); ++m) drawn.Add(normals[m], times[m]);
    const Eigen::VectorXd line = over.Curve(over.Solve(drawn, penalty));
    for (std::size_t b = 0; b < values.size(); ++b) {
      values[b].push_back(line[static_cast<Eigen::Index>(b)]);
    }
  }
  curve->low = curve->high = curve->mean;
  for (std::size_t b = 0; b < values.size(); ++b) {
    const auto bin = static_cast<Eigen::Index>(b);
    curve->low[bin] = Quantile(values[b], 0.05);
    curve->high[bin] = Quantile(values[b], 0.95);
  }
}

std::optional<Proposal> CurveProposer::Run(const Stream& stream) const {
  const Choice choice = Choose();
  if (choice.variable == nullptr) return std::nullopt;
  const CurveOver over = Over(*choice.variable, choice.is_share);
  const std::vector<LeastSquares> normals = Normals(over);
  LeastSquares seen;
  for (const LeastSquares& one : normals) seen.Add(one);
  ProposedCurve curve{choice.variable->name,
                      choice.is_share,
                      over.at(),
                      over.Curve(over.Solve(seen, choice.penalty)),
                      {},
                      {}};
  SetBand(over, normals, choice.penalty, stream, &curve);
  Proposal proposal{problem_.channel, {}, std::move(curve)};
  proposal.rmse_select = RmseSelect(choice);
  proposal.rmse_before = RmsOver(problem_.residual, Of(Part::kFinal));
  proposal.rmse_after = RmsOver(over.Left(proposal.curve->mean), Of(Part::kFinal));
  return Holds(proposal.rmse_before, proposal.rmse_after) ? std::optional(std::move(proposal))
                                                          : std::nullopt;
}

}  // namespace

std::optional<Proposal> ProposeCurve(const CurveProblem& problem, const Stream& stream) {
  return CurveProposer(problem).Run(stream);
}

}  // namespace tera
