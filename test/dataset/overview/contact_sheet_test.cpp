#include "dataset/overview/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tera {
namespace {

SheetTile Tile(std::uint8_t grey, std::vector<std::string> lines) {
  SheetTile tile{.picture = Picture(160, 120, 3), .title = "t", .lines = std::move(lines)};
  std::fill(tile.picture.data.begin(), tile.picture.data.end(), grey);
  return tile;
}

/// Pixels of a grey in a sheet.
std::int64_t Count(const Picture& sheet, std::uint8_t grey) {
  return std::count(sheet.data.begin(), sheet.data.end(), grey) / 3;
}

TEST(ContactSheet, HasEveryPictureWholeButForItsTitle) {
  std::vector<SheetTile> tiles;
  for (int k = 0; k < 7; ++k) tiles.push_back(Tile(static_cast<std::uint8_t>(60 + 20 * k), {}));
  const Picture sheet = ContactSheet(tiles);
  for (int k = 0; k < 7; ++k) {
    const std::int64_t seen = Count(sheet, static_cast<std::uint8_t>(60 + 20 * k));
    EXPECT_GT(seen, 160 * 120 - 300) << k;  // a letter and its rim
    EXPECT_LE(seen, 160 * 120 + 50) << k;
  }
  // Seven of 164 x 124 px: two columns are 328 px wide and 496 px high, three 492 and 372.
  EXPECT_EQ(sheet.width_px, 2 * 164 + 4);
  EXPECT_EQ(sheet.height_px, 4 * 124 + 4);
}

TEST(ContactSheet, LinesStandBelowAndAreCutToThePicturesWidth) {
  const Picture bare = ContactSheet({Tile(100, {})});
  const Picture sheet = ContactSheet({Tile(100, {"a", std::string(500, 'w')})});
  EXPECT_EQ(sheet.width_px, bare.width_px);
  EXPECT_EQ(sheet.height_px, bare.height_px + 2 * 13);
  bool has_text = false;
  for (int y = bare.height_px; y < sheet.height_px; ++y) {
    for (int x = 0; x < sheet.width_px; ++x) {
      has_text = has_text || sheet.at(x, y, 0) > 150;
      if (x > 164) {
        EXPECT_LT(sheet.at(x, y, 0), 30);
      }
    }
  }
  EXPECT_TRUE(has_text);
}

}  // namespace
}  // namespace tera
