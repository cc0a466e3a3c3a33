#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "view/viewed.h"

namespace tera {

/// A page with part of the data embedded.
struct Excerpt {
  std::string html;
  std::string words;  ///< description of the content
};

/// Makes a page with an excerpt of the data.
///
/// Model   contents: all tables, thinned to evenly spaced rows; grounds; scenes; each n-th frame of
///         every camera and lidar with all its images. n is the smallest stride for which the page
///         has at most `most_bytes`. The page embeds data in base 64.
/// Throws  InputError if even each thousandth frame exceeds the limit.
Excerpt MakeExcerpt(const std::vector<Viewed>& viewed, const std::string& page,
                    std::uint64_t most_bytes);

}  // namespace tera
