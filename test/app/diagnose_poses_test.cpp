#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "app/diagnosed_scenario.h"

namespace tera {
namespace {

constexpr long long kSecond_ns = 1'000'000'000, kPeriod_ns = kSecond_ns / 50;

/// Poses at 50 Hz that wait for up to 0.6 s of every two. They are stamped on arrival, one every 5
/// ms.
std::string AsTheyArrive(std::istream& poses) {
  std::ostringstream arrived;
  std::string row;
  std::getline(poses, row);
  arrived << row << '\n';
  long long last_ns = 0;
  while (std::getline(poses, row)) {
    const long long measured_ns = std::stoll(row);
    if (measured_ns % kPeriod_ns != 0) continue;
    const long long into_ns = measured_ns % (2 * kSecond_ns);
    const long long wait_ns = std::max(0LL, 3 * kSecond_ns / 5 - into_ns);
    last_ns = std::max(measured_ns + wait_ns, last_ns + kSecond_ns / 200);
    arrived << last_ns << row.substr(row.find(',')) << '\n';
  }
  return arrived.str();
}

/// An excavator that drives on asphalt, with the measurements of a real one.
class DiagnoseMeasuredPoses : public DiagnoseByScenario {
 protected:
  DiagnoseMeasuredPoses() {
    Write("levers.csv", TrackLevers());
    Write("scenario.yaml", R"(
name: drive
duration_s: 61
terrain: {size_m: [40, 40], cell_m: 0.2, soil: asphalt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    ground: kinematic
    start: {joints_deg: {boom: 55, arm: -130, bucket: -40, blade: 20}}
    operator: {type: lever_replay, csv: levers.csv, time_column: t_s}
    rig: {sensors: [{name: encoders, preset: tera:config/sensors/encoder.yaml,
                     joints: [left_track, right_track]},
                    {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: undercarriage,
                     xyz_m: [0.3, 0, 0.5]}]}
)");
  }

  /// A real recording of the scenario with arrival stamps.
  void RecordReal(const Arguments& more = {}) const {
    Record("real", more);
    Edit("real/dataset.yaml", "simulated: true", "simulated: false");
    std::ifstream poses(folder() / "real/truth/excavator1/pose.csv");
    const std::string arrived = AsTheyArrive(poses);
    Write("real/truth/excavator1/pose.csv", arrived);
  }

 private:
  void Edit(const std::string& name, const std::string& from, const std::string& to) const {
    std::stringstream text;
    text << std::ifstream(folder() / name).rdbuf();
    std::string edited = text.str();
    const std::size_t at = edited.find(from);
    ASSERT_NE(at, std::string::npos) << name;
    Write(name, edited.replace(at, from.size(), to));
  }
};

TEST_F(DiagnoseMeasuredPoses, OfStampsOfArrivalNamesTheseAndNothingOfTheUnitThatTheyMove) {
  RecordReal();
  Write("library.yaml", "only: [arrival_stamps, effective_gauge, clock_offset, filter_delay]\n");
  EXPECT_EQ(Diagnose("real", "why", {"--no-simulation"}), Names{"arrival_stamps"});
  const Json finding = Report("why")["findings"][0];
  EXPECT_EQ(finding["target"], "poses");
  EXPECT_TRUE(Report("why")["not_judged"].empty());
  EXPECT_GT(finding["held_out"]["excess_variance_removed"].get<double>(), 0.9);
}

TEST_F(DiagnoseMeasuredPoses, OfThatCandidateAloneComparesTheUnitWithoutAny) {
  RecordReal();
  Write("library.yaml", "only: [arrival_stamps]\n");
  EXPECT_EQ(Diagnose("real", "why"), Names{"arrival_stamps"});
  EXPECT_TRUE(Report("why")["not_judged"].empty());
  EXPECT_TRUE(Report("why")["whole_simulation"].is_null());  // no simulation has stamps of arrival
}

TEST_F(DiagnoseMeasuredPoses, TellsOnceWhatCannotBeComparedByStampsNorByArrivals) {
  const Arguments with_receiver = {"--set",
                                   "machines[0].rig.sensors[1]={name: gnss, link: undercarriage, "
                                   "preset: \"tera:config/sensors/rtk_f9p.yaml\"}"};
  RecordReal(with_receiver);
  const std::string receiver = "real/excavator1/gnss/data.csv";
  std::ifstream samples(folder() / receiver);
  std::vector<std::string> rows;
  for (std::string row; std::getline(samples, row);) rows.push_back(row);
  ASSERT_GT(rows.size(), 200u);
  std::string burst;  // 120 within 0.12 s, and the last
  for (std::size_t k = 0; k <= 120; ++k) {
    const std::string row = rows[k].substr(rows[k].find(','));
    burst +=
        (k == 0 ? "t_ns" : std::to_string(kSecond_ns + static_cast<long long>(k) * 1'000'000)) +
        row + "\n";
  }
  burst += rows.back() + "\n";
  Write(receiver, burst);
  Write("library.yaml", "only: [arrival_stamps]\n");
  EXPECT_EQ(Diagnose("real", "why", with_receiver), Names{"arrival_stamps"});
  EXPECT_EQ(Report("why")["not_compared"].size(), 1u);
}

TEST_F(DiagnoseMeasuredPoses, WithoutThatCandidateExplainsNothingAndTheUnitAgreesWithAllElse) {
  RecordReal();
  Write("library.yaml", "without: [arrival_stamps]\n");
  const Names names = Diagnose("real", "why", {"--no-simulation"});
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()),
            std::set<std::string>{"unexplained"});
  EXPECT_TRUE(Report("why")["not_judged"].empty());
}

}  // namespace
}  // namespace tera
