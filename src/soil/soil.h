#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "core/types/ground_tools.h"
#include "core/types/rigid_obstacle.h"
#include "core/types/terrain_surface.h"
#include "soil/soil_view.h"

namespace tera {

/// How a soil holds water and lets it through; nothing for pavement and the like.
///
/// Model   suction (S_e^(n/(1-n)) - 1)^(1/n) / alpha, S_e = (S - S_r) / (1 - S_r) of the degree of
///         saturation S.
/// Source  van Genuchten 1980, Soil Sci. Soc. Am. J. 44.
struct SoilWater {
  double residual = 0;          ///< S_r
  double alpha_1pm = 0, n = 0;  ///< alpha for suction as a height of water
  double conductivity_mps = 0;  ///< hydraulic, saturated
  bool holds() const { return alpha_1pm > 0; }
};

/// Mechanical and visible properties of one soil.
///
/// Source  values of the shipped soils: see the notes in config/soils/; parameters as in McKyes
///         1985 (cutting), Bekker 1969 and Wong 2008 (pressure and sinkage), Janosi and Hanamoto
///         1961 (shear).
struct SoilType {
  std::string name;
  double bank_density_kgpm3 = 0;  ///< undisturbed
  double max_density_kgpm3 = 0;   ///< fully compacted
  double swell = 1.0;             ///< loose volume over bank volume
  double friction_angle_rad = 0;
  double cohesion_pa = 0;
  double soil_tool_friction_rad = 0;
  double adhesion_pa = 0;
  double repose_angle_rad = 0;
  /// Friction of fast flow over that of slow flow: less than 1 for dry grains, more for moist
  /// crumbs.
  double fast_flow_friction = 1;
  double young_modulus_pa = 0;
  // Pressure-sinkage (Bekker) and shear (Janosi-Hanamoto) under running gear, all from one
  // measurement. A plate's shear strength is not the internal one of a cut or a wall.
  double k_c_npm_n1 = 0;    ///< N/m^(n+1)
  double k_phi_npm_n2 = 0;  ///< N/m^(n+2)
  double sinkage_exponent = 1;
  double shear_friction_rad = 0;
  double shear_cohesion_pa = 0;
  double shear_modulus_m = 0;       ///< K
  double compression_index = 0.05;  ///< C_c: void ratio lost for each tenfold pressure
  double moisture = 0;              ///< degree of saturation, 0..1
  /// Bank density and moisture without the water that a run's weather brought; density 0: it
  /// brought none.
  double unwetted_density_kgpm3 = 0, unwetted_moisture = 0;
  SoilWater water;
  // Appearance.
  Vec3 albedo = Vec3(0.3, 0.22, 0.15);  ///< linear RGB when dry
  double grain_size_m = 0.01;           ///< of visible detail, and of the flow's inertial number
};

/// A round stretch of ground that lies higher (or lower) than the site says, falling off beyond its
/// radius as a half wave of cosine.
struct RaisedGround {
  Vec2 centre_W_m = Vec2::Zero();
  double radius_m = 0, edge_m = 1, height_m = 0;
};

/// Movement of soil since the start. One place's gain is another's loss: the total stays zero.
struct MassLedger {
  double ground_kg = 0;   ///< gained by the ground
  double shifted_kg = 0;  ///< sum of the gains of single columns, piles included
  double grains_kg = 0;   ///< in the air
  double carried_kg = 0;  ///< in shovels
  double beds_kg = 0;     ///< in trucks' beds
  double outside_kg = 0;  ///< pushed over the border of the site
  double water_kg = 0;    ///< of ground_kg, that weather brought
  double total_kg() const {
    return ground_kg + grains_kg + carried_kg + beds_kg + outside_kg - water_kg;
  }
};

/// An open box that soil may be dumped into: a truck's bed, a container, a bin.
///
/// Frames  B frame of its carrier, z up.
struct SoilBed {
  Vec3 floor_B_m = Vec3::Zero();  ///< middle of its floor
  Vec2 size_m = Vec2::Zero();     ///< inner length along x and width along y
  double wall_m = 0;              ///< height of its walls above the floor; that at -x is a gate
};

/// A bed's load.
struct BedLoad {
  double mass_kg = 0, volume_m3 = 0;
};

/// Georeference of a site read from a GeoTIFF: geodetic place of W's origin.
struct SiteOrigin {
  double lat_deg = 0, lon_deg = 0, height_m = 0;
};

class Site;

/// The ground of one run as columns, and everything that moves it.
///
/// Frames  W; tools in the frames of their links, as in GroundTools.
/// Model   columns of strata and layers of soil that keep mass; tools cut, carry, push
///         and dump, tracks press ruts, slopes steeper than repose flow. Forces by the fundamental
///         earthmoving equation and by pressure-sinkage. docs/reference/soil.md says each in full.
/// Omits   water that stands or flows on the surface, collisions between clods, flow inside the
///         bucket.
/// Source  Reece 1964; McKyes 1985; Bekker 1969; Janosi and Hanamoto 1961; Culmann's wall.
class Soil {
 public:
  virtual ~Soil() = default;

  /// Registers a machine's tools; returns its handle for Act. Call before the first Act.
  virtual int AddMachine(const GroundTools& tools) = 0;

  /// Adds a bed, empty, at W's origin; returns its handle.
  virtual int AddBed(const SoilBed& bed) = 0;
  /// Puts a bed, with its load, where its carrier is. Soil slides out of an open gate.
  virtual void MoveBed(int handle, const Pose& X_WB, bool gate_is_open) = 0;
  virtual BedLoad bed_load(int handle) const = 0;

  /// Adds an obstacle at W's origin, for those machines that climb it; returns its handle.
  virtual int AddObstacle(const RigidObstacle& obstacle) = 0;
  virtual void MoveObstacle(int handle, const BodyState& state) = 0;

  /// Forces of the ground on machine `handle` in its present motion, and the work that its tools
  /// and tracks do on the ground over the next `dt_s`: cuts, carries, dumps, presses ruts.
  virtual SoilReaction Act(int handle, const GroundToolsMotion& motion, double dt_s) = 0;
  /// Lets slopes steeper than the angle of repose flow for `dt_s`.
  virtual void Flow(double dt_s) = 0;
  /// Lets the site's weather act until a time since the start of the run.
  virtual void LetWeatherAct(TimeNs since_start_ns) = 0;

  virtual const TerrainSurface& surface() const = 0;
  /// Every soil at every moisture that the run may give it; those that are shown come first.
  virtual const std::vector<SoilType>& soils() const = 0;
  virtual MassLedger ledger() const = 0;

  /// Change is counted from the present ground on; at first, from the site as it was read.
  virtual void MarkStart() = 0;
  /// The soil `depth_m` below the surface at (x, y) in W, at the nearest column; nothing above the
  /// surface and beyond the site.
  virtual std::optional<SoilSample> SampleBelow(double x_m, double y_m, double depth_m) const = 0;
  /// The ground in cubes: mass, soil, compaction and moisture at every depth of a box.
  virtual SoilVoxels Voxels(const VoxelBox& box) const = 0;
  /// A raster of the ground as GeoTIFF, georeferenced about `origin`; a pixel is the mean of
  /// `columns_per_pixel` columns to a side. Throws InputError where it cannot be written.
  virtual void WriteGeoTiff(const std::filesystem::path& file, GroundRaster raster,
                            const SiteOrigin& origin, int columns_per_pixel) const = 0;
};

/// The ground of a run that starts on `site`, which is copied. `seed` scatters poured clods.
std::unique_ptr<Soil> MakeSoil(const Site& site, std::uint64_t seed);

}  // namespace tera
