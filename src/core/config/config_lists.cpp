#include <fmt/format.h>

#include <algorithm>

#include "core/config/config_layers.h"
#include "core/units.h"

/// Lists of numbers, texts and mappings, and patches of single items.

namespace tera {

using internal::AddFault;
using internal::AddMissing;
using internal::ConfigNode;
using internal::Find;
using internal::FindAll;
using internal::Found;
using internal::Harmless;
using internal::Layer;
using internal::Need;
using internal::NumberAt;
using internal::NumberText;
using internal::Shown;

namespace {

void RecordNumbers(ConfigNode& node, std::string_view key, const std::vector<double>& values) {
  YAML::Node list(YAML::NodeType::Sequence);
  list.SetStyle(YAML::EmitterStyle::Flow);
  for (const double v : values) list.push_back(NumberText(v));
  node.resolved[std::string(key)] = list;
}

/// A list with the layers of each item, topmost first.
struct FoundList {
  Found list;
  std::vector<std::vector<Found>> items;
};

/// Finds the list among the values of `key`, topmost first. Values above it must be mappings
/// {index: keys}, which patch items of the list. Reports a fault and returns nullopt if there is no
/// list.
std::optional<FoundList> ListAmong(ConfigNode& node, std::string_view key,
                                   const std::vector<Found>& values, const std::string& need) {
  const auto list = std::find_if(values.begin(), values.end(),
                                 [](const Found& value) { return !value.node.IsMap(); });
  if (list == values.end() || !list->node.IsSequence()) {
    const Found& wrong = list == values.end() ? values.back() : *list;
    const bool patch = wrong.layer->is_patch && wrong.node.IsMap();
    AddFault(
        node, key, wrong,
        fault::Mistyped(patch ? "an item of a list that is not there" : Shown(wrong.node), need));
    return std::nullopt;
  }
  FoundList found{*list, std::vector<std::vector<Found>>(list->node.size())};
  for (auto patch = values.begin(); patch != list; ++patch) {
    for (const auto& entry : patch->node) {
      const std::string index = entry.first.Scalar();
      const auto number = internal::IsIndex(index) ? internal::ParseNumber(index) : std::nullopt;
      if (number && *number < static_cast<double>(found.items.size())) {
        found.items[static_cast<std::size_t>(*number)].push_back({entry.second, patch->layer});
      } else {
        AddFault(node, key, *patch,
                 {FaultKind::kNoSuchName,
                  fmt::format("no item [{}], the list has {}", index, found.items.size())});
      }
    }
  }
  for (std::size_t i = 0; i < found.items.size(); ++i) {
    found.items[i].push_back({list->node[i], list->layer});
  }
  return found;
}

}  // namespace

Vec3 ConfigMap::Vector3(std::string_view key, const Range& each) const {
  const auto v = Numbers(key, each, 3, 3);
  return {v[0], v[1], v[2]};
}

Vec3 ConfigMap::Vector3(std::string_view key, const Range& each, const Vec3& otherwise) const {
  if (Has(key)) return Vector3(key, each);
  RecordNumbers(*node_, key, {otherwise.x(), otherwise.y(), otherwise.z()});
  return otherwise;
}

Vec2 ConfigMap::Vector2(std::string_view key, const Range& each) const {
  const auto v = Numbers(key, each, 2, 2);
  return {v[0], v[1]};
}

Vec2 ConfigMap::Vector2(std::string_view key, const Range& each, const Vec2& otherwise) const {
  if (Has(key)) return Vector2(key, each);
  RecordNumbers(*node_, key, {otherwise.x(), otherwise.y()});
  return otherwise;
}

std::vector<double> ConfigMap::Numbers(std::string_view key, const Range& each,
                                       std::size_t min_count, std::size_t max_count) const {
  const std::vector<double> harmless(min_count, Harmless(each));
  const auto values = FindAll(*node_, key);
  const std::string need =
      fmt::format("a list of {}{} numbers, each {}", min_count == max_count ? "" : "at least ",
                  min_count, Need(each));
  if (values.empty()) {
    if (min_count > 0) AddMissing(*node_, key, need);
    return harmless;
  }
  const auto found = ListAmong(*node_, key, values, need);
  if (!found) return harmless;
  if (found->items.size() < min_count || found->items.size() > max_count) {
    AddFault(*node_, key, found->list, fault::Mistyped(Shown(found->list.node), need));
    return harmless;
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const auto number =
        NumberAt(*node_, fmt::format("{}[{}]", key, i), found->items[i].front(), each);
    numbers.push_back(number.value_or(Harmless(each)));
  }
  RecordNumbers(*node_, key, numbers);
  return numbers;
}

std::vector<std::vector<double>> ConfigMap::NumberRows(std::string_view key, const Range& each,
                                                       std::size_t columns,
                                                       std::size_t min_rows) const {
  const std::vector<double> harmless(columns, Harmless(each));
  const std::string need = fmt::format("a list of at least {} rows of {} numbers, each {}",
                                       min_rows, columns, Need(each));
  const auto values = FindAll(*node_, key);
  std::vector<std::vector<double>> rows;
  if (values.empty()) {
    if (min_rows > 0) AddMissing(*node_, key, need);
    return {min_rows, harmless};
  }
  const auto found = ListAmong(*node_, key, values, need);
  if (!found) return {min_rows, harmless};
  if (found->items.size() < min_rows) {
    AddFault(*node_, key, found->list, fault::Mistyped(Shown(found->list.node), need));
    return {min_rows, harmless};
  }
  const std::string row_need = fmt::format("{} numbers, each {}", columns, Need(each));
  YAML::Node resolved(YAML::NodeType::Sequence);
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const std::string row_key = fmt::format("{}[{}]", key, i);
    const auto row = ListAmong(*node_, row_key, found->items[i], row_need);
    if (row && row->items.size() != columns) {
      AddFault(*node_, row_key, row->list, fault::Mistyped(Shown(row->list.node), row_need));
    }
    std::vector<double> numbers = harmless;
    YAML::Node resolved_row(YAML::NodeType::Sequence);
    resolved_row.SetStyle(YAML::EmitterStyle::Flow);
    for (std::size_t k = 0; k < columns; ++k) {
      if (row && row->items.size() == columns) {
        const auto number =
            NumberAt(*node_, fmt::format("{}[{}]", row_key, k), row->items[k].front(), each);
        numbers[k] = number.value_or(harmless[k]);
      }
      resolved_row.push_back(NumberText(numbers[k]));
    }
    rows.push_back(std::move(numbers));
    resolved.push_back(resolved_row);
  }
  node_->resolved[std::string(key)] = resolved;
  return rows;
}

