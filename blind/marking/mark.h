#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "blind/cases/benchmark_case.h"
#include "blind/marking/answer.h"
#include "blind/marking/improvement.h"

namespace tera::blind {

/// How one parameter came out.
struct ParameterMark {
  std::string effect, parameter;
  double truth = 0, value = 0, sigma = 0;
  double RelativeError() const;
  bool Covered() const;  ///< by value -/+ 1.645 sigma
};

/// What an answer is worth, measured against what was hidden.
///
/// Model   A finding names an effect where it is of the same joint and its class, of three at most,
///         holds the effect's name or one that says the same. It is confidently wrong where its
///         confidence is 0.9 or more and its class holds nothing that was hidden in that joint.
///         Intervals overlap by the time in both over the time in either; the true ones are where
///         what is hidden changes the rate by more than the noise's deviation, half a second
///         around: of the effect that the finding names, or of all those of its channel.
struct Mark {
  int number = 0;
  CaseKind kind = CaseKind::kNothing;
  Strength strength = Strength::kMedium;
  std::string fault;  ///< why there is no answer; empty: there is one
  double seconds = 0, recorded_s = 0;
  double signal_to_noise = 0;                                ///< of the loudest effect
  double shows_s = std::numeric_limits<double>::infinity();  ///< of what shows for least

  std::vector<std::string> hidden, answered;  ///< for the list of cases
  bool found_something = false;
  bool right_first = false;
  int named = 0;  ///< of what is hidden
  bool spurious = false;
  bool confident_wrong = false;
  bool flagged = false, right_variable_flagged = false;  ///< unexplained, of a joint concerned
  bool misnamed = false;                                 ///< a name for what has none
  bool listed_untestable = false;

  bool located = false;  ///< there was a finding to be located
  bool right_channel = false, right_variable = false, has_variable = false;
  double overlap = 0;
  std::vector<ParameterMark> parameters;
  std::optional<double> share_of_oracle;  ///< improvement.h
  std::vector<MethodMark> methods;        ///< beside it
};

Mark MarkAnswer(const BenchmarkCase& benchmark_case, const CaseRecording& recording,
                const Answer& answer);

}  // namespace tera::blind
