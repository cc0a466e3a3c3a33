#include "blind/marking/mark.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "blind/cases/case_recording.h"

namespace tera::blind {
namespace {

constexpr std::size_t kLargestClass = 3;
constexpr double kConfident = 0.9;
constexpr double kAround_s = 0.5;
constexpr double kGrid_s = 0.05;

bool Contains(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

/// Whether a finding is of a channel that shows it, or of one within that, as an axis of a unit is.
bool IsOf(const Concealed& hidden, const Finding& finding) {
  return std::any_of(hidden.channels.begin(), hidden.channels.end(), [&](const std::string& part) {
    const std::string channel = fmt::format("{}/{}", kName, part);
    return finding.channel == channel || finding.channel.starts_with(channel + "/");
  });
}

bool HoldsNameOf(const Concealed& hidden, const Finding& finding) {
  if (hidden.name.empty() || finding.target != hidden.target) return false;
  return Contains(finding.names, hidden.name) ||
         std::any_of(hidden.alike.begin(), hidden.alike.end(),
                     [&](const std::string& name) { return Contains(finding.names, name); });
}

bool Names(const Finding& finding, const Concealed& hidden) {
  return !finding.unexplained() && finding.names.size() <= kLargestClass &&
         HoldsNameOf(hidden, finding);
}

/// Names something that comes with the form, or a real drive: neither what was asked for nor wrong.
bool NamesWhatIsBesides(const BenchmarkCase& c, const Finding& finding) {
  if (c.injected && IsOfRealDrive(finding.target, finding.mechanism)) return true;
  return std::any_of(c.hidden.begin(), c.hidden.end(), [&](const Concealed& hidden) {
    return finding.target == hidden.target &&
           std::any_of(hidden.besides.begin(), hidden.besides.end(),
                       [&](const std::string& name) { return Contains(finding.names, name); });
  });
}

bool IsConfidentlyWrong(const BenchmarkCase& c, const Finding& finding) {
  if (finding.unexplained() || finding.confidence < kConfident) return false;
  if (NamesWhatIsBesides(c, finding)) return false;
  return std::none_of(c.hidden.begin(), c.hidden.end(),
                      [&](const Concealed& hidden) { return HoldsNameOf(hidden, finding); });
}

/// The finding that names it, if any: by its own name rather than by one alike.
const Finding* NamingOf(const Concealed& hidden, const Answer& answer) {
  const Finding* alike = nullptr;
  for (const Finding& finding : answer.findings) {
    if (!Names(finding, hidden)) continue;
    if (finding.mechanism == hidden.name) return &finding;
    if (alike == nullptr) alike = &finding;
  }
  return alike;
}

/// Where one finding stands for two that look the same, its number is that of both together: not
/// asked.
void MarkParameters(const BenchmarkCase& c, const Concealed& hidden, const Answer& answer,
                    Mark* mark) {
  const Finding& finding = *NamingOf(hidden, answer);
  if (finding.mechanism != hidden.name) return;  // others have other parameters
  const auto stands_for = std::count_if(c.hidden.begin(), c.hidden.end(), [&](const Concealed& h) {
    return NamingOf(h, answer) == &finding;
  });
  if (stands_for > 1) return;
  for (const auto& [name, truth] : hidden.truth) {
    const auto found = finding.parameters.find(name);
    if (found == finding.parameters.end()) continue;
    mark->parameters.push_back(
        {hidden.name, name, truth, found->second.value, found->second.sigma});
  }
}

/// On an even grid, where what is hidden shows.
std::vector<bool> WhereItShows(const Change& change, double duration_s) {
  std::vector<bool> shows(static_cast<std::size_t>(duration_s / kGrid_s) + 1, false);
  for (std::size_t k = 0; k < change.t_s.size(); ++k) {
    if (std::abs(change.over_noise[k]) < 1) continue;
    const auto from = static_cast<std::size_t>(std::max(0.0, change.t_s[k] - kAround_s) / kGrid_s);
    const auto to = static_cast<std::size_t>((change.t_s[k] + kAround_s) / kGrid_s);
    for (std::size_t i = from; i <= std::min(to, shows.size() - 1); ++i) shows[i] = true;
  }
  return shows;
}

double Overlap(const std::vector<bool>& shows,
               const std::vector<std::pair<double, double>>& intervals_s) {
  double both = 0, either = 0;
  for (std::size_t i = 0; i < shows.size(); ++i) {
    const double t_s = static_cast<double>(i) * kGrid_s;
    const bool said = std::any_of(
        intervals_s.begin(), intervals_s.end(),
        [&](const auto& interval) { return t_s >= interval.first && t_s <= interval.second; });
    both += shows[i] && said ? 1 : 0;
    either += shows[i] || said ? 1 : 0;
  }
  return either > 0 ? both / either : 0;
}

/// Marks the location of the first finding against the effect that it names, or without one against
/// all hidden effects in its channel. A real drive has faults of its own, which may be located too.
void MarkPlace(const BenchmarkCase& c, const CaseRecording& recording, const Answer& answer,
               Mark* mark) {
  if (answer.findings.empty() || c.hidden.empty() || c.injected) return;
  const Finding& first = answer.findings.front();
  mark->located = true;
  const bool is_named = std::any_of(c.hidden.begin(), c.hidden.end(),
                                    [&](const Concealed& hidden) { return Names(first, hidden); });
  std::vector<bool> shows;
  for (std::size_t i = 0; i < c.hidden.size(); ++i) {
    const Concealed& hidden = c.hidden[i];
    if (!IsOf(hidden, first)) continue;
    mark->right_channel = true;
    if (is_named && !Names(first, hidden)) continue;
    mark->has_variable = mark->has_variable || !hidden.variables.empty();
    mark->right_variable = mark->right_variable || Contains(hidden.variables, first.variable);
    const std::vector<bool> own = WhereItShows(recording.changes[i], c.duration_s);
    shows.resize(own.size(), false);
    for (std::size_t k = 0; k < own.size(); ++k) shows[k] = shows[k] || own[k];
  }
  mark->overlap = Overlap(shows, first.intervals_s);
}

void MarkOutside(const BenchmarkCase& c, const Answer& answer, Mark* mark) {
  const Concealed& hidden = c.hidden.front();
  for (const Finding& finding : answer.findings) {
    if (!IsOf(hidden, finding)) continue;
    mark->flagged = mark->flagged || finding.unexplained();
    mark->misnamed = mark->misnamed || !finding.unexplained();
    mark->right_variable_flagged =
        mark->right_variable_flagged ||
        (finding.unexplained() && Contains(hidden.variables, finding.variable));
  }
}

std::string Described(const Finding& finding) {
  return fmt::format("{} {}{}", finding.unexplained() ? finding.channel : finding.target,
                     fmt::join(finding.names, " or "),
                     finding.variable.empty() ? "" : " by " + finding.variable);
}

}  // namespace

double ParameterMark::RelativeError() const {
  return std::abs(value - truth) / std::max(std::abs(truth), 1e-9);
}

bool ParameterMark::Covered() const { return std::abs(value - truth) <= 1.645 * sigma; }

Mark MarkAnswer(const BenchmarkCase& c, const CaseRecording& recording, const Answer& answer) {
  Mark mark;
  mark.number = c.number;
  mark.kind = c.kind;
  mark.strength = c.strength;
  mark.recorded_s = c.duration_s;
  mark.found_something = !answer.findings.empty();
  for (const Finding& finding : answer.findings) {
    mark.answered.push_back(Described(finding));
    mark.confident_wrong = mark.confident_wrong || IsConfidentlyWrong(c, finding);
    const bool is_right = std::any_of(c.hidden.begin(), c.hidden.end(),
                                      [&](const Concealed& h) { return Names(finding, h); });
    mark.spurious =
        mark.spurious || (!finding.unexplained() && !is_right && !NamesWhatIsBesides(c, finding));
  }
  for (const Change& change : recording.changes) {
    mark.signal_to_noise = std::max(mark.signal_to_noise, change.Rms());
    mark.shows_s = std::min(mark.shows_s, change.Shows_s());
  }
  for (const Concealed& hidden : c.hidden) {
    mark.hidden.push_back(
        fmt::format("{} {}", hidden.target, hidden.name.empty() ? hidden.form : hidden.name));
    if (NamingOf(hidden, answer) != nullptr) {
      ++mark.named;
      mark.right_first = mark.right_first || Names(answer.findings.front(), hidden);
      MarkParameters(c, hidden, answer, &mark);
    }
    for (const auto& [name, target] : answer.untestable) {
      mark.listed_untestable =
          mark.listed_untestable || (name == hidden.name && target == hidden.target);
    }
  }
  if (c.kind == CaseKind::kOutside) MarkOutside(c, answer, &mark);
  MarkPlace(c, recording, answer, &mark);
  return mark;
}

}  // namespace tera::blind
