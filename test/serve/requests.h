#pragma once

#include "serve/session.h"

/// Requests of a session, numbered by the test itself.

namespace tera {

inline v1::Request Numbered(std::uint64_t sequence) {
  v1::Request request;
  request.set_sequence(sequence);
  return request;
}

inline v1::Request Hello(std::uint64_t sequence = 1, std::uint32_t protocol = kServeProtocol) {
  v1::Request request = Numbered(sequence);
  request.mutable_hello()->set_protocol(protocol);
  request.mutable_hello()->set_client("test");
  return request;
}

inline v1::Request Describe(std::uint64_t sequence) {
  v1::Request request = Numbered(sequence);
  request.mutable_describe();
  return request;
}

inline v1::Request Reset(std::uint64_t sequence, std::uint64_t seed = 1) {
  v1::Request request = Numbered(sequence);
  request.mutable_reset()->set_seed(seed);
  return request;
}

inline v1::Request Step(std::uint64_t sequence, std::uint32_t physics_steps = 1) {
  v1::Request request = Numbered(sequence);
  request.mutable_step()->set_physics_steps(physics_steps);
  return request;
}

}  // namespace tera
