#pragma once

#include <string>
#include <vector>

#include "core/motion.h"

/// YAML text for values that are drawn for a scenario.

namespace tera {

/// A quoted text with any characters.
std::string QuotedText(const std::string& text);
/// A name; quoted if it contains characters that names must not have. The later lookup then rejects
/// it.
std::string NameText(const std::string& name);
/// "[x, y]", rounded to a millimetre.
std::string PointText(const Vec2& p_m);
/// "[[x, y], ...]".
std::string OutlineText(const std::vector<Vec2>& outline_m);

}  // namespace tera
