#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "blind/cases/benchmark_case.h"
#include "blind/marking/answer.h"
#include "blind/marking/improvement.h"

namespace tera::blind {

/// Result for one parameter.
struct ParameterMark {
  std::string effect, parameter;
  double truth = 0, value = 0, sigma = 0;
  double RelativeError() const;
  bool Covered() const;  ///< truth within value -/+ 1.645 sigma
};

/// Assessment of an answer against the hidden effects.
///
/// Model   A finding names an effect if it concerns the same joint and its class, of at most three,
///         holds the effect's name or an equivalent one. It is confidently wrong if its confidence
///         is 0.9 or more and its class holds nothing hidden in that joint. The overlap of
///         intervals is the time in both over the time in either. A true interval is where the
///         hidden effect changes the rate by more than the noise's deviation, extended by half a
///         second: for the effect that the finding names, or for all those of its channel.
struct Mark {
  int number = 0;
  CaseKind kind = CaseKind::kNothing;
  Strength strength = Strength::kMedium;
  std::string fault;  ///< reason for a missing answer; empty: there is an answer
  double seconds = 0, recorded_s = 0;
  double signal_to_noise = 0;                                ///< of the strongest effect
  double shows_s = std::numeric_limits<double>::infinity();  ///< of the effect that shows for the
                                                             ///< shortest time

  std::vector<std::string> hidden, answered;  ///< for the list of cases
  bool found_something = false;
  bool right_first = false;
  int named = 0;  ///< number of hidden effects that are named
  bool spurious = false;
  bool confident_wrong = false;
  bool flagged = false, right_variable_flagged = false;  ///< "unexplained", in an affected joint
  bool misnamed = false;                                 ///< a name for an effect without name
  bool listed_untestable = false;

  bool located = false;  ///< whether a finding could be located
  bool right_channel = false, right_variable = false, has_variable = false;
  double overlap = 0;
  std::vector<ParameterMark> parameters;
  std::optional<double> share_of_oracle;  ///< improvement.h
  std::vector<MethodMark> methods;        ///< beside it
};

Mark MarkAnswer(const BenchmarkCase& benchmark_case, const CaseRecording& recording,
                const Answer& answer);

}  // namespace tera::blind
