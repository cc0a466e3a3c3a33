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
  bool strict = false;  ///< what MountWarnings tells is an error
  std::function<void(double done_s, double duration_s)> progress;
};

/// Throws InputError where a zone or the eye of the study names no link of its machine, and where a
/// zone lies beside the site.
void CheckStudy(const LayoutStudy& study, const Scenario& scenario);

/// Looks at `layouts` over the cycle, all of them at the same moments. What the machine hides from
/// an eye is the same for all. Throws InputError as CheckStudy does, and where `strict` refuses a
/// mount.
std::vector<LayoutReport> Evaluate(const Cycle& cycle, const LayoutStudy& study,
                                   std::vector<Layout> layouts, const EvaluateOptions& options);

}  // namespace tera
