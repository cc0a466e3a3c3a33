#include "sim/state/state_playback.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/parse_number.h"
#include "sim/state/state_log.h"
#include "sim/state/state_rows.h"

namespace tera {
namespace {

std::vector<double> NumbersOf(const std::string& bytes) {
  std::vector<double> numbers(bytes.size() / sizeof(double));
  if (!numbers.empty()) {
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  }
  return numbers;
}

}  // namespace

StatePlayback::StatePlayback(const Scenario& scenario, const std::string& resolved_yaml,
                             const std::filesystem::path& file)
    : scenario_(scenario),
      path_(file),
      file_(file),
      series_(StateColumns(scenario)),
      columns_(StateColumns(scenario)),
      ground_(scenario.site->surface()),
      weather_(scenario.site->weather()) {
  if (file_.header() != StateHeader(resolved_yaml, columns_)) {
    Fail("belongs to another scenario or another version of TERA");
  }
  const std::optional<Block> start = file_.Next();
  if (!start || !StartFrom(scenario, NumbersOf(start->front()), &state_) || !LoadBlock()) {
    Fail("is damaged");
  }
  Advance(0);
  previous_ = state_;
}

bool StatePlayback::Step() {
  if (next_ == count_ && !LoadBlock()) {
    const auto steps = std::llround(scenario_.duration_s * scenario_.physics_rate_hz) + 1;
    if (step_ != steps) Fail(fmt::format("ends after {} steps of {}", step_, steps));
    return false;
  }
  previous_ = state_;
  ++step_;
  Advance(1.0 / scenario_.physics_rate_hz);
  return true;
}

void StatePlayback::Advance(double dt_s) {
  AdvanceByRow(scenario_, std::span(rows_).subspan(next_++ * columns_, columns_), dt_s, &state_);
  state_.t_ns = SampleClock{.rate_hz = scenario_.physics_rate_hz, .start_ns = 0}.Due(step_);
  TerrainChange change;
  if (!terrain_.Next(ground_, &change)) Fail("is damaged");
  Apply(change, &ground_);
  if (weather_ && weather_->Advance(state_.t_ns)) ground_.SetWetness(weather_->wetness());
}

bool StatePlayback::LoadBlock() {
  std::optional<Block> block = file_.Next();
  if (!block) return false;
  const std::optional<std::size_t> count = ParseNumber<std::size_t>(block->front());
  std::size_t stream = 1;
  if (!count || *count == 0 || !series_.Unpack(*block, *count, &stream, &rows_) ||
      !terrain_.Load(&*block, &stream) || stream != block->size()) {
    Fail("is damaged");
  }
  count_ = *count;
  next_ = 0;
  return true;
}

void StatePlayback::Fail(const std::string& finding) const {
  throw InputError(
      path_.string(),
      fmt::format("{}; need the file that `tera generate --keep-state` wrote with this dataset",
                  finding));
}

}  // namespace tera
