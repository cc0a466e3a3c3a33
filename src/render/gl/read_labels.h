#pragma once

#include <cstdint>
#include <span>

#include "core/types/label_channels.h"
#include "core/workers.h"
#include "render/gl/gl_objects.h"

namespace tera {

/// Shader outputs per pixel of one image.
struct LabelOutputs {
  const GlObject& word;    ///< LabelSource::kLabelWord
  const GlObject& normal;  ///< LabelSource::kSurfaceNormal
};

/// CPU copy of the outputs: one word, and four 16-bit values in W, the last of which is not part of
/// the normal. Outputs that no requested label needs may be empty.
struct ReadLabelOutputs {
  std::span<const std::uint32_t> word;
  std::span<const std::uint16_t> normal;
};

/// Fills the images of `frame` that `labels` names and shaders write, at the outputs' size.
void FillLabels(const ReadLabelOutputs& outputs, int width_px, int height_px, const Mat3& R_WC,
                LabelSet labels, Workers* workers, CameraFrame* frame);

/// Reads only the instance image, synchronously.
Image<std::uint16_t> ReadInstances(const GlObject& word, int width_px, int height_px);

}  // namespace tera
