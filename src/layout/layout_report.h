#pragma once

#include <map>
#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/polar_map.h"

namespace tera {

/// What is known of one layout over a cycle.
struct LayoutReport {
  std::string name, file;
  std::string cycle;  ///< the dataset or scenario that it was looked at over
  /// SHA-256 of what was asked of what: the study and the cycle's scenario.
  std::string asked_sha256;
  std::vector<std::string> viewers;
  Expense expense;
  std::vector<double> t_s;  ///< of the moments
  std::vector<Figure> figures;
  std::vector<PolarMap> maps;
  std::vector<PolarCurve> curves;
  /// How far the machine reaches from above in each direction (HullRadii_m), the farthest over the
  /// cycle; empty where it is not known.
  std::vector<double> outline_m;
  /// Of each zone, what keeps its blind places from being seen, and how much pairs of viewers see
  /// together.
  std::map<std::string, std::map<std::string, double>> blind_causes, overlaps;
  std::vector<std::string> warnings;
};

/// Name of the shovel that digs: the first that carries soil, else the first; empty of none.
std::string DiggingShovel(const LayoutReport& report);

/// This figure, or null.
const Figure* FindFigure(const LayoutReport& report, const FigureId& id);

}  // namespace tera
