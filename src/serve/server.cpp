#include "serve/server.h"

#include <fmt/format.h>
#include <google/protobuf/stubs/logging.h>
#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "core/error.h"
#include "serve/client_stream.h"
#include "serve/session.h"
#include "tera/v1/simulation.grpc.pb.h"

namespace tera {
namespace {

// The server notices the loss of a client or network after the sum of these times.
constexpr int kAskAfter_ms = 30'000, kAnswerWithin_ms = 30'000;

constexpr std::chrono::seconds kFarewell{2};

/// Address and port in URI notation; an IPv6 address is in brackets.
std::string Endpoint(const std::string& address, int port) {
  const bool bare_ipv6 = address.find(':') != std::string::npos && !address.starts_with("[");
  return fmt::format(fmt::runtime(bare_ipv6 ? "[{}]:{}" : "{}:{}"), address, port);
}

/// Rejects a call before its first message.
class RefusedStream final : public grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  explicit RefusedStream(const grpc::Status& status) { Finish(status); }

 private:
  void OnDone() override { delete this; }
};

grpc::Status BeingStopped() {
  return {grpc::StatusCode::UNAVAILABLE, "the server is being stopped"};
}

using Service = v1::Simulation::WithRawCallbackMethod_Session<v1::Simulation::Service>;
using Reactor = grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>;

}  // namespace

/// gRPC's threads accept calls; `thread_` serves them.
struct Server::Impl final : Service {
  Impl(const ServerOptions& options, MakeStage make, Log to)
      : name(options.name),
        hello_within(options.hello_within),
        make_stage(std::move(make)),
        log(std::move(to)) {
    // Faults are sent to the client or thrown, so the libraries need not print them.
    google::protobuf::SetLogHandler(nullptr);
    constexpr int kUnlessSet = 0;
    setenv("GRPC_VERBOSITY", "NONE", kUnlessSet);
    grpc::ServerBuilder builder;
    int port = 0;
    const std::string endpoint = Endpoint(options.address, options.port);
    builder.AddListeningPort(endpoint, grpc::InsecureServerCredentials(), &port);
    // Disables port sharing, with which two servers would receive clients in turn.
    builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, kAskAfter_ms);
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kAnswerWithin_ms);
    builder.SetMaxReceiveMessageSize(static_cast<int>(kLargestRequest_bytes));
    builder.RegisterService(this);
    grpc_server = builder.BuildAndStart();
    if (!grpc_server || port == 0) {
      throw InputError(
          "", {FaultKind::kUnwritable,
               fmt::format("cannot listen on {}; need an address of this machine and a port "
                           "that no other program uses (--port 0 finds one)",
                           endpoint)});
    }
    address = Endpoint(options.address, port);
    thread = std::thread([this] { ServeOneAfterTheOther(); });
  }

  ~Impl() override {
    {
      const std::lock_guard lock(mutex);
      stopping = true;
      if (stream != nullptr) stream->Stop();
      changed.notify_all();
    }
    // Ends the session of the current client, and cancels its call if it does not read.
    grpc_server->Shutdown(std::chrono::system_clock::now() + kFarewell);
    thread.join();
    grpc_server->Wait();
  }

  Reactor* Session(grpc::CallbackServerContext* context) override {
    const std::lock_guard lock(mutex);
    if (stopping) {
      return new RefusedStream(BeingStopped());
    }
    if (stream != nullptr) {
      return new RefusedStream(
          {grpc::StatusCode::RESOURCE_EXHAUSTED,
           fmt::format("busy with {}; one session at a time, try again when it has ended", who)});
    }
    stream = new ClientStream;
    who = context->peer();
    changed.notify_all();
    return stream;
  }

  void ServeOneAfterTheOther() {
    std::unique_lock lock(mutex);
    while (true) {
      changed.wait(lock, [this] { return stopping || stream != nullptr; });
      if (stream == nullptr) return;
      ClientStream* const serving = stream;
      lock.unlock();
      grpc::Status status = ServeWhole(serving);
      if (Stopping()) status = BeingStopped();
      log(fmt::format("{}: session ended{}", who,
                      status.ok() ? "" : ": " + status.error_message()));
      lock.lock();
      stream = nullptr;  // released before the call ends, so that the client can call again at once
      serving->End(status);
    }
  }

  /// Serves a session from its first message to its end.
  grpc::Status ServeWhole(ClientStream* serving) {
    try {
      const std::unique_ptr<Stage> stage = make_stage([=] { return serving->cancelled(); });
      tera::Session session(stage.get(), name);
      return Exchange(&session, serving);
    } catch (const std::exception& error) {
      return {grpc::StatusCode::INTERNAL,
              fmt::format("internal error, please report it: {}", error.what())};
    }
  }

  grpc::Status Exchange(tera::Session* session, ClientStream* serving) {
    grpc::ByteBuffer incoming;
    while (true) {
      const auto heard =
          session->greeted() ? serving->Read(&incoming) : serving->Read(&incoming, hello_within);
      if (heard == ClientStream::Heard::kSilence) return NoHello();
      if (heard != ClientStream::Heard::kMessage) break;
      grpc::Slice bytes;
      if (const grpc::Status status = incoming.DumpToSingleSlice(&bytes); !status.ok()) {
        return status;
      }
      tera::Session::Answer answer =
          session->Handle({reinterpret_cast<const char*>(bytes.begin()), bytes.size()});
      if (const auto* end = std::get_if<grpc::Status>(&answer)) return *end;
      if (std::get<v1::Response>(answer).has_welcome()) Greeted(session->client());
      grpc::ByteBuffer outgoing;
      bool own_buffer = false;
      const grpc::Status status = grpc::SerializationTraits<v1::Response>::Serialize(
          std::get<v1::Response>(answer), &outgoing, &own_buffer);
      if (!status.ok()) return status;
      if (!serving->Write(outgoing)) break;
    }
    if (serving->cancelled()) return {grpc::StatusCode::CANCELLED, "the client is gone"};
    return grpc::Status::OK;
  }

  bool Stopping() {
    const std::lock_guard lock(mutex);
    return stopping;
  }

  grpc::Status NoHello() const {
    return {grpc::StatusCode::DEADLINE_EXCEEDED,
            fmt::format("no Hello within {} s; need it as the first request",
                        std::chrono::duration<double>(hello_within).count())};
  }

  void Greeted(const std::string& client) {
    const std::lock_guard lock(mutex);
    if (!client.empty()) who = fmt::format("{} at {}", client, who);
    log(fmt::format("{}: session begun", who));
  }

  const std::string name;
  const std::chrono::milliseconds hello_within;
  const MakeStage make_stage;
  const Log log;
  std::string address;
  std::unique_ptr<grpc::Server> grpc_server;

  std::mutex mutex;
  std::condition_variable changed;
  bool stopping = false;
  ClientStream* stream = nullptr;  ///< stream in service, or to be served next
  std::string who;                 ///< name of its client
  std::thread thread;
};

Server::Server(const ServerOptions& options, MakeStage make_stage, Log log)
    : impl_(std::make_unique<Impl>(options, std::move(make_stage), std::move(log))) {}

Server::~Server() = default;

const std::string& Server::address() const { return impl_->address; }

}  // namespace tera
