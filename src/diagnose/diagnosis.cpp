#include "diagnose/diagnosis.h"

namespace tera {

std::string_view NameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNone:
      return "none";
    case Verdict::kNamed:
      return "named";
    case Verdict::kClass:
      return "class";
    case Verdict::kUnexplained:
      return "unexplained";
    case Verdict::kUntestable:
      return "untestable";
  }
  return "";
}

std::vector<Verdict> VerdictsOf(const Diagnosis& diagnosis) {
  bool named = false, several = false, unexplained = false, judged = false;
  bool untestable = !diagnosis.not_compared.empty() || !diagnosis.missing_input.empty();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    judged = judged || diagnosed.diagnosis.is_testable;
    untestable = untestable || !diagnosed.diagnosis.is_testable;
    for (const Finding& finding : diagnosed.diagnosis.findings) {
      (finding.evidence.rivals.size() > 1 ? several : named) = true;
    }
    unexplained = unexplained || !diagnosed.diagnosis.unexplained.empty();
    for (const Detectability& candidate : diagnosed.diagnosis.detectability) {
      untestable = untestable || !candidate.smallest;
    }
  }
  judged = judged || !diagnosis.sensors.estimate.channels.empty();
  untestable = untestable || !diagnosis.sensors.estimate.untestable.empty();
  for (const SensorFound& found : diagnosis.sensors.findings) {
    (found.finding.evidence.rivals.size() > 1 ? several : named) = true;
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    judged = judged || sensor.is_judged();
    untestable = untestable || !sensor.is_judged();
    for (const PerceptionFinding& found : sensor.findings) {
      (found.finding.evidence.rivals.size() > 1 ? several : named) = true;
    }
  }
  std::vector<Verdict> verdicts;
  if (named) verdicts.push_back(Verdict::kNamed);
  if (several) verdicts.push_back(Verdict::kClass);
  if (unexplained) verdicts.push_back(Verdict::kUnexplained);
  if (verdicts.empty() && judged) verdicts.push_back(Verdict::kNone);
  if (untestable) verdicts.push_back(Verdict::kUntestable);
  return verdicts;
}

}  // namespace tera
