#pragma once

#include <string>

namespace tera {

/// Head and style of a layout page, up to its contents. It needs no network.
std::string PageBegin(const std::string& title);
std::string PageEnd();

/// Legend for the colours of MapSvg.
std::string MapLegend();

}  // namespace tera
