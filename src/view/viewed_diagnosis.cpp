#include <map>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "view/viewed_index.h"

namespace tera {
namespace {

using Json = nlohmann::ordered_json;

/// Sizes of the files whose names start with `begin` and end with `end`, by name.
Json FilesOf(const std::filesystem::path& folder, const std::string& begin,
             const std::string& end) {
  std::map<std::string, std::uintmax_t> sizes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name.starts_with(begin) && name.ends_with(end)) {
      sizes[name] = entry.file_size();
    }
  }
  return sizes;
}

}  // namespace

std::string DiagnosisIndexJson(const std::filesystem::path& diagnosis) {
  const std::filesystem::path file = diagnosis / "diagnosis.json";
  const Json read = Json::parse(ReadWholeFile(file), nullptr, false);
  if (read.is_discarded() || !read.is_object() || !read.contains("findings") ||
      !read.contains("verdict")) {
    throw InputError(
        file.string(),
        {FaultKind::kMalformed,
         "is no JSON with `verdict` and `findings`; need the diagnosis.json of tera diagnose"});
  }
  const Json json = {{"kind", "diagnosis"},
                     {"diagnosis", read},
                     {"grounds", FilesOf(diagnosis, "ground_", ".tif")},
                     {"series", FilesOf(diagnosis, "series_", ".csv")}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tera
