#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/random.h"

namespace tera::blind {

/// Plain numbers of a base on two tracks.
struct PlainTracks {
  double gauge_m = 0, radius_m = 0, contact_m = 0;
  double full_rate_radps = 0;  ///< of a sprocket at full lever
  double mass_kg = 0, turning_kgm2 = 0;

  /// Throws InputError where the file lacks one of the numbers.
  static PlainTracks Read(const std::filesystem::path& machine_yaml);
  PlainTracks Off(double share, const Stream& stream) const;
};

/// Deviations of the running gear from tracks without slip and skid.
struct TrackForm {
  double contact = 0;  ///< loaded share of the tracks' length; 0: their middle alone
  double worn_left = 1, worn_right = 1;  ///< real radius over nominal
  double shear_m = 0;                    ///< shear modulus K of the ground; 0: friction alone
  double drag = 0;                       ///< rolling resistance over weight
  double friction = 0.7;
};

struct TrackLevers {
  double left = 0, right = 0;
};

/// Motion of the base, without noise. Frames: W level; x and y of the point below the tracks'
/// middle.
struct Drive {
  double command_s = 0.02;
  std::vector<TrackLevers> lever;
  std::vector<double> t_s;
  std::vector<double> x_m, y_m, yaw_rad;
  std::vector<double> forward_mps, yaw_radps;
  std::vector<TrackLevers> angle_rad, rate_radps;  ///< of the sprockets
};

using TrackDriver = std::function<TrackLevers(double t_s)>;

/// A base on tracks on level ground.
///
/// Model   a mass with a turning inertia. Each track has eleven evenly loaded shoes. Friction
///         opposes a shoe's sliding, forward and sideways as one vector, with the magnitude mu N
///         tanh(s / s0), or with the shear of the ground since the front shoe, mu N (1 - e^(-j /
///         K)). Slip, skid and the turning resistance follow.
/// Omits   slopes, load transfer, sinkage.
/// Source  Janosi and Hanamoto 1961; Wong and Chiang 2001, "A general theory for skid steering of
///         tracked vehicles on firm ground".
Drive DriveAlong(const PlainTracks& tracks, const TrackForm& form, double duration_s,
                 const std::vector<double>& sample_s, const TrackDriver& driver);

TrackDriver Replayed(const Drive& drive);

}  // namespace tera::blind
