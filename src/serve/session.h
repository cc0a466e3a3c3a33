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
inline constexpr std::size_t kLongestClientName = 128;

/// What a session acts on: a scenario of which one episode after the other is simulated. Throws
/// InputError where a request cannot be done.
class Stage {
 public:
  virtual ~Stage() = default;
  virtual v1::Description Describe() = 0;
  /// Nothing where the session ended meanwhile; so for Step.
  virtual std::optional<v1::Observation> Reset(const v1::Reset& request) = 0;
  virtual std::optional<v1::Observation> Step(const v1::Step& request) = 0;
  /// From a Reset that was done on, until a fault ends the episode.
  virtual bool InEpisode() const = 0;
};

/// One client's requests in their turn: bytes in, the answer out. Knows no socket.
///
/// Model   states: waiting for Hello; greeted; in an episode, from the first Reset that was done.
///         What breaks the protocol ends the session; what is in its turn but cannot be done, or
///         has fields that are unknown here, is answered by a Refusal and leaves the state as it
///         was. Where it ended the stage's episode the Refusal says so.
class Session {
 public:
  /// A response to send, or the status with which the session ends.
  using Answer = std::variant<v1::Response, grpc::Status>;

  /// `server` is what Welcome says of it.
  Session(Stage* stage, std::string server) : stage_(stage), server_(std::move(server)) {}

  Answer Handle(std::string_view request_bytes);

  bool greeted() const { return greeted_; }
  /// The client's name, from its Hello; printable.
  const std::string& client() const { return client_; }

 private:
  grpc::Status OutOfTurn(const v1::Request& request) const;
  grpc::Status Unfit(const v1::Hello& hello) const;
  void Greet(const v1::Hello& hello, v1::Response* response);
  /// False where the session ended meanwhile.
  bool Act(const v1::Request& request, v1::Response* response);
  void Refuse(const std::string& message, v1::Response* response) const;

  Stage* stage_;
  std::string server_, client_;
  std::uint64_t next_ = 1;  ///< sequence number
  bool greeted_ = false, in_episode_ = false;
};

}  // namespace tera
