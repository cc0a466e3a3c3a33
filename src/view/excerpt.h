#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "view/viewed.h"

namespace tera {

/// A page with part of the data in it.
struct Excerpt {
  std::string html;
  std::string words;  ///< what is in it, for people
};

/// Model   all tables, thinned to rows evenly spaced; grounds; scenes; and of every camera and
/// lidar each n-th frame, with all
///         its pictures, n being the smallest for which the page is no larger than `most_bytes`.
///         Data stand in the page in base 64. Throws InputError where not even every thousandth
///         frame fits.
Excerpt MakeExcerpt(const std::vector<Viewed>& viewed, const std::string& page,
                    std::uint64_t most_bytes);

}  // namespace tera
