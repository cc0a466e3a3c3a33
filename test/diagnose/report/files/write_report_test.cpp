#include "diagnose/report/files/write_report.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "diagnose/report/files/diagnosis_json.h"
#include "diagnose/report/files/effects_yaml.h"
#include "diagnose/report/made_diagnosis.h"
#include "diagnose/report/page/html_report.h"
#include "own_folder.h"

namespace tera {
namespace {

TEST(WriteReport, LeavesThreeWholeFilesAndASeriesOfEachChannel) {
  const std::filesystem::path folder = OwnFolder() / "report";
  const Diagnosis diagnosis = Of(BoomWithDeadBand());
  WriteReport(folder, diagnosis, "run");
  EXPECT_EQ(ReadWholeFile(folder / "diagnosis.json"), DiagnosisJson(diagnosis));
  EXPECT_EQ(ReadWholeFile(folder / "effects.yaml"), EffectsYaml(diagnosis, "run"));
  EXPECT_EQ(ReadWholeFile(folder / "report.html"), HtmlReport(diagnosis, "run"));
  const std::string series = ReadWholeFile(folder / "series_excavator1_encoders_boom_radps.csv");
  EXPECT_EQ(series.substr(0, series.find("1000000000")),
            "t_ns,measured_radps,simulated_before_radps,simulated_after_radps,error_before_radps,"
            "error_after_radps\n0,3,2,3,1,0\n500000000,3,2,3,1,0\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 4);
}

TEST(WriteReport, AddsTheLeversToDriveNext) {
  const std::filesystem::path folder = OwnFolder() / "with_levers";
  WriteReport(folder, Complete(), "run");
  EXPECT_EQ(ReadWholeFile(folder / "next_manoeuvre.csv"), "t_ns,boom\n0,0\n1000000000,0.15\n");
}

TEST(WriteReport, SaysWhereItCannotWrite) {
  WriteWholeFile(OwnFolder() / "a_file", "");
  EXPECT_THROW(WriteReport(OwnFolder() / "a_file", Of(BoomWithDeadBand()), "run"), InputError);
}

}  // namespace
}  // namespace tera
