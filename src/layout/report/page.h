#pragma once

#include <string>

namespace tera {

/// HTML head and style of a layout page, up to the start of its contents. The page loads nothing
/// from the network.
std::string PageBegin(const std::string& title);
std::string PageEnd();

/// Legend for the colour scale of MapSvg.
std::string MapLegend();

}  // namespace tera
