#include "blind/marking/improvement.h"

#include <algorithm>

#include "blind/cases/case_recording.h"

namespace tera::blind {
namespace {

constexpr double kWorthwhile = 2;  ///< mean square of the error over that of the noise

/// The channel of what is hidden in which there is most to gain.
std::optional<std::string> WorstChannel(const BenchmarkCase& c, const CaseRecording& recording,
                                        const ErrorByChannel& as_it_is) {
  std::optional<std::string> worst;
  double most = kWorthwhile;
  for (const Concealed& hidden : c.hidden) {
    for (const std::string& part : hidden.channels) {
      const std::string channel = std::string(kName) + "/" + part;
      const auto noise = recording.noise_rms.find(channel);
      const auto error = as_it_is.find(channel);
      if (noise == recording.noise_rms.end() || error == as_it_is.end()) continue;
      const double ratio = error->second / noise->second;
      if (ratio * ratio < most) continue;
      most = ratio * ratio;
      worst = channel;
    }
  }
  return worst;
}

bool IsHidden(const BenchmarkCase& c, const std::string& name, const std::string& target) {
  return std::any_of(c.hidden.begin(), c.hidden.end(), [&](const Concealed& hidden) {
    const auto& alike = hidden.alike;
    return hidden.target == target &&
           (hidden.name == name || std::find(alike.begin(), alike.end(), name) != alike.end());
  });
}

}  // namespace

std::optional<double> ShareOfOracle(const BenchmarkCase& c, const CaseRecording& recording,
                                    const ErrorByChannel& as_it_is, const ErrorByChannel& after) {
  const auto channel = WorstChannel(c, recording, as_it_is);
  if (!channel || !after.contains(*channel)) return std::nullopt;
  const double before = as_it_is.at(*channel), left = after.at(*channel);
  const double noise = recording.noise_rms.at(*channel);
  return (before * before - left * left) / (before * before - noise * noise);
}

std::vector<MethodMark> MarkMethods(const BenchmarkCase& c, const CaseRecording& recording,
                                    const BaselineAnswers& answers) {
  std::vector<MethodMark> marks;
  for (const MethodAnswer& answer : answers.methods) {
    MethodMark mark{
        answer.method, answer.gives_findings, answer.gives_names, answer.found, false, {}};
    if (!answer.names.empty()) {
      const auto& [name, target] = answer.names.front();
      mark.right_first = IsHidden(c, name, target);
    }
    mark.share = ShareOfOracle(c, recording, answers.as_it_is, answer.rmse);
    marks.push_back(std::move(mark));
  }
  return marks;
}

}  // namespace tera::blind
