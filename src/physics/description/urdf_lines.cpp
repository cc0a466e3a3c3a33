#include "physics/description/urdf_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace tera {
namespace {

/// Converts XML_ERROR_MISMATCHED_ELEMENT to "mismatched element".
std::string InWords(std::string_view name) {
  for (const std::string_view prefix : {"XML_ERROR_", "XML_"}) {
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  }
  std::string words(name);
  std::transform(words.begin(), words.end(), words.begin(), [](unsigned char c) {
    return c == '_' ? ' ' : static_cast<char>(std::tolower(c));
  });
  return words;
}

}  // namespace

std::string UrdfLines::PlaceOf(const std::string& kind, const std::string& name) const {
  const auto line = lines_.find(kind + " " + name);
  return fmt::format("{} '{}' of {}{}", kind, name, file_,
                     line == lines_.end() ? "" : fmt::format(":{}", line->second));
}

bool ParseXml(const ConfigMap& config, const std::filesystem::path& file, const std::string& xml,
              tinyxml2::XMLDocument* document) {
  if (document->Parse(xml.c_str(), xml.size()) == tinyxml2::XML_SUCCESS) return true;
  config.Fault(
      "urdf", {FaultKind::kMalformed,
               fmt::format("{}:{} is not valid XML ({}); correct it", file.filename().string(),
                           std::max(1, document->ErrorLineNum()), InWords(document->ErrorName()))});
  return false;
}

UrdfLines LinesOf(const tinyxml2::XMLElement& robot, const std::filesystem::path& file) {
  UrdfLines lines(file.filename().string());
  for (const auto* e = robot.FirstChildElement(); e; e = e->NextSiblingElement()) {
    if (const char* name = e->Attribute("name")) lines.Add(e->Name(), name, e->GetLineNum());
  }
  return lines;
}

}  // namespace tera
