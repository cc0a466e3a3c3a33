#pragma once

#include <cstdint>
#include <span>

#include "core/types/label_channels.h"
#include "core/workers.h"
#include "render/gl/gl_objects.h"

namespace tera {

/// What shaders have written of each pixel of one picture.
struct LabelOutputs {
  const GlObject& word;    ///< of LabelSource::kLabelWord
  const GlObject& normal;  ///< of LabelSource::kSurfaceNormal
};

/// The same, read: one word, and four values of 16 bits in W, of which the last is no part of the
/// normal. Either may be missing where `labels` below names none of it.
struct ReadLabelOutputs {
  std::span<const std::uint32_t> word;
  std::span<const std::uint16_t> normal;
};

/// Fills those pictures of `frame`, of the outputs' size, that `labels` names and shaders write.
void FillLabels(const ReadLabelOutputs& outputs, int width_px, int height_px, const Mat3& R_WC,
                LabelSet labels, Workers* workers, CameraFrame* frame);

/// The picture of instances alone, read at once.
Image<std::uint16_t> ReadInstances(const GlObject& word, int width_px, int height_px);

}  // namespace tera
