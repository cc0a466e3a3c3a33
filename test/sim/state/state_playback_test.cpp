#include "sim/state/state_playback.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "core/config/config.h"
#include "core/error.h"
#include "dataset/format/sample_recording.h"
#include "sim/simulation.h"
#include "sim/state/state_log.h"
#include "sim/work_fixture.h"

// A simulation and its playback: everything that sensors observe is bitwise equal.

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr char kText[] = "what the scenario was read from";

Scenario Read(const std::string& text) {
  const Config config = Config::FromText(text, "s.yaml");
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

/// A mast, and a walking person.
std::string Mast(const std::string& more = "") {
  return R"(
name: mast
duration_s: 1.25
settle_s: 0
terrain: {size_m: [8, 8], cell_m: 0.1, soil: dirt, relief: {amplitude_m: 0.2, wavelength_m: 3}}
machines:
  - {name: mast1, machine: tera:config/machines/mast.yaml, start: {xy_m: [1, -2], yaw_deg: 40}, operator: {type: idle}}
obstacles:
  - {name: person1, preset: tera:config/obstacles/person.yaml, xy_m: [2, 1],
     path: [{t_s: 0.2, xy_m: [2, 1]}, {t_s: 0.9, xy_m: [1, 2]}, {t_s: 1.1, xy_m: [1, 2.5]}]}
  - {name: cone1, preset: tera:config/obstacles/cone.yaml, xy_m: [-2, 1], yaw_deg: 30}
)" + more;
}

/// Everything of an instant that a sensor may measure.
std::vector<double> NumbersOf(const Instant& now) {
  std::vector<double> n = {static_cast<double>(now.t_ns)};
  const auto add = [&](const auto& matrix) {
    for (Eigen::Index k = 0; k < matrix.size(); ++k) n.push_back(matrix(k));
  };
  const auto add_body = [&](const BodyState& body) {
    add(body.X_WB.matrix());
    add(body.v_WB_mps);
    add(body.w_WB_radps);
    add(body.a_WB_mps2);
    add(body.alpha_WB_radps2);
  };
  for (const MachineState& machine : now.machines) {
    for (const BodyState& link : machine.links) add_body(link);
    for (const auto* values :
         {&machine.q_rad, &machine.qd_radps, &machine.gear_angle_rad, &machine.gear_rate_radps}) {
      n.push_back(static_cast<double>(values->size()));
      n.insert(n.end(), values->begin(), values->end());
    }
    for (const auto& load : machine.shovel_load) n.insert(n.end(), {load.mass_kg, load.volume_m3});
  }
  for (const BodyState& obstacle : now.obstacles) add(obstacle.X_WB.matrix());
  for (const BedLoad& bed : now.beds) n.insert(n.end(), {bed.mass_kg, bed.volume_m3});
  return n;
}

/// A digest of the visible ground: its vertices, refinement and clods.
std::uint64_t DigestOf(const TerrainSurface& ground) {
  std::uint64_t digest = 14695981039346656037u;  // FNV-1a, of words
  const auto add = [&](std::uint64_t word) { digest = (digest ^ word) * 1099511628211u; };
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  for (int j = 0; j < ground.ny; ++j) {
    for (int i = 0; i < ground.nx; ++i) {
      const TerrainSurface::Vertex vertex = ground.at(i, j);
      add(std::uint64_t{bits(vertex.height_m)} << 32 | vertex.cover.soil << 24 |
          vertex.cover.moisture << 16 | vertex.cover.looseness << 8 | vertex.cover.rut);
    }
  }
  for (int t = 0; t < ground.tile_count(); ++t) {
    add(ground.IsRefined(t % ground.tiles_x(), t / ground.tiles_x()));
  }
  for (const TerrainSurface::Grain& grain : ground.grains()) {
    for (const float x : {grain.p_W_m.x(), grain.p_W_m.y(), grain.p_W_m.z(), grain.radius_m}) {
      add(bits(x));
    }
    add(std::uint64_t{grain.number} << 16 | grain.soil << 8 | grain.moisture);
  }
  return digest;
}

struct Seen {
  std::vector<double> numbers;
  std::uint64_t ground = 0;
  std::size_t grains = 0;
};

