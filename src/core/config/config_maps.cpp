#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/config/config_beneath.h"
#include "core/config/config_faults.h"
#include "core/config/config_layers.h"
#include "core/config/config_peek.h"

/// Nested mappings, mappings in files, named mappings, and places of faults.

namespace tera {

using internal::AddFault;
using internal::AddMissing;
using internal::ConfigNode;
using internal::Find;
using internal::FindAll;
using internal::Found;
using internal::Join;
using internal::Layer;
using internal::PlaceOf;
using internal::Record;
using internal::Shown;

namespace {

/// The word that removes an effect of the lower layers.
constexpr char kNothing[] = "none";

/// The layer of the mapping `found` at `key`.
Layer LayerAt(std::string_view key, const Found& found) {
  return {found.node,
          found.layer->file,
          found.layer->directory,
          Join(found.layer->path, key),
          found.layer->beneath,
          found.layer->is_patch};
}

/// Layers of the mapping at `key`: the patches and mappings of every layer that has the key,
/// topmost first.
std::vector<Layer> LayersOf(ConfigNode& node, std::string_view key) {
  std::vector<Layer> layers;
  for (const Found& found : FindAll(node, key)) {
    if (found.node.IsMap()) {
      layers.push_back(LayerAt(key, found));
    } else {
      AddFault(node, key, found, fault::Mistyped(Shown(found.node), "a mapping of keys"));
    }
  }
  return layers;
}

/// The value at a path of keys. The function is recursive because assignment to a YAML::Node
/// overwrites the node it refers to, so a loop variable would change the document.
std::optional<YAML::Node> ValueAt(const YAML::Node& map, std::span<const std::string> path) {
  if (path.empty()) return map;
  if (!map.IsMap()) return std::nullopt;
  const auto value = internal::ValueIn(map, path.front());
  return value ? ValueAt(*value, path.subspan(1)) : std::nullopt;
}

bool TakesAway(const YAML::Node& node) { return node.IsScalar() && node.Scalar() == kNothing; }

std::shared_ptr<ConfigNode> AddChild(ConfigNode& parent, std::string_view key,
                                     std::vector<Layer> layers) {
  if (layers.empty())
    layers.push_back({YAML::Node(YAML::NodeType::Map),
                      parent.layers[0].file,
                      {},
                      Join(parent.layers[0].path, key)});
  auto child = parent.document->AddNode(std::move(layers));
  child->unread = parent.unread;
  parent.resolved[std::string(key)] = child->resolved;
  parent.children.emplace(key, child);
  return child;
}

}  // namespace

std::string ConfigMap::Yaml(std::string_view key) const {
  const auto found = Find(*node_, key);
  if (!found) {
    AddMissing(*node_, key, "a value");
    return "";
  }
  return internal::OnOneLine(found->node);
}

std::vector<std::string> ConfigMap::Keys() const { return internal::NamesIn(*node_); }

bool ConfigMap::Has(std::string_view key) const { return Find(*node_, key).has_value(); }

ConfigMap ConfigMap::Map(std::string_view key) const {
  if (const auto known = node_->children.find(key); known != node_->children.end()) {
    return ConfigMap(known->second);
  }
  const std::size_t faults_before = FaultCount(*this);
  if (!Has(key)) AddMissing(*node_, key, "a mapping of keys");
  const auto child = AddChild(*node_, key, LayersOf(*node_, key));
  child->unread = child->unread || FaultCount(*this) > faults_before;
  return ConfigMap(child);
}

std::optional<ConfigMap> ConfigMap::OptionalMap(std::string_view key) const {
  if (!Has(key)) return std::nullopt;
  return Map(key);
}

std::optional<ConfigMap> ConfigMap::OptionalMapUnder(std::string_view key, const ConfigMap& upper,
                                                     std::string_view upper_key) const {
  std::vector<Layer> layers = LayersOf(*upper.node_, upper_key);
  const std::vector<Layer> lower = LayersOf(*node_, key);
  layers.insert(layers.end(), lower.begin(), lower.end());
  if (layers.empty()) return std::nullopt;
  return ConfigMap(AddChild(*node_, key, std::move(layers)));
}

ConfigMap ConfigMap::MapOrFile(std::string_view key) const {
  if (const auto known = node_->children.find(key); known != node_->children.end()) {
    return ConfigMap(known->second);
  }
  const std::size_t faults_before = FaultCount(*this);
  if (!Has(key)) AddMissing(*node_, key, "a YAML file's path, or a mapping of keys");
  std::vector<Layer> layers;
  for (const Found& found : FindAll(*node_, key)) {
    if (found.node.IsMap()) {
      layers.push_back(LayerAt(key, found));
    } else if (found.node.IsScalar()) {
      const std::string path = Join(found.layer->path, key);
      if (auto loaded = internal::LoadLayer(*node_, key, found, path)) layers.push_back(*loaded);
      break;  // the file replaces all lower layers
    } else {
      AddFault(*node_, key, found,
               fault::Mistyped(Shown(found.node), "a file's path or a mapping"));
    }
  }
  const auto child = AddChild(*node_, key, std::move(layers));
  child->unread = child->unread || FaultCount(*this) > faults_before;
  return ConfigMap(child);
}

std::optional<ConfigMap> internal::ConfigDocument::MapOrNone(const ConfigMap& config,
                                                             std::string_view key,
                                                             const std::string& need) {
  ConfigNode& node = *config.node_;
  const std::vector<Found> values = FindAll(node, key);
  if (values.empty()) return std::nullopt;
  std::vector<Layer> layers;
  for (const Found& found : values) {
    if (TakesAway(found.node)) break;
    if (!found.node.IsMap()) {
      AddFault(node, key, found, fault::Mistyped(Shown(found.node), need));
      return std::nullopt;
    }
    layers.push_back(LayerAt(key, found));
  }
  if (TakesAway(values.back().node)) {
    AddFault(node, key, values.back(),
             fmt::format("'{}' takes away an effect of a lower layer (the machine's file, the "
                         "scenario, an earlier --effects file), but none of them has it; leave it "
                         "out",
                         kNothing));
  }
  if (layers.empty()) {
    // A reader of the resolved document adds the LayBeneath layer again, so `none` must be
    // recorded.
    if (values.back().layer->beneath) Record(node, key, kNothing);
    return std::nullopt;
  }
  return ConfigMap(AddChild(node, key, std::move(layers)));
}

std::vector<std::pair<std::string, ConfigMap>> ConfigMap::NamedMaps(std::string_view key) const {
  std::vector<std::pair<std::string, ConfigMap>> maps;
  const auto parent = OptionalMap(key);
  if (!parent) return maps;
  for (const std::string& name : internal::NamesIn(*parent->node_)) {
    maps.emplace_back(name, parent->Map(name));
  }
  return maps;
}

std::vector<std::pair<std::string, double>> ConfigMap::NamedNumbers(std::string_view key,
                                                                    const Range& each) const {
  std::vector<std::pair<std::string, double>> numbers;
  const auto parent = OptionalMap(key);
  if (!parent) return numbers;
  for (const std::string& name : internal::NamesIn(*parent->node_)) {
    numbers.emplace_back(name, parent->Number(name, each));
  }
  return numbers;
}

void ConfigMap::Fault(std::string_view key, const InputFault& fault) const {
  if (const auto found = key.empty() ? std::nullopt : Find(*node_, key)) {
    AddFault(*node_, key, *found, fault);
  } else if (!node_->unread) {
    const Layer& layer = internal::LowestWritten(*node_);
    AddFault(*node_, key, Found{layer.node, &layer}, fault);
  }
}

std::string ConfigMap::Place(std::string_view key) const {
  const auto found = key.empty() ? std::nullopt : Find(*node_, key);
  const Layer& layer = found ? *found->layer : internal::LowestWritten(*node_);
  const std::string path = Join(layer.path, key);
  const std::string place = PlaceOf(found ? found->node : layer.node, layer);
  return path.empty() ? place : fmt::format("{}: {}", place, path);
}

std::size_t FaultCount(const ConfigMap& config) {
  return internal::ConfigDocument::FaultsWith(config);
}

std::string ChoiceOfKeys(const ConfigMap& config, std::string_view key,
                         std::initializer_list<std::string_view> allowed) {
  const std::size_t faults_before = FaultCount(config);
  std::string choice = config.Choice(key, allowed);
  if (FaultCount(config) > faults_before) internal::ConfigDocument::LeaveUnread(config);
  return choice;
}

bool HasBelow(const ConfigMap& config, std::string_view key, std::string_view inner) {
  const std::vector<Layer>& layers = internal::ConfigDocument::NodeOf(config).layers;
  return std::any_of(layers.begin(), layers.end(), [&](const Layer& layer) {
    const auto map = internal::ValueIn(layer.node, key);
    return map && map->IsMap() && internal::ValueIn(*map, inner).has_value();
  });
}

std::vector<std::string> ItemsAt(const ConfigMap& config, const std::vector<std::string>& path) {
  std::vector<std::string> items;
  for (const Layer& layer : internal::ConfigDocument::NodeOf(config).layers) {
    const auto list = ValueAt(layer.node, path);
    if (!list || !list->IsSequence()) continue;
    for (const auto& item : *list) items.push_back(internal::OnOneLine(item));
    break;
  }
  return items;
}

bool IsUnread(const ConfigMap& config) { return internal::ConfigDocument::Unread(config); }

void LayBeneath(const ConfigMap& config, const std::string& file,
                const std::vector<GivenNumber>& numbers) {
  internal::ConfigDocument::LayBeneath(config, file, numbers);
}

void internal::ConfigDocument::LayBeneath(const ConfigMap& config, const std::string& file,
                                          const std::vector<GivenNumber>& numbers) {
  YAML::Node map(YAML::NodeType::Map);
  for (const GivenNumber& number : numbers) {
    YAML::Node at = map;
    for (const std::string& key : number.path) at.reset(at[key]);
    at = NumberText(number.value);
  }
  const Layer own = LowestWritten(*config.node_);
  config.node_->layers.push_back({map, file, own.directory, own.path, true});
}

bool LiesBelow(const ConfigMap& config, std::string_view key, std::string_view upper) {
  return internal::ConfigDocument::LiesBelow(config, key, upper);
}

bool internal::ConfigDocument::LiesBelow(const ConfigMap& config, std::string_view key,
                                         std::string_view upper) {
  const auto below = Find(*config.node_, key), above = Find(*config.node_, upper);
  return below && above && below->layer > above->layer;
}
}  // namespace tera
