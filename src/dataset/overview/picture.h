#pragma once

#include <cstdint>
#include <string>

#include "core/types/label_channels.h"
#include "core/types/measurement.h"

/// Colour images of sensor data for display, arranged in tiles.

namespace tera {

using Picture = Image<std::uint8_t>;  ///< 3 channels, RGB

/// Colours depth from near (red) to far (blue). Pixels without depth are black.
Picture ColourDepth(const Image<float>& depth_m);
/// Colours labels as their channel requires. Classes: kSemanticClasses. Numbers: one colour each, 0
/// dark grey. Directions: x, y, z as red, green, blue, from -1 (dark) to 1 (bright). Flow, nearness
/// and rise: see LabelColours. Pixels without a value are black.
Picture ColourLabels(LabelColours colours, const Image<std::uint8_t>& picture);
Picture ColourLabels(LabelColours colours, const Image<std::uint16_t>& picture);

/// Scales `picture` to fit a tile, centres it on black and adds a caption.
Picture FitTile(const Picture& picture, int width_px, int height_px, const std::string& caption);

/// Writes a line of white text with a dark outline. (x, y) is the lower left corner of its first
/// letter.
void WriteText(const std::string& text, int x_px, int y_px, Picture* picture);

/// Copies `tile` into `sheet` with its upper left corner at (x, y). It must fit.
void Paste(const Picture& tile, int x_px, int y_px, Picture* sheet);

}  // namespace tera
