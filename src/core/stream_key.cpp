#include "core/stream_key.h"

#include <Random123/philox.h>

namespace tera {

std::array<std::uint32_t, 2> StreamKey(std::uint64_t seed, std::uint64_t name_hash) {
  const r123::Philox4x32::ctr_type counter = {
      {static_cast<std::uint32_t>(name_hash), static_cast<std::uint32_t>(name_hash >> 32), 0, 0}};
  const r123::Philox4x32::key_type key = {
      {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  const auto mixed = r123::Philox4x32()(counter, key);
  return {mixed[0], mixed[1]};
}

}  // namespace tera
