#include "core/uniform_bits.h"

#include <Random123/philox.h>

#include <cstddef>

#include "core/random.h"
#include "core/stream_key.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace tera {
namespace {

using Philox = r123::Philox4x32;

/// Stream::Uniform returns (b + 1/2) / 2^53 for the 53 bits b, rounded to a double. For values of
/// 1/2 and above, the rounding makes b even.
std::uint64_t AsRounded(std::uint64_t b) { return b >> 52 != 0 ? b + (b & 1) : b; }

#if defined(__x86_64__)

constexpr std::size_t kLanes = 4;  ///< 64-bit lanes

/// Ten rounds of Philox4x32 on four counters, `index` to `index` + 3, in AVX2 registers. Each
/// 32-bit word is in the lower half of a 64-bit lane. The upper halves never affect the lower
/// halves.
__attribute__((target("avx2"))) void DrawFour(std::array<std::uint32_t, 2> key, std::uint64_t index,
                                              std::uint64_t* bits) {
  constexpr int kRounds = 10;
  const __m256i m0 = _mm256_set1_epi64x(PHILOX_M4x32_0), m1 = _mm256_set1_epi64x(PHILOX_M4x32_1);
  __m256i c0 = _mm256_add_epi64(_mm256_set1_epi64x(static_cast<long long>(index)),
                                _mm256_set_epi64x(3, 2, 1, 0));
  __m256i c1 = _mm256_srli_epi64(c0, 32), c2 = _mm256_setzero_si256(), c3 = c2;
  for (int round = 0; round < kRounds; ++round) {
    const __m256i p0 = _mm256_mul_epu32(m0, c0), p1 = _mm256_mul_epu32(m1, c2);
    c0 = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(p1, 32), c1),
                          _mm256_set1_epi64x(key[0]));
    c2 = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(p0, 32), c3),
                          _mm256_set1_epi64x(key[1]));
    c1 = p1;
    c3 = p0;
    key[0] += PHILOX_W32_0;
    key[1] += PHILOX_W32_1;
  }
  const __m256i low = _mm256_and_si256(c1, _mm256_set1_epi64x(0xffffffffll));
  const __m256i b = _mm256_srli_epi64(_mm256_or_si256(_mm256_slli_epi64(c0, 32), low), 11);
  const __m256i odd_half =
      _mm256_and_si256(_mm256_and_si256(b, _mm256_srli_epi64(b, 52)), _mm256_set1_epi64x(1));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(bits), _mm256_add_epi64(b, odd_half));
}

__attribute__((target("avx2"))) std::size_t DrawInFours(std::array<std::uint32_t, 2> key,
                                                        std::uint64_t first,
                                                        std::span<std::uint64_t> bits) {
  std::size_t k = 0;
  for (; k + kLanes <= bits.size(); k += kLanes) DrawFour(key, first + k, &bits[k]);
  return k;
}

bool HasWideLanes() {
  static const bool has = __builtin_cpu_supports("avx2");
  return has;
}

#endif

}  // namespace

UniformBits::UniformBits(std::uint64_t seed, std::string_view name)
    : key_(StreamKey(seed, HashText(name))) {}

void UniformBits::Draw(std::uint64_t first, std::span<std::uint64_t> bits) const {
  std::size_t done = 0;
#if defined(__x86_64__)
  if (HasWideLanes()) done = DrawInFours(key_, first, bits);
#endif
  DrawSingly(first + done, bits.subspan(done));
}

void UniformBits::DrawSingly(std::uint64_t first, std::span<std::uint64_t> bits) const {
  for (std::size_t k = 0; k < bits.size(); ++k) {
    const std::uint64_t index = first + k;
    const auto out = Philox()(
        {{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), 0, 0}},
        {{key_[0], key_[1]}});
    bits[k] = AsRounded(((static_cast<std::uint64_t>(out[0]) << 32) | out[1]) >> 11);
  }
}

}  // namespace tera
