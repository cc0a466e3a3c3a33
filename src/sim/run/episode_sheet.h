#pragma once

#include <string>
#include <vector>

#include "dataset/overview/contact_sheet.h"
#include "render/gl/egl_options.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// A contact sheet of a scenario's episodes: the first instant of each (FirstLook) with its drawn
/// values. Values that all episodes share are omitted.
class EpisodeSheet {
 public:
  /// Adds the next episode. Throws as FirstLook does.
  void Add(const Scenario& scenario, const EglOptions& egl);
  /// Draws the sheet. At least one episode must have been added.
  Picture Draw() const;

 private:
  std::vector<SheetTile> tiles_;
};

/// Shortens "key.of.some: value" of Scenario::drawn: last part of the key, numbers with four
/// digits, and only the length of a list of mappings.
std::string DrawnInShort(const std::string& drawn);

}  // namespace tera
