#pragma once

#include <limits>

#include "core/motion.h"
#include "core/types/effects.h"

namespace tera {

/// Largest forces, either way, with which a base is driven.
struct BaseEffort {
  double forward_n = 0, left_n = 0, yaw_nm = 0;
};

/// Running gear as the slot sees it.
struct TrackGeometry {
  double gauge_m = 1;           ///< between the middles of left and right
  double contact_length_m = 1;  ///< on the ground
  double weight_n = 1;
};

/// How tracks differ from two that neither slip nor skid. As built, not at all.
struct TrackKinematicsParameters {
  double scale = 1;       ///< track_scale
  double difference = 0;  ///< track_asymmetry: right over left
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

/// Speeds of the shoes (or treads) of both sides, positive when they drive forward.
struct TrackSpeeds {
  double left_mps = 0, right_mps = 0;
};

/// What the tracks work against.
struct TrackCircumstances {
  double roll_rad = 0, pitch_rad = 0;  ///< of the base, as RpyFromRotation gives them
  Vec2 tool_force_B_n = Vec2::Zero();  ///< of the ground on bucket and blade, forward and left
  double tool_torque_B_nm = 0;         ///< of that force, about the base's z axis
};

/// Motion of the base in the plane of its tracks, at the middle of their contact.
struct PlanarTwist {
  double forward_mps = 0, left_mps = 0, yaw_radps = 0;
};

/// Slot `ground`, first part: track_scale s and track_asymmetry a make of the speed V that the
/// sprockets' rate and nominal radius give those of the shoes, s V (1 - a/2) on the left and
/// s V (1 + a/2) on the right.
TrackSpeeds ShoeSpeeds(const TrackSpeeds& nominal, const TrackKinematicsParameters& parameters);

/// Slot `ground`, second part: from the speeds of the shoes to the motion of the base.
///
/// Frames  B base, x forward, y left, z up, its origin amid the contact of both tracks.
/// Model   Each track moves on the ground at u = V (1 - i). Its slip i is the sum of track_slip's
///         constant, slope_slip's i0 + k tan(slope along its travel), and what its thrust T over
///         its load N asks for: by Janosi and Hanamoto T = mu N (1 - (1 - e^-x) / x), x = i L / K,
///         and by rolling_resistance T / (C N), also where its f is 0. T carries the weight's part
///         along the slope, the rolling resistance f N and the tools' force. Then, with y0 and x0
///         of icr_shift and the effective gauge r B,
///           w = (u_right - u_left) / (r B),  v_x = (1 - k_turn t) (u_left + u_right) / 2 + w y0,
///           v_y = -w x0 - k_side tan(side slope) (|u_left| + |u_right|) / 2.
///         with t = |V_right - V_left| / (|V_left| + |V_right|): shoes that are dragged sideways
///         shear the ground lengthwise as well (track_slip's turn_slip).
///         digging_force: a tool force beyond the share h of the weight W drags the base along at
///         yield (|F| - h W) / W, its torque likewise with the arm L / 4 of the tracks.
///         Without effects v_x = (V_left + V_right) / 2, w = (V_right - V_left) / B, v_y = 0.
/// Omits   inertia; load moved between the tracks; slip beyond |i| = 1.
/// Source  Wong, Theory of Ground Vehicles, 4th ed. 2008, ch. 2 and 6; Janosi and Hanamoto 1961;
///         Martinez, Mandow et al., Int. J. Robotics Research 24(10), 2005: ICRs of tracks; Wong
///         and Chiang, Proc. IMechE D 215(3), 2001: shear of tracks that skid in a turn.
PlanarTwist MoveOnTracks(const TrackSpeeds& shoes, const TrackCircumstances& circumstances,
                         const TrackGeometry& geometry,
                         const TrackKinematicsParameters& parameters);

}  // namespace tera
