#include "diagnose/blocks/gnss_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>

#include "core/units.h"
#include "diagnose/blocks/candidate_list.h"
#include "diagnose/blocks/sample_grid.h"
#include "diagnose/sensors/reflection.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

constexpr std::ptrdiff_t kFewestPositions = 100;
constexpr std::array<const char*, 3> kEnuColumns = {"/east_m", "/north_m", "/up_m"};
constexpr std::size_t kMostPositions = 1200;  ///< maximum per receiver
constexpr double kLargestYaw_deg = 135;       ///< rotation of a pair; half a turn is an exchange
constexpr double kPlacement_m = 0.01;  ///< standard deviation of an antenna's position on its link
constexpr double kLeastOffset_m = 1e-3;  ///< least standard deviation of a channel's offset
/// Below these speeds a machine is at rest.
constexpr double kLeastSpeed_mps = 0.05, kLeastBoomTurning_radps = 0.02;
/// Half the interval over which velocities are averaged.
constexpr TimeNs kHalfSpan_ns = 250'000'000;
/// Delays in the flexible regressor: short ones, and +-18 s between GPS time and UTC.
constexpr std::array<double, 8> kLate_s = {-18, -8, -3, -1, 1, 3, 8, 18};

using AxisSeries = std::array<std::vector<double>, 3>;

/// Time grid shared by all receivers of a block.
struct CommonGrid {
  std::vector<SampleGrid> of;      ///< grid of each receiver's compared samples
  std::vector<std::size_t> every;  ///< n of each receiver, if every n-th sample is compared
  TimeNs first_ns = 0;

  std::size_t size() const { return of.front().size; }
  double period_s() const { return of.front().period_s; }
  TimeNs t_ns(std::size_t place) const {
    return first_ns + FromSeconds(static_cast<double>(place) * period_s());
  }
};

template <typename Value>
std::vector<Value> Every(std::size_t step, const std::vector<Value>& values) {
  std::vector<Value> out;
  for (std::size_t k = 0; k < values.size(); k += step) out.push_back(values[k]);
  return out;
}

/// Thinning factor per receiver, proportional to the number of positions.
std::vector<std::size_t> ThinningOf(const GnssLog& log) {
  std::size_t most = 1;
  for (const ReceiverLog& one : log) most = std::max(most, one.t_ns.size());
  const std::size_t of_most = (most + kMostPositions - 1) / kMostPositions;
  std::vector<std::size_t> every;
  for (const ReceiverLog& one : log) {
    every.push_back(std::max<std::size_t>(1, (of_most * one.t_ns.size() + most / 2) / most));
  }
  return every;
}

CommonGrid GridOf(const GnssLog& log) {
  CommonGrid grid;
  grid.every = ThinningOf(log);
  double period_s = 0;
  TimeNs last_ns = log.front().t_ns.back();
  grid.first_ns = log.front().t_ns.front();
  std::vector<std::vector<TimeNs>> compared_ns;
  for (std::size_t r = 0; r < log.size(); ++r) {
    compared_ns.push_back(Every(grid.every[r], log[r].t_ns));
    period_s = std::max(period_s, SampleGrid::Under(compared_ns[r]).period_s);
    grid.first_ns = std::min(grid.first_ns, log[r].t_ns.front());
    last_ns = std::max(last_ns, log[r].t_ns.back());
  }
  for (const std::vector<TimeNs>& t_ns : compared_ns) {
    grid.of.push_back(SampleGrid::Over(grid.first_ns, last_ns, period_s, t_ns));
  }
  return grid;
}

/// Motion of an antenna at its documented mount, on the grid.
struct ReceiverCourse {
  std::vector<double> east_mps, north_mps, up_mps;
  std::vector<double> forward_mps, left_mps, turning_radps;
  std::vector<double> yaw_rad, roll_rad, pitch_rad, time_s;
  /// Vertical part of the boom's direction, and its east and north components scaled by it.
  std::vector<double> raised, raised_east, raised_north;
  std::array<std::vector<Vec3>, kLate_s.size()>
      away_m;  ///< earlier position minus present position, for each delay
};

void AddBoom(const ReceiverLog& log, TimeNs t_ns, ReceiverCourse* course) {
  const Vec3 boom_W =
      log.boom ? Vec3(log.boom->At(t_ns).linear() * log.boom_direction_B) : Vec3(Vec3::Zero());
  const double raised = std::max(0.0, boom_W.z()), level = std::hypot(boom_W.x(), boom_W.y());
  course->raised.push_back(raised);
  course->raised_east.push_back(level > 0 ? raised * boom_W.x() / level : 0);
  course->raised_north.push_back(level > 0 ? raised * boom_W.y() / level : 0);
}

