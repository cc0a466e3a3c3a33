#include "sensors/lidar/lidar.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string_view>

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

/// Times of the columns of one revolution. Column c begins at the fraction c / columns.
struct SweptScan {
  const LidarModel& model;
  TimeNs start_ns, end_ns;

  TimeNs ColumnStart(int column) const {
    const double part = static_cast<double>(column) / model.columns;
    return start_ns +
           static_cast<TimeNs>(std::llround(part * static_cast<double>(end_ns - start_ns)));
  }
};

/// Beam of a lidar without a stated one: Velodyne VLP-16 user manual, section 4.2 and appendix.
constexpr double kUsualDivergence_rad = 0.003;
constexpr int kRing = 6;                                     ///< sub-rays around the axis
constexpr double kAxisWeight = 0.5, kRingWeight = 1 / 12.0;  ///< of the energy

/// Sub-rays of a beam around its axis.
std::vector<Vec3> SubRays(const Vec3& axis, const LidarBeam& beam) {
  std::vector<Vec3> rays = {axis};
  if (beam.sub_rays == 1) return rays;
  const double angle_rad = beam.divergence_rad / std::sqrt(2 * std::log(2.0));
  const Vec3 across = axis.unitOrthogonal(), up = axis.cross(across);
  for (int k = 0; k < kRing; ++k) {
    const double turn = 2 * kPi * k / kRing;
    rays.push_back(std::cos(angle_rad) * axis +
                   std::sin(angle_rad) * (std::cos(turn) * across + std::sin(turn) * up));
  }
  return rays;
}

Vec3 Direction(double elevation_rad, double azimuth_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

}  // namespace

void Serialize(ModelArchive* archive, LidarModel* m) {
  constexpr double kSecondsPerMicrosecond = 1e-6;
  archive->Visit("pattern", &m->pattern);
  if (m->pattern) {
    m->elevation_rad = m->azimuth_offset_rad = m->firing_offset_s = {0};
  } else {
    archive->Need("elevation_deg", &m->elevation_rad, Between(-90, 90, "deg"), kMaxBeams, kDeg);
    m->azimuth_offset_rad.resize(m->elevation_rad.size());
    archive->Visit("azimuth_offset_deg", &m->azimuth_offset_rad, Between(-180, 180, "deg"), kDeg);
    m->firing_offset_s.resize(m->elevation_rad.size());
    archive->Visit("firing_offset_us", &m->firing_offset_s, AtLeast(0, "us"),
                   kSecondsPerMicrosecond);
    archive->Need("columns", &m->columns, Between(1, kMaxColumns, ""));
    archive->Visit("clockwise", &m->clockwise);
  }
  archive->Visit("min_range_m", &m->min_range_m, AtLeast(0, "m"));
  archive->Visit("max_range_m", &m->max_range_m, Positive("m"));
  archive->Check(m->max_range_m > m->min_range_m, "max_range_m",
                 "not beyond min_range_m; need min_range_m < max_range_m");
  archive->Visit("range_noise_m", &m->range_noise_m, AtLeast(0, "m"));
  archive->Visit("range_at_10_percent_m", &m->range_at_10_percent_m, AtLeast(0, "m"));
  archive->Visit("range_at_80_percent_m", &m->range_at_80_percent_m, Positive("m"));
  archive->Check(m->range_at_80_percent_m.value_or(1e9) > m->range_at_10_percent_m,
                 "range_at_80_percent_m",
                 "not beyond range_at_10_percent_m; a bright target is seen farther");
  archive->Visit("range_noise_at_limit_m", &m->range_noise_at_limit_m, AtLeast(0, "m"));
  archive->Visit("beam", &m->beam);
}

RangeEquation::RangeEquation(const LidarModel& model) {
  const LidarBeam beam = model.beam.value_or(LidarBeam{.divergence_rad = kUsualDivergence_rad});
  aperture_m_ = beam.aperture_m;
  divergence_rad_ = beam.divergence_rad;
  near_m_ = aperture_m_ / divergence_rad_;
  surface_near_m_ = model.beam ? near_m_ : 0;
  dark_range_m_ = model.range_at_10_percent_m;
  const double bright_m = model.range_at_80_percent_m.value_or(0);
  if (bright_m <= 0) return;
  if (dark_range_m_ <= 0) {
    const double nearer = std::sqrt(kBrightTarget / kDarkTarget);
    dark_range_m_ = (bright_m + surface_near_m_) / nearer - surface_near_m_;
  } else {
    bright_exponent_ = std::log(kBrightTarget / kDarkTarget) / std::log(bright_m / dark_range_m_);
  }
}

