#include "diagnose/tolerances/default_tolerances.h"

namespace tera {
namespace {

constexpr double kRate = 0.06;       ///< rate at full lever, in either direction and at any angle
constexpr double kBand = 0.02;       ///< dead band, as a share of full lever
constexpr double kExponent = 0.085;  ///< changes the rate at half lever by kRate
constexpr double kTravel = 0.02, kTracksDiffer = 0.005, kGauge = 0.05;
constexpr double kPerSlope = 0.05;  ///< estimate: slopes are known to half a degree at best
constexpr double kEncoderZero_deg = 0.17, kEncoderZero_rad = 0.003;
constexpr double kEncoderScale = 0.01;  ///< estimate: linkages between sensor and joint
constexpr double kGyroBias_degps = 0.115, kAccelBias_mps2 = 0.04;
constexpr double kGyroScale = 0.02, kAccelScale = 0.01;  ///< estimates: without calibration
constexpr double kWarming_k = 30;  ///< usual rise of temperature, over which a bias drifts
constexpr double kMount_deg = 0.46, kUnitPlace_m = 0.05, kAntennaPlace_m = 0.025;
constexpr double kHeading_deg = 2.9, kDatum_m = 0.04;
/// Estimate: half of the largest phase error by a reflection, which is a quarter of the carrier's
/// wavelength (Georgiadou and Kleusberg 1988).
constexpr double kReflected_m = 0.024;
constexpr double kPoseTilt_deg = 1.15;   ///< estimate: map levelled by registration
constexpr double kClockDrift_ppm = 100;  ///< estimate: quartz without compensation

constexpr DefaultTolerance kTable[] = {
    {"command_delay", "delay_s", 0, kStampTolerance_s},
    {"input_hold", "period_s", 0, 2 * kStampTolerance_s},  // the mean delay is half the period
    {"actuator_lag", "time_s", 0, kStampTolerance_s},
    {"drive_friction", "time_s", 0, kStampTolerance_s},
    {"dead_band", "width", 0, kBand},
    {"lever_saturation", "limit", 1, kRate},
    {"valve_curve", "exponent", 1, kExponent},
    {"asymmetric_gain", "ratio", 1, kRate},
    {"rate_gain", "gain", 1, kRate},
    {"flow_sharing", "capacity", 1, kRate},
    {"backlash", "gap_rad", 0, kEncoderZero_rad},
    {"track_scale", "scale", 1, kTravel},
    {"track_asymmetry", "difference", 0, kTracksDiffer},
    {"track_slip", "slip", 0, kTravel},
    {"slope_slip", "slip", 0, kTravel},
    {"slope_slip", "slip_per_slope", 0, kPerSlope},
    {"side_slip", "drift_per_slope", 0, kPerSlope},
    {"effective_gauge", "ratio", 1, kGauge},
    {"mount_rotation", "roll_deg", 0, kMount_deg},
    {"mount_rotation", "pitch_deg", 0, kMount_deg},
    {"mount_rotation", "yaw_deg", 0, kMount_deg},
    {"mount_rotation", "roll_deg", 0, kPoseTilt_deg, "poses"},
    {"mount_rotation", "pitch_deg", 0, kPoseTilt_deg, "poses"},
    {"mount_rotation", "yaw_deg", 0, kHeading_deg, "poses"},
    {"imu_lever_arm", "x_m", 0, kUnitPlace_m},
    {"imu_lever_arm", "y_m", 0, kUnitPlace_m},
    {"imu_lever_arm", "z_m", 0, kUnitPlace_m},
    {"gnss_lever_arm", "x_m", 0, kAntennaPlace_m},
    {"gnss_lever_arm", "y_m", 0, kAntennaPlace_m},
    {"gnss_lever_arm", "z_m", 0, kAntennaPlace_m},
    {"antenna_yaw", "yaw_deg", 0, kHeading_deg},
    {"bias", "gyro_x_degps", 0, kGyroBias_degps},
    {"bias", "gyro_y_degps", 0, kGyroBias_degps},
    {"bias", "gyro_z_degps", 0, kGyroBias_degps},
    {"bias", "accel_x_mps2", 0, kAccelBias_mps2},
    {"bias", "accel_y_mps2", 0, kAccelBias_mps2},
    {"bias", "accel_z_mps2", 0, kAccelBias_mps2},
    {"bias", "angle_deg", 0, kEncoderZero_deg},
    {"bias", "travel_m", 0, kEncoderZero_rad},  // per metre of lever
    {"temperature_drift", "gyro_x_degpspk", 0, kGyroBias_degps / kWarming_k},
    {"temperature_drift", "gyro_y_degpspk", 0, kGyroBias_degps / kWarming_k},
    {"temperature_drift", "gyro_z_degpspk", 0, kGyroBias_degps / kWarming_k},
    {"temperature_drift", "accel_x_mps2pk", 0, kAccelBias_mps2 / kWarming_k},
    {"temperature_drift", "accel_y_mps2pk", 0, kAccelBias_mps2 / kWarming_k},
    {"temperature_drift", "accel_z_mps2pk", 0, kAccelBias_mps2 / kWarming_k},
    {"scale", "gyro_x_factor", 1, kGyroScale},
    {"scale", "gyro_y_factor", 1, kGyroScale},
    {"scale", "gyro_z_factor", 1, kGyroScale},
    {"scale", "accel_x_factor", 1, kAccelScale},
    {"scale", "accel_y_factor", 1, kAccelScale},
    {"scale", "accel_z_factor", 1, kAccelScale},
    {"scale", "position_factor", 1, kEncoderScale},
    {"scale", "rate_factor", 1, kEncoderScale},
    {"height_datum", "offset_m", 0, kDatum_m},
    {"position_datum", "east_m", 0, kDatum_m},
    {"position_datum", "north_m", 0, kDatum_m},
    {"multipath", "horizontal_m", 0, kReflected_m},
    {"multipath", "vertical_m", 0, kReflected_m},
    {"clock_offset", "offset_s", 0, kStampTolerance_s},
    {"clock_drift", "drift_ppm", 0, kClockDrift_ppm},
    {"latency", "delay_s", 0, kStampTolerance_s},
    {"filter_delay", "time_constant_s", 0, kStampTolerance_s},
};

}  // namespace

std::span<const DefaultTolerance> DefaultTolerances() { return kTable; }

const DefaultTolerance* DefaultToleranceOf(std::string_view target, std::string_view mechanism,
                                           std::string_view parameter) {
  const DefaultTolerance* found = nullptr;
  for (const DefaultTolerance& one : kTable) {
    if (one.mechanism != mechanism || one.parameter != parameter) continue;
    if (one.target == target) return &one;
    if (one.target.empty()) found = &one;
  }
  return found;
}

}  // namespace tera
