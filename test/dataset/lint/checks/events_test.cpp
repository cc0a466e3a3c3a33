#include <gmock/gmock.h>

#include "dataset/lint/healthy_recording.h"

// events.rows, broken place by place.

namespace tera {
namespace {

using testing::HasSubstr;

class EventRules : public LintTest {
 protected:
  LintPlace Expect(const std::string& from, const std::string& to,
                   const std::string& message) const {
    Edit("truth/events.csv", from, to);
    const LintFinding finding = Only("events.rows", "truth/events.csv");
    EXPECT_THAT(finding.places[0].message, HasSubstr(message));
    return finding.places[0];
  }
};

TEST_F(EventRules, AnotherHeader) { Expect("end_ns", "end_s", "need 't_ns,end_ns,kind"); }
TEST_F(EventRules, AnUnknownKind) { Expect(",contact,", ",kiss,", "unknown kind 'kiss'"); }
TEST_F(EventRules, AUnitOfAnotherKind) { Expect(",N\n", ",kg\n", "unit 'kg', need 'N'"); }
TEST_F(EventRules, AnEndBeyondTheRecording) {
  EXPECT_EQ(Expect("700000000", "2010000001", "ends at 2.010000001 s").line, 2);
}
// A run ends with the physics step that reaches its duration.
TEST_F(EventRules, AnEndWithinAStepOfTheRecordingsIsNone) {
  Edit("truth/events.csv", "700000000", "2003333333");
  EXPECT_TRUE(Found().empty());
}
TEST_F(EventRules, ABeginningBeforeTheRecording) {
  EXPECT_EQ(Expect("500000000", "-500000000", "begins at -0.5 s").line, 2);
}
TEST_F(EventRules, TheLineIsThatOfTheFileAfterAFaultyRow) {
  Edit("truth/events.csv", ",unit\n", ",unit\n1,2\n");
  Edit("truth/events.csv", "700000000", "2010000001");
  const LintFinding finding = Only("events.rows", "truth/events.csv");
  ASSERT_EQ(finding.places.size(), 2u);
  EXPECT_EQ(finding.places[0].line, 2);
  EXPECT_EQ(finding.places[1].line, 3);
}
TEST_F(EventRules, AMachineThatIsNotThere) {
  Expect(",digger,", ",dumper,", "is of machine 'dumper', which has no channels");
}

}  // namespace
}  // namespace tera
