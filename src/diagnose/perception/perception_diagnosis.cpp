#include "diagnose/perception/perception_diagnosis.h"

#include <utility>

namespace tera {

PerceptionDiagnosis NotJudged(const std::string& channel, const std::string& target,
                              const std::string& why) {
  PerceptionDiagnosis diagnosis;
  diagnosis.channel = channel;
  diagnosis.target = target;
  diagnosis.not_judged = why;
  return diagnosis;
}

void TakeOver(RegistrationSearch search, PerceptionDiagnosis* diagnosis) {
  diagnosis->noise_rmse = search.noise_rmse;
  diagnosis->detectability = std::move(search.detectability);
  for (Finding& found : search.findings) diagnosis->findings.push_back({std::move(found), {}, {}});
  for (Finding& found : search.unconfirmed) {
    diagnosis->unconfirmed.push_back({std::move(found), {}, {}});
  }
}

}  // namespace tera
