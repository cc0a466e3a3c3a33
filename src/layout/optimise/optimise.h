#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "layout/optimise/found_layout.h"
#include "layout/optimise/search.h"

namespace tera {

struct OptimiseProgress {
  int generation = 0, generations = 0;
  double hypervolume =
      0;  ///< hypervolume of the current front, over the corner of the first layouts
};

struct OptimiseOptions {
  std::filesystem::path out;
  int threads = 2;
  bool resume = false;
  std::function<void(const OptimiseProgress&)> progress;
};

/// Searches for layouts of the Pareto front: no other layout is better in every objective.
///
/// Model   NSGA-II over the genes (candidate.h), from a greedy layout and random ones, or by
///         LayoutSearch::start. Violations of the limits count as worse the larger they are. Every
///         generation has its own seed, and its state is stored with the result, so an interrupted
///         search resumes to the same end.
/// Source  Deb et al. 2002, "A fast and elitist multiobjective genetic algorithm: NSGA-II", IEEE
///         Transactions on Evolutionary Computation 6(2), by pagmo.
///
/// Writes `options.out`: front/NN.yaml, a rig for each layout, greedy.yaml, front.csv,
/// hypervolume.csv, search.html.
///
/// Throws  InputError as Appraisal does, if no layout is within the limits, and if the state to
///         resume belongs to another search.
OptimiseResult Optimise(const LayoutSearch& search, const std::string& search_text,
                        const OptimiseOptions& options);

}  // namespace tera
