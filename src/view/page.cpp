#include "view/page.h"

#include <fmt/format.h>

#include "core/config/config.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

/// A build without the page has this file instead, which gives the reason.
constexpr char kMissingName[] = "missing.txt";

std::string WhyMissing(const std::vector<std::filesystem::path>& places) {
  for (const std::filesystem::path& page : places) {
    const std::filesystem::path why = page.parent_path() / kMissingName;
    if (!std::filesystem::exists(why)) continue;
    std::string text = ReadWholeFile(why);
    while (text.ends_with('\n')) text.pop_back();
    return text;
  }
  return "build the target tera_view_page, which needs esbuild, curl and the network once";
}

}  // namespace

std::vector<std::filesystem::path> PagePlaces() {
  return {DataRoot() / "web" / "tera-view.html", TERA_BUILT_PAGE};
}

std::string ReadPage(const std::vector<std::filesystem::path>& places) {
  for (const std::filesystem::path& page : places) {
    if (!std::filesystem::exists(page)) continue;
    std::string text = ReadWholeFile(page);
    if (text.find(kPackMark) != std::string::npos) return text;
    throw InputError(page.string(), {FaultKind::kMalformed,
                                     "is not the page of tera view; build or install it again"});
  }
  throw InputError("tera view", {FaultKind::kUnsupported,
                                 fmt::format("its page was not built: {}", WhyMissing(places))});
}

}  // namespace tera
