#pragma once

#include <cstdint>
#include <string>

#include "core/types/label_channels.h"
#include "core/types/measurement.h"

/// Pictures for people to look at: sensor images in colour, fitted into tiles.

namespace tera {

using Picture = Image<std::uint8_t>;  ///< 3 channels, RGB

/// Depth from near (red) to far (blue), black where there is none.
Picture ColourDepth(const Image<float>& depth_m);
/// Labels in the colours of their channel: classes in those of kSemanticClasses; each number in one
/// of its own, 0 in dark grey; a direction's x, y, z as red, green, blue, -1 dark and 1 bright;
/// flow, nearness and rise as LabelColours has them; black where there is none.
Picture ColourLabels(LabelColours colours, const Image<std::uint8_t>& picture);
Picture ColourLabels(LabelColours colours, const Image<std::uint16_t>& picture);

/// `picture` shrunk or enlarged to fit a tile, centred on black, with a caption.
Picture FitTile(const Picture& picture, int width_px, int height_px, const std::string& caption);

/// Writes a line of text, white with a dark rim, from the lower left corner (x, y) of its first
/// letter on.
void WriteText(const std::string& text, int x_px, int y_px, Picture* picture);

/// Copies `tile` into `sheet` with its corner at (x, y); it must fit.
void Paste(const Picture& tile, int x_px, int y_px, Picture* sheet);

}  // namespace tera
