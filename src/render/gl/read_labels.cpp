#include "render/gl/read_labels.h"

#include <epoxy/gl.h>

#include <type_traits>
#include <vector>

#include "core/types/surface_normal.h"

namespace tera {
namespace {

std::vector<std::uint32_t> ReadWords(const GlObject& word, int width_px, int height_px) {
  std::vector<std::uint32_t> words(static_cast<std::size_t>(width_px) * height_px);
  glGetTextureImage(word.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                    static_cast<GLsizei>(words.size() * sizeof(std::uint32_t)), words.data());
  return words;
}

template <typename T>
void Extract(const std::vector<std::uint32_t>& words, int first_bit, Image<T>* picture) {
  for (std::size_t p = 0; p < words.size(); ++p) {
    picture->data[p] = static_cast<T>(words[p] >> first_bit);
  }
}

/// From unsigned 16-bit values in W to those of surface_normal.h in C.
void ReadNormals(const GlObject& output, const Mat3& R_WC, Image<std::uint16_t>* picture) {
  constexpr double kHalfRange = 32767.5;
  constexpr std::size_t kOutputs = 4;  // of a pixel; the last is no part of the normal
  const std::size_t pixels = picture->data.size() / 3;
  std::vector<std::uint16_t> raw(kOutputs * pixels);
  glGetTextureImage(output.id(), 0, GL_RGBA, GL_UNSIGNED_SHORT,
                    static_cast<GLsizei>(raw.size() * sizeof(std::uint16_t)), raw.data());
  for (std::size_t p = 0; p < pixels; ++p) {
    const std::uint16_t* v = &raw[kOutputs * p];
    if (v[0] == 0 && v[1] == 0 && v[2] == 0) continue;
    const Vec3 n_W = Vec3(v[0], v[1], v[2]) / kHalfRange - Vec3::Ones();
    const auto pixel = PixelOfNormal(R_WC.transpose() * n_W.normalized());
    for (std::size_t k = 0; k < 3; ++k) picture->data[3 * p + k] = pixel[k];
  }
}

}  // namespace

void ReadLabels(const LabelOutputs& outputs, int width_px, int height_px, const Mat3& R_WC,
                LabelSet labels, CameraFrame* frame) {
  const std::vector<std::uint32_t> words = ReadWords(outputs.word, width_px, height_px);
  ForEachLabel(*frame, [&](const LabelChannel& channel, auto& picture) {
    const bool is_drawn =
        channel.source == LabelSource::kLabelWord || channel.source == LabelSource::kSurfaceNormal;
    if (!labels[IndexOf(channel)] || !is_drawn) return;
    picture = std::remove_reference_t<decltype(picture)>(width_px, height_px, channel.components);
    if (channel.source == LabelSource::kLabelWord) {
      Extract(words, channel.first_bit, &picture);
    } else if constexpr (std::is_same_v<decltype(picture), Image<std::uint16_t>&>) {
      ReadNormals(outputs.normal, R_WC, &picture);
    }
  });
}

Image<std::uint16_t> ReadInstances(const GlObject& word, int width_px, int height_px) {
  Image<std::uint16_t> instance(width_px, height_px);
  Extract(ReadWords(word, width_px, height_px), kLabelChannels[kInstanceChannel].first_bit,
          &instance);
  return instance;
}

}  // namespace tera
