#include "render/gl/read_labels.h"

#include <epoxy/gl.h>

#include <type_traits>
#include <vector>

#include "core/types/surface_normal.h"

namespace tera {
namespace {

constexpr std::size_t kLeastLabelsOfThread = 1 << 15;  ///< minimum number of pixels per thread

/// Extracts the components in order, starting at `first_bit`.
template <typename T>
void Extract(std::span<const std::uint32_t> words, int first_bit, Workers* workers,
             Image<T>* picture) {
  const auto components = static_cast<std::size_t>(picture->channels);
  workers->ForRanges(words.size(), kLeastLabelsOfThread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      for (std::size_t c = 0; c < components; ++c) {
        picture->data[components * p + c] =
            static_cast<T>(words[p] >> (static_cast<std::size_t>(first_bit) + 8 * sizeof(T) * c));
      }
    }
  });
}

/// Converts unsigned 16-bit values in W to the values of surface_normal.h in C.
void TakeNormals(std::span<const std::uint16_t> outputs, const Mat3& R_WC, Workers* workers,
                 Image<std::uint16_t>* picture) {
  constexpr double kHalfRange = 32767.5;
  constexpr std::size_t kOutputs = 4, kFew = 1 << 11;
  workers->ForRanges(outputs.size() / kOutputs, kFew, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const std::uint16_t* v = &outputs[kOutputs * p];
      if (v[0] == 0 && v[1] == 0 && v[2] == 0) continue;
      const Vec3 n_W = Vec3(v[0], v[1], v[2]) / kHalfRange - Vec3::Ones();
      const auto pixel = PixelOfNormal(R_WC.transpose() * n_W.normalized());
      for (std::size_t k = 0; k < 3; ++k) picture->data[3 * p + k] = pixel[k];
    }
  });
}

}  // namespace

void FillLabels(const ReadLabelOutputs& outputs, int width_px, int height_px, const Mat3& R_WC,
                LabelSet labels, Workers* workers, CameraFrame* frame) {
  ForEachLabel(*frame, [&](const LabelChannel& channel, auto& picture) {
    const bool is_drawn =
        channel.source == LabelSource::kLabelWord || channel.source == LabelSource::kSurfaceNormal;
    if (!labels[IndexOf(channel)] || !is_drawn) return;
    picture = std::remove_reference_t<decltype(picture)>(width_px, height_px, channel.components);
    if (channel.source == LabelSource::kLabelWord) {
      Extract(outputs.word, channel.first_bit, workers, &picture);
    } else if constexpr (std::is_same_v<decltype(picture), Image<std::uint16_t>&>) {
      TakeNormals(outputs.normal, R_WC, workers, &picture);
    }
  });
}

Image<std::uint16_t> ReadInstances(const GlObject& word, int width_px, int height_px) {
  std::vector<std::uint32_t> words(static_cast<std::size_t>(width_px) * height_px);
  glGetTextureImage(word.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                    static_cast<GLsizei>(words.size() * sizeof(std::uint32_t)), words.data());
  Image<std::uint16_t> instance(width_px, height_px);
  for (std::size_t p = 0; p < words.size(); ++p) {
    instance.data[p] =
        static_cast<std::uint16_t>(words[p] >> kLabelChannels[kInstanceChannel].first_bit);
  }
  return instance;
}

}  // namespace tera
