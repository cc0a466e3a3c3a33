#include "diagnose/statistics/regime/curve_shape.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

namespace tera {
namespace {

using Function = std::function<double(double)>;

double Sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Gain over a constant of the best combination of functions, and its coefficients.
struct Gain {
  double value = 0;
  Eigen::VectorXd coefficient;
};

Gain GainOf(const RegimeCurve& curve, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd normal = columns.transpose() * curve.information * columns;
  normal.diagonal().array() += 1e-9 * normal.diagonal().mean() + 1e-300;
  const Eigen::VectorXd pull = columns.transpose() * curve.pull;
  Gain out;
  out.coefficient = normal.ldlt().solve(pull);
  out.value = std::max(0.0, pull.dot(out.coefficient));
  return out;
}

Eigen::MatrixXd Columns(const RegimeCurve& curve, const std::vector<Function>& functions) {
  Eigen::MatrixXd out(curve.at.size(), static_cast<Eigen::Index>(functions.size()));
  for (Eigen::Index c = 0; c < out.cols(); ++c) {
    for (Eigen::Index b = 0; b < out.rows(); ++b) {
      out(b, c) = functions[static_cast<std::size_t>(c)](curve.at[b]);
    }
  }
  return out;
}

/// First and last bin with samples.
struct Visited {
  double low, high;
};

Visited VisitedRange(const RegimeCurve& curve) {
  Visited out{INFINITY, -INFINITY};
  const double few = 1e-3 * curve.count.sum();
  for (Eigen::Index b = 0; b < curve.at.size(); ++b) {
    if (curve.count[b] < few) continue;
    out.low = std::min(out.low, curve.at[b]);
    out.high = std::max(out.high, curve.at[b]);
  }
  return out;
}

/// Tries families and keeps the best by gain minus penalty.
class Contest {
 public:
  explicit Contest(const RegimeCurve& curve) : curve_(curve), price_(std::log(curve.rows)) {}

  void Try(CurveShape shape, const std::vector<Function>& functions, int bends) {
    const Gain gain = GainOf(curve_, Columns(curve_, functions));
    const double worth =
        gain.value - price_ * static_cast<double>(static_cast<int>(functions.size()) + bends);
    if (worth <= worth_) return;
    worth_ = worth;
    best_ = shape;
    best_.gain = gain.value;
    best_.slope = gain.coefficient[0];
  }

  const CurveShape& best() const { return best_; }
  double worth() const { return worth_; }
  double price() const { return price_; }

