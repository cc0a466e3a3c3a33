#include "serve/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "serve/requests.h"

// The order of requests, without a socket and without a simulation.

namespace tera {
namespace {

using grpc::StatusCode;
using testing::HasSubstr;

/// Counts physics steps as nanoseconds; refuses seed 13 and steps of 13. A step of 14 ends the
/// episode.
class CountingStage : public Stage {
 public:
  v1::Description Describe(std::uint32_t) override {
    v1::Description description;
    description.set_scenario("counting");
    return description;
  }
  std::optional<v1::Observation> Reset(const v1::Reset& request) override {
    if (request.seed() == 13) throw InputError("no seed 13");
    time_ns_ = 0;
    in_episode_ = true;
    return Now();
  }
  std::optional<v1::Observation> Step(const v1::Step& request) override {
    if (request.physics_steps() == 13) throw InputError("no 13 steps");
    if (request.physics_steps() == 14) in_episode_ = false;
    if (!in_episode_) throw InputError("a fault");
    if (ended) return std::nullopt;
    time_ns_ += request.physics_steps();
    return Now();
  }

  std::optional<v1::Outcomes> Do(const v1::Batch&) override { return v1::Outcomes(); }
  bool InEpisode() const override { return in_episode_; }

  bool ended = false;

 private:
  bool in_episode_ = false;
  v1::Observation Now() const {
    v1::Observation observation;
    observation.set_time_ns(time_ns_);
    return observation;
  }
  std::int64_t time_ns_ = 0;
};

class SessionTest : public testing::Test {
 protected:
  Session::Answer Send(const v1::Request& request) {
    return session_.Handle(request.SerializeAsString());
  }
  v1::Response Response(const v1::Request& request) {
    const Session::Answer answer = Send(request);
    if (const auto* end = std::get_if<grpc::Status>(&answer)) {
      ADD_FAILURE() << end->error_message();
      return {};
    }
    return std::get<v1::Response>(answer);
  }
  void ExpectEnd(const Session::Answer& answer, StatusCode code, const std::string& words) {
    const auto* end = std::get_if<grpc::Status>(&answer);
    ASSERT_NE(end, nullptr);
    EXPECT_EQ(end->error_code(), code);
    EXPECT_THAT(end->error_message(), HasSubstr(words));
  }

