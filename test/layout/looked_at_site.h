#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/units.h"
#include "dataset/format/sample_recording.h"
#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/sight/sighting.h"
#include "sim/simulation.h"

/// Level sites with boxes, and their viewers.

namespace tera {

/// A closed box between two corners, as a mesh file with the node "body".
inline std::string BoxObj(const Vec3& low_m, const Vec3& high_m) {
  std::string obj = "o body\n";
  for (int k = 0; k < 8; ++k) {
    obj += fmt::format("v {} {} {}\n", k & 1 ? high_m.x() : low_m.x(),
                       k & 2 ? high_m.y() : low_m.y(), k & 4 ? high_m.z() : low_m.z());
  }
  return obj + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

/// H of these tests: away from W's origin and rotated.
inline constexpr double kHYaw_deg = 40;
inline Pose X_WH() { return MakePose({2, -3, 0}, 0, 0, kHYaw_deg * kDeg); }

/// An obstacle as a box between two corners in H.
struct BoxInH {
  std::string name;
  Vec3 low_m, high_m;
  bool is_glass = false;
};

/// A machine of boxes about H, without any levers moved.
struct PartInH {
  std::string label;
  Vec3 low_m, high_m;
};

struct SiteText {
  double size_m = 80;
  std::vector<BoxInH> boxes = {};
  std::vector<PartInH> parts = {};  ///< none: a post that is invisible
  std::string terrain = "";         ///< more keys of the terrain, each after a comma
};

class LookedAtSite {
 public:
  explicit LookedAtSite(const SiteText& text)
      : scenario_(Read(text)),
        assembly_(scenario_),
        simulation_(scenario_),
        sighting_(scenario_, assembly_, 1) {
    sighting_.Show(simulation_.state(), simulation_.ground());
  }

  const Sighting& sighting() const { return sighting_; }
  const TerrainSurface& ground() const { return simulation_.ground(); }
  const Scenario& scenario() const { return scenario_; }
  const SceneAssembly& assembly() const { return assembly_; }
  const Instant& now() const { return simulation_.state(); }

 private:
  Scenario Read(const SiteText& text) {
    std::string links, joints, levers, parent = "post";
    for (std::size_t k = 0; k < text.parts.size(); ++k) {
      const PartInH& part = text.parts[k];
      const std::string name = "part" + std::to_string(k);
      links += fmt::format(
          "        {}: {{mass_kg: 10, inertia_kgm2: [1, 1, 1], label: {}, visuals: [{{mesh: {}, "
          "node: body}}]}}\n",
          name, part.label, Mesh(name, part.low_m, part.high_m));
      joints += fmt::format(
          "        turn{}: {{type: revolute, parent: {}, child: {}, axis: [0, 0, 1], limits_deg: "
          "[-170, 170], max_rate_degps: 60, max_effort_nm: 500}}\n",
          k, parent, name);
      levers += (k > 0 ? ", turn" : "turn") + std::to_string(k);
    }
    std::string yaml = fmt::format(
        "name: site\nduration_s: 1\nsettle_s: 0\n"
        "terrain: {{size_m: [{0}, {0}], cell_m: 0.5, soil: asphalt{1}}}\n"
        "machines:\n  - name: machine1\n    operator: {{type: idle}}\n"
        "    start: {{xy_m: [2, -3], yaw_deg: {2}}}\n    machine:\n      kind: post\n"
        "      fixed_base: true\n      links:\n"
        "        post: {{mass_kg: 10, inertia_kgm2: [1, 1, 1], label: structure}}\n",
        text.size_m, text.terrain, kHYaw_deg);
    yaml += links;
    if (!joints.empty()) yaml += "      joints:\n" + joints + "      levers: [" + levers + "]\n";
    if (!text.boxes.empty()) yaml += "obstacles:\n";
    for (const BoxInH& box : text.boxes) {
      const Vec3 middle_m = 0.5 * (box.low_m + box.high_m), size_m = box.high_m - box.low_m;
      yaml += fmt::format(
          "  - {{name: {}, label: barrier, mesh: {}, xy_m: [2, -3], yaw_deg: {}, collision: "
          "[{{xyz_m: [{}, {}, {}], size_m: [{}, {}, {}]}}]}}\n",
          box.name, Mesh(box.name, box.low_m, box.high_m, box.is_glass), kHYaw_deg, middle_m.x(),
          middle_m.y(), middle_m.z(), size_m.x(), size_m.y(), size_m.z());
    }
    const Config config = Config::FromText(yaml, "site.yaml");
    Scenario scenario = ReadScenario(config.root());
    config.Finish();
    return scenario;
  }
  std::string Mesh(const std::string& name, const Vec3& low_m, const Vec3& high_m,
                   bool is_glass = false) {
    const std::filesystem::path file = scratch_.path() / (name + ".obj");
    WriteWholeFile(scratch_.path() / "glass.mtl", "newmtl glass\nKd 0.2 0.3 0.3\nd 0.25\n");
    const std::string material = is_glass ? "mtllib glass.mtl\nusemtl glass\n" : "";
    WriteWholeFile(file, material + BoxObj(low_m, high_m));
    return file.string();
  }

  const ScratchDirectory scratch_;
  const Scenario scenario_;
  const SceneAssembly assembly_;
  const Simulation simulation_;
  Sighting sighting_;
};

/// Looks equally in all directions, without limit.
inline ViewField EverywhereAlike(double per_steradian = 1e9) {
  ViewField field;
  field.per_steradian = [per_steradian](const Vec3&) { return per_steradian; };
  field.reach_m = [](double) { return 1e3; };
  field.max_distance_m = 1e3;
  field.distance_sigma_m = [](double) { return 0.0; };
  return field;
}

/// A viewer at a place of H.
inline Viewer ViewerAt(const std::string& name, const Vec3& p_H_m,
                       const ViewField& field = EverywhereAlike()) {
  Viewer viewer;
  viewer.name = name;
  viewer.field = field;
  viewer.X_WS = X_WH() * MakePose(p_H_m);
  return viewer;
}

inline Layout LayoutOf(std::vector<Viewer> viewers) {
  Layout layout;
  layout.name = "by_hand";
  layout.viewers = std::move(viewers);
  return layout;
}

/// The figure of this name at the only moment.
inline const Figure& FigureOf(const std::vector<Figure>& figures, const std::string& name) {
  for (const Figure& figure : figures) {
    if (NameOf(figure.id) == name) return figure;
  }
  ADD_FAILURE() << "no figure " << name;
  static const Figure none{.id = {}, .at = {0}, .error = {0}};
  return none;
}

}  // namespace tera
