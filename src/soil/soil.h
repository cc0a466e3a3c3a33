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

/// Water retention and conductivity of a soil. Pavement and similar soils hold no water.
///
/// Model   suction = (S_e^(n/(1-n)) - 1)^(1/n) / alpha, where S_e = (S - S_r) / (1 - S_r) and S is
///         the degree of saturation.
/// Source  van Genuchten 1980, Soil Sci. Soc. Am. J. 44.
struct SoilWater {
  double residual = 0;          ///< S_r, residual degree of saturation
  double alpha_1pm = 0, n = 0;  ///< alpha for suction as a height of water
  double conductivity_mps = 0;  ///< saturated hydraulic conductivity
  bool holds() const { return alpha_1pm > 0; }
};

/// Mechanical and visible properties of one soil.
///
/// Source  Values of the shipped soils: notes in config/soils/. Parameters: McKyes 1985 (cutting),
///         Bekker 1969 and Wong 2008 (pressure and sinkage), Janosi and Hanamoto 1961 (shear).
struct SoilType {
  std::string name;
  double bank_density_kgpm3 = 0;  ///< undisturbed
  double max_density_kgpm3 = 0;   ///< fully compacted
  double swell = 1.0;             ///< loose volume over undisturbed volume
  double friction_angle_rad = 0;
  double cohesion_pa = 0;
  double soil_tool_friction_rad = 0;
  double adhesion_pa = 0;
  double repose_angle_rad = 0;
  /// Ratio of the friction of fast flow to that of slow flow: below 1 for dry grains, above 1 for
  /// moist crumbs.
  double fast_flow_friction = 1;
  double young_modulus_pa = 0;
  // Pressure-sinkage (Bekker) and shear (Janosi-Hanamoto) under running gear, all from one
  // measurement. The shear strength under a plate differs from the internal strength of a cut or a
  // wall.
  double k_c_npm_n1 = 0;    ///< k_c in N/m^(n+1)
  double k_phi_npm_n2 = 0;  ///< k_phi in N/m^(n+2)
  double sinkage_exponent = 1;
  double shear_friction_rad = 0;
  double shear_cohesion_pa = 0;
  double shear_modulus_m = 0;       ///< K, displacement that mobilises 63 % of the strength
  double compression_index = 0.05;  ///< C_c: loss of void ratio per tenfold pressure
  double moisture = 0;              ///< degree of saturation, 0..1
  /// Bank density and moisture without the water from weather. Density 0 means that weather brought
  /// none.
  double unwetted_density_kgpm3 = 0, unwetted_moisture = 0;
  SoilWater water;
  Vec3 albedo = Vec3(0.3, 0.22, 0.15);  ///< linear RGB when dry
  double grain_size_m = 0.01;           ///< for visible detail and for the inertial number of flow
};

/// A round area raised (or lowered, if negative) by height_m. Beyond the radius, the height falls
/// to zero over edge_m as half a cosine wave.
struct RaisedGround {
  Vec2 centre_W_m = Vec2::Zero();
  double radius_m = 0, edge_m = 1, height_m = 0;
};

/// Soil mass moved since the start. Mass is conserved: total_kg() stays zero.
struct MassLedger {
  double ground_kg = 0;   ///< gain of the ground
  double shifted_kg = 0;  ///< sum of the gains of all columns that gained, piles included
  double grains_kg = 0;   ///< in the air
  double carried_kg = 0;  ///< in shovels
  double beds_kg = 0;     ///< in the beds of trucks
  double outside_kg = 0;  ///< pushed over the border of the site
  double water_kg = 0;    ///< part of ground_kg that weather brought
  double total_kg() const {
    return ground_kg + grains_kg + carried_kg + beds_kg + outside_kg - water_kg;
  }
};

