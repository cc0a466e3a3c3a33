#pragma once

#include <string>
#include <vector>

#include "dataset/overview/contact_sheet.h"
#include "render/gl/egl_options.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Episodes of a scenario side by side: the first instant of each (FirstLook), and below it what
/// was drawn, in few letters, but for values that all of them have.
class EpisodeSheet {
 public:
  /// Draws the next episode. Throws as FirstLook does.
  void Add(const Scenario& scenario, const EglOptions& egl);
  /// All that were added, at least one.
  Picture Draw() const;

 private:
  std::vector<SheetTile> tiles_;
};

/// "key.of.some: value" of Scenario::drawn with the end of its key, a number with four digits, a
/// list of mappings by how many there are.
std::string DrawnInShort(const std::string& drawn);

}  // namespace tera