Seen Look(const Instant& now, const TerrainSurface& ground) {
  return {NumbersOf(now), DigestOf(ground), ground.grains().size()};
}

/// The index of the first bitwise difference; none if equal.
std::optional<std::size_t> FirstDifference(const std::vector<double>& a,
                                           const std::vector<double>& b) {
  if (a.size() != b.size()) return std::min(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (std::bit_cast<std::uint64_t>(a[k]) != std::bit_cast<std::uint64_t>(b[k])) return k;
  }
  return std::nullopt;
}

class Playback : public testing::Test {
 protected:
  /// Runs the scenario as `tera generate` does, one step beyond its end, and keeps its state.
  /// Returns the visible state at the start and after each step.
  std::vector<Seen> Keep(const Scenario& scenario, const std::string& text = kText) {
    Simulation simulation(scenario);
    StateLog log(scenario, text, file(), simulation.state());
    std::vector<Seen> seen = {Look(simulation.state(), simulation.ground())};
    const auto steps = std::llround(scenario.duration_s * scenario.physics_rate_hz) + 1;
    for (std::int64_t k = 0; k < steps; ++k) {
      simulation.Step();
      log.Add(simulation.state());
      seen.push_back(Look(simulation.state(), simulation.ground()));
    }
    log.Commit();
    EXPECT_EQ(log.bytes(), static_cast<std::int64_t>(std::filesystem::file_size(file())));
    last_ = NumbersOf(simulation.state());
    return seen;
  }

  void ExpectPlayedBack(const Scenario& scenario, const std::vector<Seen>& seen) {
    StatePlayback playback(scenario, kText, file());
    EXPECT_FALSE(FirstDifference(NumbersOf(playback.state()), seen[0].numbers)) << "at the start";
    EXPECT_EQ(DigestOf(playback.ground()), seen[0].ground) << "at the start";
    for (std::size_t k = 1; k < seen.size(); ++k) {
      ASSERT_TRUE(playback.Step()) << k;
      const WorldStep step = playback.last_step();
      const auto at = FirstDifference(NumbersOf(step.after), seen[k].numbers);
      ASSERT_FALSE(at) << "number " << *at << " of step " << k;
      ASSERT_FALSE(FirstDifference(NumbersOf(step.before), seen[k - 1].numbers)) << k;
      ASSERT_EQ(DigestOf(step.ground), seen[k].ground) << "ground of step " << k;
    }
    EXPECT_FALSE(playback.Step());
  }

  std::filesystem::path file() const { return scratch_.path() / "state.blocks"; }

  const ScratchDirectory scratch_;
  std::vector<double> last_;
};

TEST_F(Playback, OfAMastAndAPersonWhoWalksIsTheSame) {
  const Scenario scenario = Read(Mast());
  const auto seen = Keep(scenario);
  EXPECT_EQ(seen.size(), 627u);
  EXPECT_TRUE(FirstDifference(seen[100].numbers, seen[400].numbers));
  ExpectPlayedBack(scenario, seen);
}

TEST_F(Playback, OfADiggingExcavatorIsTheSame) {
  for (const double settle_s : {0.0, 0.3}) {
    const Scenario scenario = Read(R"(
name: dig
seed: 5
duration_s: 1.6
physics_rate_hz: 250
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {yaw_deg: 20, joints_deg: {boom: 30, arm: -80, bucket: -60}}
    operator: {type: dig_cycle, reach_m: 4.0}
settle_s: )" + std::to_string(settle_s) +
                                   "\n");
    const auto seen = Keep(scenario);
    EXPECT_NE(seen.front().ground, seen.back().ground) << "nothing was dug";
    ExpectPlayedBack(scenario, seen);
  }
}

TEST_F(Playback, OfADigInTheRainIsTheSame) {
  const Scenario scenario = Read(R"(
name: dig
seed: 5
duration_s: 61
physics_rate_hz: 100
settle_s: 0.3
environment: {rain_mmph: 60, cloud_cover: 1}
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt, weather_before: [{hours: 1}]}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {yaw_deg: 20, joints_deg: {boom: 30, arm: -80, bucket: -60}}
    operator: {type: dig_cycle, reach_m: 4.0}
)");
  const auto seen = Keep(scenario);
  EXPECT_NE(seen[998].ground, seen[1001].ground) << "no rain was seen";
  ExpectPlayedBack(scenario, seen);
}

