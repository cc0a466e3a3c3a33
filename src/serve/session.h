#pragma once

#include <grpcpp/support/status.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "tera/v1/simulation.pb.h"

namespace tera {

inline constexpr std::uint32_t kServeProtocol = 1;
inline constexpr std::uint64_t kLargestRequest_bytes = 1 << 20;
inline constexpr std::uint64_t kLargestSamples_bytes = 256 << 20;
/// Protobuf ends at 2 GiB; machine states take little beside samples and terrain.
inline constexpr std::uint64_t kLargestBatch_bytes = 1 << 30;
inline constexpr std::size_t kLongestClientName = 128;
inline constexpr std::uint32_t kMostEnvironments = 64;

/// Simulation behind a session: consecutive episodes of a scenario, in environment 0 unless a Batch
/// names others. Throws InputError if a request cannot be fulfilled.
class Stage {
 public:
  virtual ~Stage() = default;
  virtual v1::Description Describe(std::uint32_t environment) = 0;
  /// Returns nullopt if the session has ended during the call, as does Step.
  virtual std::optional<v1::Observation> Reset(const v1::Reset& request) = 0;
  virtual std::optional<v1::Observation> Step(const v1::Step& request) = 0;
  /// Does all turns. Throws InputError, before any is done, if there are too many environments, two
  /// turns of one, or more samples than kLargestBatch_bytes.
  virtual std::optional<v1::Outcomes> Do(const v1::Batch& request) = 0;
  /// True from a successful Reset until a fault ends the episode.
  virtual bool InEpisode() const = 0;
};

/// Protocol of one client: request bytes in, response out. It is independent of sockets.
///
/// Model   states: waiting for Hello; greeted; in an episode after the first successful Reset. A
///         protocol violation ends the session. A valid request that cannot be fulfilled, or that
///         has unknown fields, receives a Refusal and does not change the state. The Refusal says
///         so if the stage's episode has ended.
class Session {
 public:
  /// A response to send, or the status that ends the session.
  using Answer = std::variant<v1::Response, grpc::Status>;

  /// `server` is the server name in Welcome.
  Session(Stage* stage, std::string server) : stage_(stage), server_(std::move(server)) {}

  Answer Handle(std::string_view request_bytes);

  bool greeted() const { return greeted_; }
  /// The client's name from its Hello; printable.
  const std::string& client() const { return client_; }

 private:
  grpc::Status OutOfTurn(const v1::Request& request) const;
  grpc::Status Unfit(const v1::Hello& hello) const;
  void Greet(const v1::Hello& hello, v1::Response* response);
  /// Returns false if the session has ended during the call.
  bool Act(const v1::Request& request, v1::Response* response);
  void Refuse(const std::string& message, v1::Response* response) const;

  Stage* stage_;
  std::string server_, client_;
  std::uint64_t next_ = 1;  ///< sequence number
  bool greeted_ = false, in_episode_ = false;
};

}  // namespace tera