Lidar::Lidar(const LidarModel& model, const SampleClock& clock, TimeNs latency_ns,
             std::uint64_t seed, const std::string& stream_name)
    : model_(model),
      equation_(model),
      pulse_m_(PulseLength_m(model.beam)),
      sub_rays_(model.beam ? model.beam->sub_rays : 1),
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
    const double turned_rad = model_.pattern ? 0 : Spin(model_) * clock_.rate_hz * offset_s;
    const Vec3 axis_H =
        Direction(model_.elevation_rad[b], model_.azimuth_offset_rad[b] + turned_rad);
    beams_.push_back({.d_H = model_.beam ? SubRays(axis_H, *model_.beam) : std::vector{axis_H},
                      .offset_ns = FromSeconds(offset_s)});
  }
}

/// A return: where it is, and the reflectance across the beam that it shows.
struct Lidar::Return {
  double range_m, reflectance, power;
  SemanticClass label;
  std::uint16_t instance;
};

/// Orders returns as the receiver picks them, and keeps as many as it reports.
void Lidar::Pick(const std::optional<LidarBeam>& beam, std::vector<Return>* returns) {
  if (returns->size() < 2) return;
  const std::string_view pick = beam ? std::string_view(beam->pick) : "strongest";
  std::stable_sort(returns->begin(), returns->end(), [&](const Return& a, const Return& b) {
    if (pick == "first") return a.range_m < b.range_m;
    return pick == "last" ? a.range_m > b.range_m : a.power > b.power;
  });
  const std::size_t most = beam ? beam->returns : 1;
  if (returns->size() > most) returns->resize(most);
}

/// One block of columns of a revolution, from poses to points.
struct Lidar::Block {
  std::vector<Ray> rays;  ///< all sub-rays of a pulse in sequence
  std::vector<Vec3> d_S;  ///< one per pulse
  std::vector<TimeNs> since_start_ns;
  std::vector<RayHit> hits;
  // Buffers of one pulse.
  std::vector<Echo> echoes, peaks;
  std::vector<Return> returns;
};

/// Rotation of the head at the start of a column. A pattern's only beam is the axis x of the head.
Mat3 Lidar::HeadAt(std::int64_t k, int column) const {
  if (model_.pattern) {
    const auto pulse = static_cast<std::uint64_t>(k) * model_.columns + column;
    return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), model_.pattern->Direction(pulse))
        .toRotationMatrix();
  }
  const double azimuth_rad = kPi + Spin(model_) * column / model_.columns;
  return Eigen::AngleAxisd(azimuth_rad, Vec3::UnitZ()).toRotationMatrix();
}

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
    const Mat3 R_SH = HeadAt(k, column);
    const double per_ns = 1.0 / static_cast<double>(next_ns - column_ns);
    for (const Beam& beam : beams_) {
      const double s = per_ns * static_cast<double>(beam.offset_ns);
      const TimeNs since_ns = column_ns + beam.offset_ns - sweep.start_ns;
      block->d_S.push_back(R_SH * beam.d_H.front());
      block->since_start_ns.push_back(since_ns);
      for (const Vec3& d_H : beam.d_H) {
        const Vec3 d_S = R_SH * d_H;
        const Vec3 d_W = X_begin.linear() * d_S + s * (turn * d_S);
        block->rays.push_back(
            {.origin_W_m = (X_begin.translation() + s * shift).cast<float>(),
             .direction_W = d_W.cast<float>(),
             .max_range_m = static_cast<float>(model_.max_range_m),
             .time = static_cast<float>(static_cast<double>(since_ns) / span_ns)});
      }
    }
    X_begin = X_end;
  }
  block->hits.resize(block->rays.size());
}

