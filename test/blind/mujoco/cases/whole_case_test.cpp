#include "blind/mujoco/cases/whole_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "own_folder.h"

namespace tera::blind::mujoco {
namespace {

namespace fs = std::filesystem;

OwnersMachine Read(const std::string& size) {
  const std::string machine = "examples/prove/excavator" + size + ".yaml";
  const std::string rig = "examples/prove/rig" + size + ".yaml";
  return {machine, rig, MachineNumbers::Read(machine, rig)};
}

const OwnersMachine& FourTons() {
  static const OwnersMachine machine = Read("4t");
  return machine;
}

/// The machine reserved for the end.
const OwnersMachine& TwoTons() {
  static const OwnersMachine machine = Read("2t");
  return machine;
}

WholeCase Drawn(int number, std::optional<double> duration_s = {}, bool reserve = false) {
  const OwnersMachine& machine = reserve ? TwoTons() : FourTons();
  return DrawWholeCase(4, number, machine.numbers, reserve, duration_s);
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

/// The first case of a kind that drives as stated.
WholeCase First(CaseKind kind, bool drives, double duration_s, const MachineNumbers& numbers) {
  for (int k = 0;; ++k) {
    WholeCase c = DrawWholeCase(4, k, numbers, false, duration_s);
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
    const Forms forms = Drawn(k, {}, k % 2 == 0).within;
    for (const DriveForm& drive : forms.plant.drives) {
      EXPECT_LT(std::abs(drive.gain * drive.negative * (1 + std::abs(drive.wave)) - 1), 0.06);
      EXPECT_LT(drive.overlap, 0.02);
      // A spring has a delay of 2 zeta / omega. The area of its squared error after a step is (1 +
      // 4 zeta^2) / (4 zeta omega); an equal delay has that area too. Pilot and bus follow.
      const OilNumbers& oil = drive.oil;
      const double late_s = 2 * oil.damping / oil.natural_radps;
      const double off_s =
          (1 + 4 * oil.damping * oil.damping) / (4 * oil.damping * oil.natural_radps);
      EXPECT_LT(std::max(late_s, off_s) + drive.pilot_s + drive.bus.delay_s + drive.bus.jitter_s,
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

/// Straight, in arcs and on the spot: path and rotation relative to the sprockets' turns, by the
/// files' radius and gauge.
void ExpectDrivesAsTheFilesSay(const MachineNumbers& numbers) {
  WholeCase c = First(CaseKind::kNothing, true, 40, numbers);
  c.habit.kinds = {Manoeuvre::kStraight, Manoeuvre::kSpot, Manoeuvre::kArc};
  const Course course = Drive(numbers, c.within.plant, c.start, 40,
                              Hand(numbers, c.habit, Stream(4, "hand")), Stream(4, "messages"));
  double way_m = 0, asked_m = 0, turned_rad = 0, asked_rad = 0;
  for (double t_s = 0.5; t_s < 39; t_s += 0.5) {
    const Instant &from = course.At(t_s), &to = course.At(t_s + 0.5);
    const Vec3 ahead = from.q_WB * Vec3::UnitX(), later = to.q_WB * Vec3::UnitX();
    const double left_m = numbers.radius_m * (to.angle_rad[0] - from.angle_rad[0]);
    const double right_m = numbers.radius_m * (to.angle_rad[1] - from.angle_rad[1]);
    asked_m += std::abs(left_m + right_m) / 2;
    way_m += std::abs((to.p_WB_m - from.p_WB_m).dot((ahead + later).normalized()));
    asked_rad += std::abs(right_m - left_m) / numbers.gauge_m;
    turned_rad += std::abs(std::atan2(ahead.cross(later).z(), ahead.dot(later)));
  }
  EXPECT_GT(asked_m, 5);
  EXPECT_NEAR(way_m / asked_m, 1, 0.02);
  EXPECT_GT(asked_rad, 1);
  EXPECT_NEAR(turned_rad / asked_rad, 1, 0.05);
}

TEST(WholeCase, NothingWrongDrivesAsTheFilesSayWithinTheTolerances) {
  EXPECT_EQ(FourTons().numbers.radius_m, 0.225);
  EXPECT_EQ(FourTons().numbers.gauge_m, 1.148);
  ExpectDrivesAsTheFilesSay(FourTons().numbers);
  EXPECT_EQ(TwoTons().numbers.radius_m, 0.165);
  EXPECT_EQ(TwoTons().numbers.gauge_m, 0.77);
  ExpectDrivesAsTheFilesSay(TwoTons().numbers);
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

std::string FormOf(const std::string& name, Variant variant) {
  Draws draws(Stream(1, name));
  const Draw draw{FourTons().numbers, Strength::kMedium, variant, &draws};
  const auto has = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (has(EffectsOfTracks())) return DrawOfTracks(name, draw).concealed.form;
  if (has(EffectsOfSensors())) return DrawOfSensor(name, draw).concealed.form;
  for (std::size_t axis = kSlew; axis < kAxisCount; ++axis) {
    if (CanHold(axis, name, variant)) return DrawOfJoint(name, axis, draw).concealed.form;
  }
  return "";
}

TEST(WholeCase, EveryEffectHasTwoFormsAndOneThatIsKeptInReserve) {
  int effects = 0;
  for (const auto* names : {&EffectsOfJoints(), &EffectsOfTracks(), &EffectsOfSensors()}) {
    for (const std::string& name : *names) {
      const std::set<std::string> forms = {FormOf(name, Variant::kFirst),
                                           FormOf(name, Variant::kSecond),
                                           FormOf(name, Variant::kReserved)};
      EXPECT_EQ(forms.size(), 3u) << name;
      EXPECT_FALSE(forms.contains("")) << name;
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

TEST(WholeCase, TheWorkingSetDrawsBothOfItsFormsMachinesAndNothingOfTheReserve) {
  std::set<std::string> working, reserved;
  std::set<std::size_t> machines;
  for (int k = 0; k < 600; ++k) {
    machines.insert(MachineOfCase(4, k, 2));
    for (const Concealed& c : Drawn(k).about.hidden) working.insert(c.form);
    for (const Concealed& c : Drawn(k, {}, true).about.hidden) reserved.insert(c.form);
    for (const Manoeuvre kind : Drawn(k).habit.kinds) EXPECT_FALSE(IsReserved(kind));
  }
  EXPECT_EQ(machines.size(), 2u);
  // Two forms of 21 effects and four others, one of which its two levers reveal; or one of each and
  // four. Some 400 effects are hidden. Untestable ones have only one form.
  EXPECT_EQ(working.size(), 2u * 21 + 5 + 3);
  EXPECT_EQ(reserved.size(), 21u + 4 + 3);
  const std::set<std::string> of_both = {"valve that ends where no lever goes",
                                         "mass in the bucket of a machine whose oil is stiff",
                                         "late clock of the unit of a chassis that stands"};
  std::set<std::string> seen;
  std::set_intersection(working.begin(), working.end(), reserved.begin(), reserved.end(),
                        std::inserter(seen, seen.end()));
  EXPECT_EQ(seen, of_both);
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

/// Medium or strong: a faint effect may lie below the noise.
TEST(WholeCase, EveryFormInReserveShowsInItsChannels) {
  std::set<std::string> seen;
  for (int k = 0; seen.size() < 25; ++k) {
    WholeCase c = Drawn(k, 30, true);
    const bool is_one = c.about.kind == CaseKind::kOne || c.about.kind == CaseKind::kOutside;
    if (!is_one || c.about.strength == Strength::kFaint) continue;
    if (!seen.insert(c.about.hidden[0].form).second) continue;
    const WholeRecording recording = RecordWholeCase(&c, TwoTons().numbers, 4);
    ASSERT_EQ(recording.marks.changes.size(), 1u);
    EXPECT_GT(recording.marks.changes[0].Rms(), 0.3) << c.about.hidden[0].form;
  }
}

}  // namespace
}  // namespace tera::blind::mujoco
