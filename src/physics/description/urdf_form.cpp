#include "physics/description/urdf_form.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>

namespace tera {
namespace {

using XmlElement = tinyxml2::XMLElement;

/// Name space URIs by prefix.
using Namespaces = std::map<std::string, std::string, std::less<>>;

/// Part of all xacro URIs, and the usual prefix.
constexpr std::string_view kXacro = "xacro";
constexpr std::string_view kDeclaration = "xmlns:";
/// Elements for Gazebo alone. Their plugins may contain expressions.
constexpr std::string_view kGazebo = "gazebo";
/// Elements of a <robot> that the readers use.
constexpr std::array<std::string_view, 5> kReadElements = {"link", "joint", "material",
                                                           "transmission", "ros2_control"};

std::string_view PrefixOf(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? std::string_view() : name.substr(0, colon);
}

Namespaces Within(const XmlElement& element, Namespaces outer) {
  for (const auto* a = element.FirstAttribute(); a; a = a->Next()) {
    const std::string_view name = a->Name();
    if (name.starts_with(kDeclaration)) {
      outer[std::string(name.substr(kDeclaration.size()))] = a->Value();
    }
  }
  return outer;
}

bool IsXacroName(std::string_view name, const Namespaces& namespaces) {
  const std::string_view prefix = PrefixOf(name);
  if (prefix.empty()) return false;
  const auto uri = namespaces.find(prefix);
  return uri == namespaces.end() ? prefix == kXacro : uri->second.find(kXacro) != std::string::npos;
}

bool HasExpression(std::string_view text) {
  return text.find("${") != std::string_view::npos || text.find("$(") != std::string_view::npos;
}

struct XacroPlace {
  int line;
  std::string found;
};

/// The first part of `element` that needs xacro; empty if there is none.
std::optional<XacroPlace> FindXacro(const XmlElement& element, const Namespaces& outer,
                                    bool is_for_gazebo) {
  const Namespaces namespaces = Within(element, outer);
  if (IsXacroName(element.Name(), namespaces)) return {{element.GetLineNum(), element.Name()}};
  is_for_gazebo = is_for_gazebo || element.Name() == kGazebo;
  for (const auto* a = element.FirstAttribute(); a; a = a->Next()) {
    if (IsXacroName(a->Name(), namespaces)) return {{a->GetLineNum(), a->Name()}};
    if (!is_for_gazebo && HasExpression(a->Value())) {
      return {{a->GetLineNum(), fmt::format("{} '{}'", a->Name(), a->Value())}};
    }
  }
  for (const auto* node = element.FirstChild(); node; node = node->NextSibling()) {
    if (const XmlElement* child = node->ToElement()) {
      if (const auto place = FindXacro(*child, namespaces, is_for_gazebo)) return place;
    } else if (node->ToText() && !is_for_gazebo && HasExpression(node->Value())) {
      return {{node->GetLineNum(), fmt::format("text of <{}>", element.Name())}};
    }
  }
  return std::nullopt;
}

/// `file` with its extension replaced by .urdf.
std::string AsUrdf(const std::string& file) {
  const std::size_t point = file.rfind('.');
  const std::string stem = file.substr(0, point);
  return stem.ends_with(".urdf") ? stem : stem + ".urdf";
}

std::string XacroCommand(const std::string& file) {
  if (AsUrdf(file) != file) return fmt::format("xacro {} > {}", file, AsUrdf(file));
  return fmt::format("xacro {0}.xacro > {0} (after mv {0} {0}.xacro)", file);
}

/// Names the form of a file with this root element and the way to convert it to a URDF; empty if
/// unknown.
std::string OtherForm(std::string_view root, const std::string& file) {
  std::string urdf = AsUrdf(file);
  if (urdf == file) urdf = "robot.urdf";
  if (root == "sdf" || root == "world" || root == "model" || root == kGazebo) {
    return fmt::format(
        "this is SDF, Gazebo's form; make a URDF of it: sdf2urdf.py {} {} (of "
        "pysdf), or take the URDF or xacro that it was made of",
        file, urdf);
  }
  if (root == "mujoco" || root == "mujocoinclude") {
    return fmt::format(
        "this is MJCF, MuJoCo's form; make a URDF of it: pip install mjcf-urdf-simple-converter; "
        "python3 -c \"from mjcf_urdf_simple_converter import convert; convert('{}', '{}')\"",
        file, urdf);
  }
  if (root == "COLLADA") return "this is a COLLADA mesh; name it in a URDF's <mesh>";
  return "";
}

/// Counts unread elements of `parent` and attributes of other name spaces, by name.
void CountUnread(const XmlElement& parent, bool is_robot, std::map<std::string, int>* counts) {
  for (const auto* a = parent.FirstAttribute(); a; a = a->Next()) {
    const std::string_view prefix = PrefixOf(a->Name());
    if (!prefix.empty() && !prefix.starts_with("xml")) ++(*counts)[a->Name()];
  }
  for (const XmlElement* e = parent.FirstChildElement(); e; e = e->NextSiblingElement()) {
    const std::string_view name = e->Name();
    const bool is_read = is_robot ? std::find(kReadElements.begin(), kReadElements.end(), name) !=
                                        kReadElements.end()
                                  : PrefixOf(name).empty();
    if (is_read) {
      CountUnread(*e, false, counts);
    } else {
      ++(*counts)[fmt::format("<{}>", name)];
    }
  }
}

}  // namespace

bool RequireUrdf(const ConfigMap& config, const std::string& file,
                 const tinyxml2::XMLDocument& document) {
  const XmlElement* root = document.RootElement();
  if (root == nullptr) {
    config.Fault("urdf", {FaultKind::kMalformed,
                          fmt::format("{} has no element; need a URDF's <robot>", file)});
    return false;
  }
  if (const auto xacro = FindXacro(*root, {}, false)) {
    config.Fault("urdf", {FaultKind::kUnsupported,
                          fmt::format("this is xacro; make a URDF of it: {}", XacroCommand(file)),
                          fmt::format("{}:{}: {}", file, xacro->line, xacro->found)});
    return false;
  }
  const std::string_view name = root->Name();
  if (name == "robot") return true;
  const std::string form = OtherForm(name, file);
  config.Fault("urdf",
               {FaultKind::kUnsupported, form.empty() ? "need a URDF, whose root is <robot>" : form,
                fmt::format("{}:{}: <{}>", file, root->GetLineNum(), name)});
  return false;
}

std::vector<std::string> UnreadElements(const XmlElement& robot) {
  std::map<std::string, int> counts;
  CountUnread(robot, true, &counts);
  std::vector<std::string> shown;
  for (const auto& [name, count] : counts) shown.push_back(fmt::format("{} {}", count, name));
  return shown;
}

}  // namespace tera
