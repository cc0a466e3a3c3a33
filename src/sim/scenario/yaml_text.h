#pragma once

#include <string>
#include <vector>

#include "core/motion.h"

/// Values in YAML syntax, for drawn items of a scenario.

namespace tera {

/// A quoted text with any characters.
std::string QuotedText(const std::string& text);
/// A name, quoted if it has characters that a name cannot have. The lookup then refuses it.
std::string NameText(const std::string& name);
/// "[x, y]", to a millimetre.
std::string PointText(const Vec2& p_m);
/// "[[x, y], ...]".
std::string OutlineText(const std::vector<Vec2>& outline_m);

}  // namespace tera
