#include "serve/server.h"

#include <gmock/gmock.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/error.h"
#include "serve/requests.h"
#include "tera/v1/simulation.grpc.pb.h"

// Over a real socket: clients that misbehave, die, or come second. No simulation.

namespace tera {
namespace {

using grpc::StatusCode;
using testing::AllOf;
using testing::HasSubstr;

constexpr int kEndless = 1000, kFaulty = 2;  // physics steps
constexpr std::size_t kLarge = 10 << 20;

/// A step of one physics step completes at once; one of kEndless runs until the session ends.
class EndlessStage : public Stage {
 public:
  EndlessStage(std::function<bool()> ended, std::atomic<int>* alive, std::atomic<bool>* stepping)
      : ended_(std::move(ended)), alive_(alive), stepping_(stepping) {
    ++*alive_;
  }
  ~EndlessStage() override { --*alive_; }
  v1::Description Describe(std::uint32_t) override {
    v1::Description description;
    description.set_scenario(std::string(kLarge, 'x'));
    return description;
  }
  std::optional<v1::Observation> Reset(const v1::Reset&) override { return v1::Observation(); }
  std::optional<v1::Observation> Step(const v1::Step& request) override {
    if (request.physics_steps() == 1) return v1::Observation();
    if (request.physics_steps() == kFaulty) throw std::runtime_error("a wheel came off");
    *stepping_ = true;
    while (!ended_()) std::this_thread::yield();
    *stepping_ = false;
    return std::nullopt;
  }
  std::optional<v1::Outcomes> Do(const v1::Batch&) override { return v1::Outcomes(); }
  bool InEpisode() const override { return true; }

 private:
  std::function<bool()> ended_;
  std::atomic<int>* alive_;
  std::atomic<bool>* stepping_;
};

/// A client that sends arbitrary bytes.
class RawClient {
 public:
  explicit RawClient(const std::string& address)
      : stub_(v1::Simulation::NewStub(
            grpc::CreateCustomChannel(address, Credentials(), AnyAnswer()))),
        stream_(stub_->Session(&context_)) {}
  ~RawClient() { context_.TryCancel(); }

  bool Send(const v1::Request& request) { return stream_->Write(request); }
  /// None if the server ended the session.
  std::optional<v1::Response> Receive() {
    v1::Response response;
    if (!stream_->Read(&response)) return std::nullopt;
    return response;
  }
  std::optional<v1::Response> Ask(const v1::Request& request) {
    Send(request);
    return Receive();
  }
  void Close() { stream_->WritesDone(); }
  grpc::Status End() {
    while (Receive()) continue;
    return stream_->Finish();
  }
  void Die() { context_.TryCancel(); }

  static std::shared_ptr<grpc::ChannelCredentials> Credentials() {
    return grpc::InsecureChannelCredentials();
  }
  static grpc::ChannelArguments AnyAnswer() {
    grpc::ChannelArguments arguments;
    arguments.SetMaxReceiveMessageSize(-1);
    return arguments;
  }

 private:
  grpc::ClientContext context_;
  std::unique_ptr<v1::Simulation::Stub> stub_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::Request, v1::Response>> stream_;
};

class ServerTest : public testing::Test {
 protected:
  std::string address() const { return server_->address(); }
  /// A client that is served as soon as the server is free.
  std::unique_ptr<RawClient> Served() {
    while (true) {
      auto client = std::make_unique<RawClient>(address());
      if (const auto welcome = client->Ask(Hello(1))) {
        EXPECT_TRUE(welcome->has_welcome());
        return client;
      }
      const grpc::Status end = client->End();
      EXPECT_EQ(end.error_code(), StatusCode::RESOURCE_EXHAUSTED) << end.error_message();
    }
  }
  void ExpectReady() { EXPECT_TRUE(Served()->Ask(Reset(2))->has_observation()); }

  std::atomic<int> stages_ = 0;
  std::atomic<bool> stepping_ = false;
  std::unique_ptr<Server> server_ = std::make_unique<Server>(
      ServerOptions{.name = "tera 9"},
      [this](std::function<bool()> ended) {
        return std::make_unique<EndlessStage>(std::move(ended), &stages_, &stepping_);
      },
      [](const std::string&) {});
};

TEST_F(ServerTest, ListensOnLoopbackAtAPortOfTheSystemsChoice) {
  EXPECT_THAT(address(), testing::MatchesRegex("127\\.0\\.0\\.1:[1-9][0-9]*"));
}

TEST_F(ServerTest, RefusesAPortThatIsTaken) {
  const int port = std::stoi(address().substr(address().find(':') + 1));
  try {
    const Server second({.port = port}, {}, {});
    FAIL() << "listens on a taken port";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("cannot listen on " + address()), HasSubstr("--port")));
  }
}

TEST_F(ServerTest, ServesOneClientAfterTheOther) {
  for (int k = 0; k < 3; ++k) {
    RawClient client(address());
    ASSERT_TRUE(client.Ask(Hello(1))->has_welcome());
    EXPECT_TRUE(client.Ask(Describe(2))->has_description());
    EXPECT_TRUE(client.Ask(Reset(3))->has_observation());
    EXPECT_TRUE(client.Ask(Step(4))->has_observation());
    client.Close();
    EXPECT_TRUE(client.End().ok());
    EXPECT_EQ(stages_, 0);  // gone before its client learnt of the end
  }
}

TEST_F(ServerTest, SendsLargeAnswers) {
  const auto client = Served();
  for (int k = 2; k < 5; ++k) {
    EXPECT_EQ(client->Ask(Describe(k))->description().scenario().size(), kLarge);
  }
}

