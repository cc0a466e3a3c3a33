#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "core/config/config.h"

namespace tera {

/// Whether the XML of `file` is a URDF: a <robot> in which nothing is xacro, neither elements nor
/// attributes of its name space, whatever their prefix, nor ${...} and $(...) in what is read. A
/// fault of `urdf` says what it is instead, and how a URDF is made of it.
bool RequireUrdf(const ConfigMap& config, const std::string& file,
                 const tinyxml2::XMLDocument& document);

/// Elements of a URDF and attributes of other name spaces that nobody reads here, as "2 <gazebo>".
std::vector<std::string> UnreadElements(const tinyxml2::XMLElement& robot);

}  // namespace tera
