#pragma once

#include <cstddef>

namespace tera::blind {

/// Shares of the lags of spool, pilot and coil.
inline constexpr double kLagShares[] = {50. / 63, 10. / 63, 3. / 63};

/// Deviations of one joint's drive from the ideal, in the forms of this benchmark. No form is
/// written as the library mechanism that should be named for it. 0, or 1 for factors, is ideal.
///
/// Model   in the order in which the lever's signal passes them.
struct AxisForm {
  // Between hand and valve: a queue of messages, or a line of equal lags.
  double queue_s = 0,
         queue_jitter_s = 0;  ///< delay of each message: queue + |N(0, jitter)|, in order
  double hold_s = 0;          ///< messages are sampled once in this period
  double spool_play = 0;      ///< share of the lever within which friction holds the spool; springs
                              ///< centre it
  double line_s = 0;          ///< sum of the line's lags
  std::size_t line_stages = 0;

  // Valve: what the notches of its spool open.
  double overlap = 0;       ///< of the spool over the port, of its full stroke
  double notch = 0.02;      ///< stroke over which a round notch opens to its full width
  double area_square = 0;   ///< area (1 - s) x + s x^2 of a triangular notch in a slot
  double area_end = 0;      ///< stroke at which the area ends, rounded
  double piston_ratio = 1;  ///< area over the piston to area around the rod: negative is faster
  double delivered = 1;     ///< share of the flow that a worn pump delivers

  // Stroke of the spool and oil behind it.
  double lag_s = 0;       ///< sum of three lags, in kLagShares
  double slew_per_s = 0;  ///< greatest change of the rate, in full rates a second
  double supply_nm = 0;   ///< effort at supply pressure; the oil's spring below
  double oil_radps = 40, oil_damping = 0.4;

  // Cylinder, structure, pins.
  bool pins = false;       ///< the lever sets the piston's rate, the pins make the joint's
  double pins_at_rad = 0;  ///< where that gives the nominal rate
  double flex_radps = 0, flex_damping = 0;  ///< mass on a spring behind the drive
  double gap_rad = 0;                       ///< two masses, the second held by its seized pin
  // LuGre friction against a compliant motor with time constant `weak_s`. Sliding bristles hold a
  // share of their static force.
  double bristle_nm = 0, bristle_radps = 0.05, sliding_share = 0.6, weak_s = 0.08;

  // Effects outside the library.
  double warm_share = 0, warm_s = 1;  ///< rate less by share e^(-t / warm)
  double other_share = 0;             ///< rate less by share |lever of another axis|
  std::size_t other_axis = 0;
  double ripple_share = 0, ripple_cycles = 0;  ///< rate by position: 1 + share sin(cycles q)
};

}  // namespace tera::blind