ReceiverCourse CourseOf(const SensorDescription& receiver, const ReceiverLog& log,
                        const CommonGrid& grid) {
  ReceiverCourse course;
  const Vec3& p_LS_m = receiver.X_BS.translation();
  const double span_s = ToSeconds(2 * kHalfSpan_ns);
  for (std::size_t place = 0; place < grid.size(); ++place) {
    const TimeNs t_ns = grid.t_ns(place);
    const Pose from = log.track.At(t_ns - kHalfSpan_ns), to = log.track.At(t_ns + kHalfSpan_ns);
    const Vec3 v_W_mps = (to * p_LS_m - from * p_LS_m) / span_s;
    const Vec3 rpy_rad = RpyFromRotation(log.track.At(t_ns).linear());
    const double c = std::cos(rpy_rad.z()), s = std::sin(rpy_rad.z());
    course.east_mps.push_back(v_W_mps.x());
    course.north_mps.push_back(v_W_mps.y());
    course.up_mps.push_back(v_W_mps.z());
    course.forward_mps.push_back(c * v_W_mps.x() + s * v_W_mps.y());
    course.left_mps.push_back(c * v_W_mps.y() - s * v_W_mps.x());
    const double turned_rad = RpyFromRotation(to.linear()).z() - RpyFromRotation(from.linear()).z();
    course.turning_radps.push_back(std::remainder(turned_rad, 2 * kPi) / span_s);
    course.roll_rad.push_back(rpy_rad.x());
    course.pitch_rad.push_back(rpy_rad.y());
    course.yaw_rad.push_back(rpy_rad.z());
    course.time_s.push_back(static_cast<double>(place) * grid.period_s());
    AddBoom(log, t_ns, &course);
    const Vec3 p_WS_m = log.track.PointAt(t_ns, p_LS_m);
    for (std::size_t i = 0; i < kLate_s.size(); ++i) {
      const Vec3 then_m = log.track.PointAt(t_ns - FromSeconds(kLate_s[i]), p_LS_m);
      course.away_m[i].push_back(then_m - p_WS_m);
    }
  }
  return course;
}

/// `axis`: 0 east, 1 north, 2 up.
Eigen::MatrixXd FlexibleRegressor(const ReceiverCourse& course, int axis) {
  std::vector<double> sine, cosine, swing_sine, swing_cosine, time, square;
  const double last_s = std::max(course.time_s.back(), 1e-9);
  for (std::size_t k = 0; k < course.time_s.size(); ++k) {
    sine.push_back(std::sin(course.yaw_rad[k]));
    cosine.push_back(std::cos(course.yaw_rad[k]));
    swing_sine.push_back(sine.back() * course.turning_radps[k]);
    swing_cosine.push_back(cosine.back() * course.turning_radps[k]);
    time.push_back(course.time_s[k] / last_s);
    square.push_back(time.back() * time.back());
  }
  const std::vector<const std::vector<double>*> all = {&sine,
                                                       &cosine,
                                                       &swing_sine,
                                                       &swing_cosine,
                                                       &course.east_mps,
                                                       &course.north_mps,
                                                       &course.up_mps,
                                                       &course.roll_rad,
                                                       &course.pitch_rad,
                                                       &time,
                                                       &square,
                                                       &course.raised,
                                                       &course.raised_east,
                                                       &course.raised_north};
  const auto size = static_cast<Eigen::Index>(sine.size());
  const auto known = static_cast<Eigen::Index>(all.size());
  Eigen::MatrixXd columns(size, known + static_cast<Eigen::Index>(kLate_s.size()));
  for (std::size_t c = 0; c < all.size(); ++c) {
    columns.col(static_cast<Eigen::Index>(c)) =
        Eigen::Map<const Eigen::VectorXd>(all[c]->data(), size);
  }
  for (std::size_t i = 0; i < kLate_s.size(); ++i) {
    for (Eigen::Index k = 0; k < size; ++k) {
      columns(k, known + static_cast<Eigen::Index>(i)) =
          course.away_m[i][static_cast<std::size_t>(k)][axis];
    }
  }
  return columns;
}

/// Changes of east, north or up by an antenna 1 cm further ahead, and by one 1 cm further left.
Eigen::MatrixXd PlacementColumns(const ReceiverCourse& course, std::size_t axis) {
  const auto size = static_cast<Eigen::Index>(course.yaw_rad.size());
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(size, axis < 2 ? 2 : 0);
  for (Eigen::Index k = 0; axis < 2 && k < size; ++k) {
    const double yaw_rad = course.yaw_rad[static_cast<std::size_t>(k)];
    const Vec3 ahead(std::cos(yaw_rad), std::sin(yaw_rad), 0);
    columns(k, 0) = kPlacement_m * ahead[static_cast<Eigen::Index>(axis)];
    columns(k, 1) = kPlacement_m * Vec3::UnitZ().cross(ahead)[static_cast<Eigen::Index>(axis)];
  }
  return columns;
}

