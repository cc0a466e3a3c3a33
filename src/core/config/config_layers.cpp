#include "core/config/config_layers.h"

#include <fmt/format.h>

#include <algorithm>

namespace tera::internal {
namespace {

/// Sets flow style on every nested collection; the style of the emitter does not override theirs.
void MakeFlow(YAML::Node node) {
  if (!node.IsMap() && !node.IsSequence()) return;
  node.SetStyle(YAML::EmitterStyle::Flow);
  for (auto entry : node) MakeFlow(node.IsMap() ? entry.second : entry);
}

}  // namespace

/// Avoids yaml-cpp's operator[]: it throws for absent keys on a const node and may insert on a
/// mutable node.
std::optional<YAML::Node> ValueIn(const YAML::Node& map, std::string_view key) {
  for (const auto& entry : map) {
    if (entry.first.IsScalar() && entry.first.Scalar() == key) return entry.second;
  }
  return std::nullopt;
}

std::optional<Found> Find(ConfigNode& node, std::string_view key) {
  node.asked.emplace(key);
  for (const Layer& layer : node.layers) {
    if (auto value = ValueIn(layer.node, key)) return Found{*value, &layer};
  }
  return std::nullopt;
}

std::vector<Found> FindAll(ConfigNode& node, std::string_view key) {
  node.asked.emplace(key);
  std::vector<Found> all;
  for (const Layer& layer : node.layers) {
    if (auto value = ValueIn(layer.node, key)) all.push_back({*value, &layer});
  }
  return all;
}

std::vector<std::string> NamesIn(const ConfigNode& node) {
  std::vector<std::string> names;
  for (auto layer = node.layers.rbegin(); layer != node.layers.rend(); ++layer) {
    for (const auto& entry : layer->node) {
      const std::string name = entry.first.Scalar();
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

std::string PlaceOf(const YAML::Node& node, const Layer& layer) {
  const YAML::Mark mark = node.Mark();
  if (mark.is_null() || layer.is_patch) return layer.file;
  return fmt::format("{}:{}:{}", layer.file, mark.line + 1, mark.column + 1);
}

std::string OnOneLine(const YAML::Node& node) {
  YAML::Node flat = YAML::Clone(node);
  MakeFlow(flat);
  YAML::Emitter emitter;
  emitter << flat;
  std::string text = emitter.c_str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string Join(const std::string& path, std::string_view key) {
  if (path.empty()) return std::string(key);
  return key.empty() ? path : fmt::format("{}.{}", path, key);
}

std::string Shown(const YAML::Node& node) {
  if (node.IsScalar()) return fmt::format("'{}'", node.Scalar());
  if (node.IsSequence()) return fmt::format("a list of {}", node.size());
  if (node.IsMap()) return "a mapping";
  return "nothing";
}

void AddFault(ConfigNode& node, std::string_view key, const Found& found, InputFault fault) {
  std::string place = PlaceOf(found.node, *found.layer);
  const std::string path = Join(found.layer->path, key);
  if (!path.empty()) place += ": " + path;
  if (!fault.place.empty()) place += ": " + fault.place;
  fault.place = std::move(place);
  node.document->faults.push_back(std::move(fault));
}

const Layer& LowestWritten(const ConfigNode& node) {
  const auto lowest = std::find_if(node.layers.rbegin(), node.layers.rend(),
                                   [](const Layer& layer) { return !layer.beneath; });
  return lowest == node.layers.rend() ? node.layers.back() : *lowest;
}

void AddMissing(ConfigNode& node, std::string_view key, const std::string& need) {
  if (node.unread) return;
  const Layer& layer = LowestWritten(node);
  AddFault(node, key, Found{layer.node, &layer}, fault::Missing(need));
}

void Record(ConfigNode& node, std::string_view key, const std::string& scalar) {
  node.resolved[std::string(key)] = scalar;
}

}  // namespace tera::internal
