#include <gmock/gmock.h>

#include "dataset/lint/healthy_recording.h"

// events.rows, broken place by place.

namespace tera {
namespace {

using testing::HasSubstr;

class EventRules : public LintTest {
 protected:
  void Expect(const std::string& from, const std::string& to, const std::string& message) const {
    Edit("truth/events.csv", from, to);
    const LintFinding finding = Only("events.rows", "truth/events.csv");
    EXPECT_THAT(finding.places[0].message, HasSubstr(message));
  }
};

TEST_F(EventRules, AnotherHeader) { Expect("end_ns", "end_s", "need 't_ns,end_ns,kind"); }
TEST_F(EventRules, AnUnknownKind) { Expect(",contact,", ",kiss,", "unknown kind 'kiss'"); }
TEST_F(EventRules, AUnitOfAnotherKind) { Expect(",N\n", ",kg\n", "unit 'kg', need 'N'"); }
TEST_F(EventRules, AnEndBeyondTheRecording) {
  Expect("700000000", "2000000001", "ends at 2.000000001 s, need 0 to 2 s");
}
TEST_F(EventRules, AMachineThatIsNotThere) {
  Expect(",digger,", ",dumper,", "is of machine 'dumper', which has no channels");
}

}  // namespace
}  // namespace tera