std::vector<RegimeVariable> VariablesOf(const ReceiverCourse& course, bool has_boom,
                                        double period_s) {
  std::vector<RegimeVariable> variables = {
      {"yaw", WholeSeries(period_s, course.yaw_rad), true},
      {"speed", WholeSeries(period_s, course.forward_mps)},
      {"yaw_rate", WholeSeries(period_s, course.turning_radps)},
      {"pitch", WholeSeries(period_s, course.pitch_rad)},
      {"roll", WholeSeries(period_s, course.roll_rad)},
      {"time", WholeSeries(period_s, course.time_s)}};
  if (has_boom) variables.push_back({"raised_part", WholeSeries(period_s, course.raised)});
  return variables;
}

/// Values divided by their maximum, as a command. Values below `least` become zero.
Series CommandOf(std::vector<double> values, double least, double period_s) {
  double largest = least;
  for (const double x : values) largest = std::max(largest, std::abs(x));
  for (double& x : values) x = std::abs(x) < least ? 0 : x / largest;
  return WholeSeries(period_s, std::move(values));
}

bool Has(const SensorDescription& receiver, std::string_view id) {
  return FindEffect(receiver.effects, id) != nullptr;
}

void AddCandidates(const SensorDescription& receiver, bool has_boom, bool is_pair,
                   bool turns_as_one, std::vector<Candidate>* candidates) {
  CandidateList out(receiver.name, EffectTarget::kGnss, receiver.effects, SensorMechanisms());
  out.Add("gnss_lever_arm", {{0, -10, 10}, {1, -10, 10}, {2, -10, 10}},
          {{0.05, 0.05, 0.05}, {0.3, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}, {1, 0, 0}, {0, 1, 0}});
  out.Add("position_datum", {{0, -1000, 1000}, {1, -1000, 1000}},
          {{0.05, 0.05}, {0.3, 0.3}, {1, -1}, {10, 10}});
  out.Add("height_datum", {{0, -120, 120}}, {{0.05}, {-0.05}, {0.3}, {-0.3}, {1}, {-1}, {20}});
  if (has_boom) {
    const double most_m = LargestReflection_m(std::get<GnssModel>(receiver.model).fix);
    out.Add(
        "multipath", {{0, 0, most_m}, {1, 0, most_m}, {2, -180, 180}},
        {{0.02, 0.05, 0}, {0.02, 0.05, 120}, {0.02, 0.05, -120}, {0.2, std::min(0.3, most_m), 0}});
  }
  out.Add("clock_offset", {{0, -40, 40}},
          {{0.02}, {-0.02}, {0.1}, {-0.1}, {0.5}, {-0.5}, {2}, {-2}, {18}, {-18}});
  out.Add("latency", {{0, 0, 5}}, {{0.02, 0}, {0.1, 0}, {0.5, 0}, {2, 0}});
  out.Add("filter_delay", {{0, 0.01, 5, true}}, {{0.05}, {0.2}, {0.6}});
  if (is_pair) out.Add("antenna_swap", {}, {{}});
  if (turns_as_one) {
    out.Add("antenna_yaw", {{0, -kLargestYaw_deg, kLargestYaw_deg}},
            {{2}, {-2}, {8}, {-8}, {30}, {-30}, {90}, {-90}});
  }
  std::vector<Candidate> found = out.Take();
  std::move(found.begin(), found.end(), std::back_inserter(*candidates));
}

/// Candidates of a block. Exchange and rotation of a pair belong to the second receiver if the
/// scenario has them there, otherwise to the first.
std::vector<Candidate> CandidatesOf(const std::vector<SensorDescription>& receivers,
                                    const GnssLog& log) {
  std::vector<Candidate> candidates;
  const bool is_pair = receivers.size() == 2;
  const bool on_one_link = is_pair && receivers[0].link == receivers[1].link;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const auto is_here = [&](std::string_view id) {
      return is_pair && (r == 1) == Has(receivers[1], id);
    };
    AddCandidates(receivers[r], log[r].boom.has_value(), is_here("antenna_swap"),
                  on_one_link && is_here("antenna_yaw"), &candidates);
  }
  return candidates;
}

/// Positions relative to `origin_m`, by axis.
AxisSeries Split(const std::vector<Vec3>& p_m, const std::vector<Vec3>& origin_m) {
  AxisSeries split;
  for (std::size_t k = 0; k < p_m.size(); ++k) {
    const Vec3 away_m = p_m[k] - origin_m[k];
    for (int i = 0; i < 3; ++i) split[static_cast<std::size_t>(i)].push_back(away_m[i]);
  }
  return split;
}

