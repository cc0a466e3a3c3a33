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

/// The visible world. Rasterizer and ray scene share this description, so that cameras and lidars
/// observe the same world.

namespace tera {

/// A mesh attached to a body. Several nodes may share a body and an instance.
struct SceneNode {
  int mesh = 0;    ///< index into SceneModel::meshes; unused if `shape` is set
  int shape = -1;  ///< index into SceneState::shapes, for a deforming mesh; -1: none
  int body = 0;    ///< index into SceneState::X_WB
  Pose X_BG = Pose::Identity();
  double scale = 1.0;
  SemanticClass label = SemanticClass::kStructure;
  std::uint16_t instance = 0;            ///< index into SceneModel::instances
  std::shared_ptr<const NodeWear> wear;  ///< null: as new
};

inline constexpr std::size_t kMostLamps = 8;

/// An object that labels distinguish. Instance 0 is "none"; it also stands for the terrain.
///
/// Model   a whole (a machine) consists of parts, which are instances with the whole as `parent`. A
///         whole has no nodes of its own: its pixels are those of its parts.
struct SceneInstance {
  std::string name;  ///< "excavator1/bucket", "person1"
  SemanticClass label = SemanticClass::kSky;
  int body = -1;  ///< body in whose frame the box is given
  Vec3 box_min_B_m = Vec3::Zero(), box_max_B_m = Vec3::Zero();
  int shape = -1;            ///< index of the shape whose box applies instead; -1: none
  double capacity_m3 = 0;    ///< heaped capacity of the shovel whose load the shape shows
  std::uint16_t parent = 0;  ///< the whole that contains this part; 0: no parent
  bool is_whole = false;     ///< has parts; its box encloses them at each time
};

/// A named point of an object: a joint of a machine or of a person.
struct SceneKeypoint {
  std::string name;
  std::uint16_t instance = 0;
  int body = 0;
  Vec3 p_B_m = Vec3::Zero();
  double radius_m = 0;  ///< a visible surface may lie up to this distance in front of the point
};

/// Appearance of a soil, indexed by TerrainSurface::Cover::soil.
struct SoilAppearance {
  Vec3 albedo = Vec3(0.3, 0.22, 0.15);
  double grain_size_m = 0.01;
};

/// Light and atmosphere.
///
/// Frames  W.
/// Model   sun_illuminance_klx: direct sunlight on a plane that faces the sun (clear noon: about 90
///         to 110). A sun below the horizon lights only the sky.
///         turbidity: parameter of the sky model.
///         exposure_ev100: exposure value of the image at ISO 100, log2(N^2 / t) (sunlit ground:
///         15).
///         cloud_cover: cloudy fraction of the sky (Sky); empty: thin clouds over a clear sky.
///         sky_illuminance_lx: illuminance of level ground by the clear sky; empty: by the sky
///         model.
/// Omits   clouds that shade parts of the site, haze that varies with height near the ground.
/// Source  ISO 2720 (exposure value); Preetham et al. 1999 (turbidity); Koschmieder 1924 (fog).
struct Environment {
  Vec3 to_sun_W = Vec3(0.4, 0.3, 0.85).normalized();
  double sun_illuminance_klx = 90.0;
  double turbidity = 3.0;
  double fog_visibility_m = 2000.0;  ///< contrast falls to 2 % at this distance (Koschmieder)
  double exposure_ev100 = 15.0;
  std::optional<double> cloud_cover;  ///< 0 to 1
  std::optional<double> sky_illuminance_lx;
  Weather weather;
};

/// Constant part of the scene.
struct SceneModel {
  std::vector<Mesh> meshes;
  Textures textures;
  std::vector<SceneNode> nodes;
  std::vector<SceneInstance> instances;  ///< instances[0] is "none"
  std::vector<SceneKeypoint> keypoints;
  std::vector<SoilAppearance> soils;
  /// Null: the ground has the colours of its soils.
  std::shared_ptr<const GroundPaint> ground_paint;
  Environment environment;
  std::vector<Lamp> lamps;  ///< at most kMostLamps
  int body_count = 0;
  int shape_count = 0;

  /// Adds a mesh file, or one node of it, and returns its index. Each file and node is loaded only
  /// once.
  int AddMesh(const std::filesystem::path& file, const std::string& node);
};

/// Current state of a deforming mesh: the soil in a shovel.
///
/// Frames  B is the frame of the body that carries it.
struct ShapedMesh {
  std::vector<double> key;  ///< equal keys imply equal meshes
  std::vector<MeshPart> parts;
  Vec3 box_min_B_m = Vec3::Zero(), box_max_B_m = Vec3::Zero();  ///< bounding box of the parts
  double volume_m3 = 0, mass_kg = 0;                            ///< of the soil
};

/// One entry per shape, at most SceneModel::shape_count. A null or missing entry is an invisible
/// shape.
using Shapes = std::vector<std::shared_ptr<const ShapedMesh>>;

/// The shape with this index, or null.
const ShapedMesh* ShapeAt(const Shapes& shapes, int index);
/// True if both have equal keys or are both null.
bool AreAlike(const ShapedMesh* a, const ShapedMesh* b);

/// Time-varying part of the scene.
struct SceneState {
  TimeNs t_ns = 0;
  std::vector<Pose> X_WB;  ///< one per body
  const TerrainSurface* terrain = nullptr;
  Shapes shapes;
  const DustVolume* dust = nullptr;  ///< null without airborne dust
  double exposure_s = 0.004;         ///< exposure time, for the streaks of falling drops
};

}  // namespace tera
