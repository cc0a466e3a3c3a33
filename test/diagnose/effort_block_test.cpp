#include "diagnose/blocks/effort_block.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/random.h"
#include "diagnose/search/block_diagnosis.h"
#include "sim/drive_fixture.h"

namespace tera {
namespace {

using ::testing::UnorderedElementsAre;

/// What a recording would hold: ideal encoders and efforts.
struct Recorded {
  TableRecording efforts;
  std::vector<NamedEncoders> encoders{{"m/encoders", {}}};
};

/// A sled of 95.1 kg on a level rail, driven to and fro; its effort by Newton's law.
struct Sled {
  Sled(double offset_n, double more_back_nspm, double noise_n) {
    const Stream noise(5, "noise");
    recorded.encoders[0].recording.axes.push_back({"carriage", true});
    recorded.efforts.columns = {"carriage_n"};
    for (int k = 0; k < 10000; ++k) {
      const double t_s = 0.004 * k, w = 2.2, z = 3.7;
      const double q_m = 0.04 * std::sin(w * t_s) + 0.015 * std::sin(z * t_s + 0.3);
      const double v_mps = 0.04 * w * std::cos(w * t_s) + 0.015 * z * std::cos(z * t_s + 0.3);
      const double a_mps2 =
          -0.04 * w * w * std::sin(w * t_s) - 0.015 * z * z * std::sin(z * t_s + 0.3);
      const double viscous_nspm = v_mps > 0 ? 200 : 200 + more_back_nspm;
      const double force_n = 95.1 * a_mps2 + std::copysign(20, v_mps) + viscous_nspm * v_mps +
                             offset_n + noise_n * noise.Gaussian(static_cast<std::uint64_t>(k));
      const TimeNs t_ns = TimeNs{k} * 4'000'000;
      recorded.encoders[0].recording.samples.push_back(
          {.t_ns = t_ns, .q_rad = {q_m}, .qd_radps = {v_mps}});
      recorded.efforts.t_ns.push_back(t_ns);
      recorded.efforts.rows.push_back({force_n});
    }
    model = Drive::Read("emps.yaml", "{}", "soil: asphalt", "").machines[0].placement.model;
  }
  std::vector<EffortLog> Logs() const {
    return MakeEffortLogs(model, "m/efforts", recorded.efforts, recorded.encoders);
  }
  BlockDiagnosis Diagnose() {
    block = *MakeEffortBlock(model, Logs().at(0));
    return DiagnoseBlock(block, {}, Stream(1, "diagnose"));
  }

  Recorded recorded;
  MachineModel model;
  ReplayBlock block;
};

std::vector<std::string> NamesOf(const BlockDiagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const Finding& finding : diagnosis.findings) {
    names.emplace_back(finding.term.suspect->mechanism->id);
  }
  return names;
}

const Finding& FindingOf(const BlockDiagnosis& diagnosis, std::string_view id) {
  for (const Finding& finding : diagnosis.findings) {
    if (finding.term.suspect->mechanism->id == id) return finding;
  }
  throw std::runtime_error("not found: " + std::string(id));
}

/// Whether a mechanism is a finding, or not told apart from one.
bool IsNamedOrAlike(const BlockDiagnosis& diagnosis, std::string_view id) {
  for (const Finding& finding : diagnosis.findings) {
    for (const Suspect* suspect : finding.evidence.rivals) {
      if (suspect->mechanism->id == id) return true;
    }
  }
  return false;
}

TEST(EffortBlock, NamesDryAndViscousFrictionAndAnOffset) {
  Sled sled(-3.2, 0, 1);
  const BlockDiagnosis diagnosis = sled.Diagnose();
  EXPECT_EQ(diagnosis.findings.size(), 3u);
  const Finding& viscous = FindingOf(diagnosis, "viscous_friction");
  EXPECT_NEAR(viscous.parameters[0].value, 200, 6);
  EXPECT_EQ(viscous.parameters[0].unit, "N s/m");
  // Dry friction of one direction beside an offset is dry friction of both beside another offset.
  EXPECT_TRUE(IsNamedOrAlike(diagnosis, "coulomb_friction"));
  EXPECT_TRUE(IsNamedOrAlike(diagnosis, "effort_offset"));
}

TEST(EffortBlock, NamesFrictionThatIsStrongerOneWay) {
  Sled sled(0, 70, 1);
  const BlockDiagnosis diagnosis = sled.Diagnose();
  EXPECT_THAT(NamesOf(diagnosis),
              UnorderedElementsAre("coulomb_friction", "viscous_friction", "asymmetric_friction"));
  const Finding& one_way = FindingOf(diagnosis, "asymmetric_friction");
  EXPECT_EQ(one_way.parameters[3].name, "negative_nmsprad");
  EXPECT_NEAR(one_way.parameters[3].value, 70, 8);
}

}  // namespace
}  // namespace tera
