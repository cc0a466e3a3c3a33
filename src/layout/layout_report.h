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
  std::string cycle;  ///< path of the cycle's dataset or scenario
  /// SHA-256 of the study and of the cycle's scenario. Reports are comparable only if it is equal.
  std::string asked_sha256;
  std::vector<std::string> viewers;
  Expense expense;
  std::vector<double> t_s;  ///< times of the evaluated moments
  std::vector<Figure> figures;
  std::vector<PolarMap> maps;
  std::vector<PolarCurve> curves;
  /// Outline of the machine from above: HullRadii_m, its maximum over the cycle. Empty if unknown.
  std::vector<double> outline_m;
  /// For each zone: the share of its blind places by cause, and the overlap of each pair of
  /// viewers.
  std::map<std::string, std::map<std::string, double>> blind_causes, overlaps;
  std::vector<std::string> warnings;
};

/// Name of the digging shovel: the first that carries soil, else the first. Empty without a shovel.
std::string DiggingShovel(const LayoutReport& report);

/// The figure with this id, or null.
const Figure* FindFigure(const LayoutReport& report, const FigureId& id);

}  // namespace tera
