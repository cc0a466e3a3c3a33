#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tera::blind {

/// RMSE on held-out manoeuvres by the name of the channel.
using ErrorByChannel = std::map<std::string, double>;

/// What one simpler method answered.
struct MethodAnswer {
  std::string method;
  bool gives_findings = false;  ///< it can say that something is wrong
  bool gives_names = false;     ///< and what
  bool found = false;
  std::vector<std::pair<std::string, std::string>> names;  ///< mechanism, target; in its order
  ErrorByChannel rmse;
};

struct BaselineAnswers {
  ErrorByChannel as_it_is;  ///< of the simulation without any change
  std::vector<MethodAnswer> methods;
};

/// Throws InputError where the file is not of the form that docs/evidence/proof.md describes.
BaselineAnswers ReadBaselines(const std::filesystem::path& baselines_json);

}  // namespace tera::blind
