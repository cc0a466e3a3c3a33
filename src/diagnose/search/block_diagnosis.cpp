#include "diagnose/search/block_diagnosis.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "diagnose/search/free_member.h"
#include "diagnose/statistics/signed_rank.h"

namespace tera {
namespace {

constexpr double kSeen = 15;  ///< gain in log-likelihood on TRAIN that survives all that follows
constexpr double kLeastUnexplained = 0.05;
constexpr std::size_t kLongestResponse = 2000;
constexpr double kUnconfirmedP = 0.05;
constexpr double kUndetermined = 1e-10;  ///< of the largest eigenvalue of the information

class Procedure {
 public:
  Procedure(const ReplayBlock& block, const SearchOptions& options, const Stream& stream)
      : block_(block),
        options_(options),
        stream_(stream),
        manoeuvres_(SplitByManoeuvre(block.commands, {}, stream)),
        likelihood_(block, NoiseOfBlock(block)),
        train_(MaskOf(manoeuvres_, Part::kTrain, block.samples())),
        final_(MaskOf(manoeuvres_, Part::kFinal, block.samples())),
        fitter_(block, likelihood_, train_) {}

  BlockDiagnosis Run();

 private:
  Finding Describe(const SearchResult& search, std::size_t term) const;
  void Confirm(BlockDiagnosis* out) const;
  void FindUnexplained(const SearchResult& search, BlockDiagnosis* out) const;
  Detectability DetectabilityOf(const Suspect& suspect) const;
  HeldOutError Compare(const FittedStructure& before, const FittedStructure& after,
                       std::size_t channel) const;
  std::size_t MostImproved(const FittedStructure& before, const FittedStructure& after) const;
  Eigen::VectorXd LeftByFreeMember(const Misfit& misfit, std::size_t channel) const;

  const ReplayBlock& block_;
  const SearchOptions& options_;
  const Stream& stream_;
  std::vector<Manoeuvre> manoeuvres_;
  Likelihood likelihood_;
  Mask train_, final_;
  StructureFitter fitter_;
};

double MeanSquare(const Series& residual, const Mask& mask) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < residual.size(); ++k) {
    if (!mask[k] || !residual.valid[k]) continue;
    sum += residual.value[k] * residual.value[k];
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// Of the process, by its response to single innovations; those of a t distribution.
double VarianceOf(const NoiseModel& noise) {
  std::vector<double> response = {1};
  double sum = 1;
  for (std::size_t k = 1; k < kLongestResponse; ++k) {
    double next = 0;
    for (std::size_t i = 0; i < std::min(noise.order(), k); ++i) {
      next += noise.ar[i] * response[k - 1 - i];
    }
    response.push_back(next);
    sum += next * next;
  }
  return sum * noise.scale * noise.scale * noise.dof / (noise.dof - 2);
}

/// Standard deviations from an information matrix; none for what lies in its null space.
std::vector<std::optional<double>> SigmasOf(const Eigen::MatrixXd& information) {
  const Eigen::Index size = information.rows();
  std::vector<std::optional<double>> sigma(static_cast<std::size_t>(size));
  if (size == 0) return sigma;
  const Eigen::VectorXd unit = information.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Eigen::MatrixXd scaled =
      unit.cwiseInverse().asDiagonal() * information * unit.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  const double least = kUndetermined * solver.eigenvalues().maxCoeff();
  for (Eigen::Index i = 0; i < size; ++i) {
    double variance = 0;
    bool determined = information(i, i) > 0;
    for (Eigen::Index e = 0; e < size; ++e) {
      const double part = std::pow(solver.eigenvectors()(i, e), 2);
      if (solver.eigenvalues()[e] > least) {
        variance += part / solver.eigenvalues()[e];
      } else if (part > 1e-6) {
        determined = false;
      }
    }
    if (determined) sigma[static_cast<std::size_t>(i)] = std::sqrt(variance) / unit[i];
  }
  return sigma;
}

/// The numbers of one term; no standard deviation where it is wider than the parameter's range.
std::vector<ParameterEstimate> EstimatesOf(const FittedStructure& found, std::size_t wanted) {
  const std::vector<std::optional<double>> sigmas = SigmasOf(found.information);
  std::size_t first = 0;
  for (std::size_t t = 0; t < wanted; ++t) first += found.terms[t].suspect->free.size();
  const Term& term = found.terms[wanted];
  std::vector<ParameterEstimate> estimates;
  const auto& parameters = term.suspect->mechanism->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    estimates.push_back(
        {std::string(parameters[i].name), std::string(parameters[i].unit), term.values[i], {}});
  }
  for (std::size_t f = 0; f < term.suspect->free.size(); ++f) {
    const FreeParameter& free = term.suspect->free[f];
    if (sigmas[first + f].value_or(1e300) > free.upper - free.lower) continue;
    estimates[free.index].sigma = sigmas[first + f];
  }
  return estimates;
}

Eigen::VectorXd Procedure::LeftByFreeMember(const Misfit& misfit, std::size_t channel) const {
  const NoiseModel& noise = likelihood_.noise()[channel];
  const Series left =
      LessFreeMember(block_.channels[channel], misfit.residual[channel], noise, train_);
  const Eigen::Map<const Eigen::VectorXd> value(left.value.data(),
                                                static_cast<Eigen::Index>(left.size()));
  return WhiteningFilter(noise, left.valid).Apply(value) / noise.scale;
}

HeldOutError Procedure::Compare(const FittedStructure& before, const FittedStructure& after,
                                std::size_t channel) const {
  HeldOutError error{channel, 0, 0, 0, 1};
  const double mse_before = MeanSquare(before.misfit.residual[channel], final_);
  const double mse_after = MeanSquare(after.misfit.residual[channel], final_);
  const double noise = VarianceOf(likelihood_.noise()[channel]);
  error.rmse_before = std::sqrt(mse_before);
  error.rmse_after = std::sqrt(mse_after);
  if (mse_before > noise) {
    error.excess_removed = std::clamp((mse_before - mse_after) / (mse_before - noise), -1.0, 1.0);
  }
  error.p = SteadyGainP(
      likelihood_, before.misfit, after.misfit,
      HeldOutBlocks(manoeuvres_, Part::kFinal, block_.period_s(), options_.held_out_block_s));
  return error;
}

std::size_t Procedure::MostImproved(const FittedStructure& before,
                                    const FittedStructure& after) const {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t c = 0; c < block_.channels.size(); ++c) {
    const double gain =
        before.misfit.innovation[c].squaredNorm() - after.misfit.innovation[c].squaredNorm();
    if (gain <= most) continue;
    most = gain;
    best = c;
  }
  return best;
}

