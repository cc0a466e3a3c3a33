#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "dataset/export/export.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/bag_bytes.h"
#include "dataset/import/import_csv.h"

/// Bags damaged by a crash, a disk or an attacker.

namespace tera {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr char kMapping[] =
    "name: logged\nmachine: digger\nimus: [{name: imu, topic: /digger/imu}]\n"
    "tables: [{name: commands, topic: /digger/levers, columns: {boom: {column: 'position[boom]', "
    "unit: '1'}}}]\n";

struct Kind {
  const char* name;
  ExportFormat format;
  BagStorage storage;
  BagCompression compression;
  const char* file;
};

class DamagedBag : public ::testing::TestWithParam<Kind> {
 protected:
  DamagedBag() {
    const Kind& kind = GetParam();
    WriteWholeSample(scratch_.path() / "run", {});
    Export(scratch_.path() / "run", scratch_.path() / "bag",
           {.format = kind.format, .storage = kind.storage, .compression = kind.compression});
    whole_ = ReadWholeFile(scratch_.path() / "bag" / kind.file);
    log_ = std::string("log") + fs::path(kind.file).extension().string();
    WriteWholeFile(scratch_.path() / "mapping.yaml", kMapping + ("file: " + log_ + "\n"));
  }

  /// Fault of an import of these bytes; empty if accepted.
  std::string FaultOf(const std::string& bytes, bool skips, ImportReport* report = nullptr) {
    WriteWholeFile(scratch_.path() / log_, bytes);
    fs::remove_all(Out());
    try {
      const ImportReport done =
          ImportCsv(scratch_.path() / "mapping.yaml", Out(), {.skips_bad_rows = skips});
      if (report != nullptr) *report = done;
      return "";
    } catch (const InputError& fault) {
      EXPECT_FALSE(fs::exists(Out())) << fault.what();
      EXPECT_FALSE(fs::exists(Out().string() + ".incomplete")) << fault.what();
      EXPECT_THAT(fault.what(), AnyOf(HasSubstr(log_), HasSubstr("mapping.yaml")));
      return fault.what();
    }
  }
  fs::path Out() const { return scratch_.path() / "out"; }

  ScratchDirectory scratch_;
  std::string whole_, log_;
};

TEST_P(DamagedBag, CutOffAnywhereIsToldOfAndReadAsFarAsItGoes) {
  constexpr std::size_t kPieces = 20;
  ASSERT_EQ(FaultOf(whole_, false), "");
  for (std::size_t k = 0; k < kPieces; ++k) {
    const std::string cut = whole_.substr(0, whole_.size() * k / kPieces);
    EXPECT_NE(FaultOf(cut, false), "") << k;
    ImportReport report;
    if (FaultOf(cut, true, &report).empty()) {
      // The partial data must indicate the missing rest.
      ASSERT_EQ(report.channels.size(), 2u);
      for (const ImportedChannel& channel : report.channels) EXPECT_GT(channel.left_out, 0) << k;
    }
  }
  const std::string last = whole_.substr(0, whole_.size() - 1);
  EXPECT_NE(FaultOf(last, false), "");
}

TEST_P(DamagedBag, FlippedBitsDoNoHarm) {
  // As many places as time allows, by a step coprime to every layout.
  const std::size_t step = whole_.size() / 200 | 1;
  for (std::size_t at = 0; at < whole_.size(); at += step) {
    std::string flipped = whole_;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
    FaultOf(flipped, false);
    FaultOf(flipped, true);
  }
}

INSTANTIATE_TEST_SUITE_P(OfBags, DamagedBag,
                         ::testing::Values(Kind{"zstd", ExportFormat::kRosbag2, BagStorage::kMcap,
                                                BagCompression::kZstd, "bag_0.mcap"},
                                           Kind{"lz4", ExportFormat::kRosbag2, BagStorage::kMcap,
                                                BagCompression::kLz4, "bag_0.mcap"},
                                           Kind{"none", ExportFormat::kRosbag2, BagStorage::kMcap,
                                                BagCompression::kNone, "bag_0.mcap"},
                                           Kind{"sqlite3", ExportFormat::kRosbag2,
                                                BagStorage::kSqlite3, BagCompression::kNone,
                                                "bag_0.db3"},
                                           Kind{"ros1", ExportFormat::kBag, BagStorage::kMcap,
                                                BagCompression::kNone, "bag.bag"}),
                         [](const auto& info) { return std::string(info.param.name); });

/// An MCAP file of one number a message.
class HostileMcap : public ::testing::Test {
 protected:
  std::string FaultOf(const std::string& bytes, bool skips = false) {
    WriteWholeFile(scratch_.path() / "log.mcap", bytes);
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   "name: n\nmachine: m\nfile: log.mcap\ntables: [{name: t, topic: /t, columns: "
                   "{v: {column: data, unit: '1'}}}]\n");
    fs::remove_all(scratch_.path() / "out");
    try {
      report_ = ImportCsv(scratch_.path() / "mapping.yaml", scratch_.path() / "out",
                          {.skips_bad_rows = skips});
      return "";
    } catch (const InputError& fault) {
      return fault.what();
    }
  }
  static SmallMcap Bag() { return SmallMcap("std_msgs/msg/Float64", "float64 data\n"); }
  static std::string Value(double v) { return Cdr().Add(v).bytes(); }
  static std::string Chunk(std::uint64_t size, const std::string& compression,
                           const std::string& records, std::uint32_t crc = 0) {
    return McapRecord(0x06, Packed()
                                .Add(std::uint64_t{0})
                                .Add(std::uint64_t{0})
                                .Add(size)
                                .Add(crc)
                                .Text(compression)
                                .Add(static_cast<std::uint64_t>(records.size()))
                                .Raw(records)
                                .bytes());
  }

