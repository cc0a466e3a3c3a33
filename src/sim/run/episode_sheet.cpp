#include "sim/run/episode_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "sim/run/first_look.h"

namespace tera {
namespace {

constexpr int kTileWidth_px = 320, kTileHeight_px = 240;

/// Removes the lines that are equal in all tiles.
void KeepWhatDiffers(std::vector<SheetTile>* tiles) {
  if (tiles->size() < 2) return;
  const std::vector<std::string> first = tiles->front().lines;
  for (const std::string& line : first) {
    const auto has = [&](const SheetTile& tile) {
      return std::find(tile.lines.begin(), tile.lines.end(), line) != tile.lines.end();
    };
    if (!std::all_of(tiles->begin(), tiles->end(), has)) continue;
    for (SheetTile& tile : *tiles) std::erase(tile.lines, line);
  }
}

/// The last two names of a key path.
std::string EndOf(const std::string& key) {
  const std::size_t point = key.rfind('.');
  if (point == std::string::npos || point == 0) return key;
  const std::size_t before = key.rfind('.', point - 1);
  return before == std::string::npos ? key : key.substr(before + 1);
}

}  // namespace

std::string DrawnInShort(const std::string& drawn) {
  const std::size_t colon = drawn.find(": ");
  if (colon == std::string::npos) return drawn;
  const std::string name = EndOf(drawn.substr(0, colon)), yaml = drawn.substr(colon + 2);
  if (yaml.starts_with("[{")) {
    return fmt::format("{}: {} items", name, std::count(yaml.begin(), yaml.end(), '{'));
  }
  char* end = nullptr;
  const double number = std::strtod(yaml.c_str(), &end);
  const bool is_number = end != yaml.c_str() && *end == '\0';
  return fmt::format("{}: {}", name, is_number ? fmt::format("{:.4g}", number) : yaml);
}

void EpisodeSheet::Add(const Scenario& scenario, const EglOptions& egl) {
  SheetTile tile{.picture = FirstLook(scenario, kTileWidth_px, kTileHeight_px, egl),
                 .title = fmt::format("episode {}", tiles_.size()),
                 .lines = {}};
  for (const std::string& value : scenario.drawn) tile.lines.push_back(DrawnInShort(value));
  tiles_.push_back(std::move(tile));
}

Picture EpisodeSheet::Draw() const {
  std::vector<SheetTile> tiles = tiles_;
  KeepWhatDiffers(&tiles);
  return ContactSheet(tiles);
}

}  // namespace tera
