#include <fmt/format.h>

#include <algorithm>

#include "core/config_layers.h"

/// Mappings in mappings, in files and by name; faults and places.

namespace tera {

using internal::AddFault;
using internal::AddMissing;
using internal::ConfigNode;
using internal::Find;
using internal::Found;
using internal::Join;
using internal::Layer;
using internal::PlaceOf;
using internal::Shown;
using internal::ValueIn;

namespace {

/// In the place of a mapping: takes away what the layers below have.
constexpr char kNothing[] = "none";

/// Layers of the mapping at `key`: the overlaying patches and every layer's own mapping.
std::vector<Layer> LayersOf(ConfigNode& node, std::string_view key) {
  node.asked.emplace(key);
  std::vector<Layer> layers;
  for (const Layer& layer : node.layers) {
    const auto value = ValueIn(layer.node, key);
    if (!value) continue;
    if (value->IsMap()) {
      layers.push_back({*value, layer.file, layer.directory});
    } else if (!layers.empty() && value->IsScalar() && value->Scalar() == kNothing) {
      break;  // it takes away what lies below, and was overlaid itself
    } else {
      AddFault(node, key, Found{*value, &layer},
               fmt::format("{} found, need a mapping of keys", Shown(*value)));
    }
  }
  return layers;
}

std::shared_ptr<ConfigNode> AddChild(ConfigNode& parent, std::string_view key,
                                     std::vector<Layer> layers) {
  if (layers.empty())
    layers.push_back({YAML::Node(YAML::NodeType::Map), parent.layers[0].file, {}});
  auto child = parent.document->AddNode(Join(parent.path, key), std::move(layers));
  parent.resolved[std::string(key)] = child->resolved;
  parent.children.emplace(key, child);
  return child;
}

}  // namespace

bool ConfigMap::Has(std::string_view key) const { return Find(*node_, key).has_value(); }

ConfigMap ConfigMap::Map(std::string_view key) const {
  if (const auto known = node_->children.find(key); known != node_->children.end()) {
    return ConfigMap(known->second);
  }
  if (!Has(key)) AddMissing(*node_, key, "a mapping of keys");
  return ConfigMap(AddChild(*node_, key, LayersOf(*node_, key)));
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
  if (!Has(key)) AddMissing(*node_, key, "a YAML file's path, or a mapping of keys");
  std::vector<Layer> layers;
  for (const Layer& layer : node_->layers) {
    const auto value = ValueIn(layer.node, key);
    if (!value) continue;
    if (value->IsMap()) {
      layers.push_back({*value, layer.file, layer.directory});
    } else if (value->IsScalar()) {
      if (auto loaded = internal::LoadLayer(*node_, key, Found{*value, &layer})) {
        layers.push_back(*loaded);
      }
      break;  // a file replaces what lies below
    } else {
      AddFault(*node_, key, Found{*value, &layer},
               fmt::format("{} found, need a file's path or a mapping", Shown(*value)));
    }
  }
  return ConfigMap(AddChild(*node_, key, std::move(layers)));
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
void ConfigMap::Fault(std::string_view key, const std::string& finding) const {
  if (const auto found = key.empty() ? std::nullopt : Find(*node_, key)) {
    AddFault(*node_, key, *found, finding);
  } else {
    const Layer& layer = node_->layers.back();
    AddFault(*node_, key, PlaceOf(layer.node, layer.file), finding);
  }
}

std::string ConfigMap::Place(std::string_view key) const {
  const std::string path = Join(node_->path, key);
  const auto found = key.empty() ? std::nullopt : Find(*node_, key);
  const Layer& layer = found ? *found->layer : node_->layers.back();
  const std::string place = PlaceOf(found ? found->node : layer.node, layer.file);
  return path.empty() ? place : fmt::format("{}: {}", place, path);
}
}  // namespace tera
