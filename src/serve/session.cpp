#include "serve/session.h"

#include <fmt/format.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace tera {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// A field of the message, or of a nested message, that this build does not know, such as "field 9
/// of Action". Newer clients may send such fields; ignoring one would silently ignore part of the
/// request.
std::optional<std::string> UnknownField(const Message& message) {
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  const auto& unknown = reflection.GetUnknownFields(message);
  if (!unknown.empty()) {
    return fmt::format("field {} of {}", unknown.field(0).number(),
                       message.GetDescriptor()->name());
  }
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
    const int count = field->is_repeated() ? reflection.FieldSize(message, field) : 1;
    for (int k = 0; k < count; ++k) {
      const Message& inner = field->is_repeated() ? reflection.GetRepeatedMessage(message, field, k)
                                                  : reflection.GetMessage(message, field);
      if (auto found = UnknownField(inner)) return found;
    }
  }
  return std::nullopt;
}

using grpc::Status;
using grpc::StatusCode;

Status MustNot(const std::string& finding) { return {StatusCode::FAILED_PRECONDITION, finding}; }

/// True if the name is fit for logs and terminals: short and printable.
bool CanBeShown(const std::string& client) {
  return client.size() <= kLongestClientName &&
         std::all_of(client.begin(), client.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

}  // namespace

Session::Answer Session::Handle(std::string_view request_bytes) {
  v1::Request request;
  if (!request.ParseFromArray(request_bytes.data(), static_cast<int>(request_bytes.size()))) {
    return Status(StatusCode::INVALID_ARGUMENT,
                  fmt::format("message {} ({} bytes) is no tera.v1.Request; need one as in "
                              "proto/tera/v1/simulation.proto",
                              next_, request_bytes.size()));
  }
  if (const Status status = OutOfTurn(request); !status.ok()) return status;
  ++next_;
  v1::Response response;
  response.set_sequence(request.sequence());
  if (const auto unknown = UnknownField(request)) {
    Refuse(fmt::format("{} is not known to this server ({}); leave it out, or use a "
                       "server of the client's version",
                       *unknown, server_),
           &response);
  } else if (request.has_hello()) {
    Greet(request.hello(), &response);
  } else if (!Act(request, &response)) {
    return Status(StatusCode::CANCELLED, "the session ended while the request was being done");
  }
  return response;
}

Status Session::OutOfTurn(const v1::Request& request) const {
  if (request.sequence() != next_) {
    return MustNot(
        fmt::format("sequence number {} found, need {}: 1 for the first request of a "
                    "session, one more for each after it",
                    request.sequence(), next_));
  }
  if (request.kind_case() == v1::Request::KIND_NOT_SET) {
    return {StatusCode::UNIMPLEMENTED,
            fmt::format("request {} is of no kind that protocol {} knows; need Hello, Describe, "
                        "Reset, Step or Batch",
                        request.sequence(), kServeProtocol)};
  }
  if (!greeted_ && !request.has_hello()) {
    return MustNot("the first request is not Hello; need Hello with the protocol's number");
  }
  if (greeted_ && request.has_hello()) return MustNot("a second Hello; need one, at the beginning");
  if (request.has_step() && !in_episode_) return MustNot("Step before any Reset; need Reset first");
  return request.has_hello() ? Unfit(request.hello()) : Status::OK;
}

Status Session::Unfit(const v1::Hello& hello) const {
  if (hello.protocol() != kServeProtocol) {
    return MustNot(
        fmt::format("protocol {} asked for, this server speaks {}; use a client of its "
                    "version ({})",
                    hello.protocol(), kServeProtocol, server_));
  }
  if (!CanBeShown(hello.client())) {
    return {StatusCode::INVALID_ARGUMENT,
            fmt::format("a client's name of {} bytes that cannot be shown; need at most {} "
                        "printable ASCII characters",
                        hello.client().size(), kLongestClientName)};
  }
  return Status::OK;
}

void Session::Greet(const v1::Hello& hello, v1::Response* response) {
  greeted_ = true;
  client_ = hello.client();
  v1::Welcome& welcome = *response->mutable_welcome();
  welcome.set_protocol(kServeProtocol);
  welcome.set_server(server_);
  welcome.set_largest_request_bytes(kLargestRequest_bytes);
  welcome.set_largest_samples_bytes(kLargestSamples_bytes);
  welcome.set_most_environments(kMostEnvironments);
}

bool Session::Act(const v1::Request& request, v1::Response* response) {
  try {
    if (request.has_describe()) {
      *response->mutable_description() = stage_->Describe(request.describe().environment());
      return true;
    }
    if (request.has_batch()) {
      std::optional<v1::Outcomes> outcomes = stage_->Do(request.batch());
      if (!outcomes) return false;
      in_episode_ = in_episode_ || stage_->InEpisode();
      *response->mutable_outcomes() = std::move(*outcomes);
      return true;
    }
    std::optional<v1::Observation> observation =
        request.has_reset() ? stage_->Reset(request.reset()) : stage_->Step(request.step());
    if (!observation) return false;
    in_episode_ = true;
    *response->mutable_observation() = std::move(*observation);
  } catch (const InputError& error) {
    Refuse(error.what(), response);
  }
  return true;
}

void Session::Refuse(const std::string& message, v1::Response* response) const {
  response->mutable_refusal()->set_message(message);
  response->mutable_refusal()->set_episode_over(in_episode_ && !stage_->InEpisode());
}

}  // namespace tera
