#pragma once

#include <string>
#include <vector>

#include "dataset/overview/contact_sheet.h"
#include "render/gl/egl_options.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// A contact sheet of a scenario's episodes: the first instant of each (FirstLook), with its drawn
/// values in short form. Values that all episodes share are left out.
class EpisodeSheet {
 public:
  /// Draws the next episode. Throws as FirstLook does.
  void Add(const Scenario& scenario, const EglOptions& egl);
  /// The sheet of all added episodes, at least one.
  Picture Draw() const;

 private:
  std::vector<SheetTile> tiles_;
};

/// Short form of "key.of.some: value" of Scenario::drawn: the end of its key, numbers with four
/// digits, and the count of a list of mappings.
std::string DrawnInShort(const std::string& drawn);

}  // namespace tera