  CountingStage stage_;
  Session session_{&stage_, "tera 9"};
};

TEST_F(SessionTest, GreetsDescribesResetsAndSteps) {
  const v1::Response welcome = Response(Hello(1));
  EXPECT_EQ(welcome.sequence(), 1u);
  EXPECT_EQ(welcome.welcome().protocol(), 1u);
  EXPECT_EQ(welcome.welcome().server(), "tera 9");
  EXPECT_GT(welcome.welcome().largest_request_bytes(), 0u);
  EXPECT_EQ(session_.client(), "test");
  EXPECT_EQ(Response(Describe(2)).description().scenario(), "counting");
  EXPECT_EQ(Response(Reset(3)).observation().time_ns(), 0);
  EXPECT_EQ(Response(Step(4, 5)).observation().time_ns(), 5);
  const v1::Response later = Response(Step(5, 2));
  EXPECT_EQ(later.observation().time_ns(), 7);
  EXPECT_EQ(later.sequence(), 5u);
  EXPECT_EQ(Response(Reset(6)).observation().time_ns(), 0);
}

TEST_F(SessionTest, EndsWhereTheFirstRequestIsNotHello) {
  ExpectEnd(Send(Describe(1)), StatusCode::FAILED_PRECONDITION, "the first request is not Hello");
}

TEST_F(SessionTest, EndsAtAnotherProtocol) {
  ExpectEnd(Send(Hello(1, 2)), StatusCode::FAILED_PRECONDITION,
            "protocol 2 asked for, this server speaks 1");
}

TEST_F(SessionTest, EndsAtASecondHello) {
  Response(Hello(1));
  ExpectEnd(Send(Hello(2)), StatusCode::FAILED_PRECONDITION, "a second Hello");
}

TEST_F(SessionTest, EndsAtAWrongSequenceNumberAndSaysWhichIsNeeded) {
  ExpectEnd(Session(&stage_, "").Handle(Hello(0).SerializeAsString()),
            StatusCode::FAILED_PRECONDITION, "sequence number 0 found, need 1");
  Response(Hello(1));
  Response(Reset(2));
  ExpectEnd(Send(Step(2)), StatusCode::FAILED_PRECONDITION, "sequence number 2 found, need 3");
  ExpectEnd(Send(Step(4)), StatusCode::FAILED_PRECONDITION, "sequence number 4 found, need 3");
}

TEST_F(SessionTest, EndsAtAStepBeforeAnyReset) {
  Response(Hello(1));
  ExpectEnd(Send(Step(2)), StatusCode::FAILED_PRECONDITION, "Step before any Reset");
}

TEST_F(SessionTest, EndsAtBytesThatAreNoRequest) {
  Response(Hello(1));
  ExpectEnd(session_.Handle("\xff\xff\xff"), StatusCode::INVALID_ARGUMENT,
            "message 2 (3 bytes) is no tera.v1.Request");
  const std::string whole = Reset(2, 1234567).SerializeAsString();
  ExpectEnd(session_.Handle(whole.substr(0, whole.size() - 1)), StatusCode::INVALID_ARGUMENT,
            "is no tera.v1.Request");
}

TEST_F(SessionTest, EndsAtARequestOfAnUnknownKind) {
  Response(Hello(1));
  ExpectEnd(Send(Numbered(2)), StatusCode::UNIMPLEMENTED, "of no kind that protocol 1 knows");
  Session another(&stage_, "");
  another.Handle(Hello(1).SerializeAsString());
  // Field 15 of wire type 2, empty: a later client might send it.
  ExpectEnd(another.Handle(Numbered(2).SerializeAsString() + std::string("\x7a\x00", 2)),
            StatusCode::UNIMPLEMENTED, "of no kind");
}

TEST_F(SessionTest, GoesOnAfterARequestThatCannotBeDone) {
  Response(Hello(1));
  EXPECT_EQ(Response(Reset(2, 13)).refusal().message(), "no seed 13");
  // No episode was begun.
  ExpectEnd(Send(Step(3)), StatusCode::FAILED_PRECONDITION, "Step before any Reset");
  Session another(&stage_, "");
  const auto send = [&](const v1::Request& request) {
    return std::get<v1::Response>(another.Handle(request.SerializeAsString()));
  };
  send(Hello(1));
  send(Reset(2));
  EXPECT_EQ(send(Step(3, 13)).refusal().message(), "no 13 steps");
  EXPECT_EQ(send(Step(4, 3)).observation().time_ns(), 3);
}

TEST_F(SessionTest, SaysWhetherARefusalHasEndedTheEpisode) {
  Response(Hello(1));
  EXPECT_FALSE(Response(Reset(2, 13)).refusal().episode_over());  // none was begun
  Response(Reset(3));
  EXPECT_FALSE(Response(Step(4, 13)).refusal().episode_over());
  EXPECT_TRUE(Response(Step(5, 14)).refusal().episode_over());
  EXPECT_TRUE(Response(Step(6)).refusal().episode_over());  // sent ahead, say
  EXPECT_TRUE(Response(Reset(7)).has_observation());
  EXPECT_EQ(Response(Step(8, 5)).observation().time_ns(), 5);
}

TEST_F(SessionTest, RefusesFieldsThatItDoesNotKnowWhereverTheyAre) {
  const auto add_unknown = [](google::protobuf::Message* message) {
    message->GetReflection()->MutableUnknownFields(message)->AddVarint(77, 1);
  };
  Response(Hello(1));
  Response(Reset(2));
  v1::Request step = Step(3, 5);
  add_unknown(step.mutable_step()->add_actions());  // another kind of command, say
  EXPECT_THAT(Response(step).refusal().message(),
              testing::AllOf(HasSubstr("field 77 of Action is not known"), HasSubstr("tera 9")));
  v1::Request reset = Reset(4);
  add_unknown(reset.mutable_reset()->mutable_observe());
  EXPECT_THAT(Response(reset).refusal().message(), HasSubstr("field 77 of Observe"));
  step = Step(5, 5);
  add_unknown(&step);
  EXPECT_THAT(Response(step).refusal().message(), HasSubstr("field 77 of Request"));
  EXPECT_EQ(Response(Step(6, 5)).observation().time_ns(), 5);  // the others did nothing
}

TEST_F(SessionTest, RefusesAHelloWithAFieldThatItDoesNotKnowAndWaitsForAnother) {
  v1::Request hello = Hello(1);
  v1::Hello* greeting = hello.mutable_hello();
  greeting->GetReflection()->MutableUnknownFields(greeting)->AddVarint(77, 1);
  const v1::Response refused = Response(hello);
  EXPECT_THAT(refused.refusal().message(), HasSubstr("field 77 of Hello is not known"));
  EXPECT_FALSE(refused.refusal().episode_over());
  EXPECT_FALSE(session_.greeted());
  ExpectEnd(Session(&stage_, "").Handle(Describe(1).SerializeAsString()),
            StatusCode::FAILED_PRECONDITION, "the first request is not Hello");
  EXPECT_TRUE(Response(Hello(2)).has_welcome());
  // Another protocol's Hello may have any fields: only the protocol matters.
  hello.mutable_hello()->set_protocol(2);
  ExpectEnd(Session(&stage_, "").Handle(hello.SerializeAsString()), StatusCode::FAILED_PRECONDITION,
            "protocol 2 asked for");
}

TEST_F(SessionTest, EndsAtAClientsNameThatCannotBeShown) {
  for (const std::string& name : {std::string(129, 'x'), std::string("two\nlines"),
                                  std::string("\x1b[2J"), std::string("caf\xc3\xa9")}) {
    v1::Request hello = Hello(1);
    hello.mutable_hello()->set_client(name);
    ExpectEnd(Session(&stage_, "").Handle(hello.SerializeAsString()), StatusCode::INVALID_ARGUMENT,
              "need at most 128 printable ASCII characters");
  }
  v1::Request hello = Hello(1);
  hello.mutable_hello()->set_client(std::string(128, '~'));
  EXPECT_TRUE(Response(hello).has_welcome());
}

TEST_F(SessionTest, EndsWhereTheStageWasStopped) {
  Response(Hello(1));
  Response(Reset(2));
  stage_.ended = true;
  ExpectEnd(Send(Step(3)), StatusCode::CANCELLED, "ended");
}

}  // namespace
}  // namespace tera
