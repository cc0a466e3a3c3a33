#pragma once

#include <functional>
#include <vector>

#include "layout/layout.h"
#include "layout/layout_report.h"
#include "layout/study/cycle.h"
#include "layout/study/study.h"

namespace tera {

struct EvaluateOptions {
  int threads = 2;
  bool strict = false;  ///< a warning of MountWarnings is an error
  std::function<void(double done_s, double duration_s)> progress;
};

/// Throws InputError if a zone or the eye of the study names no link of its machine, or if a zone
/// lies off the site.
void CheckStudy(const LayoutStudy& study, const Scenario& scenario);

/// Evaluates `layouts` over the cycle, all at the same moments. Computes the eye masking once,
/// since it is the same for all layouts.
///
/// Throws  InputError as CheckStudy does, and for a refused mount if `strict` is set.
std::vector<LayoutReport> Evaluate(const Cycle& cycle, const LayoutStudy& study,
                                   std::vector<Layout> layouts, const EvaluateOptions& options);

}  // namespace tera
