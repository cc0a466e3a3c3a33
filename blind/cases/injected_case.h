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

  /// Of a CSV file with the columns t_s, meas_left_vel, meas_right_vel (rad/s), icp_index,
  /// icp_pos_* and icp_quat_*; a pose counts where its index is a new one. Throws InputError.
  static RealDrive Read(const std::filesystem::path& csv);
  /// From `from_s` on, for `length_s`; time counts from there.
  RealDrive Part(double from_s, double length_s) const;
};

/// A part of a real drive into which something was put that was not there: wheels of another
/// circumference turn faster or slower for the same way.
struct InjectedCase {
  RealDrive drive;
  double left = 1, right = 1;  ///< factors on the rates of the wheels
};

/// Whether a finding is of the vehicle itself, whatever was put in: its poses come late, and are
/// stamped as they come (they stand still and jump while all wheels turn evenly), and its sides
/// differ by one or two per cent, which its gyroscope and wheels show without poses
/// (scripts/gyro_asymmetry.py).
bool IsOfRealDrive(const std::string& target, const std::string& mechanism);

/// Names of effects that are put into real drives.
const std::vector<std::string>& NameableInRealDrives();

/// Sets the factors. The vehicle's own faults stay; the numbers of the effect are not known apart
/// from them, so none are asked for.
Concealed HideInRealDrive(const std::string& name, Strength strength, const Stream& stream,
                          InjectedCase* out);

CaseRecording RecordInjected(const InjectedCase& injected);

}  // namespace tera::blind
