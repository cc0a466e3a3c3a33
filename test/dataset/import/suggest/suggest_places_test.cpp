#include "dataset/import/suggest/suggested_table.h"

// Positions in tables: of receivers, of maps, and in units other than metres. Each suggestion is
// run.

namespace tera {
namespace {

using ::testing::HasSubstr;

/// Ten rows behind their time.
std::string Rows(const std::string& head, const std::function<std::string(int k)>& row) {
  std::string log = "time_s," + head + "\n";
  for (int k = 0; k < 10; ++k) log += fmt::format("{:.1f},{}\n", 0.1 * k, row(k));
  return log;
}

class SuggestedPlace : public SuggestedTable {
 protected:
  std::vector<GnssSample> Fixes(const std::string& log) {
    return Imported(log).LoadGnss("machine/gnss");
  }
};

TEST_F(SuggestedPlace, RowsAtZeroZeroHaveNoFixAndAreNoOrigin) {
  const auto fixes = Fixes(Rows("lat,lon,alt", [](int k) {
    return k < 3 ? std::string("0,0,0") : std::string("48.1,11.5,500");
  }));
  ASSERT_EQ(fixes.size(), 10u);
  EXPECT_EQ(fixes[2].fix, GnssFix::kNone);
  EXPECT_EQ(fixes[3].fix, GnssFix::kSingle);
  EXPECT_NEAR(fixes[3].enu_m.norm(), 0, 0.01);
}

TEST_F(SuggestedPlace, ATableWithoutAnyPlaceHasNoReceiver) {
  Imported(Rows("lat,lon,alt,fuel", [](int) { return "0,0,0,7"; }));
  EXPECT_THAT(yaml_, testing::Not(HasSubstr("gnss:")));
}

TEST_F(SuggestedPlace, HeightsHaveTheUnitOfTheirName) {
  const auto fixes = Fixes(Rows("lat_deg,lon_deg,alt_ft", [](int) { return "48.1,11.5,1000"; }));
  EXPECT_NEAR(fixes.at(0).alt_m, 304.8, 1e-9);
  EXPECT_NEAR(fixes.at(0).enu_m.norm(), 0, 0.01);
  EXPECT_THAT(Refusal(Rows("lat,lon,alt", [](int) { return "48.1,11.5,512345"; })),
              HasFault(FaultKind::kNoSuchName, "columns.alt.unit"));
}

TEST_F(SuggestedPlace, DegreesAndMinutesAreRead) {
  const auto fixes =
      Fixes(Rows("lat,lon,alt", [](int k) { return fmt::format("4807.5{:03},1130.25,500", k); }));
  EXPECT_NEAR(fixes.at(0).lat_deg, 48.125, 1e-9);
  EXPECT_NEAR(fixes.at(0).lon_deg, 11 + 30.25 / 60, 1e-9);
  EXPECT_NEAR(fixes.at(0).enu_m.norm(), 0, 0.1);
}

TEST_F(SuggestedPlace, HemispheresStandInColumnsOfTheirOwn) {
  for (const std::string row : {"4807.5,S,01130.25,W,500", "48.125,S,11.50416667,W,500"}) {
    const auto fixes = Fixes(Rows("lat,ns,lon,ew,alt", [&](int) { return row; }));
    EXPECT_NEAR(fixes.at(0).lat_deg, -48.125, 1e-7);
    EXPECT_NEAR(fixes.at(0).lon_deg, -(11 + 30.25 / 60), 1e-7);
    EXPECT_NEAR(fixes.at(0).enu_m.norm(), 0, 0.1);
  }
}

TEST_F(SuggestedPlace, WholeNumbersAreTenMillionthsOfADegreeWhereNothingElseFits) {
  const auto named =
      Fixes(Rows("lat_e7,lon_e7,alt_m", [](int) { return "481250000,115000000,500"; }));
  EXPECT_NEAR(named.at(0).lat_deg, 48.125, 1e-9);
  const auto fixes =
      Fixes(Rows("lat,lon,alt_mm", [](int) { return "481250000,115000000,500000"; }));
  EXPECT_NEAR(fixes.at(0).lat_deg, 48.125, 1e-9);
  EXPECT_NEAR(fixes.at(0).lon_deg, 11.5, 1e-9);
  EXPECT_NEAR(fixes.at(0).alt_m, 500, 1e-9);
  // Near the equator they may also be millionths.
  EXPECT_THAT(Refusal(Rows("lat,lon,alt_m", [](int) { return "12500000,99000000,500"; })),
              HasFault(FaultKind::kNoSuchName, "columns.lat.unit"));
}

TEST_F(SuggestedPlace, ALatitudeBeyondNinetyIsNoDegreesAndMinutes) {
  EXPECT_THAT(Refusal(Rows("lat,lon,alt", [](int) { return "139.7,35.6,40"; })),
              HasFault(FaultKind::kNoSuchName, "columns.lat.unit"));
}

TEST_F(SuggestedPlace, FixesInWordsAreToBeFilledIn) {
  EXPECT_THAT(
      Refusal(Rows("lat,lon,alt,fix",
                   [](int k) { return fmt::format("48.1,11.5,500,{}", k < 3 ? "NO" : "RTK"); })),
      HasFaultAt("columns.fix.constant"));
}

TEST_F(SuggestedPlace, TypesOfFixesAreNoQualities) {
  const auto fixes = Fixes(Rows("lat,lon,alt,fix_type", [](int k) {
    return fmt::format("{},11.5,500,{}", k < 4 ? 48.3 : 48.1, k < 4 ? 2 : 3);
  }));
  ASSERT_EQ(fixes.size(), 6u);
  EXPECT_NEAR(fixes[0].enu_m.norm(), 0, 0.01);
}

TEST_F(SuggestedPlace, CoordinatesOfAMapAreATable) {
  for (const std::string names : {"eastings,northings,height", "Rechtswert,Hochwert,Hoehe", "E,N,H",
                                  "utm_easting,utm_northing,alt", "easting_m,northing_m,up_m"}) {
    const TableRecording table = Imported(Rows(names, [](int) {
                                   return "686543.25,5333222.5,500";
                                 })).LoadTable("machine/map_position.csv");
    EXPECT_EQ(table.columns, (std::vector<std::string>{"east_m", "north_m", "up_m"})) << names;
    EXPECT_EQ(table.rows.at(0), (std::vector<double>{686543.25, 5333222.5, 500})) << names;
  }
  EXPECT_NEAR(Imported(Rows("easting_ft,northing_ft", [](int) { return "1000000,2000000"; }))
                  .LoadTable("machine/map_position.csv")
                  .rows.at(0)
                  .at(0),
              304800, 1e-6);
}

TEST_F(SuggestedPlace, PosesHaveTheUnitOfTheirNamesOrOneThatAMachineCanMoveIn) {
  const auto log = [](const std::string& names, double step) {
    return Rows(names + ",qw,qx,qy,qz",
                [=](int k) { return fmt::format("{},2000,100,1,0,0,0", 1000 + step * k); });
  };
  const auto x_m = [&] {
    return Recording(Out()).LoadPose("truth/machine/pose.csv").poses.at(0).X_WB.translation().x();
  };
  Imported(log("x_mm,y_mm,z_mm", 50));
  EXPECT_NEAR(x_m(), 1, 1e-12);
  Imported(log("x,y,z", 0.1));
  EXPECT_NEAR(x_m(), 1000, 1e-9);
  // 500 a second.
  EXPECT_THAT(Refusal(log("x,y,z", 50)), HasFault(FaultKind::kNoSuchName, "pose.columns.x.unit"));
}

}  // namespace
}  // namespace tera
