#include "diagnose/sensors/judge_groups.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "diagnose/motion/bounded_quadratic.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr double kInterval = 0.95;   ///< probability of an interval that must lie beyond tolerance
constexpr double kRangeEnd = 0.99;   ///< a value beyond this share of its range is at the end
constexpr double kRivalShare = 0.5;  ///< a rival reaches at least this share of a gain
/// Log odds of the posterior, about 20 : 1, beyond which a group is no rival.
constexpr double kRivalOdds = 3;
constexpr int kMostTried = 8;      ///< groups that are cross-fitted in each step
constexpr double kCancels = 0.98;  ///< correlation above which effects cancel
/// Deviation from the documented value from which a group is listed.
constexpr double kWithinSigmas = 3;
constexpr std::size_t kFewestJudgedSegments = 3;
constexpr std::size_t kMostParts = 12;  ///< number of parts for the tests

using Set = std::vector<int>;

Set With(Set set, int group) {
  set.push_back(group);
  return set;
}

Set Without(Set set, int group) {
  std::erase(set, group);
  return set;
}

bool Has(const Set& set, int group) {
  return std::find(set.begin(), set.end(), group) != set.end();
}

/// Sums of consecutive segments, in at most kMostParts parts. Errors that outlast a segment, such
/// as slow errors of receivers, would otherwise make segments confirm each other.
std::vector<ParameterQuadratic> PartsOf(const std::vector<ParameterQuadratic>& segments) {
  const std::size_t count = std::min(segments.size(), kMostParts);
  std::vector<ParameterQuadratic> parts;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const std::size_t part = s * count / segments.size();
    if (part == parts.size()) {
      parts.push_back(segments[s]);
    } else {
      parts.back().information += segments[s].information;
      parts.back().score += segments[s].score;
    }
  }
  return parts;
}

class Judge {
 public:
  Judge(const ParameterTable& table, const std::vector<ParameterQuadratic>& segments,
        const JudgeOptions& options)
      : table_(table), segments_(PartsOf(segments)), options_(options) {
    const auto count = static_cast<Eigen::Index>(table.parameters.size());
    sum_ = {Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count)};
    for (const ParameterQuadratic& q : segments) {
      sum_.information += q.information;
      sum_.score += q.score;
    }
  }

  GroupJudgement Run();

 private:
  int groups() const { return static_cast<int>(table_.groups.size()); }
  const ParameterGroup& group(int g) const { return table_.groups[static_cast<std::size_t>(g)]; }

  /// The best parameters with a set of groups free, without segment `without` if it is not -1.
  Eigen::VectorXd Fit(const Set& free, int without = -1) const {
    const ParameterPrior prior = table_.PriorWith(free);
    ParameterQuadratic q = QuadraticOf(prior);
    q.information += sum_.information;
    q.score += sum_.score;
    if (without >= 0) {
      q.information -= segments_[static_cast<std::size_t>(without)].information;
      q.score -= segments_[static_cast<std::size_t>(without)].score;
    }
    return SmallestWithin(q.information, q.score, prior.lower, prior.upper);
  }
  Eigen::VectorXd FlexibleFit() const {
    const ParameterPrior prior = table_.FlexiblePrior();
    const ParameterQuadratic q = QuadraticOf(prior);
    return SmallestWithin(q.information + sum_.information, q.score + sum_.score, prior.lower,
                          prior.upper);
  }
  std::vector<Eigen::VectorXd> CrossFits(const Set& free) const {
    std::vector<Eigen::VectorXd> fits;
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      fits.push_back(Fit(free, static_cast<int>(s)));
    }
    return fits;
  }
  /// Gains of the fits `after` over the fits `before` on the segment that each left out.
  std::vector<ManoeuvreGain> Gains(const std::vector<Eigen::VectorXd>& before,
                                   const std::vector<Eigen::VectorXd>& after) const {
    std::vector<ManoeuvreGain> gains;
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      const Eigen::VectorXd apart = after[s] - before[s];
      gains.push_back({segments_[s].At(before[s]) - segments_[s].At(after[s]),
                       0.5 * apart.dot(segments_[s].information * apart)});
    }
    return gains;
  }
  static double Total(const std::vector<ManoeuvreGain>& gains) {
    double total = 0;
    for (const ManoeuvreGain& one : gains) total += one.gain;
    return total;
  }
  double FitOf(const Eigen::VectorXd& parameters) const { return -sum_.At(parameters); }
  /// Logarithm of the largest posterior density with the groups of a set free. The prior covers
  /// only parameters that are not free.
  double LogPosterior(const Set& free) const {
    const Eigen::VectorXd best = Fit(free);
    const ParameterPrior prior = table_.PriorWith(free);
    Eigen::ArrayXd stretch = (best - prior.documented).array() / prior.sigma.array();
    for (const int g : free) stretch.segment(group(g).first, group(g).count).setZero();
    return FitOf(best) - 0.5 * stretch.square().sum();
  }

  std::vector<JudgedParameter> Posterior(const Set& free, int g,
                                         const std::vector<Eigen::VectorXd>& left_out) const;
  bool IsAdmissible(const NamedGroup& tried) const;
  std::vector<int> MostPromising(const Set& named, const Set& candidates, int most) const;
  bool Grow(Set* set) const;
  void DropInadmissible(Set* set, GroupJudgement* judgement) const;
  std::vector<int> RivalsOf(const Set& set, int g) const;
  void SetAsideCancelling(Set* set, GroupJudgement* judgement) const;
  void ListOthers(const Set& named, GroupJudgement* judgement) const;

  const ParameterTable& table_;
  const std::vector<ParameterQuadratic> segments_;
  const JudgeOptions& options_;
  ParameterQuadratic sum_;
};

