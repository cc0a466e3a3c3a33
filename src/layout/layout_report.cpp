#include "layout/layout_report.h"

#include <algorithm>

namespace tera {

const Figure* FindFigure(const LayoutReport& report, const std::string& name) {
  const auto found = std::find_if(report.figures.begin(), report.figures.end(),
                                  [&](const Figure& figure) { return figure.name == name; });
  return found == report.figures.end() ? nullptr : &*found;
}

}  // namespace tera
