#pragma once

#include <string>
#include <vector>

#include "dataset/overview/picture.h"

namespace tera {

/// One picture of a contact sheet.
struct SheetTile {
  Picture picture;
  std::string title;
  std::vector<std::string> lines;  ///< below the picture, small
};

/// Arranges tiles in columns so that the sheet is about square. Each tile has its title in the
/// picture and its lines below. All pictures have one size. Long text is cut.
Picture ContactSheet(const std::vector<SheetTile>& tiles);

}  // namespace tera
