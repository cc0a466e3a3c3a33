#include "diagnose/search/structure/prefix_search.h"

#include <algorithm>

#include "core/check.h"
#include "diagnose/search/fit/structure_fit.h"

namespace tera {
namespace {

constexpr double kCommanded_s = 60;  ///< length of the commanded manoeuvres in a prefix
/// Largest ratio of prefix to whole; longer prefixes save too little.
constexpr double kMostPrefixShare = 2.0 / 3;

Series First(const Series& series, std::size_t samples) {
  const auto end = static_cast<std::ptrdiff_t>(samples);
  return {series.period_s,
          {series.value.begin(), series.value.begin() + end},
          {series.valid.begin(), series.valid.begin() + end}};
}

Channel First(const Channel& channel, std::size_t samples) {
  const auto rows = [&](const Eigen::MatrixXd& columns) -> Eigen::MatrixXd {
    return columns.topRows(std::min(columns.rows(), static_cast<Eigen::Index>(samples)));
  };
  std::vector<RegimeVariable> variables;
  for (const RegimeVariable& variable : channel.variables) {
    variables.push_back({variable.name, First(variable.series, samples)});
  }
  return {channel.name,         channel.unit,         First(channel.measured, samples),
          channel.nuisances,    std::move(variables), rows(channel.flexible_regressor),
          rows(channel.nominal)};
}

}  // namespace

std::size_t PrefixLength(const std::vector<Manoeuvre>& manoeuvres, double period_s) {
  TERA_CHECK(!manoeuvres.empty());
  const std::size_t all = manoeuvres.back().samples.end;
  double moved_s = 0;
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (manoeuvre.axes != 0) moved_s += static_cast<double>(manoeuvre.samples.size()) * period_s;
    if (moved_s < kCommanded_s) continue;
    const std::size_t length = manoeuvre.samples.end;
    return static_cast<double>(length) < kMostPrefixShare * static_cast<double>(all) ? length : all;
  }
  return all;
}

ReplayBlock PrefixOf(const ReplayBlock& block, std::size_t samples) {
  ReplayBlock prefix;
  prefix.name = block.name;
  prefix.first_ns = block.first_ns;
  prefix.slides = block.slides;
  prefix.candidates = block.candidates;
  prefix.read_whole = block.read_whole;
  for (const Channel& channel : block.channels) {
    prefix.channels.push_back(First(channel, samples));
  }
  for (const Series& command : block.commands) prefix.commands.push_back(First(command, samples));
  prefix.replay = [&block](const Structure& terms, std::size_t wanted) {
    return block.replay(terms, wanted);
  };
  return prefix;
}

std::vector<Manoeuvre> Within(std::vector<Manoeuvre> manoeuvres, std::size_t samples) {
  std::erase_if(manoeuvres,
                [&](const Manoeuvre& manoeuvre) { return manoeuvre.samples.end > samples; });
  return manoeuvres;
}

SearchResult CarryToWhole(SearchResult search, const ReplayBlock& prefix,
                          const ReplayBlock& whole) {
  const auto move = [&](const Candidate** candidate) {
    *candidate = &whole.candidates[static_cast<std::size_t>(*candidate - prefix.candidates.data())];
  };
  for (Term& term : search.found.terms) {
    move(&term.candidate);
    std::erase_if(term.held, [&](std::size_t held) {
      if (!DefaultOf(*term.candidate, held)) return false;  // another parameter has the same effect
      term.values[held] = term.candidate->starts.front()[held];
      return true;
    });
  }
  for (Term& term : search.fullest) move(&term.candidate);
  for (TermEvidence& evidence : search.evidence) {
    for (const Candidate*& rival : evidence.rivals) move(&rival);
    for (const Candidate*& rival : evidence.expected_rivals) move(&rival);
    for (Rival& rival : evidence.rejected) move(&rival.candidate);
  }
  for (SingleEvidence& single : search.singles) move(&single.candidate);
  return search;
}

}  // namespace tera
