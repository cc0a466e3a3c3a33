#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/faults.h"
#include "dataset/export/export.h"
#include "dataset/export/frames_recording.h"
#include "dataset/export/webdataset/merged_archives.h"
#include "dataset/export/webdataset/npy.h"
#include "dataset/export/webdataset/tar_names.h"
#include "dataset/export/webdataset/tar_writer.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using enum FaultKind;
using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

// Fields by the table of IEEE Std 1003.1: name at 0, size at 124, checksum at 148, type at 156,
// magic at 257, prefix at 345.
TEST(TarWriter, AnArchiveIsOfBlocksWithHeaders) {
  const ScratchDirectory scratch;
  TarWriter tar(scratch.path() / "a.tar");
  tar.Add("folder", "name.txt", std::string(600, 'x'));
  tar.Commit();
  const std::string bytes = ReadWholeFile(scratch.path() / "a.tar");
  ASSERT_EQ(bytes.size(), 512u * (1 + 2 + 2));
  EXPECT_EQ(static_cast<std::int64_t>(bytes.size()), tar.bytes() - 1024);
  EXPECT_STREQ(bytes.c_str(), "name.txt");
  EXPECT_STREQ(bytes.c_str() + 124, "00000001130");  // 600 = 1130 octal
  EXPECT_EQ(bytes[156], '0');
  EXPECT_EQ(bytes.substr(257, 8), std::string("ustar\0"
                                              "00",
                                              8));
  EXPECT_STREQ(bytes.c_str() + 345, "folder");
  std::string header = bytes.substr(0, 512);
  header.replace(148, 8, 8, ' ');
  int sum = 0;
  for (const char c : header) sum += c;
  EXPECT_EQ(std::stoi(bytes.substr(148, 6), nullptr, 8), sum);
  EXPECT_EQ(bytes.substr(1536), std::string(1024, '\0'));
}

TEST(TarWriter, ANameThatHasNoRoomIsRefused) {
  const ScratchDirectory scratch;
  TarWriter tar(scratch.path() / "a.tar");
  EXPECT_THROW(tar.Add("f", std::string(101, 'n'), ""), InputError);
  EXPECT_THROW(tar.Add(std::string(156, 'f'), "n", ""), InputError);
}

TEST(NamesInTar, AreThoseOfAWholeArchiveAlone) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "a.tar";
  EXPECT_FALSE(NamesInTar(file));
  TarWriter tar(file);
  tar.Add("folder", "1.rgb.png", std::string(600, 'x'));
  tar.Add("folder", "1.json", "");
  tar.Commit();
  const std::string bytes = ReadWholeFile(file);
  EXPECT_EQ(NamesInTar(file), (std::vector<std::string>{"1.rgb.png", "1.json"}));
  for (std::size_t size = 0; size < bytes.size(); size += 256) {
    WriteWholeFile(file, bytes.substr(0, size));
    EXPECT_FALSE(NamesInTar(file)) << size;
  }
  std::string longer = bytes;
  longer.replace(124, 11, "77777777777");
  WriteWholeFile(file, longer);
  EXPECT_FALSE(NamesInTar(file));
}

// The format's own example: data after the header begin at a multiple of 64.
TEST(Npy, PointsBeginAtAMultipleOf64) {
  LidarPoint point;
  point.x_m = 1;
  point.label = 17;
  const std::string bytes = NpyOf({point, point});
  constexpr std::size_t kPointBytes = 4 * 4 + 4 + 2 + 2 + 1;
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\0", 8));
  const std::size_t header =
      static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ((10 + header) % 64, 0u);
  EXPECT_EQ(bytes[10 + header - 1], '\n');
  EXPECT_EQ(bytes.size(), 10 + header + 2 * kPointBytes);
  EXPECT_THAT(bytes, HasSubstr("'shape': (2,), "));
  EXPECT_EQ(bytes.back(), 17);
}

class WebdatasetTest : public testing::Test {
 protected:
  WebdatasetTest() {
    DatasetWriter writer(recording(), SampleInfo(), {});
    WriteSample(&writer, kSampleFrames);
    writer.Finish();
  }
  fs::path recording() const { return scratch_.path() / "run"; }
  fs::path out() const { return scratch_.path() / "out"; }
  json ListAfter(std::int64_t shard_bytes) {
    Export(recording(), out(), {.format = ExportFormat::kWebdataset, .shard_bytes = shard_bytes});
    return json::parse(ReadWholeFile(out() / "digger_front.json"))["shardlist"];
  }
  std::vector<InputFault> Fault(const fs::path& card = "") {
    try {
      Export(recording(), out(), {.format = ExportFormat::kWebdataset, .card = card});
    } catch (const InputError& e) {
      EXPECT_FALSE(fs::exists(out()) || fs::exists(out().string() + ".incomplete"));
      return e.faults();
    }
    return {};
  }
  ScratchDirectory scratch_;
};