 private:
  const RegimeCurve& curve_;
  double price_, worth_ = 0;
  CurveShape best_;
};

void TryWithoutBends(const Visited& all, Contest* contest) {
  CurveShape shape{.low = all.low, .high = all.high};
  shape.form = CurveForm::kLinear;
  contest->Try(shape, {[](double x) { return x; }}, 0);
  shape.form = CurveForm::kSmooth;
  contest->Try(shape, {[](double x) { return std::abs(x); }}, 0);
  contest->Try(shape, {[](double x) { return x * x; }}, 0);
  contest->Try(shape, {[](double x) { return x * std::abs(x); }}, 0);
}

/// Families symmetric about 0, with a bend at +-w.
void TryBendsAboutZero(const Visited& all, Contest* contest) {
  const double reach = std::max(std::abs(all.low), std::abs(all.high));
  if (!(all.low < 0 && all.high > 0)) return;
  for (int step = 1; step < 40; ++step) {
    const double w = reach * step / 40;
    CurveShape shape{.low = -w, .high = w, .bend = w};
    shape.form = CurveForm::kSaturating;
    contest->Try(shape, {[w](double x) { return std::clamp(x, -w, w); }}, 1);
    contest->Try(shape, {[w](double x) { return std::min(std::abs(x), w); }}, 1);
    shape.form = CurveForm::kLocal;
    contest->Try(shape, {[w](double x) { return std::abs(x) < w ? x : 0; }}, 1);
    contest->Try(shape, {[w](double x) { return std::abs(x) < w ? 1.0 : 0.0; }}, 1);
    shape.form = CurveForm::kThreshold;
    shape.outside = true;
    contest->Try(shape, {[w](double x) { return Sign(x) * std::max(std::abs(x) - w, 0.0); }}, 1);
    contest->Try(shape, {[w](double x) { return std::max(std::abs(x) - w, 0.0); }}, 1);
  }
  CurveShape jump{.form = CurveForm::kStep};
  contest->Try(jump, {Sign}, 1);
}

/// Families with one bend or jump anywhere.
void TryOneSidedBends(const Visited& all, Contest* contest) {
  for (int step = 1; step < 40; ++step) {
    const double c = all.low + (all.high - all.low) * step / 40;
    CurveShape shape{.bend = c};
    shape.form = CurveForm::kThreshold;
    shape.low = c;
    shape.high = all.high;
    contest->Try(shape, {[c](double x) { return std::max(x - c, 0.0); }}, 1);
    shape.low = all.low;
    shape.high = c;
    contest->Try(shape, {[c](double x) { return std::min(x - c, 0.0); }}, 1);
    shape.form = CurveForm::kStep;
    shape.low = shape.high = c;
    contest->Try(shape, {[c](double x) { return x > c ? 1.0 : 0.0; }}, 1);
  }
}

void TryHarmonics(const Visited& all, Contest* contest) {
  for (int k = 1; k <= 4; ++k) {
    CurveShape shape{.form = CurveForm::kPeriodic, .low = all.low, .high = all.high};
    shape.bend = k;
    contest->Try(
        shape,
        {[k](double x) { return std::sin(k * x); }, [k](double x) { return std::cos(k * x); }}, 1);
  }
}

/// Piecewise-linear functions of |x|, each times `side(x)`.
std::vector<Function> HatsOfDistance(double reach, const Function& side) {
  constexpr int kPieces = 6;
  std::vector<Function> out;
  for (int j = 0; j <= kPieces; ++j) {
    out.push_back([=](double x) {
      return side(x) * std::max(0.0, 1 - std::abs(std::abs(x) / reach * kPieces - j));
    });
  }
  return out;
}

CurveParity ParityOf(const RegimeCurve& curve, const Visited& all, double price) {
  const double reach = std::max(std::abs(all.low), std::abs(all.high));
  if (curve.angle || std::min(-all.low, all.high) < 0.2 * reach) return CurveParity::kNotTested;
  const auto odd_part = HatsOfDistance(reach, Sign);
  const auto even_part = HatsOfDistance(reach, [](double) { return 1.0; });
  auto both_parts = odd_part;
  both_parts.insert(both_parts.end(), even_part.begin(), even_part.end());
  const double odd = GainOf(curve, Columns(curve, odd_part)).value;
  const double even = GainOf(curve, Columns(curve, even_part)).value;
  const double both = GainOf(curve, Columns(curve, both_parts)).value;
  const double slack = std::max(0.05 * both, 7 * price);
  if (both < price) return CurveParity::kNotTested;
  if (both - odd < slack && odd > even) return CurveParity::kOdd;
  if (both - even < slack && even > odd) return CurveParity::kEven;
  return CurveParity::kNeither;
}

/// The shortest interval of bins with nine tenths of the energy: the sum of count mean^2.
Visited EnergyInterval(const RegimeCurve& curve) {
  const Eigen::VectorXd energy = curve.count.cwiseProduct(curve.mean.cwiseAbs2());
  const double wanted = 0.9 * energy.sum();
  Visited best{curve.at[0], curve.at[curve.at.size() - 1]};
  Eigen::Index end = 0;
  double sum = 0;
  for (Eigen::Index begin = 0; begin < energy.size(); ++begin) {
    while (end < energy.size() && sum < wanted) sum += energy[end++];
    if (sum < wanted) break;
    if (curve.at[end - 1] - curve.at[begin] < best.high - best.low) {
      best = {curve.at[begin], curve.at[end - 1]};
    }
    sum -= energy[begin];
  }
  return best;
}

void TryFree(const RegimeCurve& curve, const Visited& all, Contest* contest, CurveShape* shape) {
  const double free_gain =
      2 * curve.pull.dot(curve.mean) - curve.mean.dot(curve.information * curve.mean);
  const double worth = free_gain - contest->price() * curve.effective_freedom;
  *shape = contest->best();
  // A form that explains 95 % of a free curve's gain is kept, regardless of the number of rows.
  const bool needed = worth > contest->worth() && contest->best().gain < 0.95 * free_gain;
  if (needed) {
    const Visited interval = curve.angle ? all : EnergyInterval(curve);
    *shape = {.form = curve.discrete ? CurveForm::kLevels : CurveForm::kFree,
              .low = interval.low,
              .high = interval.high,
              .gain = free_gain};
  }
  shape->free_gain = free_gain;
}

}  // namespace

CurveShape ClassifyCurve(const RegimeCurve& curve) {
  const Visited all = VisitedRange(curve);
  Contest contest(curve);
  if (curve.angle) {
    TryHarmonics(all, &contest);
  } else {
    TryWithoutBends(all, &contest);
    TryBendsAboutZero(all, &contest);
    TryOneSidedBends(all, &contest);
  }
  CurveShape shape;
  TryFree(curve, all, &contest, &shape);
  if (shape.form != CurveForm::kNone) shape.parity = ParityOf(curve, all, contest.price());
  return shape;
}

std::string_view NameOf(CurveForm form) {
  constexpr std::string_view names[] = {"none", "linear", "smooth",   "saturating", "threshold",
                                        "step", "local",  "periodic", "levels",     "free"};
  return names[static_cast<int>(form)];
}

std::string_view NameOf(CurveParity parity) {
  constexpr std::string_view names[] = {"not tested", "odd", "even", "neither"};
  return names[static_cast<int>(parity)];
}

}  // namespace tera
