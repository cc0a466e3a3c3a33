#include "diagnose/statistics/series/manoeuvres.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/check.h"
#include "diagnose/statistics/series/robust.h"
#include "diagnose/statistics/tests/block_bootstrap.h"

namespace tera {
namespace {

using Commands = std::vector<std::vector<double>>;

constexpr double kRestLevel = 0.02;  ///< |command| up to this is rest
constexpr double kShortest_s = 0.5;  ///< shorter runs are joined to the one before
constexpr double kLongest_s = 3;     ///< longer runs are cut into equal pieces
constexpr double kTail_s = 1;        ///< rest after a manoeuvre that belongs to it
constexpr std::size_t kFewest = 10;  ///< blocks replace fewer manoeuvres than this
constexpr double kBlock_s = 5;       ///< length of such blocks
constexpr std::array<double, 3> kShareOfPart = {0.4, 0.3, 0.3};  ///< TRAIN, SELECT, FINAL

/// The active commands, and the negative ones among them.
struct Activity {
  std::uint64_t axes = 0, backward = 0;
  bool operator==(const Activity&) const = default;
};

Activity ActivityAt(const Commands& commands, std::size_t k) {
  Activity activity;
  for (std::size_t c = 0; c < commands.size(); ++c) {
    if (std::abs(commands[c][k]) <= kRestLevel) continue;
    activity.axes |= std::uint64_t{1} << c;
    if (commands[c][k] < 0) activity.backward |= std::uint64_t{1} << c;
  }
  return activity;
}

/// Runs with the same active commands. Short runs are joined to the previous one.
std::vector<Manoeuvre> RunsOfActivity(const Commands& commands, std::size_t shortest) {
  std::vector<Manoeuvre> runs;
  const std::size_t size = commands.front().size();
  for (std::size_t begin = 0; begin < size;) {
    const Activity activity = ActivityAt(commands, begin);
    std::size_t end = begin + 1;
    while (end < size && ActivityAt(commands, end) == activity) ++end;
    const bool joins =
        !runs.empty() &&
        (end - begin < shortest || Activity{runs.back().axes, runs.back().backward} == activity);
    if (joins) {
      runs.back().samples.end = end;
    } else {
      runs.push_back({{begin, end}, activity.axes, activity.backward});
    }
    begin = end;
  }
  return runs;
}

/// Moves the first `tail` samples of each rest to the manoeuvre before it.
std::vector<Manoeuvre> WithTails(std::vector<Manoeuvre> runs, std::size_t tail) {
  std::vector<Manoeuvre> out;
  for (Manoeuvre& run : runs) {
    if (run.axes == 0 && !out.empty()) {
      const std::size_t taken = std::min(tail, run.samples.size());
      out.back().samples.end += taken;
      run.samples.begin += taken;
      if (run.samples.size() == 0) continue;
    }
    out.push_back(run);
  }
  return out;
}

std::vector<Manoeuvre> CutLongOnes(const std::vector<Manoeuvre>& runs, std::size_t longest) {
  std::vector<Manoeuvre> out;
  for (const Manoeuvre& run : runs) {
    const std::size_t size = run.samples.size(), pieces = (size + longest - 1) / longest;
    for (std::size_t p = 0; p < pieces; ++p) {
      out.push_back(
          {{run.samples.begin + p * size / pieces, run.samples.begin + (p + 1) * size / pieces},
           run.axes,
           run.backward});
    }
  }
  return out;
}

std::vector<Manoeuvre> Blocks(const Commands& commands, std::size_t length) {
  std::vector<Manoeuvre> out;
  for (const Segment& block : CutIntoBlocks(commands.front().size(), length)) {
    Manoeuvre manoeuvre{block};
    for (std::size_t k = block.begin; k < block.end; ++k) {
      const Activity activity = ActivityAt(commands, k);
      manoeuvre.axes |= activity.axes;
      manoeuvre.backward |= activity.backward;
    }
    out.push_back(manoeuvre);
  }
  return out;
}

void SetAmplitudes(const Commands& commands, std::vector<Manoeuvre>* manoeuvres) {
  for (Manoeuvre& manoeuvre : *manoeuvres) {
    for (const std::vector<double>& command : commands) {
      for (std::size_t k = manoeuvre.samples.begin; k < manoeuvre.samples.end; ++k) {
        manoeuvre.amplitude = std::max(manoeuvre.amplitude, std::abs(command[k]));
      }
    }
  }
}

/// Indices of the manoeuvres by commands and directions, each list halved at its median amplitude.
std::vector<std::vector<std::size_t>> Strata(const std::vector<Manoeuvre>& manoeuvres) {
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::vector<std::size_t>> by_activity;
  for (std::size_t m = 0; m < manoeuvres.size(); ++m) {
    by_activity[{manoeuvres[m].axes, manoeuvres[m].backward}].push_back(m);
  }
  std::vector<std::vector<std::size_t>> strata;
  for (auto& [activity, members] : by_activity) {
    std::vector<double> amplitude;
    for (const std::size_t m : members) amplitude.push_back(manoeuvres[m].amplitude);
    const double middle = Median(std::move(amplitude));
    const auto louder = std::stable_partition(members.begin(), members.end(), [&](std::size_t m) {
      return manoeuvres[m].amplitude <= middle;
    });
    strata.emplace_back(members.begin(), louder);
    if (louder != members.end()) strata.emplace_back(louder, members.end());
  }
  return strata;
}

using Filling = std::array<double, 3>;

/// Number of manoeuvres that a part lacks when one more is assigned.
double Lack(const Filling& filled, std::size_t part) {
  const double total = filled[0] + filled[1] + filled[2] + 1;
  return kShareOfPart[part] * total - filled[part];
}

/// Assigns manoeuvres to parts by number, because tests count manoeuvres.
void ShareOut(std::vector<Manoeuvre>* manoeuvres, const Stream& stream) {
  Filling resting{}, moving{};
  for (std::vector<std::size_t>& stratum : Strata(*manoeuvres)) {
    std::stable_sort(stratum.begin(), stratum.end(), [&](std::size_t a, std::size_t b) {
      return stream.Uniform(a) < stream.Uniform(b);
    });
    Filling& overall = (*manoeuvres)[stratum.front()].axes == 0 ? resting : moving;
    Filling here{};
    for (const std::size_t m : stratum) {
      std::size_t best = 0;
      double most = -INFINITY;
      for (std::size_t part = 0; part < kShareOfPart.size(); ++part) {
        const double lack = Lack(here, part) + Lack(overall, part);
        if (lack <= most) continue;
        most = lack;
        best = part;
      }
      (*manoeuvres)[m].part = static_cast<Part>(best);
      ++here[best];
      ++overall[best];
    }
  }
}

}  // namespace

std::vector<Manoeuvre> SplitByManoeuvre(const std::vector<Series>& commands, const Stream& stream) {
  TERA_CHECK(!commands.empty() && commands.size() <= 64, commands.size());
  Commands bridged;
  for (const Series& command : commands) {
    TERA_CHECK(command.size() == commands.front().size(), command.size());
    bridged.push_back(BridgedValues(command));
  }
  if (bridged.front().empty()) return {};
  const auto samples = [&](double duration_s) {
    return std::max<std::size_t>(
        static_cast<std::size_t>(std::lround(duration_s / commands.front().period_s)), 1);
  };
  std::vector<Manoeuvre> out =
      CutLongOnes(WithTails(RunsOfActivity(bridged, samples(kShortest_s)), samples(kTail_s)),
                  samples(kLongest_s));
  if (out.size() < kFewest) {
    out = Blocks(bridged, samples(kBlock_s));
  }
  SetAmplitudes(bridged, &out);
  ShareOut(&out, stream);
  return out;
}

Mask MaskOf(const std::vector<Manoeuvre>& manoeuvres, Part part, std::size_t size) {
  Mask mask(size, 0);
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (manoeuvre.part != part) continue;
    TERA_CHECK(manoeuvre.samples.end <= size, manoeuvre.samples.end, size);
    std::fill(mask.begin() + static_cast<std::ptrdiff_t>(manoeuvre.samples.begin),
              mask.begin() + static_cast<std::ptrdiff_t>(manoeuvre.samples.end), 1);
  }
  return mask;
}

}  // namespace tera
