#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types/ground_tools.h"
#include "layout/layout.h"
#include "layout/measures/figure.h"

namespace tera {

/// Visibility of a working shovel: its cutting edge and its load.
///
/// Frames  B the shovel's link.
/// Model   shares of places along the edge, and over the mouth of the shell at struck level, that
///         any viewer sees (look.h). The soil in the shovel does not block the line of sight;
///         density does not count.
/// Omits   soil heaped above struck level, and the empty part of the mouth.
class ShovelView {
 public:
  /// `instance` is the scene instance of its soil, or 0 if it carries none.
  ShovelView(const Shovel& shovel, std::uint16_t instance);

  void Add(const MachineState& machine, const Layout& layout, double reflectance,
           const Sighting& sighting);
  /// "dig/SHOVEL/edge_seen" and, for a shovel that carries soil, "dig/SHOVEL/load_seen": shares.
  std::vector<Figure> Figures() const;

 private:
  double ShareSeen(const std::vector<Vec3>& places_W_m, const Layout& layout, double reflectance,
                   const Sighting& sighting) const;

  std::string name_;
  int link_;
  bool carries_;
  std::uint16_t soil_instance_;
  std::vector<Vec3> edge_B_m_, mouth_B_m_;
  std::vector<double> edge_seen_, load_seen_;
};

}  // namespace tera
