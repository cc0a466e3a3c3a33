#pragma once

#include <optional>
#include <string>
#include <vector>

#include "blind/cases/benchmark_case.h"
#include "blind/marking/baseline_answers.h"

namespace tera::blind {

/// Share of an oracle's improvement on held-out manoeuvres.
///
/// Model   (e0^2 - e^2) / (e0^2 - n^2). The channel is that of a hidden effect in which the
///         unchanged simulation errs most relative to the noise. e0 is its RMSE, e the method's, n
///         the RMS of the measurement noise, which is the oracle's residual. Negative where a
///         method makes the error worse.
/// Omits   deviations of nominal numbers, present in these cases too: the oracle knows them, no
///         method does.
///
/// None where e0^2 < 2 n^2, since there is nothing to gain, or where the method has no answer.
std::optional<double> ShareOfOracle(const BenchmarkCase& benchmark_case,
                                    const CaseRecording& recording, const ErrorByChannel& as_it_is,
                                    const ErrorByChannel& after);

/// Result of a baseline method.
struct MethodMark {
  std::string method;
  bool gives_findings = false, gives_names = false, found = false;
  bool right_first = false;  ///< the first name in its order is hidden there
  std::optional<double> share;
};

std::vector<MethodMark> MarkMethods(const BenchmarkCase& benchmark_case,
                                    const CaseRecording& recording, const BaselineAnswers& answers);

}  // namespace tera::blind
