#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config_beneath.h"
#include "core/config/config_map.h"
#include "core/config/fault_text.h"

/// Layers of a configuration's mappings, internal to config_*.cpp.

namespace tera::internal {

/// One source of a mapping: a YAML node, its file and its key path. Messages and relative paths use
/// the file. The key path is the path in that file, "machines[0].sensors[2]". Layers of one mapping
/// may have different paths, such as a machine's effects and a scenario's effects above them.
struct Layer {
  YAML::Node node;
  std::string file;
  std::filesystem::path directory;
  std::string path;
  bool beneath = false;  ///< from LayBeneath: also ranks below the resolved document
  /// A single value at its path, as --set specifies it: no line numbers, list items by index.
  bool is_patch = false;
};

struct ConfigNode {
  ConfigDocument* document = nullptr;
  std::vector<Layer> layers;  ///< the first layer wins
  YAML::Node resolved{YAML::NodeType::Map};
  std::set<std::string> asked;  ///< all keys that the reader knows
  /// The mapping is absent or unreadable, which is already reported. Its missing and surplus keys
  /// are no further faults.
  bool unread = false;
  std::map<std::string, std::shared_ptr<ConfigNode>, std::less<>>
      children;  ///< mappings returned to readers
};

struct ConfigDocument {
  std::vector<InputFault> faults;
  std::vector<std::shared_ptr<ConfigNode>> nodes;
  std::shared_ptr<ConfigNode> root;
  std::map<std::string, std::filesystem::path> inputs;  ///< locations by portable name
  std::vector<MovedFiles> moved;

  /// Location of the file `name`: as `moved` specifies, otherwise `named`.
  std::filesystem::path PlaceOf(const std::string& name, const std::filesystem::path& named) const;

  std::shared_ptr<ConfigNode> AddNode(std::vector<Layer> layers) {
    auto node = std::make_shared<ConfigNode>();
    node->document = this;
    node->layers = std::move(layers);
    nodes.push_back(node);
    return node;
  }

  /// Number of faults in the document that contains `config`.
  static std::size_t FaultsWith(const ConfigMap& config) {
    return config.node_->document->faults.size();
  }

  static void LeaveUnread(const ConfigMap& config) { config.node_->unread = true; }
  static ConfigNode& NodeOf(const ConfigMap& config) { return *config.node_; }
  static bool Unread(const ConfigMap& config) { return config.node_->unread; }
  static void LayBeneath(const ConfigMap& config, const std::string& file,
                         const std::vector<GivenNumber>& numbers);
  static bool LiesBelow(const ConfigMap& config, std::string_view key, std::string_view upper);

  /// The mapping at `key` of `config`. The word `none` removes the mappings of all lower layers.
  /// Returns nullopt if the key is absent or removed, and after a fault: any other value, or a
  /// `none` with nothing to remove. Only effects are removable.
  static std::optional<ConfigMap> MapOrNone(const ConfigMap& config, std::string_view key,
                                            const std::string& need);
};

/// File name in messages about overrides.
inline constexpr char kOverlayName[] = "--set";

/// A value and its layer.
struct Found {
  YAML::Node node;
  const Layer* layer = nullptr;
};

// Lookup.

/// The value of `key` in one mapping.
std::optional<YAML::Node> ValueIn(const YAML::Node& map, std::string_view key);
/// The value of `key` in the first layer that has it.
std::optional<Found> Find(ConfigNode& node, std::string_view key);
/// Values of `key` in all layers that have it, first wins.
std::vector<Found> FindAll(ConfigNode& node, std::string_view key);
/// Keys of all layers: the keys of the lowest layer, followed by the additions of each layer above.
std::vector<std::string> NamesIn(const ConfigNode& node);

// Places and texts of messages.

std::string PlaceOf(const YAML::Node& node, const Layer& layer);
/// The layer that a message names for a key absent from all layers.
const Layer& LowestWritten(const ConfigNode& node);
/// A value as YAML on one line.
std::string OnOneLine(const YAML::Node& node);
std::string Join(const std::string& path, std::string_view key);
/// A value as in messages.
std::string Shown(const YAML::Node& node);
void AddFault(ConfigNode& node, std::string_view key, const Found& found, InputFault fault);
void AddMissing(ConfigNode& node, std::string_view key, const std::string& need);

// Numbers.

/// Text of the required range, for messages.
std::string Need(const Range& range);
std::optional<double> ParseNumber(const std::string& text);
/// The number at `found`; otherwise reports a fault and returns nullopt.
std::optional<double> NumberAt(ConfigNode& node, std::string_view key, const Found& found,
                               const Range& range);
/// An in-range value with which reading continues after a fault.
double Harmless(const Range& range);
/// The shortest text that parses to the same number.
std::string NumberText(double value);

/// Writes a value into the resolved document.
void Record(ConfigNode& node, std::string_view key, const std::string& scalar);

// Files.

/// True if the file exists and opens; false for names that are too long and for circular links.
bool IsFile(const std::filesystem::path& path);
/// The path without links, or the unchanged path if it cannot be resolved.
std::filesystem::path Canonical(const std::filesystem::path& path);
/// The file that `text` names relative to `directory`.
std::filesystem::path Resolve(const std::string& text, const std::filesystem::path& directory);
/// A path as in messages: relative to the working directory if it is below it.
std::string ShownName(const std::filesystem::path& path);
YAML::Node LoadYaml(const std::filesystem::path& file, const std::string& shown);
/// Loads the file that `found` names as a layer of the mapping at `mapping_path`, or reports a
/// fault.
std::optional<Layer> LoadLayer(ConfigNode& node, std::string_view key, const Found& found,
                               const std::string& mapping_path);

// Overrides.

/// True for a whole number in the brackets of a path, without leading zeros.
bool IsIndex(std::string_view text);
/// `value` (YAML) at `a.b[2].c`, as nested mappings; list items are mappings keyed by index.
/// Returns nullopt for a malformed path. Throws YAML::Exception.
std::optional<Layer> PatchLayer(const std::string& path, const std::string& value,
                                const std::string& place, const std::filesystem::path& directory);
/// The layers of the overrides above `file`, last override first.
std::vector<Layer> LayersAbove(const Layer& file, const std::vector<std::string>& overrides);

}  // namespace tera::internal
