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
      0;  ///< hypervolume that the current front dominates, up to SearchState::corner
};

struct OptimiseOptions {
  std::filesystem::path out;
  int threads = 2;
  bool resume = false;
  std::function<void(const OptimiseProgress&)> progress;
};

/// Searches for the layouts of the Pareto front: those that no other layout dominates.
///
/// Model   NSGA-II over the genes (candidate.h). LayoutSearch::start selects the initial
///         population. A layout that violates the limits is worse than every allowed one; larger
///         violations are worse. Each generation has its own random seed, and its state is stored
///         in the output folder. An interrupted search therefore resumes to the same result.
/// Source  Deb et al. 2002, "A fast and elitist multiobjective genetic algorithm: NSGA-II", IEEE
///         Transactions on Evolutionary Computation 6(2), by pagmo.
///
/// Writes `options.out`: front/NN.yaml, a rig for each layout, greedy.yaml, front.csv,
/// hypervolume.csv, search.html.
///
/// Throws  InputError as Appraisal does, if no initial layout is within the limits, and if the
///         state to resume belongs to another search.
OptimiseResult Optimise(const LayoutSearch& search, const std::string& search_text,
                        const OptimiseOptions& options);

}  // namespace tera
