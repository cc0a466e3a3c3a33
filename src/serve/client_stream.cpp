#include "serve/client_stream.h"

namespace tera {

bool ClientStream::Read(grpc::ByteBuffer* buffer) {
  StartRead(buffer);
  return Wait();
}

bool ClientStream::Write(const grpc::ByteBuffer& buffer) {
  StartWrite(&buffer);
  return Wait();
}

void ClientStream::Done(bool ok) {
  const std::lock_guard lock(mutex_);
  done_ = true;
  ok_ = ok;
  changed_.notify_one();
}

bool ClientStream::Wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return done_; });
  done_ = false;
  return ok_;
}

}  // namespace tera