void Lidar::Receive(std::size_t i, std::uint64_t number, const AirEchoes& air, Block* block) const {
  block->echoes.clear();
  block->returns.clear();
  for (std::size_t j = 0; j < sub_rays_; ++j) {
    const Ray& ray = block->rays[i * sub_rays_ + j];
    const RayHit& hit = block->hits[i * sub_rays_ + j];
    const double r_m = hit.hit ? hit.range_m : ray.max_range_m;
    if (!hit.hit || r_m < model_.min_range_m) continue;
    const double cosine = -hit.normal_W.dot(ray.direction_W);
    double reflectance = hit.reflectance * std::max(cosine, 0.0);
    if (air.any()) reflectance *= air.TwoWay(ray, r_m);
    const double power = equation_.Power(reflectance, r_m);
    if (model_.beam) {
      const double weight = sub_rays_ == 1 ? 1 : j == 0 ? kAxisWeight : kRingWeight;
      block->echoes.push_back({r_m, weight * power, hit.label, hit.instance, false});
    } else if (reflectance >= equation_.LeastSurface(r_m)) {
      block->returns.push_back({r_m, reflectance, power, hit.label, hit.instance});
    }
  }
  if (air.any()) {
    // The air echoes as far as the axis reaches, where half of the power goes.
    const Ray& axis = block->rays[i * sub_rays_];
    const RayHit& hit = block->hits[i * sub_rays_];
    air.Add(axis, hit.hit ? hit.range_m : axis.max_range_m, number, &block->echoes);
  }
  if (model_.beam) {
    FindPeaks(&block->echoes, pulse_m_, &block->peaks);
  } else {
    block->peaks = block->echoes;
  }
  for (const Echo& peak : block->peaks) {
    const double r_m = peak.range_m, reflectance = equation_.Reflectance(peak.power, r_m);
    if (reflectance < (peak.is_air ? equation_.LeastAir(r_m) : equation_.LeastSurface(r_m)))
      continue;
    block->returns.push_back({r_m, reflectance, peak.power, peak.label, peak.instance});
  }
  Pick(model_.beam, &block->returns);
}

void Lidar::Detect(std::int64_t k, int begin, const AirEchoes& air, Block* block,
                   std::vector<LidarPoint>* points) const {
  const std::size_t beams = model_.elevation_rad.size();
  const auto first = (static_cast<std::uint64_t>(k) * model_.columns + begin) * beams;
  for (std::size_t i = 0; i < block->d_S.size(); ++i) {
    Receive(i, first + i, air, block);
    for (std::size_t n = 0; n < block->returns.size(); ++n) {
      const Return& found = block->returns[n];
      const double sigma_m = RangeSigma_m(found.range_m, found.reflectance);
      double measured_m = found.range_m;
      if (sigma_m > 0) {
        measured_m += sigma_m * range_noise_.Gaussian(first + i, static_cast<std::uint32_t>(n));
      }
      const Eigen::Vector3f p_S = (measured_m * block->d_S[i]).cast<float>();
      points->push_back({.x_m = p_S.x(),
                         .y_m = p_S.y(),
                         .z_m = p_S.z(),
                         .intensity = static_cast<float>(std::min(found.reflectance, 1.0)),
                         .time_offset_ns = static_cast<std::uint32_t>(block->since_start_ns[i]),
                         .ring = static_cast<std::uint16_t>(i % beams),
                         .instance = found.instance,
                         .label = static_cast<std::uint8_t>(found.label)});
    }
  }
}

double Lidar::RangeSigma_m(double range_m, double reflectance) const {
  if (!model_.range_noise_at_limit_m) return model_.range_noise_m;
  const double weakness = std::min(1.0, equation_.LeastSurface(range_m) / reflectance);
  return std::hypot(model_.range_noise_m, *model_.range_noise_at_limit_m * std::sqrt(weakness));
}

LidarScan Lidar::Measure(std::int64_t k, const PoseTrack& X_WS, const RayScene& scene, int threads,
                         const SensedAir& air) const {
  const AirEchoes echoes(equation_, {model_.min_range_m, model_.max_range_m, pulse_m_}, air,
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
      Detect(k, begin, echoes, &block, &points[b]);
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