std::vector<std::string> ConfigMap::YamlItems(std::string_view key) const {
  const auto found = internal::Find(*node_, key);
  std::vector<std::string> items;
  if (!found) {
    internal::AddMissing(*node_, key, "a list");
  } else if (!found->node.IsSequence()) {
    AddFault(*node_, key, *found, fault::Mistyped(Shown(found->node), "a list"));
  } else {
    for (const auto& item : found->node) items.push_back(internal::OnOneLine(item));
  }
  return items;
}

std::vector<std::string> ConfigMap::Texts(std::string_view key) const {
  const auto values = FindAll(*node_, key);
  std::vector<std::string> texts;
  if (values.empty()) return texts;
  const auto found = ListAmong(*node_, key, values, "a list of texts");
  if (!found) return texts;
  YAML::Node list(YAML::NodeType::Sequence);
  list.SetStyle(YAML::EmitterStyle::Flow);
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const Found& item = found->items[i].front();
    if (!item.node.IsScalar()) {
      AddFault(*node_, fmt::format("{}[{}]", key, i), item, fault::NotAText(Shown(item.node)));
      continue;
    }
    texts.push_back(item.node.Scalar());
    list.push_back(item.node.Scalar());
  }
  node_->resolved[std::string(key)] = list;
  return texts;
}

Pose ConfigMap::PoseXyzRpy() const {
  const Vec3 xyz_m = Vector3("xyz_m", Any("m"), Vec3::Zero());
  const Vec3 rpy_rad = Vector3("rpy_deg", Between(-360, 360, "deg"), Vec3::Zero()) * kDeg;
  return MakePose(xyz_m, rpy_rad.x(), rpy_rad.y(), rpy_rad.z());
}
bool ConfigMap::IsList(std::string_view key) const {
  const auto values = FindAll(*node_, key);
  const auto whole = std::find_if(values.begin(), values.end(),
                                  [](const Found& value) { return !value.node.IsMap(); });
  return whole != values.end() && whole->node.IsSequence();
}

bool ConfigMap::IsText(std::string_view key) const {
  const auto found = Find(*node_, key);
  return found && found->node.IsScalar();
}

std::vector<ConfigMap> ConfigMap::List(std::string_view key) const {
  std::vector<ConfigMap> maps;
  YAML::Node resolved(YAML::NodeType::Sequence);
  node_->resolved[std::string(key)] = resolved;
  const auto values = FindAll(*node_, key);
  if (values.empty()) return maps;
  const auto found = ListAmong(*node_, key, values, "a list of mappings");
  if (!found) return maps;
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const std::string item_key = fmt::format("{}[{}]", key, i);
    std::vector<Layer> layers;
    for (const Found& part : found->items[i]) {
      if (part.node.IsMap()) {
        layers.push_back({part.node, part.layer->file, part.layer->directory,
                          internal::Join(part.layer->path, item_key), false, part.layer->is_patch});
      } else {
        AddFault(*node_, item_key, part, fault::Mistyped(Shown(part.node), "a mapping of keys"));
      }
    }
    if (layers.empty()) continue;
    auto child = node_->document->AddNode(layers);
    resolved.push_back(child->resolved);
    maps.push_back(ConfigMap(child));
  }
  return maps;
}
}  // namespace tera
