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

/// The layers that a configuration's mappings are made of, for the files of config_*.cpp.

namespace tera::internal {

/// One source of a mapping: a YAML node, the file it stands in (for messages and relative paths),
/// and the key path that whoever wrote it there sees, "machines[0].sensors[2]". Layers of one
/// mapping may have different ones, effects of a machine and those of a scenario above them.
struct Layer {
  YAML::Node node;
  std::string file;
  std::filesystem::path directory;
  std::string path;
  bool beneath = false;  ///< of LayBeneath: below the resolved document too
  /// One value at its path, as --set gives it: without lines, and with items of lists by index.
  bool is_patch = false;
};

struct ConfigNode {
  ConfigDocument* document = nullptr;
  std::vector<Layer> layers;  ///< first wins
  YAML::Node resolved{YAML::NodeType::Map};
  std::set<std::string> asked;  ///< every key the reader knows
  /// It is not there or could not be read, which is reported already: what it lacks, and what it
  /// has beside that, is no fault.
  bool unread = false;
  std::map<std::string, std::shared_ptr<ConfigNode>, std::less<>>
      children;  ///< mappings handed out
};

struct ConfigDocument {
  std::vector<InputFault> faults;
  std::vector<std::shared_ptr<ConfigNode>> nodes;
  std::shared_ptr<ConfigNode> root;
  std::map<std::string, std::filesystem::path> inputs;  ///< places by portable name
  std::vector<MovedFiles> moved;

  /// Where a file of that name is read: as `moved` says, else at `named`.
  std::filesystem::path PlaceOf(const std::string& name, const std::filesystem::path& named) const;

  std::shared_ptr<ConfigNode> AddNode(std::vector<Layer> layers) {
    auto node = std::make_shared<ConfigNode>();
    node->document = this;
    node->layers = std::move(layers);
    nodes.push_back(node);
    return node;
  }

  /// Layers of the document that `config` is part of.
  static std::size_t FaultsWith(const ConfigMap& config) {
    return config.node_->document->faults.size();
  }

  static void LeaveUnread(const ConfigMap& config) { config.node_->unread = true; }
  static ConfigNode& NodeOf(const ConfigMap& config) { return *config.node_; }
  static bool Unread(const ConfigMap& config) { return config.node_->unread; }
  static void LayBeneath(const ConfigMap& config, const std::string& file,
                         const std::vector<GivenNumber>& numbers);
  static bool LiesBelow(const ConfigMap& config, std::string_view key, std::string_view upper);

  /// The mapping at `key` of `config`, which `none` in its place takes away: nothing below that
  /// counts. Without a value where it is absent or taken away, and after a fault: another value
  /// than these, or a `none` with nothing to take away. For effects; no other key can be taken
  /// away.
  static std::optional<ConfigMap> MapOrNone(const ConfigMap& config, std::string_view key,
                                            const std::string& need);
};

/// Stands for a file's name in the messages about overrides.
inline constexpr char kOverlayName[] = "--set";

/// A value and the layer that it stands in.
struct Found {
  YAML::Node node;
  const Layer* layer = nullptr;
};

// Looking up.

/// The value of `key` in one mapping.
std::optional<YAML::Node> ValueIn(const YAML::Node& map, std::string_view key);
/// The value of `key` in the first layer that has it.
std::optional<Found> Find(ConfigNode& node, std::string_view key);
/// Values of `key` in all layers that have it, first wins.
std::vector<Found> FindAll(ConfigNode& node, std::string_view key);
/// Keys of all layers: those of the lowest first, then what each layer above it adds.
std::vector<std::string> NamesIn(const ConfigNode& node);

// Saying where and what.

std::string PlaceOf(const YAML::Node& node, const Layer& layer);
/// The layer in which a key that no layer has would be looked for.
const Layer& LowestWritten(const ConfigNode& node);
/// A value as YAML on one line.
std::string OnOneLine(const YAML::Node& node);
std::string Join(const std::string& path, std::string_view key);
/// A value as messages show it.
std::string Shown(const YAML::Node& node);
void AddFault(ConfigNode& node, std::string_view key, const Found& found, InputFault fault);
void AddMissing(ConfigNode& node, std::string_view key, const std::string& need);

// Numbers.

/// What messages say is needed.
std::string Need(const Range& range);
std::optional<double> ParseNumber(const std::string& text);
/// The number at `found`, or a fault and nothing.
std::optional<double> NumberAt(ConfigNode& node, std::string_view key, const Found& found,
                               const Range& range);
/// A value within the range, for reading on after a fault.
double Harmless(const Range& range);
/// The shortest text that reads back as the same number.
std::string NumberText(double value);

/// Enters a value into the resolved document.
void Record(ConfigNode& node, std::string_view key, const std::string& scalar);

// Files.

/// Is there a file that can be opened? Not where the name is too long or links go in a circle.
bool IsFile(const std::filesystem::path& path);
/// The path without links, or as it stands where it cannot be followed.
std::filesystem::path Canonical(const std::filesystem::path& path);
/// The file that `text` means in a file of `directory`.
std::filesystem::path Resolve(const std::string& text, const std::filesystem::path& directory);
/// A path as messages show it: relative to the working directory where it is below it.
std::string ShownName(const std::filesystem::path& path);
YAML::Node LoadYaml(const std::filesystem::path& file, const std::string& shown);
/// Loads the file that `found` names as a layer of the mapping at `mapping_path`, or reports a
/// fault.
std::optional<Layer> LoadLayer(ConfigNode& node, std::string_view key, const Found& found,
                               const std::string& mapping_path);

// Overrides.

/// A whole number as it stands between the brackets of a path: without zeros in front.
bool IsIndex(std::string_view text);
/// `value` (YAML) at `a.b[2].c`, in nested mappings, items of lists as mappings keyed by index;
/// nothing where the path has another form. Throws YAML::Exception.
std::optional<Layer> PatchLayer(const std::string& path, const std::string& value,
                                const std::string& place, const std::filesystem::path& directory);
/// The overrides, the last first, above `file`.
std::vector<Layer> LayersAbove(const Layer& file, const std::vector<std::string>& overrides);

}  // namespace tera::internal