TEST_F(Playback, OfAnExcavatorThatDrivesOverLooseSoilIsTheSame) {
  const Scenario scenario = Read(R"(
name: drive
duration_s: 2
settle_s: 0.5
physics_rate_hz: 300
terrain: {size_m: [14, 14], cell_m: 0.1, soil: loose_sand, relief: {amplitude_m: 0.1, wavelength_m: 4}}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [-2, 1], yaw_deg: -20}
    operator: {type: waypoints, waypoints: [{xy_m: [3, 3]}]}
)");
  const auto seen = Keep(scenario);
  EXPECT_NE(seen[300].ground, seen.back().ground) << "nothing was pressed";
  ExpectPlayedBack(scenario, seen);
}

TEST_F(Playback, OfATruckThatIsLoadedBesideAMachineThatDrivesIsTheSame) {
  // The truck stands still, unlike in WorkScenario.
  const Scenario scenario =
      WorkScenario({"duration_s=11", "physics_rate_hz=200",
                    "obstacles[0].path=[{t_s: 0, xy_m: [-3.5, 5]}, {t_s: 1, xy_m: [-2.6, 4.4]}]"});
  const auto seen = Keep(scenario);
  std::size_t most_grains = 0;
  for (const Seen& s : seen) most_grains = std::max(most_grains, s.grains);
  EXPECT_GT(most_grains, 10u) << "nothing flew";
  EXPECT_GT(last_[last_.size() - 6], 1) << "nothing lies in the truck's bed";
  ExpectPlayedBack(scenario, seen);
}

TEST_F(Playback, OfAScenarioWhoseSensorsAreOthersIsTheSame) {
  const auto seen = Keep(Read(Mast()));
  std::string with_rig = Mast();
  const std::string operator_text = "operator: {type: idle}";
  with_rig.replace(with_rig.find(operator_text), operator_text.size(),
                   operator_text +
                       ", rig: {sensors: [{name: imu, preset: tera:config/sensors/icm_20948.yaml, "
                       "link: mast}]}");
  const Scenario other = Read(with_rig);
  ASSERT_EQ(other.machines[0].sensors.size(), 1u);
  ExpectPlayedBack(other, seen);
}

TEST_F(Playback, EndsWhereTheRunDoesAndHasOneStepMore) {
  // 625 steps to the end.
  const Scenario scenario = Read(Mast());
  Keep(scenario);
  StatePlayback playback(scenario, kText, file());
  int steps = 0;
  while (playback.Step()) ++steps;
  EXPECT_EQ(steps, 625 + 1);
  EXPECT_FALSE(playback.Step());
  EXPECT_EQ(playback.last_step().before.t_ns, FromSeconds(1.25));
  EXPECT_EQ(playback.last_step().after.t_ns, FromSeconds(1.252));
}

TEST_F(Playback, OfAnotherScenarioIsRefused) {
  const Scenario scenario = Read(Mast());
  Keep(scenario);
  for (const std::string text : {"", "what the scenario was read fron"}) {
    EXPECT_THAT([&] { StatePlayback(scenario, text, file()); },
                ThrowsMessage<InputError>(HasSubstr(file().string())));
  }
}

TEST_F(Playback, OfAScenarioWithOtherMachinesIsRefusedWhateverItsTextSays) {
  Keep(Read(Mast()));
  const Scenario other = WorkScenario();
  EXPECT_THAT([&] { StatePlayback(other, kText, file()); },
              ThrowsMessage<InputError>(HasSubstr(file().string())));
}

TEST_F(Playback, WithoutAFileIsRefused) {
  const Scenario scenario = Read(Mast());
  EXPECT_THAT([&] { StatePlayback(scenario, kText, file()); },
              ThrowsMessage<InputError>(HasSubstr("state.blocks")));
}

/// A file's blocks, to be modified.
struct Content {
  std::string header;
  std::vector<Block> blocks;
};

