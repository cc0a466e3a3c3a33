#include "dataset/export/picture/run_lengths.h"

#include "core/check.h"

namespace tera {
namespace {

void AppendCompressed(std::int64_t value, std::string* text) {
  constexpr int kGroupBits = 5;
  constexpr std::int64_t kGroup = 0x1f, kSign = 0x10, kMoreFollow = 0x20;
  constexpr char kFirstCharacter = 48;
  for (bool more = true; more;) {
    std::int64_t group = value & kGroup;
    value >>= kGroupBits;
    more = value != ((group & kSign) != 0 ? -1 : 0);
    if (more) group |= kMoreFollow;
    text->push_back(static_cast<char>(kFirstCharacter + group));
  }
}

}  // namespace

void RunLengths::Add(std::int64_t first, std::int64_t count) {
  TERA_CHECK(first >= end_ && count > 0, first, count, end_);
  if (first == end_ && !runs_.empty()) {
    runs_.back() += count;
  } else {
    runs_.push_back(first - end_);
    runs_.push_back(count);
  }
  end_ = first + count;
  area_px_ += count;
}

std::string RunLengths::Compressed(std::int64_t pixels) const {
  TERA_CHECK(end_ <= pixels, end_, pixels);
  std::vector<std::int64_t> runs = runs_;
  if (end_ < pixels) runs.push_back(pixels - end_);
  constexpr std::size_t kFirstDifference = 3, kBack = 2;
  std::string text;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    AppendCompressed(r < kFirstDifference ? runs[r] : runs[r] - runs[r - kBack], &text);
  }
  return text;
}

}  // namespace tera
