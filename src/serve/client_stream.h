#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/server_callback.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>

namespace tera {

/// A client's call as a stream of byte buffers, with blocking reads and writes from a single
/// thread. gRPC calls it from its own threads, owns it, and deletes it after End.
class ClientStream final : public grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  enum class Heard {
    kMessage,
    kEnd,      ///< the client closed its side or died, or gRPC rejected its data
    kSilence,  ///< no message in time; only End may follow
    kStopped   ///< the server stops; only End may follow
  };
  /// Waits for a message, indefinitely unless `within` is given.
  Heard Read(grpc::ByteBuffer* buffer, std::optional<std::chrono::milliseconds> within = {});
  /// Returns false without a reader.
  bool Write(const grpc::ByteBuffer& buffer);
  /// Stops waiting for messages, because the server stops. Any thread may call it.
  void Stop();
  /// Ends the call; no use of this object may follow.
  void End(const grpc::Status& status) { Finish(status); }

  /// True if the client died or the server stops. Any thread may call it.
  bool cancelled() const { return cancelled_; }

 private:
  void OnReadDone(bool ok) override { Done(ok); }
  void OnWriteDone(bool ok) override { Done(ok); }
  void OnCancel() override { cancelled_ = true; }
  void OnDone() override { delete this; }
  void Done(bool ok);
  /// Waits for a read. Returns false after the time limit or a server stop.
  bool Wait(std::optional<std::chrono::milliseconds> within = {});

  grpc::ByteBuffer incoming_;  ///< outlives an abandoned read
  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false, ok_ = false;  ///< state of the current read or write
  bool stopped_ = false;
};

}  // namespace tera