TEST_F(WebdatasetTest, SmallSamplesShareAnArchive) {
  const json list = ListAfter(1'000'000);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0]["nsamples"], kSampleFrames);
  EXPECT_EQ(list[0]["url"], "digger_front-000000.tar");
  EXPECT_EQ(list[0]["filesize"], fs::file_size(out() / "digger_front-000000.tar"));
}

TEST_F(WebdatasetTest, AnArchiveIsFullBeforeTheNextBegins) {
  const std::int64_t all = ListAfter(1'000'000)[0]["filesize"];
  fs::remove_all(out());
  const std::int64_t most = all / 2;
  const json list = ListAfter(most);
  // Samples of the recording are of about one size, a sixth of all.
  ASSERT_GE(list.size(), 2u);
  EXPECT_LE(list.size(), 3u);
  for (const json& archive : list) EXPECT_LE(archive["filesize"].get<std::int64_t>(), most);
  EXPECT_GT(list[0]["filesize"].get<std::int64_t>(), most - all / 5);
}

TEST_F(WebdatasetTest, ACardThatLacksFactsIsRefused) {
  const fs::path card = scratch_.path() / "card.yaml";
  WriteWholeFile(card,
                 "description: d\nlicense: MIT\nurl: https://a.example\ndate_published: today\n"
                 "person: A\norganization: B\n");
  EXPECT_THAT(Fault(card), testing::AllOf(HasFaultAt("license"), HasFaultAt("date_published")));
  WriteWholeFile(card, "description: d\n");
  EXPECT_THAT(Fault(card), HasFaultAt("license"));
}

TEST_F(WebdatasetTest, ASampleThatIsTooLargeHasAnArchiveOfItsOwn) {
  const json list = ListAfter(1);
  ASSERT_EQ(list.size(), static_cast<std::size_t>(kSampleFrames));
  EXPECT_EQ(list[5]["nsamples"], 1);
  EXPECT_EQ(list[5]["url"], "digger_front-000005.tar");
}

TEST_F(WebdatasetTest, ADateIsWrittenWhereOneIsGiven) {
  Export(recording(), out(),
         {.format = ExportFormat::kWebdataset, .start_utc_ns = 1'714'564'800 * kNsPerSecond});
  EXPECT_THAT(ReadWholeFile(out() / "digger_lidar-000000.tar"),
              HasSubstr("\"t_ns\":100000000,\"utc_ns\":1714564800100000000"));
}

TEST_F(WebdatasetTest, MergedSensorsWithOneNameForTheirFilesAreRefused) {
  const auto write = [&](const std::string& name, const std::string& camera) {
    DatasetWriter writer(scratch_.path() / name, SampleInfo(), {});
    writer.Write(writer.AddChannel(CameraChannel(camera, Sheet("camera", kLens))), FrameAt(0));
    writer.Finish();
    return MergedEpisode{name, scratch_.path() / name, ""};
  };
  const std::vector<MergedEpisode> episodes = {write("1", "a_b/c"), write("2", "a/b_c")};
  fs::create_directories(out());
  EXPECT_THAT([&] { WriteMergedArchives(episodes, out(), {}); }, ThrowsFault(kRepeated));
}

TEST_F(WebdatasetTest, WhatIsBrokenIsNamed) {
  const fs::path front = recording() / "digger/front";
  WriteWholeFile(front / "boxes/0.json", "{");
  EXPECT_THAT(Fault(), HasFault(kMalformed, "boxes/0.json"));
  fs::remove(front / "boxes/0.json");
  WriteWholeFile(front / "depth/0.png", "half");
  EXPECT_THAT(Fault(), HasFault(kMalformed, "depth/0.png"));
  for (const char* kind : {"rgb", "depth", "semantic", "instance"}) {
    fs::remove(front / kind / "0.png");
  }
  EXPECT_THAT(Fault(), HasFault(kMissing, "digger/front"));
}

}  // namespace
}  // namespace tera
