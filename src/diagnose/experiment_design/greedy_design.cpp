#include "diagnose/experiment_design/greedy_design.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/statistics/series/whitening.h"

namespace tera {
namespace {

const char* const kNothing = "nothing";

bool Has(const Structure& terms, const Candidate* candidate) {
  return std::any_of(terms.begin(), terms.end(),
                     [&](const Term& term) { return term.candidate == candidate; });
}

Structure Without(Structure terms, const Candidate* candidate) {
  std::erase_if(terms, [&](const Term& term) { return term.candidate == candidate; });
  return terms;
}

/// The mask of some segments.
Mask Within(const std::vector<Segment>& segments, std::size_t size) {
  Mask mask(size, 0);
  for (const Segment& samples : segments) {
    std::fill(mask.begin() + static_cast<std::ptrdiff_t>(samples.begin),
              mask.begin() + static_cast<std::ptrdiff_t>(samples.end), 1);
  }
  return mask;
}

/// The class of a finding: itself and its rivals, each fitted in its place.
AmbiguitySet ClassOf(const Finding& finding, const Structure& found,
                     const StructureFitter& fitter) {
  AmbiguitySet set;
  set.is_class = true;
  const Structure others = Without(found, finding.term.candidate);
  std::vector<Structure> explanations;
  for (const Candidate* rival : finding.evidence.rivals) {
    set.members.emplace_back(rival->mechanism->id);
    Structure explanation = others;
    explanation.push_back({rival, rival->starts.front()});
    explanations.push_back(rival == finding.term.candidate ? found
                                                           : fitter.FitValues(explanation).terms);
  }
  for (const Structure& truth : explanations) {
    for (const Structure& alternative : explanations) {
      if (&truth != &alternative) set.pairs.push_back({truth, alternative});
    }
    set.pairs.push_back({truth, others});
  }
  return set;
}

}  // namespace

std::vector<AmbiguitySet> AmbiguitySetsOf(const ReplayBlock& block,
                                          const BlockDiagnosis& diagnosis) {
  std::vector<AmbiguitySet> sets;
  const Structure& found = diagnosis.search.found.terms;
  const std::vector<Segment> seen = SeenSegmentsOf(diagnosis.manoeuvres);
  const Likelihood likelihood(block, diagnosis.noise, Within(seen, block.samples()));
  const StructureFitter fitter(block, likelihood, seen);
  for (const Finding& finding : diagnosis.findings) {
    if (finding.evidence.rivals.size() > 1) sets.push_back(ClassOf(finding, found, fitter));
  }
  for (const Detectability& one : diagnosis.detectability) {
    if (one.smallest || Has(found, one.candidate)) continue;
    const auto& starts = one.candidate->starts;
    Structure truth = found;
    truth.push_back({one.candidate, starts[starts.size() / 2]});
    sets.push_back(
        {{std::string(one.candidate->mechanism->id), kNothing}, false, {{truth, found}}});
  }
  return sets;
}

namespace {

/// Draws of the noise; they give the power to about five per cent.
constexpr std::uint64_t kDraws = 100;

/// True if the tests discriminate a pair with these gains, for one draw of the noise.
bool IsDiscriminated(const std::vector<ManoeuvreGain>& seen,
                     const std::vector<ManoeuvreGain>& final, bool is_class, double level) {
  if (!is_class) return GainP(seen) <= level && AreConfirming(final, kConfirmedP);
  double lead = 0;
  for (const ManoeuvreGain& gain : seen) lead += gain.gain;
  return SteadyGainP(seen) <= kRivalP && lead >= kRivalGain;
}

double PowerOf(const RivalPair& pair, bool is_class, ReplayBlock run,
               const std::vector<Manoeuvre>& manoeuvres, const NoiseModel& noise, double level,
               const Stream& stream) {
  const auto truth = run.predict(pair.truth);
  for (std::size_t k = 0; k < run.samples(); ++k) {
    if (run.channels[0].measured.valid[k]) run.channels[0].measured.value[k] = truth[0][k];
  }
  const std::vector<Segment> whole = SeenSegmentsOf(manoeuvres);
  const Likelihood likelihood(run, {noise}, Within(whole, run.samples()));
  const StructureFitter fitter(run, likelihood, whole);
  const Misfit wrong = fitter.FitValues(pair.alternative).misfit;
  Misfit right = wrong;
  right.innovation[0].setZero();
  const auto gains_over = [&](const std::vector<Segment>& segments) {
    return GainsOf(likelihood, wrong, right, PiecesOf(segments, run.period_s()));
  };
  const auto seen = gains_over(whole);
  const auto final = gains_over(SegmentsOf(manoeuvres, Part::kFinal));
  const auto drawn = [&](std::vector<ManoeuvreGain> gains, std::uint64_t first) {
    for (ManoeuvreGain& gain : gains) {
      gain.gain = gain.possible + std::sqrt(2 * gain.possible) * stream.Gaussian(first++);
    }
    return gains;
  };
  std::uint64_t discriminated = 0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const std::uint64_t first = draw << 33;
    const std::uint64_t first_of_final = first + (std::uint64_t{1} << 32);
    discriminated +=
        IsDiscriminated(drawn(seen, first), drawn(final, first_of_final), is_class, level) ? 1 : 0;
  }
  return static_cast<double>(discriminated) / static_cast<double>(kDraws);
}

}  // namespace

