#include "dataset/import/foreign_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "dataset/files/checked_file.h"
#include "own_folder.h"

// Files that are neither text tables nor point clouds, by the first bytes that their formats
// prescribe.

namespace tera {
namespace {

using namespace std::string_view_literals;
using testing::HasSubstr;

struct ForeignBeginning {
  std::string file;
  std::string_view first;
  std::string name, remedy;  ///< a part of each
};

/// A first line of RINEX: the label stands in columns 61 to 80.
const std::string kRinexLine =
    "     3.04           OBSERVATION DATA    M: Mixed            RINEX VERSION / TYPE\n";

const std::vector<ForeignBeginning> kForeignBeginnings = {
    {"a.bag", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n",
     "a pointer of Git LFS", "git lfs pull"},
    {"a.csv", "/annex/objects/SHA256E-s3--2c26.csv\n", "a pointer of git-annex", "git annex get"},
    {"a.pcap", "\xd4\xc3\xb2\xa1\x02\0\x04\0"sv, "a pcap capture", "tshark -r a.pcap"},
    {"a.pcap", "\x4d\x3c\xb2\xa1\x02\0\x04\0"sv, "a pcap capture", "tshark"},
    {"a.pcapng", "\x0a\x0d\x0d\x0a\x1c\0\0\0"sv, "a pcapng capture", "tshark -r a.pcapng"},
    {"a.obs", kRinexLine, "a RINEX file", "rnx2rtkp -o a.pos a.obs"},
    {"a.e57", "ASTM-E57\x01\0\0\0"sv, "an E57 point cloud", "pdal translate a.e57 a.las"},
    {"a.xlsx", "PK\x03\x04\x14\0\x06\0\x08\0\0\0!\0[Content_Types].xml"sv, "a workbook of Excel",
     "libreoffice --headless --convert-to csv a.xlsx"},
    {"a.xls", "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\0\0"sv, "an old document of Office", "libreoffice"},
    {"a.parquet", "PAR1\x15\x04\x15"sv, "a Parquet table", "pandas.read_parquet('a.parquet')"},
    {"a.mf4", "MDF     4.10    ", "an MDF measurement", "asammdf"},
    {"a.h5", "\x89HDF\r\n\x1a\n\0\0"sv, "an HDF5 file", "h5dump"},
    {"a.mat", "MATLAB 5.0 MAT-file, Platform: GLNXA64", "a MAT file", "writetable"},
    {"a.mat", "MATLAB 7.3 MAT-file, Platform: GLNXA64", "an HDF5 file by MATLAB", "h5dump"},
    {"a.npz", "PK\x03\x04\x14\0"sv, "an NPZ archive", "numpy.load('a.npz')"},
    {"a.zip", "PK\x03\x04\x14\0"sv, "a ZIP archive", "unzip a.zip"},
    {"a.csv.gz", "\x1f\x8b\x08\0"sv, "packed by gzip", "gunzip a.csv.gz"},
    {"a.7z", "7z\xbc\xaf\x27\x1c\0\x04"sv, "a 7z archive", "7z x a.7z"},
    {"a.xz", "\xfd\x37zXZ\0\0\x04"sv, "packed by xz", "unxz"},
    {"a.pdf", "%PDF-1.7\n", "a PDF document", "as CSV"},
    {"a.csv", "<!DOCTYPE html>\n<html>", "an HTML page", "download"},
    {"a.csv", "\n <HTML lang=en>", "an HTML page", "download"},
    {"a.json", "[{\"t\": 1}]", "a document in JSON", "pandas.read_json"},
    {"can.log", "(1436509052.249713) vcan0 044#2A366C2BBA\n", "a log of a CAN bus by candump",
     "cantools"},
    {"can.log", " (1436509052.249713)  can0  18F01D03   [3]  2A 36 6C\n", "by candump", "DBC"},
    {"can.log", "  can0  044   [2]  2A 36\n", "by candump", "DBC"},
    {"can.asc", "date Wed Apr 16 09:21:13.159 am 2014\nbase hex  timestamps absolute\n",
     "an ASC log of a CAN bus by Vector", "DBC"},
    {"can.trc", ";$FILEVERSION=1.1\n;$STARTTIME=41208.4\n", "a TRC log of a CAN bus", "DBC"},
    {"can.trc", ";####\n;   C:\\NewFile.trc\n;\n;   Message Number\n", "a TRC log", "DBC"},
    {"can.blf", "LOGG\x90\0\0\0"sv, "a BLF log of a CAN bus", "DBC"},
    {"can.blf", "LOGG\xd0\1\0\0"sv, "a BLF log of a CAN bus", "DBC"},
    {"can.blf", "LOGG", "a BLF log of a CAN bus", "DBC"},
    {"a.parquet", "PAR1\x19\x04"sv, "a Parquet table", "pandas.read_parquet"},
    {"a.parquet", "PAR1", "a Parquet table", "pandas.read_parquet"},
    {"can.csv", "timestamp,arbitration_id,extended,remote,error,dlc,data\n",
     "a table of undecoded frames", "DBC"},
};

TEST(ForeignFile, EachFormIsKnownByItsFirstBytesAndHasARemedy) {
  for (const ForeignBeginning& form : kForeignBeginnings) {
    const auto found = ForeignFileOf(form.first, form.file);
    ASSERT_TRUE(found) << form.name;
    EXPECT_THAT(found->name, HasSubstr(form.name));
    EXPECT_THAT(found->remedy, HasSubstr(form.remedy)) << form.name;
    EXPECT_THAT(found->remedy, testing::Not(HasSubstr("{"))) << form.name;
  }
}

TEST(ForeignFile, TablesInTextAreNone) {
  for (const std::string_view first :
       {"time_s,boom_deg\n0,1\n", "LOGGER,t\n1,2\n", "PAR1,PAR2\n1,2\n", "# a\n1,2\n", "",
        "(s) (deg)\n0 1\n", "date time boom\n2026-11-28 12:00:00 1\n", "; a remark\nt;x\n0;1\n",
        "[General]\nrate=50\n", "id,value\n1,2\n"}) {
    EXPECT_FALSE(ForeignFileOf(first, "log.csv")) << first;
  }
}

TEST(ForeignFile, IsRefusedWithItsNameAndTheRemedy) {
  const std::filesystem::path file = OwnFolder() / "run.csv";
  WriteWholeFile(file, "(1436509052.249713) vcan0 044#2A366C2BBA\n");
  EXPECT_THAT([&] { RefuseForeignFile(file, "a text table"); },
              ThrowsFault(FaultKind::kUnsupported, "run.csv"));
  WriteWholeFile(file, "time_s,boom_deg\n0,1\n");
  EXPECT_NO_THROW(RefuseForeignFile(file, "a text table"));
}

}  // namespace
}  // namespace tera
