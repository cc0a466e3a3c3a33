#include "core/config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "core/check.h"
#include "core/error.h"
#include "core/spelling.h"
#include "core/units.h"

namespace tera {
namespace fs = std::filesystem;
namespace internal {

/// One source of a mapping: a YAML node, the file it stands in (for messages and relative paths).
struct Layer {
  YAML::Node node;
  std::string file;
  fs::path directory;
};

struct ConfigNode {
  ConfigDocument* document = nullptr;
  std::string path;           ///< key path from the root, "machines[0].sensors[2]"
  std::vector<Layer> layers;  ///< first wins
  YAML::Node resolved{YAML::NodeType::Map};
  std::set<std::string> asked;  ///< every key the reader knows
  std::map<std::string, std::shared_ptr<ConfigNode>, std::less<>>
      children;  ///< mappings handed out
};

struct ConfigDocument {
  std::vector<std::string> faults;
  std::vector<std::shared_ptr<ConfigNode>> nodes;
  std::shared_ptr<ConfigNode> root;

  std::shared_ptr<ConfigNode> AddNode(std::string path, std::vector<Layer> layers) {
    auto node = std::make_shared<ConfigNode>();
    node->document = this;
    node->path = std::move(path);
    node->layers = std::move(layers);
    nodes.push_back(node);
    return node;
  }
};

namespace {

/// Stands for a file's name in the messages about overrides, which have no lines.
constexpr char kOverlayName[] = "--set";

std::string PlaceOf(const YAML::Node& node, const std::string& file) {
  const YAML::Mark mark = node.Mark();
  if (mark.is_null() || file == kOverlayName) return file;
  return fmt::format("{}:{}:{}", file, mark.line + 1, mark.column + 1);
}

std::string Join(const std::string& path, std::string_view key) {
  if (path.empty()) return std::string(key);
  return key.empty() ? path : fmt::format("{}.{}", path, key);
}

struct Found {
  YAML::Node node;
  const Layer* layer = nullptr;
};

/// The value of `key` in the first layer that has it. yaml-cpp's operator[] is avoided: on a
/// const node it throws for absent keys, on a mutable one it may insert.
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

void AddFault(ConfigNode& node, std::string_view key, const std::string& place,
              const std::string& finding) {
  const std::string path = Join(node.path, key);
  node.document->faults.push_back(path.empty() ? fmt::format("{}: {}", place, finding)
                                               : fmt::format("{}: {}: {}", place, path, finding));
}

void AddFault(ConfigNode& node, std::string_view key, const Found& found,
              const std::string& finding) {
  AddFault(node, key, PlaceOf(found.node, found.layer->file), finding);
}

void AddMissing(ConfigNode& node, std::string_view key, const std::string& need) {
  const Layer& layer = node.layers.back();
  AddFault(node, key, PlaceOf(layer.node, layer.file), fmt::format("missing, need {}", need));
}

std::string Shown(const YAML::Node& node) {
  if (node.IsScalar()) return fmt::format("'{}'", node.Scalar());
  if (node.IsSequence()) return fmt::format("a list of {}", node.size());
  if (node.IsMap()) return "a mapping";
  return "nothing";
}

std::string Need(const Range& range) {
  const std::string unit = range.unit.empty() || range.unit == "1" ? "" : " " + range.unit;
  const bool has_min = std::isfinite(range.min), has_max = std::isfinite(range.max);
  if (has_min && has_max && range.min_excluded) {
    return fmt::format("more than {0}{2}, at most {1}{2}", range.min, range.max, unit);
  }
  if (has_min && has_max) return fmt::format("{} to {}{}", range.min, range.max, unit);
  if (has_min) {
    return fmt::format("{} {}{}", range.min_excluded ? "more than" : "at least", range.min, unit);
  }
  if (has_max) return fmt::format("at most {}{}", range.max, unit);
  return fmt::format("a number{}", unit.empty() ? "" : " in" + unit);
}

bool Contains(const Range& range, double value) {
  return std::isfinite(value) && value <= range.max &&
         (range.min_excluded ? value > range.min : value >= range.min);
}

std::optional<double> ParseNumber(const std::string& text) {
  double value = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(begin, end, value);
  if (status != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// The number at `found`, or a fault and nothing.
std::optional<double> NumberAt(ConfigNode& node, std::string_view key, const Found& found,
                               const Range& range) {
  const auto value = found.node.IsScalar() ? ParseNumber(found.node.Scalar()) : std::nullopt;
  if (!value) {
    AddFault(node, key, found,
             fmt::format("{} is not a number, need {}", Shown(found.node), Need(range)));
    return std::nullopt;
  }
  if (!Contains(range, *value)) {
    AddFault(node, key, found,
             fmt::format("{} is out of range, need {}", found.node.Scalar(), Need(range)));
    return std::nullopt;
  }
  return value;
}

/// A value within the range, for reading on after a fault.
double Harmless(const Range& range) {
  if (Contains(range, 1.0)) return 1.0;
  if (std::isfinite(range.min) && std::isfinite(range.max)) return 0.5 * (range.min + range.max);
  return std::isfinite(range.min) ? range.min + 1.0 : range.max - 1.0;
}

std::string NumberText(double value) { return fmt::format("{}", value); }

void Record(ConfigNode& node, std::string_view key, const std::string& scalar) {
  node.resolved[std::string(key)] = scalar;
}

void RecordNumbers(ConfigNode& node, std::string_view key, const std::vector<double>& values) {
  YAML::Node list(YAML::NodeType::Sequence);
  list.SetStyle(YAML::EmitterStyle::Flow);
  for (const double v : values) list.push_back(NumberText(v));
  node.resolved[std::string(key)] = list;
}

YAML::Node LoadYaml(const fs::path& file, const std::string& shown, const std::string& context) {
  std::ifstream stream(file);
  if (!stream) {
    throw InputError(
        fmt::format("{}{}: cannot be read; need a readable YAML file", context, shown));
  }
  std::stringstream text;
  text << stream.rdbuf();
  try {
    YAML::Node node = YAML::Load(text.str());
    if (!node.IsMap()) {
      throw InputError(fmt::format("{}{}:1:1: need a mapping of keys at the top", context, shown));
    }
    return node;
  } catch (const YAML::Exception& e) {
    throw InputError(fmt::format("{}{}:{}:{}: not valid YAML: {}", context, shown, e.mark.line + 1,
                                 e.mark.column + 1, e.msg));
  }
}

fs::path Resolve(const std::string& text, const fs::path& directory) {
  if (text.starts_with("tera:")) return DataRoot() / text.substr(5);
  const fs::path path(text);
  return path.is_absolute() ? path : directory / path;
}

/// Is there a file that can be opened? Not where the name is too long or links go in a circle.
bool IsFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// The path without links, or as it stands where it cannot be followed.
fs::path Canonical(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  return error ? path.lexically_normal() : canonical;
}

/// The form of a path that means the same on another machine where that is possible.
std::string Portable(const fs::path& path) {
  const fs::path absolute = Canonical(path);
  const fs::path relative = absolute.lexically_relative(Canonical(DataRoot()));
  if (!relative.empty() && *relative.begin() != "..") return "tera:" + relative.generic_string();
  return absolute.generic_string();
}

std::string ShownName(const fs::path& path) {
  const fs::path relative = Canonical(path).lexically_relative(fs::current_path());
  return !relative.empty() && *relative.begin() != ".." ? relative.generic_string()
                                                        : path.lexically_normal().generic_string();
}

/// What paths of a layer are relative to, for messages.
std::string BaseOf(const Layer& layer) {
  return layer.file == kOverlayName ? "the working directory" : layer.file;
}

/// Loads the file that `found` names as a layer, or reports a fault.
std::optional<Layer> LoadLayer(ConfigNode& node, std::string_view key, const Found& found) {
  const fs::path path = Resolve(found.node.Scalar(), found.layer->directory);
  if (!IsFile(path)) {
    AddFault(node, key, found,
             fmt::format("file '{}' does not exist; correct the path (relative to {}, or "
                         "'tera:...' for a file that TERA ships)",
                         found.node.Scalar(), BaseOf(*found.layer)));
    return std::nullopt;
  }
  const std::string shown = ShownName(path);
  try {
    return Layer{LoadYaml(path, shown, ""), shown, path.parent_path()};
  } catch (const InputError& e) {
    node.document->faults.push_back(e.what());
    return std::nullopt;
  }
}

bool IsIndex(std::string_view text) {
  const bool digits = !text.empty() && std::all_of(text.begin(), text.end(),
                                                   [](char c) { return c >= '0' && c <= '9'; });
  return digits && (text == "0" || text.front() != '0');
}

/// The keys of `a.b[2].c`: a, b, 2 and c. Nothing where the path is not of that form.
std::vector<std::string> KeysOf(std::string_view path) {
  std::vector<std::string> keys;
  for (std::size_t at = 0; at < path.size();) {
    const bool index = path[at] == '[';
    const std::size_t begin = index || (path[at] == '.' && at > 0) ? at + 1 : at;
    const std::size_t end = std::min(path.find_first_of(index ? "]" : ".[", begin), path.size());
    const std::string_view key = path.substr(begin, end - begin);
    const bool needs_point = !index && at > 0 && path[at] != '.';
    if (index ? !IsIndex(key) || end == path.size() || at == 0
              : key.empty() || needs_point || key.find(']') != key.npos) {
      return {};
    }
    keys.emplace_back(key);
    at = index ? end + 1 : end;
  }
  return keys;
}

/// Parses `a.b[2].c=value` into nested mappings, list items as mappings keyed by index.
Layer OverrideLayer(const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto keys = KeysOf(std::string_view(text).substr(0, equals));
  if (equals == std::string::npos || keys.empty()) {
    throw InputError(
        fmt::format("--set {}: need key.path=value, items of lists as key[0]=value", text));
  }
  YAML::Node value;
  try {
    value = YAML::Load(text.substr(equals + 1));
  } catch (const YAML::Exception& e) {
    throw InputError(fmt::format("--set {}: not a YAML value: {}", text, e.msg));
  }
  for (auto key = keys.rbegin(); key != keys.rend(); ++key) {
    YAML::Node map(YAML::NodeType::Map);
    map[*key] = value;
    value.reset(map);
  }
  return {value, kOverlayName, fs::current_path()};
}

/// The overrides, the last first, above `file`.
std::vector<Layer> LayersAbove(const Layer& file, const std::vector<std::string>& overrides) {
  std::vector<Layer> layers;
  for (auto text = overrides.rbegin(); text != overrides.rend(); ++text) {
    layers.push_back(OverrideLayer(*text));
  }
  layers.push_back(file);
  return layers;
}

/// Values of `key` in all layers that have it, first wins.
std::vector<Found> FindAll(ConfigNode& node, std::string_view key) {
  node.asked.emplace(key);
  std::vector<Found> all;
  for (const Layer& layer : node.layers) {
    if (auto value = ValueIn(layer.node, key)) all.push_back({*value, &layer});
  }
  return all;
}

/// A list, and what each of its items is made of, first wins.
struct FoundList {
  Found list;
  std::vector<std::vector<Found>> items;
};

/// The first list among `values`. Mappings above it are patches, which address items by index:
/// {2: {rate_hz: 5}}. Other values are a fault, and nothing.
std::optional<FoundList> ListAmong(ConfigNode& node, std::string_view key,
                                   const std::vector<Found>& values, const std::string& need) {
  const auto list = std::find_if(values.begin(), values.end(),
                                 [](const Found& value) { return !value.node.IsMap(); });
  if (list == values.end() || !list->node.IsSequence()) {
    const Found& wrong = list == values.end() ? values.back() : *list;
    const bool patch = wrong.layer->file == kOverlayName && wrong.node.IsMap();
    AddFault(node, key, wrong,
             fmt::format("{} found, need {}",
                         patch ? "an item of a list that is not there" : Shown(wrong.node), need));
    return std::nullopt;
  }
  FoundList found{*list, std::vector<std::vector<Found>>(list->node.size())};
  for (auto patch = values.begin(); patch != list; ++patch) {
    for (const auto& entry : patch->node) {
      const std::string index = entry.first.Scalar();
      const auto number = IsIndex(index) ? ParseNumber(index) : std::nullopt;
      if (number && *number < static_cast<double>(found.items.size())) {
        found.items[static_cast<std::size_t>(*number)].push_back({entry.second, patch->layer});
      } else {
        AddFault(node, key, *patch,
                 fmt::format("no item [{}], the list has {}", index, found.items.size()));
      }
    }
  }
  for (std::size_t i = 0; i < found.items.size(); ++i) {
    found.items[i].push_back({list->node[i], list->layer});
  }
  return found;
}

/// Keys of all layers: those of the lowest first, then what each layer above it adds.
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

}  // namespace
}  // namespace internal

using internal::AddFault;
using internal::AddMissing;
using internal::Find;
using internal::Found;
using internal::Harmless;
using internal::Layer;
using internal::Need;
using internal::NumberAt;
using internal::NumberText;
using internal::Record;
using internal::Shown;

Range Any(std::string unit) { return {.unit = std::move(unit)}; }
Range Positive(std::string unit) {
  return {.min = 0, .min_excluded = true, .unit = std::move(unit)};
}
Range AtLeast(double min, std::string unit) { return {.min = min, .unit = std::move(unit)}; }
Range Between(double min, double max, std::string unit) {
  return {.min = min, .max = max, .unit = std::move(unit)};
}

double ConfigMap::Number(std::string_view key, const Range& range) const {
  const auto value = OptionalNumber(key, range);
  if (value) return *value;
  if (!Has(key)) AddMissing(*node_, key, Need(range));
  return Harmless(range);
}

double ConfigMap::Number(std::string_view key, const Range& range, double otherwise) const {
  if (const auto value = OptionalNumber(key, range)) return *value;
  Record(*node_, key, NumberText(otherwise));
  return otherwise;
}

std::optional<double> ConfigMap::OptionalNumber(std::string_view key, const Range& range) const {
  const auto found = Find(*node_, key);
  if (!found) return std::nullopt;
  const auto value = NumberAt(*node_, key, *found, range);
  if (!value) return Harmless(range);
  Record(*node_, key, NumberText(*value));
  return value;
}

std::int64_t ConfigMap::Integer(std::string_view key, const Range& range) const {
  const double value = Number(key, range);
  if (value != std::floor(value)) Fault(key, fmt::format("{} is not a whole number", value));
  return std::llround(value);
}

std::int64_t ConfigMap::Integer(std::string_view key, const Range& range,
                                std::int64_t otherwise) const {
  if (Has(key)) return Integer(key, range);
  Record(*node_, key, fmt::format("{}", otherwise));
  return otherwise;
}

bool ConfigMap::Boolean(std::string_view key, bool otherwise) const {
  const auto found = Find(*node_, key);
  bool value = otherwise;
  if (found && !YAML::convert<bool>::decode(found->node, value)) {
    AddFault(*node_, key, *found, fmt::format("{} is neither true nor false", Shown(found->node)));
    value = otherwise;
  }
  Record(*node_, key, value ? "true" : "false");
  return value;
}

std::string ConfigMap::Text(std::string_view key) const {
  const auto found = Find(*node_, key);
  if (!found) {
    AddMissing(*node_, key, "a text");
    return {};
  }
  if (!found->node.IsScalar() || found->node.Scalar().empty()) {
    AddFault(*node_, key, *found, fmt::format("{} is not a text", Shown(found->node)));
    return {};
  }
  Record(*node_, key, found->node.Scalar());
  return found->node.Scalar();
}

std::string ConfigMap::Text(std::string_view key, std::string_view otherwise) const {
  if (Has(key)) return Text(key);
  Record(*node_, key, std::string(otherwise));
  return std::string(otherwise);
}

std::string ConfigMap::Choice(std::string_view key,
                              std::initializer_list<std::string_view> allowed) const {
  if (!Has(key)) {
    AddMissing(*node_, key, fmt::format("one of {}", fmt::join(allowed, ", ")));
    return std::string(*allowed.begin());
  }
  const std::string value = Text(key);
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return value;
  if (!value.empty()) {
    Fault(key, fmt::format("'{}' is not known, need one of {}{}", value, fmt::join(allowed, ", "),
                           DidYouMean(value, {allowed.begin(), allowed.end()})));
  }
  return std::string(*allowed.begin());
}

std::string ConfigMap::Choice(std::string_view key, std::initializer_list<std::string_view> allowed,
                              std::string_view otherwise) const {
  if (Has(key)) return Choice(key, allowed);
  Record(*node_, key, std::string(otherwise));
  return std::string(otherwise);
}

Vec3 ConfigMap::Vector3(std::string_view key, const Range& each) const {
  const auto v = Numbers(key, each, 3, 3);
  return {v[0], v[1], v[2]};
}

Vec3 ConfigMap::Vector3(std::string_view key, const Range& each, const Vec3& otherwise) const {
  if (Has(key)) return Vector3(key, each);
  internal::RecordNumbers(*node_, key, {otherwise.x(), otherwise.y(), otherwise.z()});
  return otherwise;
}

Vec2 ConfigMap::Vector2(std::string_view key, const Range& each) const {
  const auto v = Numbers(key, each, 2, 2);
  return {v[0], v[1]};
}

Vec2 ConfigMap::Vector2(std::string_view key, const Range& each, const Vec2& otherwise) const {
  if (Has(key)) return Vector2(key, each);
  internal::RecordNumbers(*node_, key, {otherwise.x(), otherwise.y()});
  return otherwise;
}

std::vector<double> ConfigMap::Numbers(std::string_view key, const Range& each,
                                       std::size_t min_count, std::size_t max_count) const {
  const std::vector<double> harmless(min_count, Harmless(each));
  const auto values = internal::FindAll(*node_, key);
  const std::string need =
      fmt::format("a list of {}{} numbers, each {}", min_count == max_count ? "" : "at least ",
                  min_count, Need(each));
  if (values.empty()) {
    if (min_count > 0) AddMissing(*node_, key, need);
    return harmless;
  }
  const auto found = internal::ListAmong(*node_, key, values, need);
  if (!found) return harmless;
  if (found->items.size() < min_count || found->items.size() > max_count) {
    AddFault(*node_, key, found->list,
             fmt::format("{} found, need {}", Shown(found->list.node), need));
    return harmless;
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const auto number =
        NumberAt(*node_, fmt::format("{}[{}]", key, i), found->items[i].front(), each);
    numbers.push_back(number.value_or(Harmless(each)));
  }
  internal::RecordNumbers(*node_, key, numbers);
  return numbers;
}

std::vector<std::vector<double>> ConfigMap::NumberRows(std::string_view key, const Range& each,
                                                       std::size_t columns,
                                                       std::size_t min_rows) const {
  const std::vector<double> harmless(columns, Harmless(each));
  const std::string need = fmt::format("a list of at least {} rows of {} numbers, each {}",
                                       min_rows, columns, Need(each));
  const auto values = internal::FindAll(*node_, key);
  std::vector<std::vector<double>> rows;
  if (values.empty()) {
    if (min_rows > 0) AddMissing(*node_, key, need);
    return {min_rows, harmless};
  }
  const auto found = internal::ListAmong(*node_, key, values, need);
  if (!found) return {min_rows, harmless};
  if (found->items.size() < min_rows) {
    AddFault(*node_, key, found->list,
             fmt::format("{} found, need {}", Shown(found->list.node), need));
    return {min_rows, harmless};
  }
  const std::string row_need = fmt::format("{} numbers, each {}", columns, Need(each));
  YAML::Node resolved(YAML::NodeType::Sequence);
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const std::string row_key = fmt::format("{}[{}]", key, i);
    const auto row = internal::ListAmong(*node_, row_key, found->items[i], row_need);
    if (row && row->items.size() != columns) {
      AddFault(*node_, row_key, row->list,
               fmt::format("{} found, need {}", Shown(row->list.node), row_need));
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

std::vector<std::string> ConfigMap::Texts(std::string_view key) const {
  const auto values = internal::FindAll(*node_, key);
  std::vector<std::string> texts;
  if (values.empty()) return texts;
  const auto found = internal::ListAmong(*node_, key, values, "a list of texts");
  if (!found) return texts;
  YAML::Node list(YAML::NodeType::Sequence);
  list.SetStyle(YAML::EmitterStyle::Flow);
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const Found& item = found->items[i].front();
    if (!item.node.IsScalar()) {
      AddFault(*node_, fmt::format("{}[{}]", key, i), item,
               fmt::format("{} is not a text", Shown(item.node)));
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

bool ConfigMap::Has(std::string_view key) const { return Find(*node_, key).has_value(); }

bool ConfigMap::IsList(std::string_view key) const {
  const auto values = internal::FindAll(*node_, key);
  const auto whole = std::find_if(values.begin(), values.end(),
                                  [](const Found& value) { return !value.node.IsMap(); });
  return whole != values.end() && whole->node.IsSequence();
}

namespace internal {
namespace {

/// Layers of the mapping at `key`: the overlaying patches and every layer's own mapping.
std::vector<Layer> LayersOf(ConfigNode& node, std::string_view key) {
  node.asked.emplace(key);
  std::vector<Layer> layers;
  for (const Layer& layer : node.layers) {
    const auto value = ValueIn(layer.node, key);
    if (!value) continue;
    if (value->IsMap()) {
      layers.push_back({*value, layer.file, layer.directory});
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
}  // namespace internal

ConfigMap ConfigMap::Map(std::string_view key) const {
  if (const auto known = node_->children.find(key); known != node_->children.end()) {
    return ConfigMap(known->second);
  }
  if (!Has(key)) AddMissing(*node_, key, "a mapping of keys");
  return ConfigMap(internal::AddChild(*node_, key, internal::LayersOf(*node_, key)));
}

std::optional<ConfigMap> ConfigMap::OptionalMap(std::string_view key) const {
  if (!Has(key)) return std::nullopt;
  return Map(key);
}

ConfigMap ConfigMap::MapOrFile(std::string_view key) const {
  if (const auto known = node_->children.find(key); known != node_->children.end()) {
    return ConfigMap(known->second);
  }
  if (!Has(key)) AddMissing(*node_, key, "a YAML file's path, or a mapping of keys");
  std::vector<Layer> layers;
  for (const Layer& layer : node_->layers) {
    const auto value = internal::ValueIn(layer.node, key);
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
  return ConfigMap(internal::AddChild(*node_, key, std::move(layers)));
}

std::vector<ConfigMap> ConfigMap::List(std::string_view key) const {
  std::vector<ConfigMap> maps;
  YAML::Node resolved(YAML::NodeType::Sequence);
  node_->resolved[std::string(key)] = resolved;
  const auto values = internal::FindAll(*node_, key);
  if (values.empty()) return maps;
  const auto found = internal::ListAmong(*node_, key, values, "a list of mappings");
  if (!found) return maps;
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const std::string item_key = fmt::format("{}[{}]", key, i);
    std::vector<Layer> layers;
    for (const Found& part : found->items[i]) {
      if (part.node.IsMap()) {
        layers.push_back({part.node, part.layer->file, part.layer->directory});
      } else {
        AddFault(*node_, item_key, part,
                 fmt::format("{} found, need a mapping of keys", Shown(part.node)));
      }
    }
    if (layers.empty()) continue;
    auto child = node_->document->AddNode(internal::Join(node_->path, item_key), layers);
    resolved.push_back(child->resolved);
    maps.push_back(ConfigMap(child));
  }
  return maps;
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

void ConfigMap::ApplyPreset(std::string_view key) const {
  std::set<fs::path> applied;
  for (auto found = Find(*node_, key); found;) {
    if (!found->node.IsScalar()) {
      AddFault(*node_, key, *found,
               fmt::format("{} found, need a file's path", Shown(found->node)));
      return;
    }
    const fs::path file = internal::Resolve(found->node.Scalar(), found->layer->directory);
    if (!applied.insert(internal::Canonical(file)).second) {
      AddFault(*node_, key, *found,
               fmt::format("'{}' is a preset of itself; leave the key out of one of the files",
                           found->node.Scalar()));
      return;
    }
    const auto layer = internal::LoadLayer(*node_, key, *found);
    if (!layer) return;
    node_->layers.push_back(*layer);
    const auto next = internal::ValueIn(layer->node, key);
    found = next ? std::optional(Found{*next, &node_->layers.back()}) : std::nullopt;
  }
}

fs::path ConfigMap::File(std::string_view key) const {
  const auto found = Find(*node_, key);
  if (!found) {
    AddMissing(*node_, key, "a file's path");
    return {};
  }
  if (!found->node.IsScalar()) {
    AddFault(*node_, key, *found, fmt::format("{} found, need a file's path", Shown(found->node)));
    return {};
  }
  const fs::path path = internal::Resolve(found->node.Scalar(), found->layer->directory);
  if (!internal::IsFile(path)) {
    AddFault(*node_, key, *found,
             fmt::format("file '{}' does not exist; correct the path (relative to {}, or "
                         "'tera:...' for a file that TERA ships)",
                         found->node.Scalar(), internal::BaseOf(*found->layer)));
    return {};
  }
  Record(*node_, key, internal::Portable(path));
  return path.lexically_normal();
}

std::optional<fs::path> ConfigMap::OptionalFile(std::string_view key) const {
  if (!Has(key)) return std::nullopt;
  return File(key);
}

void ConfigMap::Fault(std::string_view key, const std::string& finding) const {
  if (const auto found = key.empty() ? std::nullopt : Find(*node_, key)) {
    AddFault(*node_, key, *found, finding);
  } else {
    const Layer& layer = node_->layers.back();
    AddFault(*node_, key, internal::PlaceOf(layer.node, layer.file), finding);
  }
}

std::string ConfigMap::Place(std::string_view key) const {
  const std::string path = internal::Join(node_->path, key);
  const auto found = key.empty() ? std::nullopt : Find(*node_, key);
  const Layer& layer = found ? *found->layer : node_->layers.back();
  const std::string place = internal::PlaceOf(found ? found->node : layer.node, layer.file);
  return path.empty() ? place : fmt::format("{}: {}", place, path);
}

Config Config::FromFile(const fs::path& file, const std::vector<std::string>& overrides) {
  const std::string shown = internal::ShownName(file);
  if (!internal::IsFile(file)) {
    throw InputError(fmt::format("{}: no such file; need a YAML file", shown));
  }
  auto document = std::make_shared<internal::ConfigDocument>();
  const Layer layer{internal::LoadYaml(file, shown, ""), shown, file.parent_path()};
  document->root = document->AddNode("", internal::LayersAbove(layer, overrides));
  return Config(document);
}

Config Config::FromText(const std::string& text, const std::string& name,
                        const std::vector<std::string>& overrides) {
  YAML::Node node;
  try {
    node = YAML::Load(text);
  } catch (const YAML::Exception& e) {
    throw InputError(fmt::format("{}:{}:{}: not valid YAML: {}", name, e.mark.line + 1,
                                 e.mark.column + 1, e.msg));
  }
  if (!node.IsMap()) throw InputError(fmt::format("{}:1:1: need a mapping of keys", name));
  auto document = std::make_shared<internal::ConfigDocument>();
  document->root = document->AddNode(
      "", internal::LayersAbove(Layer{node, name, fs::current_path()}, overrides));
  return Config(document);
}

ConfigMap Config::root() const { return ConfigMap(document_->root); }

void Config::Finish() const {
  std::vector<std::string> faults = document_->faults;
  std::set<std::string> seen_unknown;
  for (const auto& node : document_->nodes) {
    for (const Layer& layer : node->layers) {
      std::set<std::string> seen;
      for (const auto& entry : layer.node) {
        const std::string key = entry.first.Scalar();
        const std::string head = fmt::format("{}: {}: ", internal::PlaceOf(entry.first, layer.file),
                                             internal::Join(node->path, key));
        if (!seen.insert(key).second) {
          faults.push_back(head + "repeated key; keep one");
        } else if (!node->asked.contains(key)) {
          const std::vector<std::string> known(node->asked.begin(), node->asked.end());
          const std::string near = DidYouMean(key, known);
          const std::string fault = fmt::format(
              "{}unknown key{}", head,
              near.empty() ? fmt::format("; known here: {}", fmt::join(known, ", ")) : near);
          if (seen_unknown.insert(fault).second) faults.push_back(fault);
        }
      }
    }
  }
  if (!faults.empty()) throw InputError(fmt::format("{}", fmt::join(faults, "\n")));
}

std::string Config::ResolvedYaml() const {
  YAML::Emitter emitter;
  emitter << document_->root->resolved;
  return std::string(emitter.c_str()) + "\n";
}

fs::path DataRoot() {
  if (const char* directory = std::getenv("TERA_DATA_DIR")) return directory;
  // An installed program may have been moved with its data, whatever prefix it was built for.
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path beside = (program.parent_path() / TERA_DATA_FROM_BIN_DIR).lexically_normal();
  if (!program.empty() && fs::is_directory(beside / "shaders")) return beside;
  if (fs::is_directory(TERA_SOURCE_DATA_DIR)) return TERA_SOURCE_DATA_DIR;
  return TERA_INSTALL_DATA_DIR;
}

}  // namespace tera
