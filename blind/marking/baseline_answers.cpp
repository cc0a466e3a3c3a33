#include "blind/marking/baseline_answers.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace tera::blind {
namespace {

using Json = nlohmann::json;

MethodAnswer MethodOf(const Json& json) {
  MethodAnswer answer{json.at("method"),
                      json.at("gives_findings"),
                      json.at("gives_names"),
                      json.at("found"),
                      {},
                      {}};
  for (const Json& name : json.at("names")) {
    answer.names.emplace_back(name.at("mechanism"), name.at("target"));
  }
  answer.rmse = json.at("rmse").get<ErrorByChannel>();
  return answer;
}

}  // namespace

BaselineAnswers ReadBaselines(const std::filesystem::path& baselines_json) {
  try {
    std::ifstream file(baselines_json);
    const Json json = Json::parse(file);
    BaselineAnswers answers{json.at("as_it_is").get<ErrorByChannel>(), {}};
    for (const Json& method : json.at("methods")) answers.methods.push_back(MethodOf(method));
    return answers;
  } catch (const Json::exception& e) {
    throw InputError(fmt::format("{}: {}; need answers as docs/evidence/proof.md describes them",
                                 baselines_json.string(), e.what()));
  }
}

}  // namespace tera::blind
