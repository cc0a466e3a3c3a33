#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/plan/campaign.h"

namespace tera {

/// The number that a rule asks for. Throws InputError if the dataset lacks the channel or column.
double FigureOf(const AcceptanceRule& rule, const std::filesystem::path& dataset);

/// The name of the first rule that a finished dataset breaks.
std::optional<std::string> BrokenRule(const std::vector<AcceptanceRule>& rules,
                                      const std::filesystem::path& dataset);

}  // namespace tera
