#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "layout/optimise/found_layout.h"
#include "layout/optimise/search.h"

namespace tera {

struct OptimiseProgress {
  int generation = 0, generations = 0;
  double hypervolume = 0;  ///< that the front so far has over the corner of what was tried first
};

struct OptimiseOptions {
  std::filesystem::path out;
  int threads = 2;
  bool resume = false;
  std::function<void(const OptimiseProgress&)> progress;
};

/// Searches layouts: those that no other is better than in every objective.
///
/// Model   NSGA-II over the genes (candidate.h), from a greedy layout and random ones, or as
///         LayoutSearch::start says. What is
///         beyond the limits counts as worse the farther it is. Every generation has a seed of its
///         own, and what is known after it is kept beside the result, so that a search that was
///         killed goes on to the same end.
/// Source  Deb et al. 2002, "A fast and elitist multiobjective genetic algorithm: NSGA-II", IEEE
///         Transactions on Evolutionary Computation 6(2), by pagmo.
///
/// Writes `options.out`: front/NN.yaml, a rig for each layout, greedy.yaml, front.csv,
/// hypervolume.csv, search.html. Throws InputError as Appraisal does, where no layout within the
/// limits was found, and where what is to be resumed is of another search.
OptimiseResult Optimise(const LayoutSearch& search, const std::string& search_text,
                        const OptimiseOptions& options);

}  // namespace tera
