#include <fmt/format.h>
#include <gmock/gmock.h>

#include "dataset/format/png.h"
#include "dataset/lint/healthy_recording.h"

// pictures.* and boxes.*: each broken by itself.

namespace tera {
namespace {

using testing::HasSubstr;

constexpr char kFirst[] = "0", kSecond[] = "200000000";

class PictureRules : public LintTest {
 protected:
  template <typename T>
  void EditPicture(const std::string& kind, const std::string& stamp, int components,
                   const std::function<void(Image<T>*)>& change) const {
    const std::string file = fmt::format("digger/front/{}/{}.png", kind, stamp);
    Image<T> picture;
    ReadPng(run() / file, components, &picture);
    change(&picture);
    Put(file, EncodePng(picture));
  }
  void EditBoxes(const std::string& from, const std::string& to) const {
    Edit("digger/front/boxes/0.json", from, to);
  }
};

TEST_F(PictureRules, APictureWithoutBytes) {
  Put("digger/front/rgb/0.png", "");
  EXPECT_EQ(Only("pictures.readable", "digger/front").places[0].file, "digger/front/rgb/0.png");
}

TEST_F(PictureRules, APictureThatIsCutOff) {
  std::string bytes = ReadWholeFile(run() / "digger/front/normal/0.png");
  bytes.resize(bytes.size() / 2);
  Put("digger/front/normal/0.png", bytes);
  Only("pictures.readable", "digger/front");
}

TEST_F(PictureRules, ADepthOfEightBits) {
  Put("digger/front/depth/0.png",
      EncodeGreyPng(Image<std::uint8_t>(kHealthyWidth_px, kHealthyHeight_px)));
  EXPECT_THAT(Only("pictures.readable", "digger/front").places[0].message,
              HasSubstr("need 16-bit grey"));
}

TEST_F(PictureRules, APictureOfAnotherSize) {
  Put("digger/front/rgb/0.png", EncodeRgbPng(Image<std::uint8_t>(12, 8, 3)));
  EXPECT_THAT(Only("pictures.size", "digger/front").places[0].message,
              HasSubstr("12 x 8 pixels, need 24 x 16"));
}

TEST_F(PictureRules, AClassThatIsNotListed) {
  EditPicture<std::uint8_t>("semantic", kSecond, 1, [](auto* p) { p->at(20, 14) = 99; });
  EXPECT_EQ(Only("pictures.classes", "digger/front").places[0].message, "1 pixels of class 99");
}

TEST_F(PictureRules, AnInstanceThatIsNotListed) {
  EditPicture<std::uint16_t>("instance", kSecond, 1, [](auto* p) { p->at(20, 14) = 300; });
  EXPECT_EQ(Only("pictures.instances", "digger/front").places[0].message,
            "1 pixels of instance 300");
}

TEST_F(PictureRules, AClassThatIsNotTheInstances) {
  EditPicture<std::uint8_t>("semantic", kSecond, 1, [](auto* p) { p->at(3, 6) = 11; });
  EXPECT_THAT(Only("pictures.agree", "digger/front").places[0].message,
              HasSubstr("1 pixels have class person but instance 1 (truck) of class truck"));
}

// A panoptic picture for each pair of class and instance, one of them with other numbers.
TEST_F(PictureRules, APanopticPictureOfOtherNumbers) {
  for (int k = 0; k <= 10; ++k) {
    const std::string name = fmt::format("{}.png", 200'000'000LL * k);
    Image<std::uint8_t> semantic;
    Image<std::uint16_t> instance;
    ReadPng(run() / "digger/front/semantic" / name, 1, &semantic);
    ReadPng(run() / "digger/front/instance" / name, 1, &instance);
    Image<std::uint8_t> panoptic(kHealthyWidth_px, kHealthyHeight_px, 3);
    for (std::size_t p = 0; p < semantic.data.size(); ++p) {
      panoptic.data[3 * p] = semantic.data[p];
      panoptic.data[3 * p + 1] = static_cast<std::uint8_t>(instance.data[p]);
    }
    std::filesystem::create_directories(run() / "digger/front/panoptic");
    Put("digger/front/panoptic/" + name, EncodePng(panoptic));
  }
  EXPECT_TRUE(Linted().findings.empty());
  EditPicture<std::uint8_t>("panoptic", kSecond, 3, [](auto* p) {
    p->at(3, 6, 0) = 11;
    p->at(3, 6, 2) = p->at(4, 6, 2) = 1;
  });
  const auto& places = Only("pictures.agree", "digger/front").places;
  EXPECT_EQ(places[0].message, "1 pixels differ from semantic/");
  EXPECT_EQ(places[1].message, "2 pixels differ from instance/");
}

TEST_F(PictureRules, DepthInTheSky) {
  EditPicture<std::uint16_t>("depth", kFirst, 1, [](auto* p) { p->at(3, 0) = 60'000; });
  EXPECT_EQ(Only("pictures.depth", "digger/front").places[0].file, "digger/front/depth/0.png");
}

// The distance along the ray cannot be less than that along the axis.
TEST_F(PictureRules, DistanceAndDepthTheOtherWayRound) {
  const std::string depth = "digger/front/depth/0.png", distance = "digger/front/distance/0.png";
  const std::string bytes = ReadWholeFile(run() / depth);
  Put(depth, ReadWholeFile(run() / distance));
  Put(distance, bytes);
  EXPECT_THAT(Only("pictures.depth", "digger/front").places[0].message,
              HasSubstr("more depth than"));
}

TEST_F(PictureRules, ANormalThatIsNotOfLengthOne) {
  EditPicture<std::uint16_t>("normal", kSecond, 3, [](auto* p) { p->at(20, 14, 2) = 300; });
  EXPECT_EQ(Only("pictures.normals", "digger/front").places[0].message,
            "1 normals are not of length 1");
}

TEST_F(PictureRules, AFlowWithAStateThatThereIsNot) {
  EditPicture<std::uint16_t>("flow_to_previous", kSecond, 3, [](auto* p) { p->at(20, 14, 2) = 4; });
  Only("pictures.flow", "digger/front");
}

TEST_F(PictureRules, AFlowOfTheFirstPicture) {
  EditPicture<std::uint16_t>("flow_to_previous", kFirst, 3, [](auto* p) { p->at(2, 3, 0) = 9; });
  EXPECT_THAT(Only("pictures.flow", "digger/front").places[0].message, HasSubstr("first picture"));
}

// Flow from this picture to the previous one, which is the wrong direction.
TEST_F(PictureRules, AFlowOfTheOtherSign) {
  for (int k = 1; k <= 10; ++k) {
    EditPicture<std::uint16_t>("flow_to_previous", std::to_string(200'000'000LL * k), 3,
                               [](auto* p) {
                                 for (std::size_t i = 0; i < p->data.size(); ++i) {
                                   if (i % 3 == 2 || p->data[i] == 0) continue;
                                   p->data[i] = static_cast<std::uint16_t>(65536 - p->data[i]);
                                 }
                               });
  }
  EXPECT_THAT(Only("pictures.motion", "digger/front").places[0].message,
              HasSubstr("ground pixels have the flow that the camera poses give"));
}

TEST_F(PictureRules, BoxesThatAreNoJson) {
  Put("digger/front/boxes/0.json", "{\"boxes\": [");
  EXPECT_EQ(Only("boxes.readable", "digger/front").places[0].file, "digger/front/boxes/0.json");
}

TEST_F(PictureRules, ABoxOfAnotherName) {
  EditBoxes("\"name\": \"truck\"", "\"name\": \"lorry\"");
  EXPECT_THAT(Only("boxes.instance", "digger/front").places[0].message,
              HasSubstr("should be of 'truck'"));
}

TEST_F(PictureRules, ABoxOfAnotherClassAndParent) {
  EditBoxes("\"class\": \"boom\"", "\"class\": \"arm\"");
  EditBoxes("\"parent\": 3", "\"parent\": 1");
  EXPECT_EQ(Only("boxes.instance", "digger/front").count, 2);
}

TEST_F(PictureRules, AShareBeyondOne) {
  EditBoxes("\"visibility\": 1.0", "\"visibility\": 1.2");
  EXPECT_THAT(Only("boxes.bounds", "digger/front").places[0].message,
              HasSubstr("has the visibility 1.2"));
}

TEST_F(PictureRules, ABoxBeyondThePicture) {
  EditBoxes("\"x_max_px\": 6", "\"x_max_px\": 24");
  const LintReport report = Linted();  // its mask contradicts it too
  ASSERT_EQ(report.findings.size(), 2u);
  EXPECT_EQ(report.findings[0].rule->id, "boxes.bounds");
  EXPECT_EQ(report.findings[1].rule->id, "boxes.mask");
}

TEST_F(PictureRules, ABoxThatIsNotItsMasks) {
  EditBoxes("\"visible_px\": 25", "\"visible_px\": 24");
  EXPECT_THAT(Only("boxes.mask", "digger/front").places[0].message,
              HasSubstr("the box of 1 (truck) has 24 pixels in 2 5 to 6 9, instance/ has 25 pixels "
                        "in 2 5 to 6 9"));
}

TEST_F(PictureRules, TheWholeCountsThePixelsOfItsParts) {
  EditBoxes("\"instance\": 3", "\"instance\": 4");
  const LintReport report = Linted();
  ASSERT_EQ(report.findings.size(), 2u);
  EXPECT_EQ(report.findings[0].rule->id, "boxes.instance");
  EXPECT_EQ(report.findings[1].rule->id, "boxes.mask");
  EXPECT_THAT(report.findings[1].places[1].message,
              HasSubstr("instance 3 has no box, but 36 pixels in 14 4 to 17 12"));
}

}  // namespace
}  // namespace tera
