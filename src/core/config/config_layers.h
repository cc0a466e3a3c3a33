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

/// Layers of a configuration's mappings. Only config_*.cpp includes this header.

namespace tera::internal {

/// One source of a mapping: a YAML node, the file that contains it, and its key path in that file,
/// such as "machines[0].sensors[2]". Messages and relative paths refer to this file. The layers of
/// one mapping may have different key paths. For example, a scenario's effects are a layer above a
/// machine's effects.
struct Layer {
  YAML::Node node;
  std::string file;
  std::filesystem::path directory;
  std::string path;
  bool beneath = false;  ///< added by LayBeneath: ranks even below the resolved document
  /// True for a single value at a path, as --set gives it. It has no line number and addresses list
  /// items by index.
  bool is_patch = false;
};

struct ConfigNode {
  ConfigDocument* document = nullptr;
  std::vector<Layer> layers;  ///< topmost layer first
  YAML::Node resolved{YAML::NodeType::Map};
  std::set<std::string> asked;  ///< every key that the program has asked for
  /// True if the mapping is absent or unreadable. That fault is reported once; missing and unknown
  /// keys of the mapping add no faults.
  bool unread = false;
  std::map<std::string, std::shared_ptr<ConfigNode>, std::less<>>
      children;  ///< nested mappings that the program has read
};

struct ConfigDocument {
  std::vector<InputFault> faults;
  std::vector<std::shared_ptr<ConfigNode>> nodes;
  std::shared_ptr<ConfigNode> root;
  std::map<std::string, std::filesystem::path> inputs;  ///< locations of input files by portable
                                                        ///< name
  std::vector<MovedFiles> moved;

  /// Location of the file `name` after `moved` is applied; `named` if no entry applies.
  std::filesystem::path PlaceOf(const std::string& name, const std::filesystem::path& named) const;

  std::shared_ptr<ConfigNode> AddNode(std::vector<Layer> layers) {
    auto node = std::make_shared<ConfigNode>();
    node->document = this;
    node->layers = std::move(layers);
    nodes.push_back(node);
    return node;
  }

  /// Number of faults so far in the document of `config`.
  static std::size_t FaultsWith(const ConfigMap& config) {
    return config.node_->document->faults.size();
  }

  static void LeaveUnread(const ConfigMap& config) { config.node_->unread = true; }
  static ConfigNode& NodeOf(const ConfigMap& config) { return *config.node_; }
  static bool Unread(const ConfigMap& config) { return config.node_->unread; }
  static void LayBeneath(const ConfigMap& config, const std::string& file,
                         const std::vector<GivenNumber>& numbers);
  static bool LiesBelow(const ConfigMap& config, std::string_view key, std::string_view upper);

  /// The mapping at `key` of `config`. The word `none` in a layer removes the mappings of all lower
  /// layers. Returns nullopt if the key is absent or removed. Any other value is a fault and also
  /// returns nullopt, as does `none` without a mapping below it. Only effects support `none`.
  static std::optional<ConfigMap> MapOrNone(const ConfigMap& config, std::string_view key,
                                            const std::string& need);
};

/// Stands for the file name in messages about overrides.
inline constexpr char kOverlayName[] = "--set";

/// A value and the layer that holds it.
struct Found {
  YAML::Node node;
  const Layer* layer = nullptr;
};

// Lookup.

/// The value of `key` in one mapping.
std::optional<YAML::Node> ValueIn(const YAML::Node& map, std::string_view key);
/// The value of `key` in the first layer that has it.
std::optional<Found> Find(ConfigNode& node, std::string_view key);
/// Values of `key` in every layer that has it, topmost first.
std::vector<Found> FindAll(ConfigNode& node, std::string_view key);
/// Keys of the lowest layer, then the additional keys of each higher layer.
std::vector<std::string> NamesIn(const ConfigNode& node);

// Places and texts of messages.

std::string PlaceOf(const YAML::Node& node, const Layer& layer);
/// The lowest layer that was not added by LayBeneath. Messages about a missing key show its place.
const Layer& LowestWritten(const ConfigNode& node);
/// A value as one line of YAML.
std::string OnOneLine(const YAML::Node& node);
std::string Join(const std::string& path, std::string_view key);
/// A value as messages show it.
std::string Shown(const YAML::Node& node);
void AddFault(ConfigNode& node, std::string_view key, const Found& found, InputFault fault);
void AddMissing(ConfigNode& node, std::string_view key, const std::string& need);

// Numbers.

/// Text of the required range, for messages.
std::string Need(const Range& range);
std::optional<double> ParseNumber(const std::string& text);
/// Reads the number at `found`. Reports a fault and returns nullopt if it is not a number or is out
/// of range.
std::optional<double> NumberAt(ConfigNode& node, std::string_view key, const Found& found,
                               const Range& range);
/// A value in range, with which reading continues after a fault.
double Harmless(const Range& range);
/// The shortest decimal text that parses to the same double.
std::string NumberText(double value);

void Record(ConfigNode& node, std::string_view key, const std::string& scalar);

// Files.

/// True if the path names a file that can be opened. Does not throw for overlong names or circular
/// links.
bool IsFile(const std::filesystem::path& path);
/// The path with all links resolved, or the path itself if that fails.
std::filesystem::path Canonical(const std::filesystem::path& path);
/// The file that `text` names relative to `directory`.
std::filesystem::path Resolve(const std::string& text, const std::filesystem::path& directory);
/// A path as messages show it: relative if it is below the working directory.
std::string ShownName(const std::filesystem::path& path);
YAML::Node LoadYaml(const std::filesystem::path& file, const std::string& shown);
/// Loads the file that `found` names as a layer for the mapping at `mapping_path`. Reports a fault
/// and returns nullopt on failure.
std::optional<Layer> LoadLayer(ConfigNode& node, std::string_view key, const Found& found,
                               const std::string& mapping_path);

// Overrides.

/// True for a list index as used in paths: decimal digits without leading zeros.
bool IsIndex(std::string_view text);
/// A layer that sets the YAML text `value` at the path `a.b[2].c`. It consists of nested mappings;
/// a list becomes a mapping keyed by index. Returns nullopt for a malformed path. Throws
/// YAML::Exception for malformed YAML.
std::optional<Layer> PatchLayer(const std::string& path, const std::string& value,
                                const std::string& place, const std::filesystem::path& directory);
/// Layers for `overrides` above the layer `file`. The last override is first and wins.
std::vector<Layer> LayersAbove(const Layer& file, const std::vector<std::string>& overrides);

}  // namespace tera::internal
