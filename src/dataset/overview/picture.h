#pragma once

#include <cstdint>
#include <string>

#include "core/types/label_channels.h"
#include "core/types/measurement.h"

/// Coloured sensor images for display, fitted into tiles.

namespace tera {

using Picture = Image<std::uint8_t>;  ///< 3 channels, RGB

/// Depth from near (red) to far (blue), black without a value.
Picture ColourDepth(const Image<float>& depth_m);
/// Labels in the colours of their channel. Classes use kSemanticClasses; numbers use one colour
/// each, 0 dark grey; a direction's x, y, z are red, green, blue, -1 dark and 1 bright; flow,
/// nearness and rise follow LabelColours; black without a value.
Picture ColourLabels(LabelColours colours, const Image<std::uint8_t>& picture);
Picture ColourLabels(LabelColours colours, const Image<std::uint16_t>& picture);

/// `picture` scaled to fit a tile, centred on black, with a caption.
Picture FitTile(const Picture& picture, int width_px, int height_px, const std::string& caption);

/// Writes a line of text, white with a dark rim; (x, y) is the lower left corner of its first
/// letter.
void WriteText(const std::string& text, int x_px, int y_px, Picture* picture);

/// Copies `tile` into `sheet` with its corner at (x, y); it must fit.
void Paste(const Picture& tile, int x_px, int y_px, Picture* sheet);

}  // namespace tera
