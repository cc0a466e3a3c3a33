#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types/ground_tools.h"
#include "layout/layout.h"
#include "layout/measures/figure.h"

namespace tera {

/// Visibility of a shovel at work: its cutting edge and its load.
///
/// Frames  B is the shovel's link.
/// Model   shares of test places that at least one viewer sees (look.h). The places lie along the
///         cutting edge and over the shell's opening at struck level. Soil in the shovel does not
///         occlude. The density of samples does not count.
/// Omits   soil heaped above struck level, and parts of the opening without soil.
class ShovelView {
 public:
  /// `instance` is the scene instance of the shovel's soil, or 0 if it carries none.
  ShovelView(const Shovel& shovel, std::uint16_t instance);

  void Add(const MachineState& machine, const Layout& layout, double reflectance,
           const Sighting& sighting);
  /// "dig/SHOVEL/edge_seen" and, for a shovel that carries soil, "dig/SHOVEL/load_seen". Both are
  /// shares.
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
