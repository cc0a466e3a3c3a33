#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "blind/mujoco/cases/whole_case.h"
#include "own_folder.h"

namespace tera::blind::mujoco {
namespace {

namespace fs = std::filesystem;

const OwnersMachine& FourTons() {
  static const OwnersMachine machine = {
      "examples/prove/excavator4t.yaml", "examples/prove/rig4t.yaml",
      MachineNumbers::Read("examples/prove/excavator4t.yaml", "examples/prove/rig4t.yaml")};
  return machine;
}

WholeCase Drawn(int number, std::optional<double> duration_s = {}, bool reserve = false) {
  return DrawWholeCase(4, number, FourTons().numbers, reserve, duration_s);
}

std::string TextOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// All files of a folder by their names in it.
std::map<std::string, std::string> FilesOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[entry.path().lexically_relative(folder).string()] = TextOf(entry.path());
    }
  }
  return files;
}

/// A case's folder.
std::map<std::string, std::string> Written(int number, const std::string& name) {
  const fs::path folder = OwnFolder() / name;
  WholeCase c = Drawn(number, 12);
  const WholeRecording recording = RecordWholeCase(&c, FourTons().numbers, 4);
  WriteWholeCase(c, FourTons(), recording.measured, folder);
  return FilesOf(folder);
}

/// The first case of a kind that drives as is said.
WholeCase First(CaseKind kind, bool drives, double duration_s) {
  for (int k = 0;; ++k) {
    WholeCase c = Drawn(k, duration_s);
    if (c.about.kind == kind && c.drives == drives) return c;
  }
}

TEST(WholeCase, SameSeedGivesTheSameBytes) {
  const auto first = Written(2, "first"), second = Written(2, "second");
  EXPECT_GE(first.size(), 18u);  // scenario, machine, rig, dataset, levers, seven or eight sensors
  EXPECT_GT(first.at("recording/digger/imu_arm/data.csv").size(), 40000u);
  EXPECT_EQ(first, second);
}

TEST(WholeCase, NothingWrongIsDrawnWithinTheTolerances) {
  for (int k = 0; k < 200; ++k) {
    const Forms forms = Drawn(k).within;
    for (const DriveForm& drive : forms.plant.drives) {
      EXPECT_LT(std::abs(drive.gain * drive.negative * (1 + std::abs(drive.wave)) - 1), 0.06);
      EXPECT_LT(drive.overlap, 0.02);
      // 2 zeta / omega of the oil's spring, the pilot, the bus.
      EXPECT_LT(2 * 0.5 / drive.oil.natural_radps + drive.pilot_s + drive.bus.delay_s +
                    drive.bus.jitter_s,
                0.04);
      EXPECT_EQ(drive.gap_rad, 0);
      EXPECT_EQ(drive.bus.lost, 0);
    }
    EXPECT_LT(std::abs(forms.plant.sprocket.mean() - 1), 0.02);
    EXPECT_LT(std::abs(forms.plant.sprocket.x() - forms.plant.sprocket.y()), 0.005);
    EXPECT_LT(std::abs(forms.plant.shoes.gauge - 1), 0.05);
    for (std::size_t u = 0; u < kUnits; ++u) {
      EXPECT_LT(forms.plant.units[u].rpy_rad.cwiseAbs().maxCoeff(), 0.008);
      EXPECT_LT(forms.sensors.units[u].gyro_radps.cwiseAbs().maxCoeff(), 0.002);
      EXPECT_LT(forms.sensors.units[u].accelerometer_mps2.cwiseAbs().maxCoeff(), 0.04);
    }
    for (std::size_t r = 0; r < kReceivers; ++r) {
      EXPECT_LT(forms.plant.antennas[r].xyz_m.cwiseAbs().maxCoeff(), 0.025);
      EXPECT_LT(forms.sensors.receivers[r].datum_m.cwiseAbs().maxCoeff(), 0.04);
    }
    for (const EncoderForm& encoder : forms.sensors.encoders) {
      EXPECT_LT(std::abs(encoder.zero_rad), 0.003);
    }
  }
}

