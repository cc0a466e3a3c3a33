#pragma once

#include <string>
#include <vector>

#include "dataset/lint/lint_job.h"

namespace tera {

/// The stamps of one channel, in order.
struct StampScan {
  std::vector<TimeNs> t_ns;
  std::vector<int> lines;

  void Add(TimeNs t, int line) {
    t_ns.push_back(t);
    lines.push_back(line);
  }
};

/// Rates, gaps and coverage of one channel.
void CheckStamps(LintJob* job, const std::string& channel, const StampScan& stamps);

}  // namespace tera
