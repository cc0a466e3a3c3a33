#include "render/gl/pixel_buffer.h"

#include <epoxy/gl.h>

#include "core/check.h"

namespace tera {
namespace {

constexpr GLbitfield kReadWhileUsed = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

GlObject MakeReadable(std::size_t bytes) {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  GlObject buffer(id, [](unsigned name) { glDeleteBuffers(1, &name); });
  glNamedBufferStorage(id, static_cast<GLsizeiptr>(bytes), nullptr,
                       kReadWhileUsed | GL_CLIENT_STORAGE_BIT);
  return buffer;
}

}  // namespace

void PixelBuffer::Begin(const GlObject& texture, unsigned format, unsigned type, std::size_t pixels,
                        std::size_t pixel_bytes) {
  bytes_ = pixels * pixel_bytes;
  if (bytes_ > room_) {
    buffer_ = MakeReadable(bytes_);
    room_ = bytes_;
    mapped_ =
        glMapNamedBufferRange(buffer_.id(), 0, static_cast<GLsizeiptr>(room_), kReadWhileUsed);
    TERA_CHECK(mapped_ != nullptr, room_);
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.id());
  glGetTextureImage(texture.id(), 0, format, type, static_cast<GLsizei>(bytes_), nullptr);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  Forget();
  copied_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void PixelBuffer::Wait() {
  if (copied_ == nullptr) return;
  constexpr GLuint64 kAtATime_ns = 1'000'000'000;
  GLenum end = GL_TIMEOUT_EXPIRED;
  while (end == GL_TIMEOUT_EXPIRED) {  // drawing has no time limit
    end = glClientWaitSync(static_cast<GLsync>(copied_), GL_SYNC_FLUSH_COMMANDS_BIT, kAtATime_ns);
  }
  TERA_CHECK(end != GL_WAIT_FAILED, glGetError());
  Forget();
}

void PixelBuffer::Forget() {
  if (copied_ != nullptr) glDeleteSync(static_cast<GLsync>(copied_));
  copied_ = nullptr;
}

}  // namespace tera