/// An open box that receives soil: the bed of a truck, a container, a bin.
///
/// Frames  B frame of the carrier, z up.
struct SoilBed {
  Vec3 floor_B_m = Vec3::Zero();  ///< middle of the floor
  Vec2 size_m = Vec2::Zero();     ///< inner length along x and width along y
  double wall_m = 0;              ///< height of the walls above the floor; the wall at -x is a gate
};

struct BedLoad {
  double mass_kg = 0, volume_m3 = 0;
};

/// Geodetic position of the origin of W, from the GeoTIFF of the site.
struct SiteOrigin {
  double lat_deg = 0, lon_deg = 0, height_m = 0;
};

class Site;

/// The ground of one run, and all processes that move it.
///
/// Frames  W; tools in the frames of their links, as in GroundTools.
/// Model   Columns of strata and soil layers conserve mass. Tools cut, carry, push and dump soil.
///         Tracks press ruts. Slopes steeper than repose flow. Tool forces follow the fundamental
///         earthmoving equation; contact forces follow pressure-sinkage. docs/reference/soil.md
///         gives all equations.
/// Omits   Water that stands or flows on the surface, collisions between clods, flow inside the
///         bucket.
/// Source  Reece 1964; McKyes 1985; Bekker 1969; Janosi and Hanamoto 1961; Culmann's wall.
class Soil {
 public:
  virtual ~Soil() = default;

  /// Registers the tools of a machine and returns its handle for Act. Call it before the first Act.
  virtual int AddMachine(const GroundTools& tools) = 0;

  /// Adds an empty bed at the origin of W and returns its handle.
  virtual int AddBed(const SoilBed& bed) = 0;
  /// Moves a bed and its load with the carrier. Soil slides out of an open gate.
  virtual void MoveBed(int handle, const Pose& X_WB, bool gate_is_open) = 0;
  virtual BedLoad bed_load(int handle) const = 0;

  /// Adds an obstacle at the origin of W and returns its handle. Machines with climbing running
  /// gear drive over it.
  virtual int AddObstacle(const RigidObstacle& obstacle) = 0;
  virtual void MoveObstacle(int handle, const BodyState& state) = 0;

  /// Advances the soil under machine `handle` by `dt_s` and returns the forces of the ground on it.
  /// In this time, the tools and tracks of the machine cut, carry, dump and press ruts.
  virtual SoilReaction Act(int handle, const GroundToolsMotion& motion, double dt_s) = 0;
  /// Advances the flow of slopes that are steeper than the angle of repose.
  virtual void Flow(double dt_s) = 0;
  /// Advances the weather of the site to a time since the start of the run.
  virtual void LetWeatherAct(TimeNs since_start_ns) = 0;

  virtual const TerrainSurface& surface() const = 0;
  /// All soil kinds of the run: each soil at each of its moistures. The visible kinds come first.
  virtual const std::vector<SoilType>& soils() const = 0;
  virtual MassLedger ledger() const = 0;

  /// Makes the present ground the reference of kChange and kMassChange. Before the first call, the
  /// reference is the site as it was read.
  virtual void MarkStart() = 0;
  /// Soil at a depth below the surface of the column nearest to (x, y) in W. Empty above the
  /// surface and outside the site.
  virtual std::optional<SoilSample> SampleBelow(double x_m, double y_m, double depth_m) const = 0;
  /// Mass, soil, compaction and moisture in the cubes of a box.
  virtual SoilVoxels Voxels(const VoxelBox& box) const = 0;
  /// Writes a raster of the ground as a GeoTIFF, georeferenced by `origin`. A pixel is the mean of
  /// `columns_per_pixel` x `columns_per_pixel` columns. Throws InputError if the file cannot be
  /// written.
  virtual void WriteGeoTiff(const std::filesystem::path& file, GroundRaster raster,
                            const SiteOrigin& origin, int columns_per_pixel) const = 0;
};

/// Creates the ground of a run from a copy of `site`. `seed` drives the scatter of poured clods.
std::unique_ptr<Soil> MakeSoil(const Site& site, std::uint64_t seed);

}  // namespace tera
