#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/server_callback.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>

namespace tera {

/// The call of a client, as a stream of byte buffers with blocking reads and writes. Only one
/// thread may read and write. gRPC owns the object and deletes it after End.
class ClientStream final : public grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  enum class Heard {
    kMessage,
    kEnd,      ///< the client closed its side or died, or gRPC rejected its data
    kSilence,  ///< no message within the time limit; only End may be called next
    kStopped   ///< the server is stopping; only End may be called next
  };
  /// Waits for a message, without a time limit unless `within` is given.
  Heard Read(grpc::ByteBuffer* buffer, std::optional<std::chrono::milliseconds> within = {});
  /// Returns false if the client no longer reads.
  bool Write(const grpc::ByteBuffer& buffer);
  /// Ends the wait for messages because the server is stopping. Thread-safe.
  void Stop();
  /// Ends the call. The object must not be used afterwards.
  void End(const grpc::Status& status) { Finish(status); }

  /// True if the client died or the server is stopping. Thread-safe.
  bool cancelled() const { return cancelled_; }

 private:
  void OnReadDone(bool ok) override { Done(ok); }
  void OnWriteDone(bool ok) override { Done(ok); }
  void OnCancel() override { cancelled_ = true; }
  void OnDone() override { delete this; }
  void Done(bool ok);
  /// Waits for the current read or write. Returns false at the time limit or if the server stops.
  bool Wait(std::optional<std::chrono::milliseconds> within = {});

  grpc::ByteBuffer incoming_;  ///< a member, because gRPC may still write to it after a read is
                               ///< abandoned
  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false, ok_ = false;  ///< state and result of the current read or write
  bool stopped_ = false;
};

}  // namespace tera
