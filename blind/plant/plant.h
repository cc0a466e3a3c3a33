#pragma once

#include <array>
#include <functional>
#include <vector>

#include "blind/plant/axis_form.h"
#include "blind/plant/excavator.h"
#include "core/random.h"

namespace tera::blind {

using Forms = std::array<AxisForm, kAxes>;

/// Motion of the excavator, without noise.
struct Motion {
  double command_s = 0.02;        ///< hold time of the levers
  std::vector<AxisValues> lever;  ///< from k * command_s on
  std::vector<double> t_s;        ///< of the samples
  std::vector<AxisValues> q_rad, w_radps;
};

/// Levers at a time, given the joints: an operator keeps them off their stops.
using Driver = std::function<AxisValues(double t_s, const AxisValues& q_rad)>;

struct Course {
  AxisValues start_rad{};
  double duration_s = 40;
  std::vector<double> sample_s;  ///< ascending times of the requested motion
};

/// The joints of an excavator under levers.
///
/// Model   each joint is a mass (everything beyond it, at the current position) under its weight
///         and a motor that demands the rate of its AxisForm, within its effort. Joints act on each
///         other by their weights alone. Integrated by variable-order backward differences, with
///         the edges of dead bands, gaps and effort limits found as roots.
/// Omits   Coriolis and centrifugal efforts, the undercarriage's motion.
/// Source  Hindmarsh et al. 2005, "SUNDIALS"; library CVODE.
Motion Move(const Excavator& excavator, const Forms& forms, const Course& course,
            const Driver& driver, const Stream& stream);

/// A driver that repeats the levers of a motion.
Driver Replayed(const Motion& motion);

}  // namespace tera::blind
