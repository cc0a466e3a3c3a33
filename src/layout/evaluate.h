#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/polar_map.h"
#include "layout/study/cycle.h"
#include "layout/study/study.h"

namespace tera {

/// What is to be known of one layout over a cycle.
struct LayoutReport {
  std::string name;
  std::filesystem::path file;
  std::vector<std::string> viewers;
  Expense expense;
  std::vector<double> t_s;  ///< of the moments
  std::vector<Figure> figures;
  std::vector<PolarMap> maps;
  /// Of each zone, what keeps its blind places from being seen, and how much pairs of viewers see
  /// together.
  std::map<std::string, std::map<std::string, double>> blind_causes, overlaps;
  std::vector<std::string> warnings;
};

struct EvaluateOptions {
  int threads = 2;
  bool strict = false;  ///< a mount inside the machine is an error
  std::function<void(double done_s, double duration_s)> progress;
};

/// Looks at `layouts` over the cycle, all of them at the same moments. Throws InputError where a
/// zone names no link or lies beside the site, and where `strict` refuses a mount.
std::vector<LayoutReport> Evaluate(const Cycle& cycle, const LayoutStudy& study,
                                   std::vector<Layout> layouts, const EvaluateOptions& options);

}  // namespace tera
