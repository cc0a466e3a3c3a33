#pragma once

#include <limits>

#include "core/motion.h"
#include "core/types/effects.h"

namespace tera {

/// Force limits of a driven base, equal in both directions.
struct BaseEffort {
  double forward_n = 0, left_n = 0, yaw_nm = 0;
};

/// Geometry and weight of running gear, for the slot `ground`.
struct TrackGeometry {
  double gauge_m = 1;           ///< between the centre lines of left and right
  double contact_length_m = 1;  ///< contact length on the ground
  double weight_n = 1;
};

/// Deviations from two tracks without slip or skid; the defaults have none.
struct TrackKinematicsParameters {
  double scale = 1;       ///< track_scale
  double difference = 0;  ///< track_asymmetry: right relative to left
  double slip = 0;        ///< track_slip
  double shear_modulus_m = 0, friction = 1;
  double turn_slip = 0;
  double slope_slip = 0, slip_per_slope = 0;
  double drift_per_slope = 0;  ///< side_slip
  double gauge_ratio = 1;      ///< effective_gauge
  double icr_forward_m = 0, icr_left_m = 0;
  double resistance = 0;  ///< rolling_resistance
  double slip_stiffness = std::numeric_limits<double>::infinity();
  double holding = 0, yield_mps = 0;  ///< digging_force
};

TrackKinematicsParameters TrackKinematicsOf(const Effects& base);

/// Speeds of the shoes (or treads) of both sides, positive for driving forward.
struct TrackSpeeds {
  double left_mps = 0, right_mps = 0;
};

/// Loads and slopes that act on the tracks.
struct TrackCircumstances {
  double roll_rad = 0, pitch_rad = 0;  ///< attitude of the base, as from RpyFromRotation
  /// force of the ground on bucket and blade, forward and left
  Vec2 tool_force_B_n = Vec2::Zero();
  double tool_torque_B_nm = 0;  ///< torque of that force about the base's z axis
};

/// Motion of the base in the plane of its tracks, at the centre of their contact.
struct PlanarTwist {
  double forward_mps = 0, left_mps = 0, yaw_radps = 0;
};

/// First part of the slot `ground`: speeds of the shoes, s V (1 - a/2) on the left and s V (1 +
/// a/2) on the right. V is the sprockets' rate times their nominal radius, s is track_scale and a
/// is track_asymmetry.
TrackSpeeds ShoeSpeeds(const TrackSpeeds& nominal, const TrackKinematicsParameters& parameters);

/// Second part of the slot `ground`: motion of the base from the speeds of the shoes.
///
/// Frames  B base, x forward, y left, z up, origin at the centre of the contact of both tracks.
/// Model   Slip: each track moves on the ground at u = V (1 - i). The slip i is the sum of these
///         parts:
///         - track_slip: a constant, plus the slip for a thrust T over the load N by Janosi and
///           Hanamoto: T = mu N (1 - (1 - e^-x) / x), x = i L / K.
///         - slope_slip: i0 + k tan(slope along the travel).
///         - rolling_resistance: T / (C N), also with f = 0.
///         The thrust T balances the weight along the slope, the rolling resistance f N and the
///         force of the tools.
///         Motion: with y0 and x0 of icr_shift and the effective gauge r B,
///         - w = (u_right - u_left) / (r B)
///         - v_x = (1 - k_turn t) (u_left + u_right) / 2 + w y0
///         - v_y = -w x0 - k_side tan(side slope) (|u_left| + |u_right|) / 2
///         where t = |V_right - V_left| / (|V_left| + |V_right|). The term with k_turn is turn_slip
///         of track_slip: shoes that slide sideways also shear the ground lengthwise. Without
///         effects, v_x = (V_left + V_right) / 2, w = (V_right - V_left) / B and v_y = 0.
///         Digging (digging_force): a tool force F above the share h of the weight W drags the base
///         at yield (|F| - h W) / W. Its torque acts likewise, with the arm L / 4 of the tracks.
/// Omits   Inertia; load transfer between the tracks; slip beyond |i| = 1.
/// Source  Wong, Theory of Ground Vehicles, 4th ed. 2008, ch. 2 and 6; Janosi and Hanamoto 1961;
///         Martinez, Mandow et al., Int. J. Robotics Research 24(10), 2005: ICRs of tracks; Wong
///         and Chiang, Proc. IMechE D 215(3), 2001: shear of tracks that skid in a turn.
PlanarTwist MoveOnTracks(const TrackSpeeds& shoes, const TrackCircumstances& circumstances,
                         const TrackGeometry& geometry,
                         const TrackKinematicsParameters& parameters);

}  // namespace tera
