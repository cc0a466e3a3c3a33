#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/types/labels.h"
#include "core/types/terrain_surface.h"
#include "render/air/dust_volume.h"
#include "render/air/weather.h"
#include "render/ground/ground_paint.h"
#include "render/lamp.h"
#include "render/meshes/mesh.h"
#include "render/wear.h"

/// What can be seen: one description for the rasterizer and for the ray scene, so that camera and
/// lidar look at the same world.

namespace tera {

/// A mesh shown at a body slot. Several nodes may share a body and an instance.
struct SceneNode {
  int mesh = 0;    ///< index into SceneModel::meshes, unless it has a shape
  int shape = -1;  ///< index into SceneState::shapes, of a mesh that changes
  int body = 0;    ///< index into SceneState::X_WB
  Pose X_BG = Pose::Identity();
  double scale = 1.0;
  SemanticClass label = SemanticClass::kStructure;
  std::uint16_t instance = 0;            ///< index into SceneModel::instances
  std::shared_ptr<const NodeWear> wear;  ///< null: as it left the factory
};

inline constexpr std::size_t kMostLamps = 8;

/// An object that labels tell apart. Instance 0 is "none"; the terrain is instance 0.
///
/// Model   A whole has parts, which are instances of their own and name it as their parent. No node
///         is of a whole: its pixels are those of its parts.
struct SceneInstance {
  std::string name;  ///< "excavator1/bucket", "person1"
  SemanticClass label = SemanticClass::kSky;
  int body = -1;  ///< body whose frame carries the box
  Vec3 box_min_B_m = Vec3::Zero(), box_max_B_m = Vec3::Zero();
  int shape = -1;            ///< shape whose box is its box; the one above is that of its place
  double capacity_m3 = 0;    ///< of what its shape shows, heaped
  std::uint16_t parent = 0;  ///< the whole that this is a part of; 0: of none
  bool is_whole = false;     ///< its box is found from its parts, whatever they do
};

/// A named point of an object: a joint of a machine or of a person.
struct SceneKeypoint {
  std::string name;
  std::uint16_t instance = 0;
  int body = 0;
  Vec3 p_B_m = Vec3::Zero();
  double radius_m = 0;  ///< how deep below the object's surface it may lie and still be seen
};

/// Appearance of a soil, by index as in TerrainSurface::soil.
struct SoilAppearance {
  Vec3 albedo = Vec3(0.3, 0.22, 0.15);
  double grain_size_m = 0.01;
};

/// Light and air.
///
/// Frames  W.
/// Model   sun_illuminance_klx is the illuminance of the sun alone on a plane that faces it (clear
///         noon: about 90 to 110); turbidity is that of the sky model; exposure_ev100 is the
///         exposure value at ISO 100, N^2 / t, for which the picture is exposed (sunlit ground:
///         15). cloud_cover is the share of the sky that clouds cover (Sky); without it thin clouds
///         lie over a clear sky. sky_illuminance_lx is that of the clear sky on level ground,
///         without it that of its model: below the horizon the sun lights the sky alone.
/// Omits   clouds that shade parts of the site, haze that varies with height near the ground.
/// Source  ISO 2720 (exposure value); Preetham et al. 1999 (turbidity); Koschmieder 1924 (fog).
struct Environment {
  Vec3 to_sun_W = Vec3(0.4, 0.3, 0.85).normalized();
  double sun_illuminance_klx = 90.0;
  double turbidity = 3.0;
  double fog_visibility_m = 2000.0;  ///< Koschmieder: contrast falls to 2 % at this distance
  double exposure_ev100 = 15.0;
  std::optional<double> cloud_cover;  ///< 0 to 1
  std::optional<double> sky_illuminance_lx;
  Weather weather;
};

/// The constant part.
struct SceneModel {
  std::vector<Mesh> meshes;
  Textures textures;  ///< of meshes
  std::vector<SceneNode> nodes;
  std::vector<SceneInstance> instances;  ///< instances[0] is "none"
  std::vector<SceneKeypoint> keypoints;
  std::vector<SoilAppearance> soils;
  std::shared_ptr<const GroundPaint> ground_paint;  ///< null: the ground has its soils' colours
  Environment environment;
  std::vector<Lamp> lamps;  ///< at most kMostLamps
  int body_count = 0;
  int shape_count = 0;

  /// Adds a mesh file (or one node of it); the same file and node is loaded once. Returns its
  /// index.
  int AddMesh(const std::filesystem::path& file, const std::string& node);
};

/// A mesh that changes, as it is now: soil carried in a shovel.
///
/// Frames  B of the body that shows it.
struct ShapedMesh {
  std::vector<double> key;  ///< what the mesh follows from: the same numbers, the same mesh
  std::vector<MeshPart> parts;
  Vec3 box_min_B_m = Vec3::Zero(), box_max_B_m = Vec3::Zero();  ///< of what it shows
  double volume_m3 = 0, mass_kg = 0;                            ///< of soil
};

/// One for each of SceneModel::shape_count; null where there is nothing to be seen. None at all
/// stands for nothing anywhere.
using Shapes = std::vector<std::shared_ptr<const ShapedMesh>>;

/// The shape of that index, or null.
const ShapedMesh* ShapeAt(const Shapes& shapes, int index);
/// Whether both look alike.
bool AreAlike(const ShapedMesh* a, const ShapedMesh* b);

/// The moving part at one instant.
struct SceneState {
  TimeNs t_ns = 0;
  std::vector<Pose> X_WB;  ///< one for each body
  const TerrainSurface* terrain = nullptr;
  Shapes shapes;
  const DustVolume* dust = nullptr;  ///< in the air; null where there is none
  double exposure_s = 0.004;         ///< for which falling drops are seen
};

}  // namespace tera