/// Estimates of group `g`, with standard deviations from the posterior and from the jackknife over
/// `left_out`.
std::vector<JudgedParameter> Judge::Posterior(const Set& free, int g,
                                              const std::vector<Eigen::VectorXd>& left_out) const {
  const Eigen::VectorXd best = Fit(free);
  const Eigen::MatrixXd precision = QuadraticOf(table_.PriorWith(free)).information;
  const auto factor = Eigen::MatrixXd(sum_.information + precision).llt();
  const int first = group(g).first, count = group(g).count;
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(best.size(), count);
  for (int i = 0; i < count; ++i) unit(first + i, i) = 1;
  const Eigen::MatrixXd columns = factor.solve(unit);
  const auto parts = static_cast<double>(left_out.size());
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(count), scatter = mean;
  for (const Eigen::VectorXd& fit : left_out) mean += fit.segment(first, count) / parts;
  for (const Eigen::VectorXd& fit : left_out) {
    scatter += (parts - 1) / parts * (fit.segment(first, count) - mean).cwiseAbs2();
  }
  const double most_sigmas =
      parts < 2 ? std::numeric_limits<double>::infinity()
                : boost::math::quantile(boost::math::students_t(parts - 1), (1 + kInterval) / 2);
  std::vector<JudgedParameter> judged;
  for (int i = 0; i < count; ++i) {
    const SensorParameter& one = table_.parameters[static_cast<std::size_t>(first + i)];
    JudgedParameter parameter{best[first + i],
                              std::sqrt(std::max(columns(first + i, i), scatter[i]))};
    const double off = std::abs(parameter.value - one.documented);
    parameter.is_beyond = off - most_sigmas * parameter.sigma > one.tolerance;
    judged.push_back(parameter);
  }
  return judged;
}

bool Judge::IsAdmissible(const NamedGroup& tried) const {
  if (tried.gain <= 0 || tried.p > options_.alpha / groups()) return false;
  bool is_beyond = false;
  for (std::size_t i = 0; i < tried.parameters.size(); ++i) {
    const SensorParameter& one =
        table_.parameters[static_cast<std::size_t>(group(tried.group).first) + i];
    const double off = tried.parameters[i].value - one.documented;
    const bool is_at_end = off > 0 ? off > kRangeEnd * (one.upper - one.documented)
                                   : -off > kRangeEnd * (one.documented - one.lower);
    if (is_at_end) return false;
    is_beyond = is_beyond || tried.parameters[i].is_beyond;
  }
  return is_beyond;
}