double DiscriminationPower(const AmbiguitySet& set, const ReplayBlock& run, const NoiseModel& noise,
                           double level, const Stream& stream) {
  const auto manoeuvres = ManoeuvresOf(run, stream);
  if (!IsTestable(manoeuvres)) return 0;
  double power = 1;
  for (const RivalPair& pair : set.pairs) {
    power = std::min(power, PowerOf(pair, set.is_class, run, manoeuvres, noise, level, stream));
  }
  return power;
}

namespace {

constexpr double kSecantStep = 0.02;  ///< step of the secants, over a parameter's range
/// Prior standard deviation of a parameter about its value, over its range.
constexpr double kPriorSigma = 0.3;

Eigen::VectorXd Predicted(const ReplayBlock& run, const Structure& terms) {
  const std::vector<double> y = run.predict(terms).front();
  return Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
}

/// Changes of the alternative's prediction by one standard deviation of each of its parameters,
/// then of each nuisance.
Eigen::MatrixXd ColumnsOf(const ReplayBlock& run, const Structure& terms,
                          const Eigen::VectorXd& predicted) {
  const Channel& channel = run.channels.front();
  std::vector<Eigen::VectorXd> columns;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    for (const FreeParameter& free : terms[t].candidate->free) {
      Structure moved = terms;
      const double place = PlaceOf(free, terms[t].values[free.index]);
      const double step = place + kSecantStep <= 1 ? kSecantStep : -kSecantStep;
      moved[t].values[free.index] = ValueAt(free, place + step);
      columns.push_back((Predicted(run, moved) - predicted) * (kPriorSigma / step));
    }
  }
  const Eigen::Index rows = predicted.size();
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(rows);
  if (rows > 2) {
    slope.segment(1, rows - 2) =
        (predicted.tail(rows - 2) - predicted.head(rows - 2)) / (2 * channel.measured.period_s);
  }
  columns.push_back(Eigen::VectorXd::Constant(rows, channel.nuisances.offset));
  columns.push_back(channel.nuisances.gain * predicted);
  columns.push_back(-channel.nuisances.delay_s * slope);
  for (Eigen::Index n = 0; n < channel.nominal.cols(); ++n) {
    columns.push_back(channel.nominal.col(n));
  }
  Eigen::MatrixXd out(rows, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    out.col(static_cast<Eigen::Index>(c)) = columns[c];
  }
  return out;
}

}  // namespace

PairInformation& PairInformation::operator+=(const PairInformation& other) {
  if (information.size() == 0) return *this = other;
  information += other.information;
  pull += other.pull;
  energy += other.energy;
  return *this;
}

double PairInformation::Lead() const {
  if (information.size() == 0) return 0;
  Eigen::MatrixXd with_prior = information;
  with_prior.diagonal().array() += 1;
  return std::max(0.0, 0.5 * (energy - pull.dot(with_prior.ldlt().solve(pull))));
}

std::vector<std::vector<PairInformation>> InformationOf(const ReplayBlock& run,
                                                        const NoiseModel& noise,
                                                        const std::vector<RivalPair>& pairs,
                                                        const std::vector<Segment>& excitations) {
  const WhiteningFilter filter(noise, run.channels.front().measured.valid);
  std::vector<std::vector<PairInformation>> information;
  for (const RivalPair& pair : pairs) {
    const Eigen::VectorXd alternative = Predicted(run, pair.alternative);
    const Eigen::VectorXd difference =
        filter.Apply(Predicted(run, pair.truth) - alternative) / noise.scale;
    Eigen::MatrixXd columns = ColumnsOf(run, pair.alternative, alternative);
    for (Eigen::Index c = 0; c < columns.cols(); ++c) {
      columns.col(c) = filter.Apply(columns.col(c)) / noise.scale;
    }
    std::vector<PairInformation> of_pair;
    for (const Segment& excitation : excitations) {
      const auto first = static_cast<Eigen::Index>(excitation.begin);
      const auto size = static_cast<Eigen::Index>(excitation.size());
      const auto rows = columns.middleRows(first, size);
      const auto d = difference.segment(first, size);
      of_pair.push_back({rows.transpose() * rows, rows.transpose() * d, d.squaredNorm()});
    }
    information.push_back(std::move(of_pair));
  }
  return information;
}

std::vector<std::size_t> ChooseExcitations(
    const std::vector<std::vector<PairInformation>>& information, const std::vector<double>& weight,
    const std::vector<double>& length_s, double duration_s) {
  std::vector<std::size_t> chosen;
  std::vector<PairInformation> sum(information.size());
  std::vector<double> score(information.size(), 0.0);
  double left_s = duration_s;
  while (true) {
    std::size_t best = length_s.size();
    double most = 0;
    for (std::size_t p = 0; p < length_s.size(); ++p) {
      if (length_s[p] > left_s) continue;
      double gain = 0;
      for (std::size_t q = 0; q < information.size(); ++q) {
        PairInformation with = sum[q];
        with += information[q][p];
        gain += weight[q] * (std::log1p(with.Lead()) - score[q]);
      }
      gain /= length_s[p];
      if (gain <= most) continue;
      most = gain;
      best = p;
    }
    if (best == length_s.size()) return chosen;
    chosen.push_back(best);
    left_s -= length_s[best];
    for (std::size_t q = 0; q < information.size(); ++q) {
      sum[q] += information[q][best];
      score[q] = std::log1p(sum[q].Lead());
    }
  }
}

}  // namespace tera
