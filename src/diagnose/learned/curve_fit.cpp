#include "diagnose/learned/curve_fit.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/statistics/hypothesis_tests/block_bootstrap.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr Eigen::Index kSplines = 20;
/// Penalty of the curve itself, in parts of the mean information: it is 0 where nothing was seen.
constexpr double kRidge = 1e-3;
constexpr std::uint64_t kReplicates = 200;  ///< of the band
constexpr std::size_t kFolds = 5;           ///< of the manoeuvres, each predicted by the others

/// Normal equations of a fit, which add up over manoeuvres.
struct LeastSquares {
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;
  double energy = 0;  ///< sum of squares of the fitted values

  void Add(const LeastSquares& other, double times = 1) {
    if (information.size() == 0) {
      information = Eigen::MatrixXd::Zero(other.information.rows(), other.information.cols());
      pull = Eigen::VectorXd::Zero(other.pull.size());
    }
    information += times * other.information;
    pull += times * other.pull;
    energy += times * other.energy;
  }
};

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
            energy};
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

 private:
  const Series& residual_;
  RegimeAxis axis_;
  Eigen::MatrixXd splines_, roughness_;
};

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

/// A form of curve that was fitted to some variable.
struct Choice {
  RegimeVariable variable;  ///< with the prediction as factor for a share
  double penalty = 0;
};

/// The normal equations of each manoeuvre of TRAIN and SELECT.
std::vector<LeastSquares> NormalsOf(const CurveOver& over,
                                    const std::vector<Manoeuvre>& manoeuvres) {
  std::vector<LeastSquares> normals;
  for (const Segment& samples : SeenSegmentsOf(manoeuvres)) normals.push_back(over.Over(samples));
  return normals;
}

std::optional<Choice> Choose(const std::vector<Manoeuvre>& manoeuvres,
                             const std::vector<RegimeVariable>& variables, const Series& residual,
                             const std::vector<double>& predicted) {
  std::optional<Choice> best;
  double least = std::numeric_limits<double>::infinity();
  for (RegimeVariable variable : variables) {
    if (RegimeAxis(variable).discrete() && !IsWay(variable)) continue;
    for (const bool is_share : {false, true}) {
      if (is_share) variable.times = predicted;
      const CurveOver over(variable, residual);
      const std::vector<LeastSquares> normals = NormalsOf(over, manoeuvres);
      for (double exponent = -5; exponent <= 1; ++exponent) {
        const double penalty = std::pow(10.0, exponent);
        const double left = LeftOfUnseen(over, normals, penalty);
        if (left >= least) continue;
        least = left;
        best = {variable, penalty};
      }
    }
  }
  return best;
}

void SetBand(const CurveOver& over, const std::vector<LeastSquares>& normals, double penalty,
             const Stream& stream, FittedCurve* curve) {
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

}  // namespace

std::optional<FittedCurve> FitCurve(const std::vector<Manoeuvre>& manoeuvres,
                                    const std::vector<RegimeVariable>& variables,
                                    const Series& residual, const std::vector<double>& predicted,
                                    const Stream& stream) {
  const std::optional<Choice> choice = Choose(manoeuvres, variables, residual, predicted);
  if (!choice) return std::nullopt;
  const auto& [variable, penalty] = *choice;
  const CurveOver over(variable, residual);
  const std::vector<LeastSquares> normals = NormalsOf(over, manoeuvres);
  LeastSquares seen;
  for (const LeastSquares& one : normals) seen.Add(one);
  FittedCurve curve{variable.name, !variable.times.empty(), over.at(),
                    over.Curve(over.Solve(seen, penalty))};
  SetBand(over, normals, penalty, stream, &curve);
  return curve;
}

}  // namespace tera