/// True if a term acts on a receiver. Exchange and rotation act on both receivers of a pair.
bool Concerns(const SensorDescription& receiver, const Structure& terms) {
  return std::any_of(terms.begin(), terms.end(), [&](const Term& term) {
    const std::string_view id = term.candidate->mechanism->id;
    return term.candidate->target == receiver.name || id == "antenna_swap" || id == "antenna_yaw";
  });
}

/// Data that the block's replay owns.
struct ReplayData {
  std::vector<SensorDescription> receivers;
  GnssLog log;
  /// Per receiver: positions under the scenario's effects.
  std::vector<std::vector<Vec3>> documented_m;

  std::vector<std::vector<Vec3>> Predict(const Structure& terms) const {
    std::vector<Effects> effects;
    for (const SensorDescription& receiver : receivers) {
      Structure own = terms;
      std::erase_if(own, [&](const Term& one) { return one.candidate->target != receiver.name; });
      effects.push_back(WithTerms(receiver.effects, own));
    }
    std::vector<std::vector<Vec3>> predicted_m;
    const GnssReplay replay(receivers, log);
    const bool swapped = std::any_of(receivers.begin(), receivers.end(), [](const auto& receiver) {
      return Has(receiver, "antenna_swap");
    });
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      const bool is_known = !documented_m.empty() && !swapped && !Concerns(receivers[r], terms);
      predicted_m.push_back(is_known ? documented_m[r] : replay.Predict(r, effects));
    }
    return predicted_m;
  }
};

std::string NameOf(const std::vector<SensorDescription>& receivers, const std::string& machine) {
  std::string name = machine + "/" + receivers.front().name;
  if (receivers.size() == 2) name += " and " + receivers.back().name;
  return name;
}

void AddChannels(const ReplayData& held, std::size_t r, const ReceiverCourse& course,
                 const CommonGrid& grid, const std::string& channel, ReplayBlock* block) {
  const ReceiverLog& log = held.log[r];
  const AxisSeries measured = Split(log.p_WS_m, held.documented_m[r]);
  const auto& noise = std::get<GnssModel>(held.receivers[r].model);
  for (std::size_t i = 0; i < 3; ++i) {
    const double slow_m = i < 2 ? noise.correlated_horizontal_m : noise.correlated_vertical_m;
    block->channels.push_back({channel + kEnuColumns[i],
                               "m",
                               grid.of[r].SpreadSeries(Every(grid.every[r], measured[i]),
                                                       Every(grid.every[r], log.known)),
                               {.offset = std::max(slow_m, kLeastOffset_m), .gain = 1e-5},
                               VariablesOf(course, log.boom.has_value(), grid.period_s()),
                               FlexibleRegressor(course, static_cast<int>(i)),
                               PlacementColumns(course, i)});
  }
}

}  // namespace

std::optional<ReplayBlock> MakeGnssBlock(const std::vector<SensorDescription>& receivers,
                                         GnssLog log, const std::string& machine) {
  for (const ReceiverLog& one : log) {
    if (std::count(one.known.begin(), one.known.end(), true) < kFewestPositions) return {};
  }
  const auto held = std::make_shared<ReplayData>(ReplayData{receivers, std::move(log), {}});
  held->documented_m = held->Predict({});
  const CommonGrid grid = GridOf(held->log);
  ReplayBlock block;
  block.name = NameOf(receivers, machine);
  block.first_ns = grid.first_ns;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const ReceiverCourse course = CourseOf(receivers[r], held->log[r], grid);
    AddChannels(*held, r, course, grid, machine + "/" + receivers[r].name, &block);
    if (r > 0) continue;
    block.commands = {CommandOf(course.forward_mps, kLeastSpeed_mps, grid.period_s()),
                      CommandOf(course.left_mps, kLeastSpeed_mps, grid.period_s()),
                      CommandOf(course.turning_radps, kLeastBoomTurning_radps, grid.period_s())};
  }
  block.candidates = CandidatesOf(receivers, held->log);
  block.replay =
      WholeReplay([held = std::shared_ptr<const ReplayData>(held), grid](const Structure& terms) {
        const auto predicted_m = held->Predict(terms);
        std::vector<std::vector<double>> channels;
        for (std::size_t r = 0; r < predicted_m.size(); ++r) {
          for (const std::vector<double>& axis : Split(predicted_m[r], held->documented_m[r])) {
            channels.push_back(grid.of[r].Spread(Every(grid.every[r], axis)));
          }
        }
        return channels;
      });
  return block;
}

}  // namespace tera
