#include "app/about/about_program.h"

#include <fmt/format.h>

#include <string_view>

#include "app/about/commit.h"
#include "app/about/version.h"

namespace tera {

std::string AboutProgram() {
  std::string text = fmt::format("tera {}\n", kVersion);
  const auto add = [&](std::string_view what, std::string_view value) {
    if (!value.empty()) text += fmt::format("{:<10} {}\n", what, value);
  };
  add("commit", kCommit);
  add("compiler", kCompiler);
  add("build", kBuildType);
  add("libraries", kLibraries);
  add("without", kAbsentLibraries);
  text.pop_back();  // removes the line end, which CLI11 adds itself
  return text;
}

}  // namespace tera
