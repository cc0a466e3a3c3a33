#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "core/config/config.h"

namespace tera {

/// True if `document` is a URDF: a <robot> without xacro. Xacro means elements or attributes of its
/// name space, with any prefix, and ${...} or $(...) in the parts that are read. The fault of
/// `urdf` names the actual form and the way to convert it to a URDF.
bool RequireUrdf(const ConfigMap& config, const std::string& file,
                 const tinyxml2::XMLDocument& document);

/// Elements of a URDF that no reader uses, and attributes of other name spaces, with their number:
/// "2 <gazebo>".
std::vector<std::string> UnreadElements(const tinyxml2::XMLElement& robot);

}  // namespace tera
