#include "dataset/import/suggest/suggest.h"

#include <fmt/format.h>

#include "core/config/spelling.h"
#include "core/error.h"
#include "dataset/import/bag/bag_source.h"
#include "dataset/import/logs/foreign_log.h"
#include "dataset/import/scans/capture_file.h"

namespace tera {
namespace {

/// A text file of points looks like a table of numbers. Only its name reveals it.
void RefusePoints(const std::filesystem::path& log) {
  const std::string ending = LowerCase(log.extension().string());
  if (ending != ".xyz" && ending != ".pts" && ending != ".neu") return;
  std::filesystem::path bare = log;
  bare.replace_extension();
  throw InputError(
      log.string(),
      {FaultKind::kUnsupported,
       fmt::format("is a point cloud in text by its name; need a log. 'tera site' reads it as LAS: "
                   "pdal translate -r readers.text --readers.text.header=\"X Y Z\" "
                   "--readers.text.separator=\" \" {} {}.las; a table of a log needs another name",
                   log.string(), bare.string())});
}

}  // namespace

std::string SuggestMapping(const std::filesystem::path& log,
                           const std::vector<std::string>& overrides) {
  if (LooksLikeCapture(log) && overrides.empty()) return SuggestForCapture(log);
  const bool is_table =
      !LooksLikeBag(log) && !std::filesystem::is_directory(log) && TypeOfLog(log).empty();
  const auto trajectory = is_table && overrides.empty() ? SuggestForTrajectory(log) : std::nullopt;
  if (trajectory) return *trajectory;
  if (is_table) {
    RefusePoints(log);
    return SuggestForTable(log, overrides);
  }
  if (!overrides.empty()) {
    throw InputError("--set " + overrides.front(),
                     {FaultKind::kUnsupported,
                      fmt::format("with --suggest it describes the format of a text table "
                                  "(csv.skip_lines=3), but {} is not one; remove it",
                                  log.string())});
  }
  std::error_code ignored;
  if (std::filesystem::is_regular_file(log, ignored) && std::filesystem::is_empty(log, ignored)) {
    throw InputError(log.string(), {FaultKind::kMissing, "is empty; copy or record it again"});
  }
  if (LooksLikeBag(log)) return SuggestForBag(log);
  return std::filesystem::is_directory(log) ? SuggestForFolder(log) : SuggestForLog(log);
}

}  // namespace tera
