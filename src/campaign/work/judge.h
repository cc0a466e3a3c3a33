#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/plan/campaign.h"

namespace tera {

/// The quantity that a rule tests. Throws InputError if the dataset lacks the channel or column.
double FigureOf(const AcceptanceRule& rule, const std::filesystem::path& dataset);

/// Name of the first rule that a finished dataset violates; nullopt if it satisfies all.
std::optional<std::string> BrokenRule(const std::vector<AcceptanceRule>& rules,
                                      const std::filesystem::path& dataset);

}  // namespace tera
