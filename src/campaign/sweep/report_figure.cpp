#include "campaign/sweep/report_figure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/config/spelling.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostNamed = 30;  ///< largest number of names in a message

/// A part of a path: a key, or the text within brackets.
struct Part {
  std::string text;
  bool is_item = false;
};

/// Keys are separated by dots. A dot within brackets belongs to the name.
std::vector<Part> PartsOf(const std::string& path) {
  std::vector<Part> parts;
  std::string word;
  const auto end_key = [&] {
    if (!word.empty()) parts.push_back({std::exchange(word, ""), false});
  };
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::size_t close = path[i] == '[' ? path.find(']', i) : std::string::npos;
    if (close != std::string::npos) {
      end_key();
      parts.push_back({path.substr(i + 1, close - i - 1), true});
      i = close;
    } else if (path[i] == '.') {
      end_key();
    } else {
      word += path[i];
    }
  }
  end_key();
  return parts;
}

std::string FirstText(const Json& item) {
  if (!item.is_object()) return "";
  for (const Json& value : item) {
    if (value.is_string()) return value;
  }
  return "";
}

bool HasText(const Json& item, const std::string& text) {
  return item.is_object() && std::any_of(item.begin(), item.end(), [&](const Json& value) {
           return value.is_string() && value == text;
         });
}

std::vector<std::string> NamesIn(const Json& node) {
  std::vector<std::string> names;
  if (node.is_object()) {
    for (const auto& [key, value] : node.items()) names.push_back(key);
  } else if (node.is_array()) {
    for (const Json& item : node) names.push_back(FirstText(item));
    const bool has_names = std::ranges::none_of(names, &std::string::empty);
    if (!has_names && !names.empty()) names = {fmt::format("0 to {}", node.size() - 1)};
  }
  return names;
}

const Json* Follow(const Json& node, const Part& part) {
  if (!part.is_item) {
    return node.is_object() && node.contains(part.text) ? &node[part.text] : nullptr;
  }
  if (!node.is_array()) return nullptr;
  std::size_t index = 0;
  const char* const end = part.text.data() + part.text.size();
  const auto [rest, error] = std::from_chars(part.text.data(), end, index);
  if (error == std::errc() && rest == end) return index < node.size() ? &node[index] : nullptr;
  const auto named =
      std::find_if(node.begin(), node.end(), [&](const Json& i) { return HasText(i, part.text); });
  return named != node.end() ? &*named : nullptr;
}

std::string Remedy(const Json& node, const std::string& word) {
  std::vector<std::string> names = NamesIn(node);
  if (names.empty()) return fmt::format("there is {} instead", node.dump().substr(0, 40));
  const std::string nearest = DidYouMean(word, names);
  const bool is_cut = names.size() > kMostNamed;
  if (is_cut) names.resize(kMostNamed);
  return fmt::format("need one of {}{}{}", fmt::join(names, ", "), is_cut ? ", ..." : "", nearest);
}

}  // namespace

double ReportFigure(const std::filesystem::path& report, const std::string& figure,
                    const std::string& place) {
  const Json root = Json::parse(ReadWholeFile(report), nullptr, false);
  if (root.is_discarded()) {
    throw InputError(report.string(),
                     {FaultKind::kMalformed, "is not JSON; need a report in JSON"});
  }
  const Json* node = &root;
  for (const Part& part : PartsOf(figure)) {
    const Json* const next = Follow(*node, part);
    if (next == nullptr) {
      throw InputError(place, {FaultKind::kNoSuchName,
                               fmt::format("'{}' names no figure of {}: no '{}'; {}", figure,
                                           report.string(), part.text, Remedy(*node, part.text))});
    }
    node = next;
  }
  if (!node->is_number() || !std::isfinite(node->get<double>())) {
    throw InputError(place,
                     {FaultKind::kMistyped, fmt::format("'{}' of {} is not a number; {}", figure,
                                                        report.string(), Remedy(*node, ""))});
  }
  return node->get<double>();
}

}  // namespace tera
