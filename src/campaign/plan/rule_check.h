#pragma once

#include <vector>

#include "campaign/plan/campaign.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Finds rules that no episode can meet, by examining scenarios only. Examples are a class that no
/// object has, and a camera, table, column or machine that does not exist.
class RuleCheck {
 public:
  explicit RuleCheck(const Campaign& campaign) : campaign_(campaign) {
    met_.resize(campaign.rules.size());
  }
  void Look(const Scenario& scenario);
  /// Throws InputError with every rule that no examined scenario can meet.
  void Finish() const;

 private:
  const Campaign& campaign_;
  std::vector<bool> met_;
};

}  // namespace tera