Finding Procedure::Describe(const SearchResult& search, std::size_t term) const {
  const FittedStructure& found = search.found;
  Structure others = found.terms;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(term));
  const FittedStructure without = fitter_.Fit(others);
  Finding finding;
  finding.term = found.terms[term];
  finding.parameters = EstimatesOf(found, term);
  finding.evidence = search.evidence[term];
  const std::size_t channel = MostImproved(without, found);
  finding.location = Locate(block_.channels[channel], channel, without.misfit.residual[channel],
                            likelihood_.noise()[channel], stream_);
  finding.held_out = Compare(without, found, channel);
  const auto alike = static_cast<double>(finding.evidence.rivals.size());
  finding.confidence = (1 - finding.evidence.p) * (1 - finding.held_out.p) / alike;
  return finding;
}

/// The free member over what was found: does it still gain, and of what is that a function?
void Procedure::FindUnexplained(const SearchResult& search, BlockDiagnosis* out) const {
  const Misfit& misfit = search.found.misfit;
  const auto blocks =
      HeldOutBlocks(manoeuvres_, Part::kSelect, block_.period_s(), options_.held_out_block_s);
  for (std::size_t c = 0; c < block_.channels.size(); ++c) {
    const Eigen::VectorXd left = LeftByFreeMember(misfit, c);
    const double dof = likelihood_.noise()[c].dof;
    std::vector<double> gain;
    double total = 0;
    for (const Segment& block : blocks) {
      gain.push_back(0);
      for (std::size_t k = block.begin; k < block.end; ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        if (!likelihood_.rows(c)[k]) continue;
        gain.back() += LogDensityOf(left[row], dof) - LogDensityOf(misfit.innovation[c][row], dof);
      }
      total += gain.back();
    }
    const double p = TestSignedRank(gain).p_greater;
    const double share = total / std::max({search.free_gain, total, 1e-9});
    if (p > options_.alpha || share < kLeastUnexplained) continue;
    out->unexplained.push_back(
        {Locate(block_.channels[c], c, misfit.residual[c], likelihood_.noise()[c], stream_), p,
         share});
  }
}

Detectability Procedure::DetectabilityOf(const Suspect& suspect) const {
  const auto nothing = block_.predict({});
  Detectability out{&suspect, {}};
  for (const std::vector<double>& start : suspect.starts) {
    const auto truth = block_.predict({{&suspect, start}});
    if (likelihood_.Discernible(nothing, truth, train_) < kSeen) continue;
    out.smallest = start[suspect.free.empty() ? 0 : suspect.free.front().index];
    break;
  }
  return out;
}

/// Parts what FINAL confirms from what it does not; what is confirmed is fitted anew on its own.
void Procedure::Confirm(BlockDiagnosis* out) const {
  Structure kept;
  std::vector<TermEvidence> evidence;
  for (std::size_t t = 0; t < out->search.found.terms.size(); ++t) {
    Finding finding = Describe(out->search, t);
    if (finding.held_out.p <= kUnconfirmedP && finding.held_out.excess_removed > 0) {
      kept.push_back(finding.term);
      evidence.push_back(finding.evidence);
      out->findings.push_back(std::move(finding));
    } else {
      out->unconfirmed.push_back(std::move(finding));
    }
  }
  if (out->unconfirmed.empty()) return;
  out->search.found = fitter_.Fit(kept);
  out->search.evidence = std::move(evidence);
  out->findings.clear();
  for (std::size_t t = 0; t < out->search.found.terms.size(); ++t) {
    out->findings.push_back(Describe(out->search, t));
  }
}

BlockDiagnosis Procedure::Run() {
  BlockDiagnosis out;
  out.manoeuvres = manoeuvres_;
  out.noise = likelihood_.noise();
  out.search = SearchStructures(block_, likelihood_, manoeuvres_, options_);
  Confirm(&out);
  FindUnexplained(out.search, &out);
  for (const Suspect& suspect : block_.suspects) {
    out.detectability.push_back(DetectabilityOf(suspect));
  }
  for (std::size_t c = 0; c < block_.channels.size(); ++c) {
    out.confirmed.push_back(Compare(out.search.nothing, out.search.found, c));
  }
  return out;
}

}  // namespace

BlockDiagnosis DiagnoseBlock(const ReplayBlock& block, const SearchOptions& options,
                             const Stream& stream) {
  return Procedure(block, options, stream).Run();
}

}  // namespace tera
