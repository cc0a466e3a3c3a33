#include "blind/plant/tracked_base.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera::blind {
namespace {

PlainTracks TrackedBaseTb235() { return PlainTracks::Read("config/machines/tb235.yaml"); }

/// Levers held for 4 s, and the base's motion.
struct Steady {
  Steady(const TrackForm& form, TrackLevers levers) : tracks(TrackedBaseTb235()) {
    drive = DriveAlong(tracks, form, 4, {3.9}, [&](double) { return levers; });
  }
  double forward_mps() const { return drive.forward_mps.back(); }
  double turn_radps() const { return drive.yaw_radps.back(); }
  PlainTracks tracks;
  Drive drive;
};

TEST(TrackedBase, ShortTracksNeitherSlipNorSkid) {
  // 0.4 and 0.8 of 1.25 m/s on a gauge of 1.148 m.
  const Steady arc({}, {0.4, 0.8});
  EXPECT_NEAR(arc.forward_mps(), 0.75, 1e-3);
  EXPECT_NEAR(arc.turn_radps(), 0.5 / 1.148, 1e-3);
}

TEST(TrackedBase, LongTracksTurnLessAsIfTheirGaugeWereWider) {
  TrackForm form;
  form.contact = 1;
  const Steady spot(form, {-0.4, 0.4});
  const double ratio = 1.0 / 1.148 / spot.turn_radps();
  // Measured values of skid-steered vehicles are 1.1 to 2.9.
  EXPECT_GT(ratio, 1.1);
  EXPECT_LT(ratio, 2.9);
  EXPECT_NEAR(Steady(form, {0.5, 0.5}).forward_mps(), 0.625, 1e-3);
}

TEST(TrackedBase, ShearingGroundGivesTheThrustThatDragNeedsAtJanosisSlip) {
  TrackForm form;
  form.shear_m = 0.02, form.drag = 0.2, form.contact = 1;
  const Steady straight(form, {0.6, 0.6});
  // drag = mu (1 - (1 - e^-x) / x) with x = i L / K, by bisection.
  double low = 1e-6, high = 50;
  for (int k = 0; k < 60; ++k) {
    const double x = (low + high) / 2;
    (0.7 * (1 + std::expm1(-x) / x) < 0.2 ? low : high) = x;
  }
  const double slip = low * 0.02 / straight.tracks.contact_m;
  EXPECT_NEAR(1 - straight.forward_mps() / 0.75, slip, 0.1 * slip);
}

TEST(TrackedBase, ALargerSprocketOnTheRightTurnsItLeft) {
  TrackForm form;
  form.worn_left = 0.95, form.worn_right = 1.05;
  const Steady straight(form, {0.5, 0.5});
  EXPECT_NEAR(straight.turn_radps(), 0.1 * 0.625 / 1.148, 1e-3);
}

}  // namespace
}  // namespace tera::blind
