#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "core/config/config.h"

namespace tera {

/// True if the XML of `file` is a URDF: a <robot> without xacro. Xacro means elements or attributes
/// of its name space, whatever their prefix, and ${...} or $(...) in the parts that are read. A
/// fault of `urdf` names the actual form and the way to make a URDF from it.
bool RequireUrdf(const ConfigMap& config, const std::string& file,
                 const tinyxml2::XMLDocument& document);

/// URDF elements and attributes of other name spaces that no reader uses, as "2 <gazebo>".
std::vector<std::string> UnreadElements(const tinyxml2::XMLElement& robot);

}  // namespace tera
