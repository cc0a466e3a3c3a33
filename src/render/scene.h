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

/// The visible world: one description for the rasterizer and the ray scene, so that camera and
/// lidar observe the same world.

namespace tera {

/// A mesh attached to a body slot. Several nodes may share a body and an instance.
struct SceneNode {
  int mesh = 0;    ///< index into SceneModel::meshes; unused with a shape
  int shape = -1;  ///< index into SceneState::shapes, for a deforming mesh; -1: none
  int body = 0;    ///< index into SceneState::X_WB
  Pose X_BG = Pose::Identity();
  double scale = 1.0;
  SemanticClass label = SemanticClass::kStructure;
  std::uint16_t instance = 0;            ///< index into SceneModel::instances
  std::shared_ptr<const NodeWear> wear;  ///< null: factory condition
};

inline constexpr std::size_t kMostLamps = 8;

/// A distinct object in the labels. Instance 0 is "none"; the terrain has instance 0.
///
/// Model   A whole has parts, which are separate instances with the whole as parent. No node
///         belongs to a whole: its pixels are the pixels of its parts.
struct SceneInstance {
  std::string name;  ///< "excavator1/bucket", "person1"
  SemanticClass label = SemanticClass::kSky;
  int body = -1;  ///< body whose frame carries the box
  Vec3 box_min_B_m = Vec3::Zero(), box_max_B_m = Vec3::Zero();
  int shape = -1;            ///< shape that supplies the box, in place of the members above
  double capacity_m3 = 0;    ///< heaped capacity for the load that the shape shows
  std::uint16_t parent = 0;  ///< the whole that contains this part; 0: no parent
  bool is_whole = false;     ///< its box encloses its parts at each instant
};

/// A named point of an object: a joint of a machine or of a person.
struct SceneKeypoint {
  std::string name;
  std::uint16_t instance = 0;
  int body = 0;
  Vec3 p_B_m = Vec3::Zero();
  double radius_m = 0;  ///< visible down to this depth below the object's surface
};

/// Appearance of a soil, indexed by TerrainSurface::Cover::soil.
struct SoilAppearance {
  Vec3 albedo = Vec3(0.3, 0.22, 0.15);
  double grain_size_m = 0.01;
};

/// Light and atmosphere.
///
/// Frames  W.
/// Model   sun_illuminance_klx is the direct sun's illuminance on a plane facing it (clear noon:
///         about 90 to 110). turbidity is the parameter of the sky model. exposure_ev100 is the
///         image's exposure value at ISO 100, N^2 / t (sunlit ground: 15). cloud_cover is the
///         clouded fraction of the sky (Sky); without it, thin clouds lie over a clear sky.
///         sky_illuminance_lx is the clear sky's illuminance on level ground; without it, the sky
///         model's value applies. A sun below the horizon lights only the sky.
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

/// Constant part of the scene.
struct SceneModel {
  std::vector<Mesh> meshes;
  Textures textures;  ///< textures of the meshes
  std::vector<SceneNode> nodes;
  std::vector<SceneInstance> instances;  ///< instances[0] is "none"
  std::vector<SceneKeypoint> keypoints;
  std::vector<SoilAppearance> soils;
  std::shared_ptr<const GroundPaint> ground_paint;  ///< null: the ground has its soils' colours
  Environment environment;
  std::vector<Lamp> lamps;  ///< at most kMostLamps
  int body_count = 0;
  int shape_count = 0;

  /// Adds a mesh file, or one node of it, and returns its index. Repeated calls with the same file
  /// and node load it once.
  int AddMesh(const std::filesystem::path& file, const std::string& node);
};

/// Present state of a deforming mesh: soil carried in a shovel.
///
/// Frames  B frame of the body that carries it.
struct ShapedMesh {
  std::vector<double> key;  ///< equal keys imply equal meshes
  std::vector<MeshPart> parts;
  Vec3 box_min_B_m = Vec3::Zero(), box_max_B_m = Vec3::Zero();  ///< box around the parts
  double volume_m3 = 0, mass_kg = 0;                            ///< soil
};

/// One entry per shape up to SceneModel::shape_count; null for an invisible shape. An empty vector
/// means that no shape is visible.
using Shapes = std::vector<std::shared_ptr<const ShapedMesh>>;

/// The shape of that index, or null.
const ShapedMesh* ShapeAt(const Shapes& shapes, int index);
/// True if both look alike.
bool AreAlike(const ShapedMesh* a, const ShapedMesh* b);

/// Moving part of the scene at one instant.
struct SceneState {
  TimeNs t_ns = 0;
  std::vector<Pose> X_WB;  ///< one per body
  const TerrainSurface* terrain = nullptr;
  Shapes shapes;
  const DustVolume* dust = nullptr;  ///< airborne dust; null without dust
  double exposure_s = 0.004;         ///< exposure time of falling drops
};

}  // namespace tera