Content ContentOf(const std::filesystem::path& file) {
  BlockFileReader reader(file);
  Content content{reader.header(), {}};
  while (std::optional<Block> block = reader.Next()) content.blocks.push_back(*block);
  return content;
}

void Write(const std::filesystem::path& file, const Content& content) {
  BlockFileWriter writer(file, content.header);
  for (const Block& block : content.blocks) writer.Append(block);
  writer.Commit();
}

class DamagedPlayback : public Playback {
 protected:
  DamagedPlayback() : scenario_(Read(Mast())) {
    Keep(scenario_);
    good_ = ContentOf(file());
  }
  /// Whether a file of this content is refused by an InputError that names it, at its end at the
  /// latest.
  bool IsRefused(const Content& content) {
    Write(file(), content);
    return PlaysToAFault();
  }
  bool PlaysToAFault() {
    try {
      StatePlayback playback(scenario_, kText, file());
      while (playback.Step()) {
      }
    } catch (const InputError& fault) {
      EXPECT_THAT(fault.what(), HasSubstr(file().string()));
      return true;
    }
    return false;
  }

  const Scenario scenario_;
  Content good_;
};

TEST_F(DamagedPlayback, OfAnotherVersionIsRefused) {
  EXPECT_FALSE(IsRefused(good_));
  for (const std::string version : {"state: 0", "state: 999", "state: x", "stale: 1"}) {
    Content other = good_;
    other.header.replace(0, other.header.find('\n'), version);
    EXPECT_TRUE(IsRefused(other)) << version;
  }
  EXPECT_TRUE(IsRefused({"", good_.blocks}));
}

TEST_F(DamagedPlayback, CutShortIsRefused) {
  ASSERT_GE(good_.blocks.size(), 3u);  // the start, a second, a quarter of one
  for (std::size_t count = 0; count < good_.blocks.size(); ++count) {
    Content shorter = good_;
    shorter.blocks.resize(count);
    EXPECT_TRUE(IsRefused(shorter)) << count << " blocks";
  }
  Write(file(), good_);
  const std::string whole = ReadWholeFile(file());
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 60) {
    WriteWholeFile(file(), std::string_view(whole).substr(0, size));
    EXPECT_TRUE(PlaysToAFault()) << size << " bytes";
  }
}

TEST_F(DamagedPlayback, LongerThanItsRunIsRefused) {
  Content longer = good_;
  longer.blocks.push_back(good_.blocks.back());
  EXPECT_TRUE(IsRefused(longer));
}

TEST_F(DamagedPlayback, WithStreamsThatAreOthersIsRefusedOrPlaysAnotherRun) {
  // States that pass every checksum but belong to another run: no crash, and missing or short
  // streams are refused.
  for (std::size_t b = 0; b < good_.blocks.size(); ++b) {
    for (std::size_t s = 0; s < good_.blocks[b].size(); ++s) {
      Content other = good_;
      other.blocks[b].resize(s);
      EXPECT_TRUE(s == 0 || IsRefused(other)) << s << " streams of block " << b;
      other = good_;
      std::string& stream = other.blocks[b][s];
      if (stream.empty()) continue;
      stream.pop_back();
      EXPECT_TRUE(IsRefused(other)) << "stream " << s << " of block " << b << " cut";
      stream.assign(stream.size() + 1, '\xff');
      IsRefused(other);
    }
  }
}

TEST_F(DamagedPlayback, AFlippedByteIsRefused) {
  Write(file(), good_);
  const std::string whole = ReadWholeFile(file());
  const std::size_t behind_magic = 14;
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 80) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0xff);
    WriteWholeFile(file(), damaged);
    EXPECT_TRUE(PlaysToAFault()) << at;
  }
  std::string damaged = whole;
  damaged[behind_magic] = static_cast<char>(damaged[behind_magic] ^ 0x01);
  WriteWholeFile(file(), damaged);
  EXPECT_TRUE(PlaysToAFault());
}

TEST(RequireState, SaysWhatToDoWhereNoneWasKept) {
  const ScratchDirectory scratch;
  EXPECT_THAT([&] { RequireState(scratch.path()); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr(scratch.path().string()), HasSubstr("--keep-state"))));
}

}  // namespace
}  // namespace tera
