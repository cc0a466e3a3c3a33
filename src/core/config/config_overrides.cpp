#include <fmt/format.h>

#include <algorithm>

#include "core/config/config_layers.h"
#include "core/error.h"

/// Overrides: texts `key.path=value` that become layers above a file.

namespace tera::internal {
namespace fs = std::filesystem;
namespace {

/// Splits a path: `a.b[2].c` gives a, b, 2 and c. Empty for a malformed path.
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

Layer OverrideLayer(const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto value = equals == std::string::npos ? "" : text.substr(equals + 1);
  if (equals == std::string::npos || KeysOf(std::string_view(text).substr(0, equals)).empty()) {
    throw InputError("--set " + text, {FaultKind::kMalformed,
                                       "need key.path=value, items of lists as key[0]=value"});
  }
  try {
    return *PatchLayer(text.substr(0, equals), value, kOverlayName, fs::current_path());
  } catch (const YAML::Exception& e) {
    throw InputError("--set " + text, {FaultKind::kMalformed, "not a YAML value: " + e.msg});
  }
}

}  // namespace

bool IsIndex(std::string_view text) {
  const bool digits = !text.empty() && std::all_of(text.begin(), text.end(),
                                                   [](char c) { return c >= '0' && c <= '9'; });
  return digits && (text == "0" || text.front() != '0');
}

std::optional<Layer> PatchLayer(const std::string& path, const std::string& value,
                                const std::string& place, const fs::path& directory) {
  const auto keys = KeysOf(path);
  if (keys.empty()) return std::nullopt;
  YAML::Node node = YAML::Load(value);
  for (auto key = keys.rbegin(); key != keys.rend(); ++key) {
    YAML::Node map(YAML::NodeType::Map);
    map[*key] = node;
    node.reset(map);
  }
  return Layer{node, place, directory, "", false, true};
}

std::vector<Layer> LayersAbove(const Layer& file, const std::vector<std::string>& overrides) {
  std::vector<Layer> layers;
  for (auto text = overrides.rbegin(); text != overrides.rend(); ++text) {
    layers.push_back(OverrideLayer(*text));
  }
  layers.push_back(file);
  return layers;
}

}  // namespace tera::internal
