#include "diagnose/report/files/baselines_json.h"

#include <nlohmann/json.hpp>

namespace tera {
namespace {

using Json = nlohmann::ordered_json;

void Put(const std::vector<std::string>& channels, const std::vector<double>& rmse, Json* map) {
  for (std::size_t c = 0; c < channels.size(); ++c) (*map)[channels[c]] = rmse[c];
}

Json EmptyAnswer(const BaselineAnswer& answer) {
  return {{"method", answer.method},
          {"gives_findings", answer.gives_findings},
          {"gives_names", answer.gives_names},
          {"found", false},
          {"names", Json::array()},
          {"rmse", Json::object()}};
}

void Add(const std::vector<std::string>& channels, const BaselineAnswer& answer, Json* method) {
  if (answer.found) (*method)["found"] = true;
  for (const NamedMechanism& name : answer.names) {
    (*method)["names"].push_back({{"mechanism", name.mechanism}, {"target", name.target}});
  }
  Put(channels, answer.rmse_final, &(*method)["rmse"]);
}

}  // namespace

std::string BaselinesJson(const std::vector<BlockBaselines>& blocks) {
  Json json = {{"as_it_is", Json::object()}, {"methods", Json::array()}};
  for (const BlockBaselines& block : blocks) {
    Put(block.channels, block.rmse_as_it_is, &json["as_it_is"]);
    for (std::size_t m = 0; m < block.answers.size(); ++m) {
      if (json["methods"].size() <= m) json["methods"].push_back(EmptyAnswer(block.answers[m]));
      Add(block.channels, block.answers[m], &json["methods"][m]);
    }
  }
  return json.dump(2) + "\n";
}

}  // namespace tera
