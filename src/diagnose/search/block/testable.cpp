#include "diagnose/search/block/testable.h"

#include <cstddef>

namespace tera {
namespace {

/// Commanded manoeuvres of TRAIN and SELECT, at least: twice those of FINAL, as their shares are.
constexpr std::size_t kFewestSeen = 6;
/// Commanded manoeuvres of FINAL, at least: Student's t over fewer confirms nothing
/// (steady_gain.h).
constexpr std::size_t kFewestFinal = 3;

}  // namespace

bool IsTestable(const std::vector<Manoeuvre>& manoeuvres) {
  std::size_t seen = 0, final = 0;
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (manoeuvre.axes != 0) ++(manoeuvre.part == Part::kFinal ? final : seen);
  }
  return seen >= kFewestSeen && final >= kFewestFinal;
}

}  // namespace tera
