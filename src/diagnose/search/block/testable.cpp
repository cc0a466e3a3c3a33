#include "diagnose/search/block/testable.h"

#include <cstddef>

namespace tera {
namespace {

/// Commanded manoeuvres in TRAIN and SELECT: twice as many as in FINAL, by their shares.
constexpr std::size_t kFewestSeen = 6;
/// Commanded manoeuvres in FINAL: with fewer, Student's t cannot confirm (steady_gain.h).
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
