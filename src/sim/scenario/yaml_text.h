#pragma once

#include <string>
#include <vector>

#include "core/motion.h"

/// Values as they stand in YAML, for items of a scenario that are drawn.

namespace tera {

/// A text in quotes, whatever characters it has.
std::string QuotedText(const std::string& text);
/// A name as it is; one with other characters than a name has in quotes, for whoever looks it up to
/// refuse.
std::string NameText(const std::string& name);
/// "[x, y]", to a millimetre.
std::string PointText(const Vec2& p_m);
/// "[[x, y], ...]".
std::string OutlineText(const std::vector<Vec2>& outline_m);

}  // namespace tera
