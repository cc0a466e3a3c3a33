#include "core/config/plain_name.h"

#include <fmt/format.h>

#include <algorithm>

namespace tera {
namespace {

bool IsPlain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

bool HasPlainLength(std::string_view name) { return !name.empty() && name.size() <= kLongestName; }

}  // namespace

bool IsPlainName(std::string_view name) {
  return HasPlainLength(name) && std::all_of(name.begin(), name.end(), IsPlain);
}

bool IsPlainNameWithPoints(std::string_view name) {
  return HasPlainLength(name) && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), [](char c) { return IsPlain(c) || c == '.'; });
}

std::string MadePlain(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_rest_of_sign = byte >= 0x80 && byte < 0xC0;  // UTF-8 continuation byte
    if (!is_rest_of_sign) plain += IsPlain(c) || (c == '.' && !plain.empty()) ? c : '_';
  }
  return plain;
}

bool RequirePlainName(const ConfigMap& config, std::string_view key, const std::string& name) {
  if (IsPlainName(name)) return true;
  if (name.empty() && !key.empty()) return false;  // ConfigMap::Text has already reported it
  config.Fault(key,
               {FaultKind::kMalformed,
                fmt::format("name '{}' cannot name a folder or a column; need letters, digits, "
                            "'_' and '-', at most {}",
                            name, kLongestName)});
  return false;
}

}  // namespace tera
