#include "blind/mujoco/cases/tolerances.h"

namespace tera::blind::mujoco {
namespace {

/// Largest share of each tolerance, so that several together stay within.
constexpr double kShare = 0.75;

void DrawDrives(Draws* draws, PlantForm* out) {
  const double late_s = draws->Between(0, 0.3 * kTolerances.late_s);  // oil and pilot have 0.018 s
  for (DriveForm& drive : out->drives) {
    drive.gain = 1 + draws->Within(0.5 * kTolerances.rate);
    drive.negative = 1 + draws->Within(0.2 * kTolerances.rate);
    drive.wave = draws->Within(0.05 * kTolerances.rate);
    drive.overlap = draws->Between(0, kShare * kTolerances.dead_band);
    drive.bus.delay_s = late_s;
    drive.bus.jitter_s = draws->Between(0, 0.002);
  }
  // Tracks of one machine are alike, or it would not go straight.
  out->drives[kRightTrack] = out->drives[kLeftTrack];
  for (const std::size_t i : {kLeftTrack, kRightTrack}) out->drives[i].wave = 0;
}

void DrawBody(Draws* draws, PlantForm* out) {
  out->shoes.gauge = 1 + draws->Between(-0.6, 0.4) * kTolerances.gauge;
  out->shoes.grip_across = draws->Between(0.3, 0.5);
  const double travel = 1 + draws->Within(kShare * kTolerances.travel);
  const double apart = draws->Within(kShare * kTolerances.tracks_apart) / 2;
  out->sprocket = {travel * (1 - apart), travel * (1 + apart)};
  for (double& mass : out->mass) mass = 1 + draws->Within(0.03);
}

void DrawMounts(Draws* draws, PlantForm* out) {
  for (Misplaced& unit : out->units) {
    unit = {draws->Vector(0.008), draws->Vector(kShare * kTolerances.mount_rad)};
  }
  for (Misplaced& antenna : out->antennas) {
    antenna.xyz_m = draws->Vector(kShare * kTolerances.antenna_m);
  }
}

void DrawSensors(Draws* draws, SensorsForm* out) {
  const auto clock = [&] { return ClockForm{draws->Within(0.2 * kTolerances.late_s), 0}; };
  for (UnitForm& unit : out->units) {
    unit.gyro_radps = draws->Vector(kShare * kTolerances.gyro_radps);
    unit.accelerometer_mps2 = draws->Vector(kShare * kTolerances.accelerometer_mps2);
    unit.clock = clock();
  }
  for (std::size_t i = kSlew; i < kAxisCount; ++i) {
    out->encoders[i].zero_rad = draws->Within(kShare * kTolerances.zero_rad);
  }
  out->joint_clock = clock();
  out->track_clock = clock();
  const Vec3 datum_m = draws->Vector(0.5 * kTolerances.datum_m);
  for (ReceiverForm& receiver : out->receivers) {
    receiver.datum_m = datum_m;
    receiver.clock = clock();
  }
}

NoiseForm DrawNoise(Draws* draws) {
  NoiseForm noise;
  const double loud = draws->Between(0.7, 1.3);
  noise.gyro_radps *= loud;
  noise.accelerometer_mps2 *= loud;
  noise.engine_hz = draws->Between(30, 42);
  noise.engine_mps2 *= draws->Between(0.3, 2);
  noise.engine_radps *= draws->Between(0.3, 2);
  noise.rate_radps *= draws->Between(0.7, 1.3);
  noise.track_radps *= draws->Between(0.7, 1.5);
  noise.white_m *= draws->Between(0.7, 1.4);
  noise.slow_m *= draws->Between(0.5, 1.5);
  noise.lost *= draws->Between(0.3, 2);
  noise.tails *= draws->Between(0, 2);
  return noise;
}

}  // namespace

Forms DrawWithinTolerances(const MachineNumbers& numbers, Draws* draws) {
  Forms forms;
  for (std::size_t i = 0; i < kAxisCount; ++i) forms.plant.drives[i].oil = numbers.oil[i];
  DrawDrives(draws, &forms.plant);
  DrawBody(draws, &forms.plant);
  DrawMounts(draws, &forms.plant);
  DrawSensors(draws, &forms.sensors);
  forms.sensors.noise = DrawNoise(draws);
  return forms;
}

}  // namespace tera::blind::mujoco
