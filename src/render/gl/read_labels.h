#pragma once

#include <cstdint>
#include <span>

#include "core/types/label_channels.h"
#include "core/workers.h"
#include "render/gl/gl_objects.h"

namespace tera {

/// GPU label outputs of one image.
struct LabelOutputs {
  const GlObject& word;    ///< LabelSource::kLabelWord
  const GlObject& normal;  ///< LabelSource::kSurfaceNormal
};

/// The label outputs after their copy to the CPU. `normal` has four 16-bit values per pixel: the
/// normal in W and an unused value. Outputs that no requested label needs may be empty.
struct ReadLabelOutputs {
  std::span<const std::uint32_t> word;
  std::span<const std::uint16_t> normal;
};

/// Converts the outputs to those images of `frame` that `labels` names.
void FillLabels(const ReadLabelOutputs& outputs, int width_px, int height_px, const Mat3& R_WC,
                LabelSet labels, Workers* workers, CameraFrame* frame);

/// Reads only the instance image. Waits for the GPU.
Image<std::uint16_t> ReadInstances(const GlObject& word, int width_px, int height_px);

}  // namespace tera
