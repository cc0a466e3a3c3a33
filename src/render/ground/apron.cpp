#include "render/ground/apron.h"

#include <epoxy/gl.h>

#include <utility>

namespace tera {

Apron::Apron(Surroundings surroundings) : land_(std::move(surroundings)) {
  using Vertex = Surroundings::Vertex;
  // Three attributes of three floats, then what only rays read.
  static_assert(sizeof(Vertex) == 3 * sizeof(Eigen::Vector3f) + sizeof(float));
  const auto& indices = land_.indices();
  indices_ = MakeBuffer(indices.size() * sizeof(indices[0]), indices.data());
  vertex_buffer_ = MakeBuffer(land_.vertices().size() * sizeof(Vertex), land_.vertices().data());
  array_ = MakeVertexArray();
  for (GLuint a = 0; a < 3; ++a) {
    glEnableVertexArrayAttrib(array_.id(), a);
    glVertexArrayAttribFormat(array_.id(), a, 3, GL_FLOAT, GL_FALSE,
                              a * static_cast<GLuint>(sizeof(Eigen::Vector3f)));
    glVertexArrayAttribBinding(array_.id(), a, 0);
  }
  glVertexArrayVertexBuffer(array_.id(), 0, vertex_buffer_.id(), 0, sizeof(Vertex));
  glVertexArrayElementBuffer(array_.id(), indices_.id());
}

void Apron::Update(const TerrainSurface& terrain) {
  land_.Update(terrain);
  glNamedBufferSubData(
      vertex_buffer_.id(), 0,
      static_cast<GLsizeiptr>(land_.vertices().size() * sizeof(land_.vertices()[0])),
      land_.vertices().data());
}

void Apron::Draw() const {
  glBindVertexArray(array_.id());
  glDrawElements(GL_TRIANGLES, 3 * triangles(), GL_UNSIGNED_SHORT, nullptr);
}

}  // namespace tera
