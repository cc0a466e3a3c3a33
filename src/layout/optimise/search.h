#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "sensors/sensor.h"

namespace tera {

/// A possible mount of a sensor: a link and bounds on the pose. Equal bounds fix a coordinate.
///
/// Frames  B link, S sensor.
struct MountBounds {
  std::string link;
  Vec3 low_B_m = Vec3::Zero(), high_B_m = Vec3::Zero();
  Vec3 low_rpy_rad = Vec3::Zero(), high_rpy_rad = Vec3::Zero();
  std::string place;  ///< its position in the search file, for messages
};

/// A sensor type that a slot can hold.
struct TypeChoice {
  std::filesystem::path preset;
  SensorDescription sensor;  ///< without a name or mount
};

/// A sensor that each candidate layout has, or may have if `optional`.
struct SensorSlot {
  std::string name;
  bool optional = true;
  std::vector<TypeChoice> types;
  std::vector<MountBounds> mounts;
  std::string place;  ///< its position in the search file, for messages
};

/// A quantity to optimise: a figure of a study (layout_measures.h) or one of "cost", "power_w",
/// "data_mbyteps", "sensors".
struct Objective {
  std::string figure;
  bool at_worst = false;  ///< the worst moment instead of the mean
  std::string place;      ///< its position in the search file, for messages
};

/// Upper limits on a layout's sums over the kept and the placed sensors.
struct Limits {
  std::optional<double> cost, power_w, data_mbyteps, sensors;
  std::string place;  ///< its position in the search file, for messages
};

/// The initial population. Other starts than kGreedy show whether the result depends on it.
enum class SearchStart {
  kGreedy,  ///< the greedy layout and random ones
  kRandom,  ///< random layouts
  kWorst,   ///< the worst of ten times as many random layouts
};

/// A search for sensor layouts.
struct LayoutSearch {
  std::filesystem::path cycle, study;  ///< paths; an empty study is the default study
  std::filesystem::path keep;          ///< rig whose sensors every layout has; may be empty
  std::vector<SensorSlot> slots;
  Limits limits;
  std::vector<Objective> objectives;
  std::string place;  ///< position of its numeric keys in the search file, for messages
  int moments =
      12;  ///< number of evenly spaced moments of the cycle at which candidates are evaluated
  int population = 48, generations = 40;
  SearchStart start = SearchStart::kGreedy;
  std::uint64_t seed = 1;
};

/// Throws InputError.
LayoutSearch LoadSearch(const std::filesystem::path& file);

}  // namespace tera
