#include "serve/scenario_source.h"

#include <mutex>
#include <utility>

#include "core/config/kept_texts.h"

namespace tera {
namespace {

using Load = std::function<LoadedScenario(std::optional<std::uint64_t>)>;

/// Cache of two scenarios: the one with its own seed, and the last one with another seed.
struct Shelf {
  Load load;
  KeptTexts texts;
  std::mutex mutex;
  SeededScenario own, latest;

  SeededScenario Read(std::optional<std::uint64_t> seed) {
    const KeptTexts::Reading reading(&texts);
    LoadedScenario loaded = load(seed);
    return {std::make_shared<const Scenario>(std::move(loaded.scenario)),
            std::move(loaded.resolved_yaml)};
  }
};

}  // namespace

ScenarioSource SourceOf(Load load) {
  const auto shelf = std::make_shared<Shelf>();
  shelf->load = std::move(load);
  shelf->own = shelf->latest = shelf->Read(std::nullopt);
  return [shelf](std::optional<std::uint64_t> seed) {
    {
      const std::lock_guard lock(shelf->mutex);
      if (!seed) return shelf->own;
      for (const SeededScenario* known : {&shelf->own, &shelf->latest}) {
        if (known->scenario->seed == *seed) return *known;
      }
    }
    SeededScenario read = shelf->Read(seed);
    const std::lock_guard lock(shelf->mutex);
    return shelf->latest = std::move(read);
  };
}

}  // namespace tera
