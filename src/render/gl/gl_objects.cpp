#include "render/gl/gl_objects.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>

#include "core/check.h"
#include "core/config/config.h"
#include "core/error.h"

namespace tera {
namespace {

std::string ReadShader(const std::string& name) {
  const std::filesystem::path path = DataRoot() / "shaders" / name;
  std::ifstream file(path);
  if (!file) {
    throw InputError(path.string(), {FaultKind::kUnreadable,
                                     "cannot read this shader; set TERA_DATA_DIR to the folder "
                                     "that holds TERA's shaders/, or install TERA again"});
  }
  constexpr std::string_view kInclude = "#include \"";
  std::string text, line;
  while (std::getline(file, line)) {
    if (line.starts_with(kInclude)) {
      const std::size_t end = line.find('"', kInclude.size());
      text += ReadShader(line.substr(kInclude.size(), end - kInclude.size()));
    } else {
      text += line + '\n';
    }
  }
  return text;
}

GlObject CompileShader(GLenum stage, const std::string& name, const Switches& switches) {
  std::string text = "#version 450 core\n";
  for (const std::string& on : switches) text += "#define " + on + "\n";
  text += ReadShader(name);
  GlObject shader(glCreateShader(stage), [](unsigned id) { glDeleteShader(id); });
  const char* source = text.c_str();
  glShaderSource(shader.id(), 1, &source, nullptr);
  glCompileShader(shader.id());
  GLint ok = 0, length = 0;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
  if (ok) return shader;
  glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length) + 1, '\0');
  glGetShaderInfoLog(shader.id(), length, nullptr, log.data());
  throw InputError("", {FaultKind::kUnsupported,
                        fmt::format("shader {} does not compile with this OpenGL driver: {}", name,
                                    log.c_str())});
}

GlObject Named(void (*create)(GLsizei, GLuint*), GlObject::Deleter deleter) {
  GLuint id = 0;
  create(1, &id);
  return GlObject(id, deleter);
}

}  // namespace

GlObject MakeBuffer(std::size_t bytes, const void* data) {
  GlObject buffer = Named([](GLsizei n, GLuint* id) { glCreateBuffers(n, id); },
                          [](unsigned id) { glDeleteBuffers(1, &id); });
  constexpr std::size_t kSmallest = 16;  // OpenGL rejects empty storage
  glNamedBufferStorage(buffer.id(), static_cast<GLsizeiptr>(std::max(bytes, kSmallest)),
                       bytes == 0 ? nullptr : data, GL_DYNAMIC_STORAGE_BIT);
  return buffer;
}

GlObject MakeVertexArray() {
  return Named([](GLsizei n, GLuint* id) { glCreateVertexArrays(n, id); },
               [](unsigned id) { glDeleteVertexArrays(1, &id); });
}

GlObject MakeQuery() {
  return Named([](GLsizei n, GLuint* id) { glCreateQueries(GL_SAMPLES_PASSED, n, id); },
               [](unsigned id) { glDeleteQueries(1, &id); });
}

std::uint8_t Unorm8(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0));
}

GlObject MakeTexture(unsigned format, int width, int height, Filter filter, Wrap wrap, int levels) {
  GlObject texture = Named([](GLsizei n, GLuint* id) { glCreateTextures(GL_TEXTURE_2D, n, id); },
                           [](unsigned id) { glDeleteTextures(1, &id); });
  const GLuint id = texture.id();
  glTextureStorage2D(id, levels, format, width, height);
  const GLint mode = wrap == Wrap::kRepeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  glTextureParameteri(id, GL_TEXTURE_WRAP_S, mode);
  glTextureParameteri(id, GL_TEXTURE_WRAP_T, mode);
  const GLint magnify = filter == Filter::kNearest ? GL_NEAREST : GL_LINEAR;
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, magnify);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER,
                      filter == Filter::kMipmapped ? GL_LINEAR_MIPMAP_NEAREST : magnify);
  if (filter == Filter::kShadow) {
    glTextureParameteri(id, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(id, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  }
  return texture;
}

GlObject MakeFramebuffer(const std::vector<unsigned>& colour, unsigned depth, bool with_stencil) {
  GlObject framebuffer = Named([](GLsizei n, GLuint* id) { glCreateFramebuffers(n, id); },
                               [](unsigned id) { glDeleteFramebuffers(1, &id); });
  std::vector<GLenum> attachments;
  for (unsigned texture : colour) {
    attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
    glNamedFramebufferTexture(framebuffer.id(), attachments.back(), texture, 0);
  }
  if (depth != 0) {
    glNamedFramebufferTexture(framebuffer.id(),
                              with_stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                              depth, 0);
  }
  if (attachments.empty()) attachments.push_back(GL_NONE);
  glNamedFramebufferDrawBuffers(framebuffer.id(), static_cast<GLsizei>(attachments.size()),
                                attachments.data());
  const GLenum status = glCheckNamedFramebufferStatus(framebuffer.id(), GL_DRAW_FRAMEBUFFER);
  TERA_CHECK(status == GL_FRAMEBUFFER_COMPLETE, status);
  return framebuffer;
}

Program::Program(const std::string& vertex_file, const std::string& fragment_file,
                 const Switches& switches)
    : program_(glCreateProgram(), [](unsigned id) { glDeleteProgram(id); }) {
  const GlObject vertex = CompileShader(GL_VERTEX_SHADER, vertex_file, switches);
  const GlObject fragment = CompileShader(GL_FRAGMENT_SHADER, fragment_file, switches);
  glAttachShader(program_.id(), vertex.id());
  glAttachShader(program_.id(), fragment.id());
  glLinkProgram(program_.id());
  GLint ok = 0, length = 0;
  glGetProgramiv(program_.id(), GL_LINK_STATUS, &ok);
  if (ok) return;
  glGetProgramiv(program_.id(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length) + 1, '\0');
  glGetProgramInfoLog(program_.id(), length, nullptr, log.data());
  throw InputError("", {FaultKind::kUnsupported,
                        fmt::format("shaders {} and {} do not link with this OpenGL driver: {}",
                                    vertex_file, fragment_file, log.c_str())});
}

void Program::Use() const { glUseProgram(program_.id()); }

int Program::Location(const char* name) const {
  const auto known = locations_.find(std::string_view(name));
  if (known != locations_.end()) return known->second;
  return locations_.emplace(name, glGetUniformLocation(program_.id(), name)).first->second;
}

void Program::Set(const char* name, int value) const {
  glProgramUniform1i(id(), Location(name), value);
}
void Program::Set(const char* name, float value) const {
  glProgramUniform1f(id(), Location(name), value);
}
void Program::Set(const char* name, const Eigen::Vector2f& value) const {
  glProgramUniform2fv(id(), Location(name), 1, value.data());
}
void Program::Set(const char* name, const Eigen::Vector3f& value) const {
  glProgramUniform3fv(id(), Location(name), 1, value.data());
}
void Program::Set(const char* name, const Eigen::Vector4f& value) const {
  glProgramUniform4fv(id(), Location(name), 1, value.data());
}
void Program::Set(const char* name, const Eigen::Matrix3f& value) const {
  glProgramUniformMatrix3fv(id(), Location(name), 1, GL_FALSE, value.data());
}
void Program::Set(const char* name, const Eigen::Matrix4f& value) const {
  glProgramUniformMatrix4fv(id(), Location(name), 1, GL_FALSE, value.data());
}
void Program::Set(const char* name, const std::vector<Eigen::Vector3f>& values) const {
  glProgramUniform3fv(id(), Location(name), static_cast<GLsizei>(values.size()),
                      values.front().data());
}

}  // namespace tera
