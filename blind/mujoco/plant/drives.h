#pragma once

#include <deque>
#include <optional>

#include "blind/mujoco/plant/arbitration.h"
#include "blind/mujoco/plant/model.h"
#include "blind/mujoco/plant/pilot_line.h"
#include "blind/mujoco/plant/radio.h"
#include "blind/mujoco/plant/valves.h"

namespace tera::blind::mujoco {

/// Path of levers to MuJoCo's actuators.
///
/// Model   Each sample is a message: lost or not (in rows, or by a Radio), delayed by the bus, its
///         Arbitration and a jitter, in order. The valve: a spool with overlap or a soft start, an
///         end, different gains by direction, and a brake. MuJoCo's filters as bus and pilot, a
///         PilotLine. Finally the demanded rate: gains by angle, load, another lever, time and
///         warmth.
class Drives {
 public:
  Drives(const MachineNumbers& numbers, const PlantForm& form, const Stream& messages);

  /// Sends a sample of all levers, at most once a step.
  void Send(double t_s, const PerAxis<double>& levers);
  /// Sets the inputs of MuJoCo's actuators, and the current friction.
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
  /// Product of all gains except the load's.
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
