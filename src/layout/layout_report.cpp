#include "layout/layout_report.h"

#include <algorithm>

namespace tera {

std::string DiggingShovel(const LayoutReport& report) {
  for (const Measure measure : {Measure::kLoadSeen, Measure::kEdgeSeen}) {
    for (const Figure& figure : report.figures) {
      if (figure.id.measure == measure) return figure.id.of;
    }
  }
  return "";
}

const Figure* FindFigure(const LayoutReport& report, const FigureId& id) {
  const auto found = std::find_if(report.figures.begin(), report.figures.end(),
                                  [&](const Figure& figure) { return figure.id == id; });
  return found == report.figures.end() ? nullptr : &*found;
}

}  // namespace tera
