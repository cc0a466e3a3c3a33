#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "core/config/config.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/sample_recording.h"
#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/sight/sighting.h"
#include "layout/study/zone.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

/// A level site and a machine of two boxes.

namespace tera {

inline constexpr double kMastHeight_m = 1.2;

/// A box from corner to corner.
struct TestBox {
  Vec3 low_m = Vec3::Zero(), high_m = Vec3::Zero();
};

/// A closed mesh whose faces point outwards.
inline std::string ObjOf(const TestBox& box) {
  std::string text = "o body\n";
  for (const double y : {box.low_m.y(), box.high_m.y()}) {
    for (const auto& [x, z] :
         {std::pair(box.low_m.x(), box.low_m.z()), std::pair(box.high_m.x(), box.low_m.z()),
          std::pair(box.high_m.x(), box.high_m.z()), std::pair(box.low_m.x(), box.high_m.z())}) {
      text += fmt::format("v {} {} {}\n", x, y, z);
    }
  }
  return text + "f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 4 3 7 8\nf 5 6 2 1\n";
}

/// The machine's base is an undercarriage, 2.5 m by 1.6 m and 0.4 m high. A mast turns on it and
/// carries a box. Neither is aligned with an axis of W, nor with the other.
class Yard {
 public:
  explicit Yard(const TestBox& on_mast, const std::string& more = "")
      : scenario_(Read(scratch_.path(), on_mast, more)),
        assembly_(scenario_),
        simulation_(scenario_),
        sighting_(scenario_, assembly_, 1) {
    sighting_.Show(simulation_.state(), simulation_.ground());
  }

  static TestBox Base() { return {Vec3(-1.5, -0.8, 0.1), Vec3(1.0, 0.8, 0.4)}; }
  /// From the base to the mast, about z.
  static constexpr double kTurn_rad = 40 * kDeg;

  const Sighting& sighting() const { return sighting_; }
  const TerrainSurface& ground() const { return simulation_.ground(); }
  const Pose& X_WBase() const { return simulation_.state().machines[0].links[0].X_WB; }
  const Pose& X_WMast() const { return simulation_.state().machines[0].links[1].X_WB; }
  Pose X_WH() const {
    Pose X_WH = Levelled(X_WMast());
    X_WH.translation().z() = 0;
    return X_WH;
  }

 private:
  static Scenario Read(const std::filesystem::path& folder, const TestBox& on_mast,
                       const std::string& more) {
    WriteWholeFile(folder / "base.obj", ObjOf(Base()));
    WriteWholeFile(folder / "mast.obj", ObjOf(on_mast));
    WriteWholeFile(folder / "digger.yaml", R"(
kind: digger
fixed_base: true
links:
  base: {mass_kg: 100, com_m: [0, 0, 0.2], inertia_kgm2: [10, 10, 10], label: undercarriage,
         visuals: [{mesh: base.obj}]}
  mast: {mass_kg: 10, com_m: [0, 0, 0.2], inertia_kgm2: [1, 1, 1], label: structure,
         visuals: [{mesh: mast.obj}]}
joints:
  turn: {type: revolute, parent: base, child: mast, xyz_m: [0, 0, 1.2], axis: [0, 0, 1],
         limits_deg: [-170, 170], max_rate_degps: 60, max_effort_nm: 500}
levers: [turn]
)");
    const Config config = Config::FromText(
        "name: yard\nduration_s: 1\nterrain: {size_m: [60, 60], cell_m: 1, soil: asphalt}\n"
        "machines:\n  - name: digger\n    machine: " +
            (folder / "digger.yaml").string() +
            "\n    start: {xy_m: [3, -2], yaw_deg: 30, joints_deg: {turn: 40}}\n"
            "    operator: {type: idle}\n" +
            more,
        "yard.yaml");
    Scenario scenario = ReadScenario(config.root());
    config.Finish();
    return scenario;
  }

  const ScratchDirectory scratch_;
  const Scenario scenario_;
  const SceneAssembly assembly_;
  const Simulation simulation_;
  Sighting sighting_;
};

/// A viewer that looks where `looks` is true, with uniform samples per steradian there.
inline Viewer ViewerOf(
    ViewField::Samples samples, double per_sr, const Pose& X_WS,
    std::function<bool(const Vec3& d_S)> looks = [](const Vec3&) { return true; }) {
  Viewer viewer;
  viewer.name = "viewer";
  viewer.field.samples = samples;
  viewer.field.per_steradian = [=](const Vec3& d_S) { return looks(d_S) ? per_sr : 0; };
  viewer.field.reach_m = [](double) { return 100.0; };
  viewer.field.max_distance_m = 100;
  viewer.field.distance_sigma_m = [](double) { return 0.0; };
  viewer.X_WS = X_WS;
  return viewer;
}

inline Layout LayoutOf(std::vector<Viewer> viewers) {
  return {.name = "layout", .file = {}, .sensors = {}, .viewers = std::move(viewers)};
}

inline const Figure& FigureOf(const std::vector<Figure>& figures, const std::string& name) {
  for (const Figure& figure : figures) {
    if (NameOf(figure.id) == name) return figure;
  }
  throw std::runtime_error("no figure " + name);
}

}  // namespace tera
