#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "sensors/sensor.h"

namespace tera {

/// A sensor's possible mounts: on a link, within bounds that may be equal.
///
/// Frames  B link, S sensor.
struct MountBounds {
  std::string link;
  Vec3 low_B_m = Vec3::Zero(), high_B_m = Vec3::Zero();
  Vec3 low_rpy_rad = Vec3::Zero(), high_rpy_rad = Vec3::Zero();
  std::string place;  ///< its position in the file, for messages
};

/// A possible type of a sensor.
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
  std::string place;  ///< its position in the file, for messages
};

/// A quantity to minimise or maximise: a figure of a study (layout_measures.h), or "cost",
/// "power_w", "data_mbyteps", "sensors".
struct Objective {
  std::string figure;
  bool at_worst = false;  ///< the worst moment instead of the mean
  std::string place;      ///< its position in the file, for messages
};

/// Upper limits of a layout, over the kept and the placed sensors together.
struct Limits {
  std::optional<double> cost, power_w, data_mbyteps, sensors;
  std::string place;  ///< its position in the file, for messages
};

/// Initial layouts in addition to random ones. Other starts show whether the result depends on it.
enum class SearchStart {
  kGreedy,  ///< the greedy layout
  kRandom,  ///< none
  kWorst,   ///< none; the random layouts are the worst of ten times as many
};

/// A search for sensor layouts.
struct LayoutSearch {
  std::filesystem::path cycle, study;  ///< an empty study is the common one
  std::filesystem::path keep;          ///< rig whose sensors every layout has; may be empty
  std::vector<SensorSlot> slots;
  Limits limits;
  std::vector<Objective> objectives;
  std::string place;  ///< position of its numbers in the file, for messages
  int moments =
      12;  ///< number of evenly spread moments of the cycle at which candidates are evaluated
  int population = 48, generations = 40;
  SearchStart start = SearchStart::kGreedy;
  std::uint64_t seed = 1;
};

/// Throws InputError.
LayoutSearch LoadSearch(const std::filesystem::path& file);

}  // namespace tera
