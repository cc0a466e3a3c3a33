#include "sim/scenario/load_scenario.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/scenario/randomise.h"
#include "sim/scenario/yaml_text.h"

namespace tera {
namespace {

/// Overlays the values that `randomise:` draws, and removes that key from the resolved text.
void LayEpisode(std::uint64_t episode, Config* config) {
  const ConfigMap root = config->root();
  if (!root.Has("randomise")) {
    if (episode == 0) return;
    root.Fault(
        "randomise",
        fmt::format(
            "is missing, so there is no episode {}; remove --episode, or write the values to draw",
            episode));
    return;
  }
  std::vector<Config::GivenValue> values = DrawEpisode(root, SeedOf(root), episode);
  std::vector<std::string> drawn;
  for (const Config::GivenValue& value : values) {
    drawn.push_back(QuotedText(value.path + ": " + value.yaml));
  }
  values.push_back({"drawn",
                    fmt::format("{{episode: {}, values: [{}]}}", episode, fmt::join(drawn, ", ")),
                    root.Place("randomise")});
  config->LayOver(values);
  config->LeaveOut("randomise");
  config->LeaveOut("seed");  // read again later, to keep the order of keys in the text
}

}  // namespace

LoadedScenario LoadScenario(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides,
                            const std::vector<std::string>& effects,
                            const std::vector<MovedFiles>& moved, std::uint64_t episode) {
  std::vector<Config::Overlay> overlays;
  for (const std::string& overlay : effects) overlays.push_back({overlay, "effects"});
  Config config = Config::FromFile(file, overrides, overlays);
  config.Move(moved);
  LayEpisode(episode, &config);
  LoadedScenario loaded;
  loaded.scenario = ReadScenario(config.root());
  config.Finish();
  loaded.resolved_yaml = config.ResolvedYaml();
  return loaded;
}

}  // namespace tera
