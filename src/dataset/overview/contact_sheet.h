#pragma once

#include <string>
#include <vector>

#include "dataset/overview/picture.h"

namespace tera {

/// One picture of many that are looked at together.
struct SheetTile {
  Picture picture;
  std::string title;
  std::vector<std::string> lines;  ///< below the picture, small
};

/// Tiles in as many columns as make the sheet about as wide as high, each with its title in the
/// picture and its lines below. All pictures have one size. Text that is too long is cut.
Picture ContactSheet(const std::vector<SheetTile>& tiles);

}  // namespace tera
