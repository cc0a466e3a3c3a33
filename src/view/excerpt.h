#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "view/viewed.h"

namespace tera {

/// A page that contains part of the data.
struct Excerpt {
  std::string html;
  std::string words;  ///< description of its content
};

/// Creates a page with an excerpt of the data.
///
/// Model   Contains all tables, reduced to evenly spaced rows; ground; scenes; and every n-th frame
///         of each camera and lidar. n is the smallest number for which the page does not exceed
///         `most_bytes`. Data is embedded in base 64.
/// Throws  InputError if the page exceeds the limit even with every thousandth frame.
Excerpt MakeExcerpt(const std::vector<Viewed>& viewed, const std::string& page,
                    std::uint64_t most_bytes);

}  // namespace tera
