#pragma once

#include <optional>
#include <string>
#include <vector>

#include "blind/cases/benchmark_case.h"
#include "blind/marking/baseline_answers.h"

namespace tera::blind {

/// Share of the improvement that an oracle reaches on held-out manoeuvres.
///
/// Model   (e0^2 - e^2) / (e0^2 - n^2) in the channel of what is hidden in which the simulation as
///         it is errs most beside the noise: e0 its RMSE, e the method's, n the RMS of the
///         measurement's noise, which is all that an oracle leaves. Below 0 where a method makes
///         things worse.
/// Omits   that nominal numbers are off in these cases too: the oracle knows them, no method does.
///
/// None where e0^2 < 2 n^2, where nothing is to be gained, or the method said nothing of it.
std::optional<double> ShareOfOracle(const BenchmarkCase& benchmark_case,
                                    const CaseRecording& recording, const ErrorByChannel& as_it_is,
                                    const ErrorByChannel& after);

/// How a simpler method did.
struct MethodMark {
  std::string method;
  bool gives_findings = false, gives_names = false, found = false;
  bool right_first = false;  ///< the name that it took first is hidden there
  std::optional<double> share;
};

std::vector<MethodMark> MarkMethods(const BenchmarkCase& benchmark_case,
                                    const CaseRecording& recording, const BaselineAnswers& answers);

}  // namespace tera::blind
