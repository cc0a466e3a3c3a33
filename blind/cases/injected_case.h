#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "blind/cases/case_recording.h"
#include "blind/plant/concealed.h"

namespace tera::blind {

/// A drive of a real skid-steer vehicle: its wheels' encoders, and poses by a reference.
struct RealDrive {
  std::vector<double> t_s, left_radps, right_radps;
  Table poses;

  /// Reads a CSV file with the columns t_s, meas_left_vel, meas_right_vel (rad/s), icp_index,
  /// icp_pos_* and icp_quat_*. A pose counts where its index is new. Throws InputError.
  static RealDrive Read(const std::filesystem::path& csv);
  /// The part from `from_s` on, `length_s` long; time counts from its start.
  RealDrive Part(double from_s, double length_s) const;
};

/// A part of a real drive with an injected effect: wheels of another circumference turn faster or
/// slower over the same distance.
struct InjectedCase {
  RealDrive drive;
  double left = 1, right = 1;  ///< factors on the rates of the wheels
};

/// Whether a finding concerns the vehicle itself, independent of the injected effect. Its poses
/// come late and carry their time of arrival: they stand still and jump while all wheels turn
/// evenly. Its sides differ by one or two per cent, as its gyroscope and wheels show without poses
/// (scripts/gyro_asymmetry.py).
bool IsOfRealDrive(const std::string& target, const std::string& mechanism);

/// Names of effects that are injected into real drives.
const std::vector<std::string>& NameableInRealDrives();

/// Sets the factors. The vehicle's own faults remain. The effect's parameters cannot be separated
/// from them, so the truth has none.
Concealed HideInRealDrive(const std::string& name, Strength strength, const Stream& stream,
                          InjectedCase* out);

CaseRecording RecordInjected(const InjectedCase& injected);

}  // namespace tera::blind
