#pragma once

#include <string>
#include <vector>

#include "dataset/overview/picture.h"

namespace tera {

struct SheetTile {
  Picture picture;
  std::string title;
  std::vector<std::string> lines;  ///< small text below the image
};

/// Arranges tiles on an approximately square sheet. A tile has its title inside the image and its
/// lines below. All images must have the same size. Text that is too long is cut.
Picture ContactSheet(const std::vector<SheetTile>& tiles);

}  // namespace tera