  ScratchDirectory scratch_;
  ImportReport report_;
};

TEST_F(HostileMcap, SizesThatAreDeclaredAreNotBelieved) {
  const std::string record = SmallMcap::MessageRecord(2, Value(2));
  const std::uint64_t huge = std::uint64_t{1} << 40;
  for (const std::string compression : {"zstd", "lz4"}) {
    EXPECT_THAT(FaultOf(Bag().Raw(Chunk(huge, compression, record)).bytes()),
                HasSubstr("a size of 1099511627776 bytes is declared"));
    EXPECT_THAT(FaultOf(Bag().Raw(Chunk(100, compression, record)).bytes()),
                HasSubstr("cannot be unpacked by " + compression));
  }
  EXPECT_THAT(FaultOf(Bag().Raw(Chunk(huge, "", record)).bytes()),
              HasSubstr("a chunk declares 1099511627776 bytes and has "));
  EXPECT_THAT(FaultOf(Bag().Raw(Chunk(record.size(), "brotli", record)).bytes()),
              HasSubstr("compressed by 'brotli', need zstd, lz4 or none"));
  EXPECT_THAT(FaultOf(Bag().Raw(Chunk(record.size(), "", record, 1)).bytes()),
              HasSubstr("the checksum of a chunk does not match its bytes"));
  EXPECT_THAT(FaultOf(Bag().Raw(Packed().Add(std::uint8_t{5}).Add(huge).bytes()).bytes()),
              HasSubstr("1099511627776 bytes are declared, but the file has only"));
}

TEST_F(HostileMcap, WhatStandsBeforeTheDamageIsRead) {
  SmallMcap bag = Bag();
  bag.Message(1, Value(1)).Message(2, Value(2));
  EXPECT_THAT(FaultOf(bag.WithoutEnd()), HasSubstr("ends without its footer"));
  EXPECT_EQ(FaultOf(bag.WithoutEnd(), true), "");
  EXPECT_EQ(report_.channels[0].rows, 2);
  EXPECT_EQ(report_.channels[0].left_out, 1);
  EXPECT_THAT(report_.channels[0].first_fault, HasSubstr("as after a crash of the recorder"));
}

TEST_F(HostileMcap, RecordsThatReferToNothingAreToldOf) {
  EXPECT_THAT(
      FaultOf(Bag().Raw(McapRecord(5, std::string("\x09\x00", 2) + std::string(20, 0))).bytes()),
      HasSubstr("a message refers to channel 9, which the file has not declared"));
  EXPECT_THAT(FaultOf(Bag().Raw(McapRecord(5, "\x07")).bytes()), HasSubstr("log.mcap: byte "));
  EXPECT_THAT(FaultOf(Bag().Message(~std::uint64_t{0}, Value(0)).bytes()),
              HasSubstr("a message's time is 18446744073709551615 ns"));
  EXPECT_THAT(FaultOf("ms,v\n1,2\n"), HasSubstr("log.mcap: is not a bag; need"));
  EXPECT_THAT(FaultOf(""), HasSubstr("log.mcap: is not a bag; need"));
}

}  // namespace
}  // namespace tera
