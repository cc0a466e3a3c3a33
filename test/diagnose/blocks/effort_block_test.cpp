#include "diagnose/blocks/effort_block.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "diagnose/replay/sled.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {
namespace {

using ::testing::UnorderedElementsAre;

/// A sled and the diagnosis of its drive.
struct DiagnosedSled : Sled {
  using Sled::Sled;
  BlockDiagnosis Diagnose() {
    block = *MakeEffortBlock(model, Logs().at(0));
    return DiagnoseBlock(block, {}, Stream(1, "diagnose"));
  }
  ReplayBlock block;
};

std::vector<std::string> NamesOf(const BlockDiagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const Finding& finding : diagnosis.findings) {
    names.emplace_back(finding.term.candidate->mechanism->id);
  }
  return names;
}

const Finding& FindingOf(const BlockDiagnosis& diagnosis, std::string_view id) {
  for (const Finding& finding : diagnosis.findings) {
    if (finding.term.candidate->mechanism->id == id) return finding;
  }
  throw std::runtime_error("not found: " + std::string(id));
}

/// Whether a mechanism is a finding or a rival of one.
bool IsNamedOrAlike(const BlockDiagnosis& diagnosis, std::string_view id) {
  for (const Finding& finding : diagnosis.findings) {
    for (const Candidate* candidate : finding.evidence.rivals) {
      if (candidate->mechanism->id == id) return true;
    }
  }
  return false;
}

TEST(EffortBlock, NamesDryAndViscousFrictionAndAnOffset) {
  DiagnosedSled sled(-3.2, 0, 1);
  const BlockDiagnosis diagnosis = sled.Diagnose();
  EXPECT_EQ(diagnosis.findings.size(), 3u);
  const Finding& viscous = FindingOf(diagnosis, "viscous_friction");
  EXPECT_NEAR(viscous.parameters[0].value, 200, 6);
  EXPECT_EQ(viscous.parameters[0].unit, "N s/m");
  // Dry friction in one direction plus an offset equals dry friction in both plus another offset.
  EXPECT_TRUE(IsNamedOrAlike(diagnosis, "coulomb_friction"));
  EXPECT_TRUE(IsNamedOrAlike(diagnosis, "effort_offset"));
}

TEST(EffortBlock, NamesFrictionThatIsStrongerOneWay) {
  DiagnosedSled sled(0, 70, 1);
  const BlockDiagnosis diagnosis = sled.Diagnose();
  EXPECT_THAT(NamesOf(diagnosis),
              UnorderedElementsAre("coulomb_friction", "viscous_friction", "asymmetric_friction"));
  const Finding& one_way = FindingOf(diagnosis, "asymmetric_friction");
  EXPECT_EQ(one_way.parameters[3].name, "negative_nmsprad");
  EXPECT_NEAR(one_way.parameters[3].value, 70, 8);
}

}  // namespace
}  // namespace tera
