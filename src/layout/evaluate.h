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
  bool strict = false;  ///< treat each warning of MountWarnings as an error
  std::function<void(double done_s, double duration_s)> progress;
};

/// Throws InputError if a zone or the eye of the study names a link that the machine lacks, or if a
/// zone lies off the site.
void CheckStudy(const LayoutStudy& study, const Scenario& scenario);

/// Evaluates all `layouts` over the same moments of the cycle. The eye masking does not depend on
/// the layout, so it is computed once.
///
/// Throws  InputError as CheckStudy does. Also for a mount inside the machine if `strict` is set.
std::vector<LayoutReport> Evaluate(const Cycle& cycle, const LayoutStudy& study,
                                   std::vector<Layout> layouts, const EvaluateOptions& options);

}  // namespace tera
