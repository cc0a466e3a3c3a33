#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/server_callback.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>

namespace tera {

/// A client's call as a stream of byte buffers that one thread reads and writes, waiting for each.
/// gRPC calls it from its own threads, owns it, and deletes it some time after End.
class ClientStream final : public grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  enum class Heard {
    kMessage,
    kEnd,      ///< the client closed its side, died, or sent what gRPC refuses
    kSilence,  ///< nothing came in time; only End may follow
    kStopped   ///< the server stops; only End may follow
  };
  /// Waits for a message, without end unless `within` is given.
  Heard Read(grpc::ByteBuffer* buffer, std::optional<std::chrono::milliseconds> within = {});
  /// False where nobody is there to read.
  bool Write(const grpc::ByteBuffer& buffer);
  /// Ends waiting for messages: the server stops. Any thread.
  void Stop();
  /// Ends the call; the last use of this.
  void End(const grpc::Status& status) { Finish(status); }

  /// True once the call is of no use any more: the client died, or the server stops. Any thread.
  bool cancelled() const { return cancelled_; }

 private:
  void OnReadDone(bool ok) override { Done(ok); }
  void OnWriteDone(bool ok) override { Done(ok); }
  void OnCancel() override { cancelled_ = true; }
  void OnDone() override { delete this; }
  void Done(bool ok);
  /// For a read. False where none was done in time, or before the server stopped.
  bool Wait(std::optional<std::chrono::milliseconds> within = {});

  grpc::ByteBuffer incoming_;  ///< outlives a read that is left
  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false, ok_ = false;  ///< of the read or write under way
  bool stopped_ = false;
};

}  // namespace tera
