#pragma once

#include <filesystem>
#include <string>

#include "dataset/realism/realism_figures.h"

namespace tera {

/// Measures the colour images of all cameras of a dataset, one image out of `every_frame`, by class
/// if there are labels. Throws InputError if there are no colour images, if one is smaller than 64
/// px, or as Recording does.
Realism MeasureRealism(const std::filesystem::path& dataset, int every_frame);

/// Table of the results next to values of photographs from the literature, with sources.
std::string RealismTable(const Realism& realism);
std::string RealismJson(const Realism& realism);

}  // namespace tera
