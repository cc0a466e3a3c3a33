#pragma once

#include <string>
#include <vector>

#include "dataset/lint/lint_job.h"

namespace tera {

/// Time stamps of a channel, in file order.
struct StampScan {
  std::vector<TimeNs> t_ns;
  std::vector<int> lines;

  void Add(TimeNs t, int line) {
    t_ns.push_back(t);
    lines.push_back(line);
  }
};

/// Checks rate, gaps and coverage of a channel.
void CheckStamps(LintJob* job, const std::string& channel, const StampScan& stamps);

}  // namespace tera
