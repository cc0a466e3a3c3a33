#include "serve/client_stream.h"

#include <utility>

namespace tera {

ClientStream::Heard ClientStream::Read(grpc::ByteBuffer* buffer,
                                       std::optional<std::chrono::milliseconds> within) {
  StartRead(&incoming_);
  if (!Wait(within)) return cancelled_ ? Heard::kStopped : Heard::kSilence;
  if (!ok_) return Heard::kEnd;
  buffer->Swap(&incoming_);
  return Heard::kMessage;
}

bool ClientStream::Write(const grpc::ByteBuffer& buffer) {
  StartWrite(&buffer);
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return done_; });
  done_ = false;
  return ok_;
}

void ClientStream::Stop() {
  cancelled_ = true;
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_one();
}

void ClientStream::Done(bool ok) {
  const std::lock_guard lock(mutex_);
  done_ = true;
  ok_ = ok;
  changed_.notify_one();
}

bool ClientStream::Wait(std::optional<std::chrono::milliseconds> within) {
  std::unique_lock lock(mutex_);
  const auto done = [this] { return done_ || stopped_; };
  if (!within) {
    changed_.wait(lock, done);
  } else if (!changed_.wait_for(lock, *within, done)) {
    return false;
  }
  return std::exchange(done_, false);
}

}  // namespace tera
