#pragma once

#include <filesystem>
#include <string>

#include "dataset/realism/realism_figures.h"

namespace tera {

/// Measures one of `every_frame` colour pictures of all cameras of a dataset, by class if there are
/// labels. Throws InputError without colour pictures, for one smaller than 64 px, and as Recording
/// does.
Realism MeasureRealism(const std::filesystem::path& dataset, int every_frame);

/// A table with comparison figures of photographs and their sources.
std::string RealismTable(const Realism& realism);
/// The same numbers as JSON.
std::string RealismJson(const Realism& realism);

}  // namespace tera