TEST_F(ServerTest, AnswersInOrderWhatWasSentAhead) {
  const auto client = Served();
  client->Send(Reset(2));
  for (int k = 3; k < 20; ++k) client->Send(Step(k));
  for (std::uint64_t k = 2; k < 20; ++k) EXPECT_EQ(client->Receive()->sequence(), k);
}

TEST_F(ServerTest, RefusesASecondClientAtOnceAndNamesTheFirst) {
  const auto first = Served();
  first->Ask(Reset(2));
  first->Send(Step(3, kEndless));
  while (!stepping_) std::this_thread::yield();
  RawClient second(address());
  const grpc::Status end = second.End();
  EXPECT_EQ(end.error_code(), StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(end.error_message(), AllOf(HasSubstr("busy with test at ipv4:127.0.0.1:"),
                                         HasSubstr("one session at a time")));
  EXPECT_TRUE(stepping_);  // the first goes on
}

TEST_F(ServerTest, IsReadyAgainAfterAClientThatDiedInTheMiddleOfAStep) {
  const auto client = Served();
  client->Ask(Reset(2));
  client->Send(Step(3, kEndless));
  while (!stepping_) std::this_thread::yield();
  client->Die();
  ExpectReady();
}

TEST_F(ServerTest, IsReadyAgainAfterAClientThatDiedBetweenRequests) {
  Served()->Die();
  ExpectReady();
}

TEST_F(ServerTest, IsReadyAgainAfterAClientThatNeverSaidHello) {
  { const RawClient silent(address()); }
  ExpectReady();
}

TEST_F(ServerTest, AClientThatSaysNothingLosesItsPlace) {
  const Server impatient(
      {.hello_within = std::chrono::seconds(2)},
      [this](std::function<bool()> ended) {
        return std::make_unique<EndlessStage>(std::move(ended), &stages_, &stepping_);
      },
      [](const std::string&) {});
  RawClient silent(impatient.address());
  const grpc::Status end = silent.End();  // without the server's action it would wait for ever
  EXPECT_EQ(end.error_code(), StatusCode::DEADLINE_EXCEEDED);
  EXPECT_THAT(end.error_message(), HasSubstr("no Hello within 2 s"));
  RawClient next(impatient.address());
  ASSERT_TRUE(next.Ask(Hello(1))->has_welcome());
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  EXPECT_TRUE(next.Ask(Reset(2))->has_observation());  // may take any time
}

TEST_F(ServerTest, EndsTheSessionOfAClientOutOfOrderAndIsReadyAgain) {
  const auto client = Served();
  const grpc::Status end = (client->Send(Step(7)), client->End());
  EXPECT_EQ(end.error_code(), StatusCode::FAILED_PRECONDITION);
  EXPECT_THAT(end.error_message(), HasSubstr("sequence number 7 found, need 2"));
  ExpectReady();
}

TEST_F(ServerTest, RefusesARequestThatIsTooLargeAndIsReadyAgain) {
  const auto client = Served();
  v1::Request large = Reset(2);
  for (int k = 0; k < 1000; ++k) {
    large.mutable_reset()->mutable_observe()->add_sensors()->set_sensor(std::string(2000, 'x'));
  }
  ASSERT_GT(large.ByteSizeLong(), kLargestRequest_bytes);
  client->Send(large);
  const grpc::Status end = client->End();
  EXPECT_EQ(end.error_code(), StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(end.error_message(), HasSubstr("larger than max"));
  ExpectReady();
}

/// Sends bytes that no protobuf library writes.
grpc::Status EndAfterBytes(const std::string& address, const std::string& bytes) {
  grpc::GenericStub stub(grpc::CreateChannel(address, RawClient::Credentials()));
  grpc::ClientContext context;
  grpc::CompletionQueue queue;
  const auto next = [&] {
    void* tag = nullptr;
    bool ok = false;
    queue.Next(&tag, &ok);
    return ok;
  };
  const auto stream = stub.PrepareCall(&context, "/tera.v1.Simulation/Session", &queue);
  stream->StartCall(nullptr);
  next();
  const grpc::Slice slice(bytes);
  stream->Write(grpc::ByteBuffer(&slice, 1), nullptr);
  next();
  grpc::Status end;
  stream->Finish(&end, nullptr);
  next();
  return end;
}

TEST_F(ServerTest, EndsTheSessionOfAClientThatSendsOtherBytesAndIsReadyAgain) {
  const grpc::Status end = EndAfterBytes(address(), "\x0a\xff\xff\xff\xff\x7f");
  EXPECT_EQ(end.error_code(), StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(end.error_message(), HasSubstr("message 1 (6 bytes) is no tera.v1.Request"));
  ExpectReady();
}

TEST_F(ServerTest, TellsOfAFaultOfItsOwnAndIsReadyAgain) {
  const auto client = Served();
  client->Ask(Reset(2));
  client->Send(Step(3, kFaulty));
  const grpc::Status end = client->End();
  EXPECT_EQ(end.error_code(), StatusCode::INTERNAL);
  EXPECT_THAT(end.error_message(), HasSubstr("a wheel came off"));
  ExpectReady();
}

TEST_F(ServerTest, StopsInTheMiddleOfAStep) {
  const auto client = Served();
  client->Ask(Reset(2));
  client->Send(Step(3, kEndless));
  while (!stepping_) std::this_thread::yield();
  server_.reset();
  EXPECT_EQ(stages_, 0);
  EXPECT_FALSE(client->End().ok());
}

}  // namespace
}  // namespace tera
