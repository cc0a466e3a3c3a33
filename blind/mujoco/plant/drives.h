#pragma once

#include <deque>
#include <optional>

#include "blind/mujoco/plant/arbitration.h"
#include "blind/mujoco/plant/model.h"
#include "blind/mujoco/plant/pilot_line.h"
#include "blind/mujoco/plant/radio.h"
#include "blind/mujoco/plant/valves.h"

namespace tera::blind::mujoco {

/// What becomes of levers on their way to MuJoCo's actuators.
///
/// Model   A message a lever's sample: lost or not (in rows, or by a Radio), late by the bus's
///         delay, by its Arbitration and by something of its own, in order. The valve: a spool that
///         overlaps its port or starts softly, ends, and gives more one way than the other, behind
///         a brake. MuJoCo's filters as bus and pilot, a PilotLine. Behind them the rate that is
///         asked of the motor: times gains by angle, load, another lever, time and warmth.
class Drives {
 public:
  Drives(const MachineNumbers& numbers, const PlantForm& form, const Stream& messages);

  /// A sample of all levers, at most one a step.
  void Send(double t_s, const PerAxis<double>& levers);
  /// Sets what MuJoCo's actuators are told, and friction as it is now.
  void Command(double t_s, const PerAxis<double>& angle_rad, Model* model, mjData* data);

 private:
  struct Message {
    double at_s = 0, lever = 0;
  };
  struct Line {
    std::deque<Message> under_way;
    double lever = 0, spool = 0, load_nm = 0;
    bool losing = false;
    std::optional<Arbitration> arbitration;
    std::optional<Radio> radio;
    std::optional<PilotLine> hose;
    std::optional<RunsAhead> falls;
    std::optional<HoldingBrake> brake;
  };
  bool IsLost(std::size_t axis, std::uint64_t number, double t_s);
  double Valve(std::size_t axis, double lever);
  double OpenSpool(const DriveForm& form, double spool) const;
  /// What becomes of a rate by all but the load.
  double Gain(std::size_t axis, double t_s, double angle_rad) const;
  double AskedRate_radps(std::size_t axis, double t_s, double valve, double angle_rad,
                         const Model& model, const mjData& data);
  void SetFriction(std::size_t axis, Model* model, const mjData& data) const;

  PerAxis<double> full_rate_radps_;
  double ring_m_;  ///< diameter
  PerAxis<DriveForm> forms_;
  Stream messages_;
  std::uint64_t sent_ = 0;
  PerAxis<Line> lines_;
};

}  // namespace tera::blind::mujoco
