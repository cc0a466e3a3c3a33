#include "sim/scenario/load_scenario.h"

namespace tera {

LoadedScenario LoadScenario(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides,
                            const std::vector<std::string>& effects,
                            const std::vector<MovedFiles>& moved) {
  std::vector<Config::Overlay> overlays;
  for (const std::string& overlay : effects) overlays.push_back({overlay, "effects"});
  Config config = Config::FromFile(file, overrides, overlays);
  config.Move(moved);
  LoadedScenario loaded;
  loaded.scenario = ReadScenario(config.root());
  config.Finish();
  loaded.resolved_yaml = config.ResolvedYaml();
  return loaded;
}

}  // namespace tera
