#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tera::blind {

/// RMSE on held-out manoeuvres, by the channel's name.
using ErrorByChannel = std::map<std::string, double>;

/// Answer of one baseline method.
struct MethodAnswer {
  std::string method;
  bool gives_findings = false;  ///< whether the method can report a discrepancy
  bool gives_names = false;     ///< whether it can also name it
  bool found = false;
  std::vector<std::pair<std::string, std::string>> names;  ///< mechanism and target, in the
                                                           ///< method's order
  ErrorByChannel rmse;
};

struct BaselineAnswers {
  ErrorByChannel as_it_is;  ///< of the unchanged simulation
  std::vector<MethodAnswer> methods;
};

/// Throws InputError for a file that violates the form in docs/evidence/proof.md.
BaselineAnswers ReadBaselines(const std::filesystem::path& baselines_json);

}  // namespace tera::blind
