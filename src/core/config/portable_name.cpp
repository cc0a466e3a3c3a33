#include "core/config/portable_name.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "core/config/config.h"
#include "core/config/config_layers.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kShipped = "tera:";
/// Folders of the source tree that an installation also has.
constexpr std::array<std::string_view, 4> kShippedFolders = {"assets", "config", "examples",
                                                             "shaders"};

bool IsShipped(const fs::path& relative) {
  return !relative.empty() && std::find(kShippedFolders.begin(), kShippedFolders.end(),
                                        relative.begin()->string()) != kShippedFolders.end();
}

}  // namespace

std::string PortableName(const fs::path& path) {
  std::error_code error;
  const fs::path plain = fs::absolute(path, error).lexically_normal();
  if (error) return path.generic_string();
  const fs::path absolute = internal::Canonical(plain.parent_path()) / plain.filename();
  for (const fs::path& relative :
       {plain.lexically_relative(DataRoot()),  // the path as written, if a folder on it is a link
        absolute.lexically_relative(internal::Canonical(DataRoot()))}) {
    if (IsShipped(relative)) return std::string(kShipped) + relative.generic_string();
  }
  return absolute.generic_string();
}

bool Concerns(const MovedFiles& moved, const std::string& name) {
  if (moved.from.empty() || !name.starts_with(moved.from)) return false;
  // the prefix ends at a folder boundary
  const bool ends = moved.from.ends_with('/') || moved.from == kShipped;
  return ends || name.size() == moved.from.size() || name[moved.from.size()] == '/';
}

fs::path PlaceOfInput(const std::string& name, const std::vector<MovedFiles>& moved) {
  for (const MovedFiles& move : moved) {
    if (!Concerns(move, name)) continue;
    const std::string below = name.substr(move.from.size());
    return below.empty() ? move.to : move.to / below.substr(below.find_first_not_of('/'));
  }
  return internal::Resolve(name, {});
}

}  // namespace tera
