#pragma once

#include <vector>

#include "campaign/plan/campaign.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Finds rules that no episode can meet, from scenarios alone: a class that no obstacle has, a
/// camera, table, column or machine that is not there.
class RuleCheck {
 public:
  explicit RuleCheck(const Campaign& campaign) : campaign_(campaign) {
    met_.resize(campaign.rules.size());
  }
  void Look(const Scenario& scenario);
  /// Throws InputError with each rule that none of the scenarios could meet.
  void Finish() const;

 private:
  const Campaign& campaign_;
  std::vector<bool> met_;
};

}  // namespace tera
