#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "sensors/sensor.h"

namespace tera {

/// Where a sensor may sit: on a link, within bounds that may be equal.
///
/// Frames  B link, S sensor.
struct MountBounds {
  std::string link;
  Vec3 low_B_m = Vec3::Zero(), high_B_m = Vec3::Zero();
  Vec3 low_rpy_rad = Vec3::Zero(), high_rpy_rad = Vec3::Zero();
  std::string place;  ///< in its file, for messages
};

/// What a sensor may be.
struct TypeChoice {
  std::filesystem::path preset;
  SensorDescription sensor;  ///< without a name and a mount
};

/// A sensor that a layout may have.
struct SensorSlot {
  std::string name;
  bool optional = true;
  std::vector<TypeChoice> types;
  std::vector<MountBounds> mounts;
  std::string place;  ///< in its file, for messages
};

/// What is to be small or large: a figure of a study (layout_measures.h), or "cost", "power_w",
/// "data_mbyteps", "sensors".
struct Objective {
  std::string figure;
  bool at_worst = false;  ///< of the worst moment instead of the mean
  std::string place;      ///< in its file, for messages
};

/// The most that a layout may take, of the sensors kept and of those placed together.
struct Limits {
  std::optional<double> cost, power_w, data_mbyteps, sensors;
  std::string place;  ///< in its file, for messages
};

/// What a search begins with beside random layouts: to begin with others shows whether what is
/// found depends on it.
enum class SearchStart {
  kGreedy,  ///< the greedy layout
  kRandom,  ///< nothing
  kWorst,   ///< nothing, and the random ones are the worst of ten times as many
};

/// A search for sensor layouts.
struct LayoutSearch {
  std::filesystem::path cycle, study;  ///< the study may be empty: the common one
  std::filesystem::path keep;          ///< rig whose sensors every layout has; may be empty
  std::vector<SensorSlot> slots;
  Limits limits;
  std::vector<Objective> objectives;
  std::string place;  ///< of its numbers in its file, for messages
  int moments = 12;   ///< of the cycle that candidates are looked at, evenly spread
  int population = 48, generations = 40;
  SearchStart start = SearchStart::kGreedy;
  std::uint64_t seed = 1;
};

/// Throws InputError.
LayoutSearch LoadSearch(const std::filesystem::path& file);

}  // namespace tera
