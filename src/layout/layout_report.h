#pragma once

#include <map>
#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/polar_map.h"

namespace tera {

/// Results of one layout over a cycle.
struct LayoutReport {
  std::string name, file;
  std::string cycle;  ///< dataset or scenario of the cycle
  /// SHA-256 over the study and the cycle's scenario.
  std::string asked_sha256;
  std::vector<std::string> viewers;
  Expense expense;
  std::vector<double> t_s;  ///< one per moment
  std::vector<Figure> figures;
  std::vector<PolarMap> maps;
  std::vector<PolarCurve> curves;
  /// Reach of the machine from above in each direction (HullRadii_m), the maximum over the cycle;
  /// empty if unknown.
  std::vector<double> outline_m;
  /// Per zone: the causes of its blind places, and the overlaps of pairs of viewers.
  std::map<std::string, std::map<std::string, double>> blind_causes, overlaps;
  std::vector<std::string> warnings;
};

/// Name of the shovel that digs: the first that carries soil, else the first; empty if there is
/// none.
std::string DiggingShovel(const LayoutReport& report);

/// The figure with this id, or null.
const Figure* FindFigure(const LayoutReport& report, const FigureId& id);

}  // namespace tera
