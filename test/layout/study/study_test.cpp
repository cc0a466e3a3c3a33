#include "layout/study/study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using testing::HasSubstr;

class Study : public testing::Test {
 protected:
  LayoutStudy Read(const std::string& yaml) {
    const auto file = scratch_.path() / "study.yaml";
    WriteWholeFile(file, yaml);
    return LoadStudy(file);
  }
  std::string FaultsOf(const std::string& yaml) {
    try {
      Read(yaml);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  const ScratchDirectory scratch_;
};

TEST_F(Study, HasNoLimitOfMaskingButItsOwn) {
  EXPECT_FALSE(Read("eye: {link: upper, xyz_m: [0.1, 0.4, 1.3]}").eye->most_masking_m);
  EXPECT_EQ(
      Read("eye: {link: upper, xyz_m: [0.1, 0.4, 1.3], most_masking_m: 0.7}").eye->most_masking_m,
      0.7);
  EXPECT_THAT(FaultsOf("eye: {link: upper, xyz_m: [0.1, 0.4, 1.3], most_masking_m: -1}"),
              HasSubstr("most_masking_m"));
}

}  // namespace
}  // namespace tera
