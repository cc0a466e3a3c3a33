#include "diagnose/search/structure/baselines.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/in_parallel.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/fit/static_map.h"
#include "diagnose/search/fit/structure_fit.h"

namespace tera {
namespace {

/// Degrees of freedom at which Student's t is the normal distribution to six digits.
constexpr double kNormalDof = 1e6;

using Rows = std::vector<Eigen::Index>;

/// A channel's samples of TRAIN and SELECT, and those of FINAL.
struct Parts {
  Rows seen, final;
};

Parts PartsOf(const Channel& channel, const Mask& final) {
  Parts parts;
  for (std::size_t k = 0; k < channel.measured.size(); ++k) {
    if (!channel.measured.valid[k]) continue;
    (final[k] ? parts.final : parts.seen).push_back(static_cast<Eigen::Index>(k));
  }
  return parts;
}

double RmsOver(const Eigen::VectorXd& x, const Rows& rows) {
  if (rows.empty()) return 0;
  return std::sqrt(x(rows).squaredNorm() / static_cast<double>(rows.size()));
}

Eigen::VectorXd VectorOf(const std::vector<double>& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

Eigen::VectorXd ResidualOf(const Channel& channel, const std::vector<double>& predicted) {
  return VectorOf(channel.measured.value) - VectorOf(predicted);
}

/// Residual of all rows after a least-squares fit of the columns to `rows`.
Eigen::VectorXd LessColumns(const Eigen::VectorXd& y, const Eigen::MatrixXd& columns,
                            const Rows& rows) {
  if (rows.empty()) return y;
  const Eigen::MatrixXd some = columns(rows, Eigen::all);
  return y - columns * some.colPivHouseholderQr().solve(Eigen::VectorXd(y(rows)));
}

Eigen::VectorXd SlopeOf(const Eigen::VectorXd& y, double period_s) {
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(y.size());
  if (y.size() < 3) return slope;
  const Eigen::Index inner = y.size() - 2;
  slope.segment(1, inner) = (y.tail(inner) - y.head(inner)) / (2 * period_s);
  return slope;
}

Eigen::VectorXd Tuned(const Channel& channel, const std::vector<double>& predicted,
                      const Parts& parts) {
  const Eigen::VectorXd y = VectorOf(predicted);
  Eigen::MatrixXd columns(y.size(), 3 + channel.nominal.cols());
  columns.col(0).setOnes();
  columns.col(1) = y;
  columns.col(2) = SlopeOf(y, channel.measured.period_s);
  if (channel.nominal.cols() > 0) columns.rightCols(channel.nominal.cols()) = channel.nominal;
  return LessColumns(ResidualOf(channel, predicted), columns, parts.seen);
}

/// Functions of the regime variables as centred columns of unit standard deviation.
Eigen::MatrixXd LibraryOf(const Channel& channel) {
  std::vector<Eigen::VectorXd> columns, plain;
  for (const RegimeVariable& variable : channel.variables) {
    if (variable.name == "time") continue;
    plain.push_back(VectorOf(BridgedValues(variable.series)));
  }
  for (std::size_t a = 0; a < plain.size(); ++a) {
    columns.push_back(plain[a]);
    columns.push_back(plain[a].cwiseAbs());
    columns.push_back(plain[a].cwiseSign());
    for (std::size_t b = a; b < plain.size(); ++b) {
      columns.push_back(plain[a].cwiseProduct(plain[b]));
    }
  }
  std::erase_if(columns, [](Eigen::VectorXd& column) {
    column.array() -= column.mean();
    const double size = column.norm();
    if (size > 0) column *= std::sqrt(static_cast<double>(column.size())) / size;
    return size < 1e-12;
  });
  Eigen::MatrixXd library(static_cast<Eigen::Index>(channel.measured.size()),
                          static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    library.col(static_cast<Eigen::Index>(k)) = columns[k];
  }
  return library;
}

double Criterion(double rms, std::size_t rows, std::size_t terms) {
  const auto n = static_cast<double>(rows);
  return n * 2 * std::log(std::max(rms, 1e-300)) + static_cast<double>(terms) * std::log(n);
}

std::optional<Eigen::Index> NextColumn(const Eigen::MatrixXd& library, const Eigen::VectorXd& left,
                                       const Rows& rows, const std::vector<Eigen::Index>& taken) {
  std::optional<Eigen::Index> best;
  double most = 0;
  for (Eigen::Index c = 0; c < library.cols(); ++c) {
    if (std::find(taken.begin(), taken.end(), c) != taken.end()) continue;
    const double along = std::abs(library.col(c)(rows).dot(left(rows)));
    if (along > most) most = along, best = c;
  }
  return best;
}

/// Residual of the matching pursuit. `terms` counts its columns.
Eigen::VectorXd Pursued(const Channel& channel, const Eigen::VectorXd& error, const Parts& parts,
                        std::size_t* terms) {
  const Eigen::VectorXd residual =
      LessColumns(error, Eigen::MatrixXd::Ones(error.size(), 1), parts.seen);
  const Eigen::MatrixXd library = LibraryOf(channel);
  std::vector<Eigen::Index> taken;
  Eigen::VectorXd left = residual;
  const std::size_t n = parts.seen.size();
  double criterion = Criterion(RmsOver(left, parts.seen), n, 0);
  while (const auto next = NextColumn(library, left, parts.seen, taken)) {
    taken.push_back(*next);
    const Eigen::VectorXd less =
        LessColumns(residual, library(Eigen::all, taken).eval(), parts.seen);
    const double lower = Criterion(RmsOver(less, parts.seen), n, taken.size());
    if (lower >= criterion) break;
    criterion = lower;
    left = less;
    ++*terms;
  }
  return left;
}

/// Adds one candidate at a time, as long as the criterion falls.
class GreedySearch {
 public:
  GreedySearch(const ReplayBlock& block, const std::vector<Parts>& parts, const Mask& seen,
               int threads)
      : block_(block), parts_(parts), seen_(seen), threads_(threads) {}

  Structure Run() const {
    Structure found;
    double criterion = CriterionOf(found);
    while (found.size() < kMostStructureTerms) {
      const Likelihood likelihood(block_, WhiteNoiseOf(found), seen_);
      const StructureFitter fitter(block_, likelihood, {});
      const auto grown = InParallel<Structure>(
          block_.candidates.size(), threads_,
          [&](std::size_t s) { return Grown(found, block_.candidates[s], fitter); });
      std::optional<std::size_t> best;
      for (std::size_t s = 0; s < grown.size(); ++s) {
        if (grown[s].size() == found.size()) continue;  // already in the structure
        const double lower = CriterionOf(grown[s]);
        if (lower < criterion) criterion = lower, best = s;
      }
      if (!best) break;
      found = grown[*best];
    }
    return found;
  }

  std::vector<double> RmseOf(const Structure& terms, const Rows Parts::*rows) const {
    const auto predicted = block_.predict(terms);
    std::vector<double> rmse;
    for (std::size_t c = 0; c < block_.channels.size(); ++c) {
      rmse.push_back(RmsOver(ResidualOf(block_.channels[c], predicted[c]), parts_[c].*rows));
    }
    return rmse;
  }

 private:
  static Structure Grown(Structure terms, const Candidate& candidate,
                         const StructureFitter& fitter) {
    const bool has = std::any_of(terms.begin(), terms.end(),
                                 [&](const Term& term) { return term.candidate == &candidate; });
    if (has) return terms;
    terms.push_back({&candidate, candidate.starts.front()});
    return fitter.FitValues(std::move(terms)).terms;
  }

  std::vector<NoiseModel> WhiteNoiseOf(const Structure& terms) const {
    std::vector<NoiseModel> noise;
    for (const double rmse : RmseOf(terms, &Parts::seen)) {
      noise.push_back({.scale = std::max(rmse, 1e-300), .dof = kNormalDof});
    }
    return noise;
  }

  double CriterionOf(const Structure& terms) const {
    std::size_t parameters = 0;
    for (const Term& term : terms) parameters += 1 + term.candidate->free.size();
    const std::vector<double> rmse = RmseOf(terms, &Parts::seen);
    double sum = 0;
    for (std::size_t c = 0; c < rmse.size(); ++c) {
      sum += Criterion(rmse[c], parts_[c].seen.size(), c == 0 ? parameters : 0);
    }
    return sum;
  }

  const ReplayBlock& block_;
  const std::vector<Parts>& parts_;
  const Mask& seen_;
  int threads_;
};

}  // namespace

std::vector<double> RmseAsItIs(const ReplayBlock& block, const Stream& stream) {
  const Mask final = MaskOf(ManoeuvresOf(block, stream), Part::kFinal, block.samples());
  const auto predicted = block.predict({});
  std::vector<double> rmse;
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    const Channel& channel = block.channels[c];
    rmse.push_back(RmsOver(ResidualOf(channel, predicted[c]), PartsOf(channel, final).final));
  }
  return rmse;
}

std::vector<BaselineAnswer> BaselinesOf(const ReplayBlock& block, int threads,
                                        const Stream& stream) {
  const std::vector<Manoeuvre> manoeuvres = ManoeuvresOf(block, stream);
  const Mask final = MaskOf(manoeuvres, Part::kFinal, block.samples());
  Mask seen = final;
  for (auto& is : seen) is = !is;
  const auto predicted = block.predict({});
  const Likelihood likelihood(block, NoiseOfBlock(block, manoeuvres), seen);
  const Misfit flexible =
      ResidualBeyondFlexible(block, likelihood, likelihood.Evaluate(predicted), manoeuvres);
  BaselineAnswer tuned{.method = "tuned parameters"};
  BaselineAnswer greedy{.method = "greedy BIC", .gives_findings = true, .gives_names = true};
  BaselineAnswer sparse{.method = "sparse regression", .gives_findings = true};
  BaselineAnswer black_box{.method = "black box"}, static_map{.method = "static map"};
  std::vector<Parts> parts;
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    const Channel& channel = block.channels[c];
    parts.push_back(PartsOf(channel, final));
    const Rows& rows = parts[c].final;
    tuned.rmse_final.push_back(RmsOver(Tuned(channel, predicted[c], parts[c]), rows));
    std::size_t terms = 0;
    const Eigen::VectorXd residual = ResidualOf(channel, predicted[c]);
    sparse.rmse_final.push_back(RmsOver(Pursued(channel, residual, parts[c], &terms), rows));
    sparse.found = sparse.found || terms > 0;
    static_map.rmse_final.push_back(RmsOver(
        ResidualOf(channel, FitPlainMap(block.commands.front(), channel.measured, seen).predicted),
        rows));
    black_box.rmse_final.push_back(RmsOver(VectorOf(flexible.residual[c].value), rows));
  }
  const GreedySearch search(block, parts, seen, threads);
  const Structure found = search.Run();
  for (const Term& term : found) {
    greedy.names.push_back({std::string(term.candidate->mechanism->id), term.candidate->target});
  }
  greedy.found = !found.empty();
  greedy.rmse_final = search.RmseOf(found, &Parts::final);
  return {std::move(static_map), std::move(tuned), std::move(greedy), std::move(sparse),
          std::move(black_box)};
}

}  // namespace tera
