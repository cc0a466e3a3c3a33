#include "sensors/lidar/lidar.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/check.h"
#include "core/units.h"
#include "render/rays/threads.h"
#include "sensors/lidar/air_echoes.h"

namespace tera {
namespace {

constexpr double kMaxColumns = 65536;
constexpr std::size_t kMaxBeams = 1024;
constexpr int kColumnsPerBlock = 16;

/// Rotation angle of the head per revolution.
double Spin(const LidarModel& model) { return (model.clockwise ? -2.0 : 2.0) * kPi; }

/// Time and azimuth of the columns of one revolution. Column c begins at the fraction c / columns.
struct SweptScan {
  const LidarModel& model;
  TimeNs start_ns, end_ns;

  TimeNs ColumnStart(int column) const {
    const double part = static_cast<double>(column) / model.columns;
    return start_ns +
           static_cast<TimeNs>(std::llround(part * static_cast<double>(end_ns - start_ns)));
  }
  /// The head starts at -x, so that the seam of a revolution lies behind the sensor.
  double Azimuth(int column) const { return kPi + Spin(model) * column / model.columns; }
};

/// Relative power of the weakest return; 0 without a limit.
double LeastPower(const LidarModel& model) {
  const double R10_m = model.range_at_10_percent_m;
  return R10_m > 0 ? kDarkTarget / (R10_m * R10_m) : 0.0;
}

Vec3 Direction(double elevation_rad, double azimuth_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

}  // namespace

void Serialize(ModelArchive* archive, LidarModel* m) {
  constexpr double kSecondsPerMicrosecond = 1e-6;
  archive->Need("elevation_deg", &m->elevation_rad, Between(-90, 90, "deg"), kMaxBeams, kDeg);
  m->azimuth_offset_rad.resize(m->elevation_rad.size());
  archive->Visit("azimuth_offset_deg", &m->azimuth_offset_rad, Between(-180, 180, "deg"), kDeg);
  m->firing_offset_s.resize(m->elevation_rad.size());
  archive->Visit("firing_offset_us", &m->firing_offset_s, AtLeast(0, "us"), kSecondsPerMicrosecond);
  archive->Need("columns", &m->columns, Between(1, kMaxColumns, ""));
  archive->Visit("clockwise", &m->clockwise);
  archive->Visit("min_range_m", &m->min_range_m, AtLeast(0, "m"));
  archive->Visit("max_range_m", &m->max_range_m, Positive("m"));
  archive->Check(m->max_range_m > m->min_range_m, "max_range_m",
                 "not beyond min_range_m; need min_range_m < max_range_m");
  archive->Visit("range_noise_m", &m->range_noise_m, AtLeast(0, "m"));
  archive->Visit("range_at_10_percent_m", &m->range_at_10_percent_m, AtLeast(0, "m"));
}

Lidar::Lidar(const LidarModel& model, const SampleClock& clock, TimeNs latency_ns,
             std::uint64_t seed, const std::string& stream_name)
    : model_(model),
      clock_(clock),
      latency_ns_(latency_ns),
      range_noise_(seed, stream_name + "/range"),
      air_draws_(seed, stream_name + "/air") {
  const std::size_t beams = model_.elevation_rad.size();
  TERA_CHECK(model_.azimuth_offset_rad.size() == beams, model_.azimuth_offset_rad.size());
  TERA_CHECK(model_.firing_offset_s.size() == beams, model_.firing_offset_s.size());
  TERA_CHECK(clock_.rate_hz >= kSlowest_hz, clock_.rate_hz);
  const double column_s = 1.0 / (clock_.rate_hz * model_.columns);
  for (std::size_t b = 0; b < beams; ++b) {
    const double offset_s = model_.firing_offset_s[b];
    TERA_CHECK(offset_s >= 0 && offset_s < column_s, offset_s, column_s);
    const double turned_rad = Spin(model_) * clock_.rate_hz * offset_s;
    beams_.push_back(
        {.d_H = Direction(model_.elevation_rad[b], model_.azimuth_offset_rad[b] + turned_rad),
         .offset_ns = FromSeconds(offset_s)});
  }
}

/// A surface's echo attenuated by the air, or a stronger echo from the air; `hit` then holds the
/// position of the latter.
double Lidar::Through(const AirEchoes& air, const Ray& ray, std::uint64_t number, double echo,
                      RayHit* hit) {
  const double range_m = hit->hit ? hit->range_m : ray.max_range_m;
  const AirEchoes::Passage passage = air.Along(ray, range_m, number);
  echo *= passage.two_way;
  const double power = hit->hit ? echo / (range_m * range_m) : 0.0;
  if (!passage.echo || passage.echo->power() <= power) return echo;
  hit->hit = true;
  hit->range_m = static_cast<float>(passage.echo->range_m);
  hit->label = passage.echo->label;
  hit->instance = 0;
  return passage.echo->echo;
}

/// One block of columns of a revolution, from poses to points.
struct Lidar::Block {
  std::vector<Ray> rays;
  std::vector<Vec3> d_S;
  std::vector<TimeNs> since_start_ns;
  std::vector<RayHit> hits;
};

void Lidar::Aim(std::int64_t k, int begin, int end, const PoseTrack& X_WS, Block* block) const {
  const SweptScan sweep{model_, clock_.Due(k), clock_.Due(k + 1)};
  const double span_ns = static_cast<double>(sweep.end_ns - sweep.start_ns);
  block->rays.clear();
  block->d_S.clear();
  block->since_start_ns.clear();
  Pose X_begin = X_WS.At(sweep.ColumnStart(begin));
  for (int column = begin; column < end; ++column) {
    const TimeNs column_ns = sweep.ColumnStart(column), next_ns = sweep.ColumnStart(column + 1);
    const Pose X_end = X_WS.At(next_ns);
    const Mat3 turn = X_end.linear() - X_begin.linear();
    const Vec3 shift = X_end.translation() - X_begin.translation();
    // Motion within a column of some tens of microseconds is linear.
    const Mat3 R_SH = Eigen::AngleAxisd(sweep.Azimuth(column), Vec3::UnitZ()).toRotationMatrix();
    const double per_ns = 1.0 / static_cast<double>(next_ns - column_ns);
    for (const Beam& beam : beams_) {
      const double s = per_ns * static_cast<double>(beam.offset_ns);
      const Vec3 d_S = R_SH * beam.d_H;
      const Vec3 d_W = X_begin.linear() * d_S + s * (turn * d_S);
      const TimeNs since_ns = column_ns + beam.offset_ns - sweep.start_ns;
      block->d_S.push_back(d_S);
      block->since_start_ns.push_back(since_ns);
      block->rays.push_back({.origin_W_m = (X_begin.translation() + s * shift).cast<float>(),
                             .direction_W = d_W.cast<float>(),
                             .max_range_m = static_cast<float>(model_.max_range_m),
                             .time = static_cast<float>(static_cast<double>(since_ns) / span_ns)});
    }
    X_begin = X_end;
  }
  block->hits.resize(block->rays.size());
}

void Lidar::Detect(std::int64_t k, int begin, const AirEchoes& air, const Block& block,
                   std::vector<LidarPoint>* points) const {
  const std::size_t beams = model_.elevation_rad.size();
  const auto first = (static_cast<std::uint64_t>(k) * model_.columns + begin) * beams;
  const double least_power = LeastPower(model_);
  for (std::size_t i = 0; i < block.hits.size(); ++i) {
    RayHit hit = block.hits[i];
    const double cosine = -hit.normal_W.dot(block.rays[i].direction_W);
    double echo = hit.reflectance * std::max(cosine, 0.0);
    if (air.any()) echo = Through(air, block.rays[i], first + i, echo, &hit);
    if (!hit.hit || hit.range_m < model_.min_range_m) continue;
    const double r_m = hit.range_m;
    if (echo < least_power * r_m * r_m) continue;
    double measured_m = r_m;
    if (model_.range_noise_m > 0)
      measured_m += model_.range_noise_m * range_noise_.Gaussian(first + i);
    const Eigen::Vector3f p_S = (measured_m * block.d_S[i]).cast<float>();
    points->push_back({.x_m = p_S.x(),
                       .y_m = p_S.y(),
                       .z_m = p_S.z(),
                       .intensity = static_cast<float>(std::min(echo, 1.0)),
                       .time_offset_ns = static_cast<std::uint32_t>(block.since_start_ns[i]),
                       .ring = static_cast<std::uint16_t>(i % beams),
                       .instance = hit.instance,
                       .label = static_cast<std::uint8_t>(hit.label)});
  }
}

LidarScan Lidar::Measure(std::int64_t k, const PoseTrack& X_WS, const RayScene& scene, int threads,
                         const SensedAir& air) const {
  const AirEchoes echoes({model_.min_range_m, model_.max_range_m, LeastPower(model_)}, air,
                         air_draws_);
  const int blocks = (model_.columns + kColumnsPerBlock - 1) / kColumnsPerBlock;
  std::vector<std::vector<LidarPoint>> points(blocks);
  std::atomic<int> next = 0;
  const auto work = [&] {
    Block block;
    for (int b = next++; b < blocks; b = next++) {
      const int begin = b * kColumnsPerBlock;
      const int end = std::min(begin + kColumnsPerBlock, model_.columns);
      Aim(k, begin, end, X_WS, &block);
      scene.Trace(block.rays, block.hits, 1);
      Detect(k, begin, echoes, block, &points[b]);
    }
  };
  RunOnThreads(std::min(threads, blocks), work);
  LidarScan scan;
  scan.t_ns = clock_.Due(k);
  scan.t_available_ns = clock_.Due(k + 1) + latency_ns_;
  for (const std::vector<LidarPoint>& part : points) {
    scan.points.insert(scan.points.end(), part.begin(), part.end());
  }
  return scan;
}

}  // namespace tera
