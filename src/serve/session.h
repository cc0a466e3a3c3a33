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
/// The limit of Protobuf is 2 GiB. Machine states are small compared with samples and terrain.
inline constexpr std::uint64_t kLargestBatch_bytes = 1 << 30;
inline constexpr std::size_t kLongestClientName = 128;
inline constexpr std::uint32_t kMostEnvironments = 64;

/// The simulation behind a session: consecutive episodes of a scenario. Requests apply to
/// environment 0 unless a Batch names others. Throws InputError if a request cannot be fulfilled.
class Stage {
 public:
  virtual ~Stage() = default;
  virtual v1::Description Describe(std::uint32_t environment) = 0;
  /// Reset and Step return nullopt if the session ends during the call.
  virtual std::optional<v1::Observation> Reset(const v1::Reset& request) = 0;
  virtual std::optional<v1::Observation> Step(const v1::Step& request) = 0;
  /// Executes all turns of a batch. Throws InputError before executing any if there are too many
  /// environments, two turns for one environment, or more samples than kLargestBatch_bytes.
  virtual std::optional<v1::Outcomes> Do(const v1::Batch& request) = 0;
  /// True after a successful Reset, until a fault ends the episode.
  virtual bool InEpisode() const = 0;
};

/// Protocol of one client: takes the bytes of a request and returns a response. It does not depend
/// on sockets.
///
/// Model   States: waiting for Hello; greeted; in an episode, after the first successful Reset. A
///         violation of the protocol ends the session. A valid request that cannot be fulfilled or
///         has unknown fields is answered with a Refusal, and the state does not change. The
///         Refusal tells if the episode has ended.
class Session {
 public:
  /// A response to send, or the status with which the session ends.
  using Answer = std::variant<v1::Response, grpc::Status>;

  /// `server` is the name of the server in Welcome.
  Session(Stage* stage, std::string server) : stage_(stage), server_(std::move(server)) {}

  Answer Handle(std::string_view request_bytes);

  bool greeted() const { return greeted_; }
  /// Name of the client from its Hello. It contains only printable characters.
  const std::string& client() const { return client_; }

 private:
  grpc::Status OutOfTurn(const v1::Request& request) const;
  grpc::Status Unfit(const v1::Hello& hello) const;
  void Greet(const v1::Hello& hello, v1::Response* response);
  /// Returns false if the session ends during the call.
  bool Act(const v1::Request& request, v1::Response* response);
  void Refuse(const std::string& message, v1::Response* response) const;

  Stage* stage_;
  std::string server_, client_;
  std::uint64_t next_ = 1;  ///< expected sequence number of the next request
  bool greeted_ = false, in_episode_ = false;
};

}  // namespace tera