/// The candidates with the largest gains on all segments, best first.
std::vector<int> Judge::MostPromising(const Set& named, const Set& candidates, int most) const {
  const double before = FitOf(Fit(named));
  std::vector<std::pair<double, int>> gains;
  for (const int g : candidates) {
    gains.emplace_back(FitOf(Fit(With(named, g))) - before, g);
  }
  std::stable_sort(gains.begin(), gains.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<int> promising;
  for (const auto& [gain, g] : gains) {
    if (static_cast<int>(promising.size()) < most && gain > 1) promising.push_back(g);
  }
  return promising;
}

/// Adds the admissible group with the largest posterior. False if there is none.
bool Judge::Grow(Set* set) const {
  Set candidates;
  for (int g = 0; g < groups(); ++g) {
    if (group(g).may_be_named && !Has(*set, g)) candidates.push_back(g);
  }
  const auto before = CrossFits(*set);
  std::optional<int> best;
  double best_posterior = 0;
  for (const int g : MostPromising(*set, candidates, kMostTried)) {
    const auto after = CrossFits(With(*set, g));
    const auto gains = Gains(before, after);
    const NamedGroup tried{
        g, Posterior(With(*set, g), g, after), Total(gains), SteadyEffectP(gains), {}};
    const double posterior = LogPosterior(With(*set, g));
    if (!IsAdmissible(tried) || (best && posterior <= best_posterior)) continue;
    best = g;
    best_posterior = posterior;
  }
  if (!best) return false;
  set->push_back(*best);
  return true;
}

/// Judges each member against all others. Inadmissible members leave, one at a time.
void Judge::DropInadmissible(Set* set, GroupJudgement* judgement) const {
  for (bool dropped = true; dropped;) {
    dropped = false;
    judgement->named.clear();
    const auto after = CrossFits(*set);
    for (const int g : *set) {
      const auto gains = Gains(CrossFits(Without(*set, g)), after);
      judgement->named.push_back(
          {g, Posterior(*set, g, after), Total(gains), SteadyEffectP(gains), {}});
    }
    for (const NamedGroup& one : judgement->named) {
      if (IsAdmissible(one)) continue;
      set->erase(std::find(set->begin(), set->end(), one.group));
      dropped = true;
      break;
    }
  }
}

std::vector<int> Judge::RivalsOf(const Set& set, int g) const {
  const Set others = Without(set, g);
  const auto base = CrossFits(others), best = CrossFits(set);
  const double gain = Total(Gains(base, best)), posterior = LogPosterior(set);
  Set candidates;
  for (int h = 0; h < groups(); ++h) {
    if (group(h).may_be_named && !Has(set, h)) candidates.push_back(h);
  }
  std::vector<int> rivals;
  for (const int h : MostPromising(others, candidates, kMostTried)) {
    const auto rival = CrossFits(With(others, h));
    if (Total(Gains(base, rival)) < kRivalShare * gain) continue;
    const bool is_likely = LogPosterior(With(others, h)) > posterior - kRivalOdds;
    if (is_likely || SteadyGainP(Gains(rival, best)) > options_.alpha) rivals.push_back(h);
  }
  return rivals;
}

/// Sets aside pairs of named groups that prove neither cause: their effects nearly cancel, and the
/// sum of both is within tolerance.
void Judge::SetAsideCancelling(Set* set, GroupJudgement* judgement) const {
  const Eigen::VectorXd best = Fit(*set);
  const Eigen::MatrixXd precision = QuadraticOf(table_.PriorWith(*set)).information;
  const Eigen::MatrixXd covariance =
      Eigen::MatrixXd(sum_.information + precision)
          .llt()
          .solve(Eigen::MatrixXd::Identity(best.size(), best.size()));
  for (std::size_t a = 0; a < set->size(); ++a) {
    for (std::size_t b = a + 1; b < set->size(); ++b) {
      const ParameterGroup &first = group((*set)[a]), &second = group((*set)[b]);
      if (first.count != second.count) continue;
      bool cancels = true;
      for (int i = 0; i < first.count; ++i) {
        const int j = first.first + i, k = second.first + i;
        const double correlation =
            covariance(j, k) / std::sqrt(covariance(j, j) * covariance(k, k));
        const SensorParameter &one = table_.parameters[static_cast<std::size_t>(j)],
                              &other = table_.parameters[static_cast<std::size_t>(k)];
        const double sign = correlation > 0 ? -1 : 1;
        const double together = best[j] - one.documented + sign * (best[k] - other.documented);
        cancels = cancels && std::abs(correlation) > kCancels &&
                  std::abs(together) < one.tolerance + other.tolerance;
      }
      if (!cancels) continue;
      judgement->not_told_apart.push_back({(*set)[a], (*set)[b]});
    }
  }
  for (const auto& pair : judgement->not_told_apart) {
    for (const int g : pair) {
      std::erase(*set, g);
      std::erase_if(judgement->named, [&](const NamedGroup& one) { return one.group == g; });
    }
  }
}

/// Fills the lists of groups that are not named.
void Judge::ListOthers(const Set& named, GroupJudgement* judgement) const {
  const auto before = CrossFits(named);
  for (int g = 0; g < groups(); ++g) {
    if (!group(g).mechanism) {
      judgement->by_group.emplace_back();
      continue;
    }
    const Set free = Has(named, g) ? named : With(named, g);
    const auto after = Has(named, g) ? before : CrossFits(free);
    judgement->by_group.push_back(Posterior(free, g, after));
    if (Has(named, g)) continue;
    const std::vector<JudgedParameter>& all = judgement->by_group.back();
    bool is_testable = false, is_off = false, is_beyond = false;
    for (int i = 0; i < group(g).count; ++i) {
      const SensorParameter& one = table_.parameters[static_cast<std::size_t>(group(g).first + i)];
      const JudgedParameter& judged = all[static_cast<std::size_t>(i)];
      const double off = std::abs(judged.value - one.documented);
      is_testable = is_testable || judged.sigma < one.tolerance;
      is_off = is_off || off > kWithinSigmas * judged.sigma;
      is_beyond = is_beyond || judged.is_beyond;
    }
    const auto is_set_aside = [&](const std::vector<int>& pair) { return Has(pair, g); };
    const auto& cancelling = judgement->not_told_apart;
    if (!is_testable) judgement->untestable.push_back(g);
    if (is_testable && is_off && !is_beyond) judgement->within.push_back(g);
    if (!is_testable || !is_beyond || !group(g).may_be_named ||
        std::any_of(cancelling.begin(), cancelling.end(), is_set_aside)) {
      continue;
    }
    const auto gains = Gains(before, after);
    const NamedGroup one{g, all, Total(gains), SteadyEffectP(gains), {}};
    if (one.gain > 0) judgement->unproven.push_back(one);
  }
}

GroupJudgement Judge::Run() {
  GroupJudgement judgement;
  Set set;
  if (segments_.size() >= kFewestJudgedSegments) {
    while (static_cast<int>(set.size()) < options_.most_named && Grow(&set)) {
    }
  }
  DropInadmissible(&set, &judgement);
  SetAsideCancelling(&set, &judgement);
  for (NamedGroup& one : judgement.named) one.rivals = RivalsOf(set, one.group);
  ListOthers(set, &judgement);
  judgement.parameters = Fit(set);
  judgement.left_to_gain = FitOf(FlexibleFit()) - FitOf(judgement.parameters);
  return judgement;
}

}  // namespace

GroupJudgement JudgeGroups(const ParameterTable& table,
                           const std::vector<ParameterQuadratic>& segments,
                           const JudgeOptions& options) {
  return Judge(table, segments, options).Run();
}

}  // namespace tera
