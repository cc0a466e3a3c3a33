#pragma once

#include <string>

namespace tera {

/// The head and the style of a page of layouts, up to its contents; no network is needed.
std::string PageBegin(const std::string& title);
std::string PageEnd();

/// What the colours of MapSvg mean, for a page.
std::string MapLegend();

}  // namespace tera
