#pragma once

#include "core/types/label_channels.h"
#include "render/gl/gl_objects.h"

namespace tera {

/// What shaders have written of each pixel of one picture.
struct LabelOutputs {
  const GlObject& word;    ///< of LabelSource::kLabelWord
  const GlObject& normal;  ///< of LabelSource::kSurfaceNormal
};

/// Fills those pictures of `frame` that `labels` names and shaders write, of the outputs' size.
void ReadLabels(const LabelOutputs& outputs, int width_px, int height_px, const Mat3& R_WC,
                LabelSet labels, CameraFrame* frame);

/// The picture of instances alone.
Image<std::uint16_t> ReadInstances(const GlObject& word, int width_px, int height_px);

}  // namespace tera