TEST(WholeCase, NothingWrongDrivesAsTheFilesSayWithinTheTolerances) {
  WholeCase c = First(CaseKind::kNothing, true, 40);
  c.habit.kinds = {Manoeuvre::kStraight, Manoeuvre::kSpot, Manoeuvre::kArc};
  const MachineNumbers& numbers = FourTons().numbers;
  const Course course = Drive(numbers, c.within.plant, c.start, 40,
                              Hand(numbers, c.habit, Stream(4, "hand")), Stream(4, "messages"));
  double way_m = 0, asked_m = 0, turned_rad = 0, asked_rad = 0;
  for (double t_s = 0.5; t_s < 39; t_s += 0.5) {
    const Instant &from = course.At(t_s), &to = course.At(t_s + 0.5);
    const Vec3 ahead = from.q_WB * Vec3::UnitX(), later = to.q_WB * Vec3::UnitX();
    const double left_m = 0.225 * (to.angle_rad[0] - from.angle_rad[0]);
    const double right_m = 0.225 * (to.angle_rad[1] - from.angle_rad[1]);
    asked_m += std::abs(left_m + right_m) / 2;
    way_m += std::abs((to.p_WB_m - from.p_WB_m).dot((ahead + later).normalized()));
    asked_rad += std::abs(right_m - left_m) / 1.148;
    turned_rad += std::abs(std::atan2(ahead.cross(later).z(), ahead.dot(later)));
  }
  EXPECT_GT(asked_m, 5);
  EXPECT_NEAR(way_m / asked_m, 1, 0.02);
  EXPECT_GT(asked_rad, 1);
  EXPECT_NEAR(turned_rad / asked_rad, 1, 0.05);
}

TEST(WholeCase, HidesWhatItsKindSays) {
  for (int k = 0; k < 150; ++k) {
    for (const bool reserve : {false, true}) {
      const WholeCase c = Drawn(k, {}, reserve);
      const std::size_t hidden = c.about.kind == CaseKind::kNothing ? 0
                                 : c.about.kind == CaseKind::kTwo   ? 2
                                                                    : 1;
      EXPECT_EQ(c.about.hidden.size(), hidden);
      EXPECT_GE(c.about.duration_s, 60);
      EXPECT_LE(c.about.duration_s, 120);
      for (const Concealed& concealed : c.about.hidden) {
        EXPECT_EQ(concealed.name.empty(), c.about.kind == CaseKind::kOutside);
      }
    }
  }
}

TEST(WholeCase, EveryEffectHasAFormThatIsKeptInReserve) {
  const auto form = [](const std::string& name, bool reserve) {
    Draws draws(Stream(1, name));
    const Draw draw{FourTons().numbers, Strength::kMedium, reserve, &draws};
    for (std::size_t axis = kSlew; axis < kAxisCount; ++axis) {
      const auto& joints = EffectsOfJoints();
      if (std::find(joints.begin(), joints.end(), name) == joints.end()) break;
      if (CanHold(axis, name, reserve)) return DrawOfJoint(name, axis, draw).concealed.form;
    }
    const auto& tracks = EffectsOfTracks();
    if (std::find(tracks.begin(), tracks.end(), name) != tracks.end()) {
      return DrawOfTracks(name, draw).concealed.form;
    }
    return DrawOfSensor(name, draw).concealed.form;
  };
  int effects = 0;
  for (const auto* names : {&EffectsOfJoints(), &EffectsOfTracks(), &EffectsOfSensors()}) {
    for (const std::string& name : *names) {
      EXPECT_NE(form(name, false), form(name, true)) << name;
      ++effects;
    }
  }
  EXPECT_EQ(effects, 21);
  for (const bool tracks : {false, true}) {
    for (const Manoeuvre kind : ManoeuvresOf(tracks, true)) {
      const auto working = ManoeuvresOf(tracks, false);
      EXPECT_EQ(std::find(working.begin(), working.end(), kind), working.end());
    }
  }
}

TEST(WholeCase, ShowsInItsChannelsWhatItHides) {
  std::set<std::string> seen;
  for (int k = 0; seen.size() < 4; ++k) {
    WholeCase c = Drawn(k, 20);
    if (c.about.kind != CaseKind::kOne || c.about.strength == Strength::kFaint) continue;
    if (!seen.insert(c.about.hidden[0].name).second) continue;
    const WholeRecording recording = RecordWholeCase(&c, FourTons().numbers, 4);
    ASSERT_EQ(recording.marks.changes.size(), 1u);
    EXPECT_GT(recording.marks.changes[0].Rms(), 0.1) << c.about.hidden[0].name;
  }
}

}  // namespace
}  // namespace tera::blind::mujoco
