#include "diagnose/sensors/sensor_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/blocks/sample_grid.h"
#include "diagnose/motion/reduce_samples.h"
#include "diagnose/sensors/estimated_joints.h"
#include "diagnose/sensors/gear_travel.h"
#include "diagnose/sensors/reflection.h"
#include "diagnose/sensors/standing_levers.h"
#include "diagnose/sensors/usable_fix.h"
#include "sensors/encoder/encoder_errors.h"
#include "sensors/slots/effect_numbers.h"

namespace tera {
namespace {

constexpr double kSplineStep_s = 0.05;  ///< time between knots
constexpr double kMargin_s = 0.5;       ///< margin of a segment's spline at either end, for delays
constexpr double kSegment_s = 10, kShortestSegment_s = 4;
constexpr double kFewestSegments = 8;
constexpr double kImuWindow_s = kSplineStep_s;
constexpr double kLeastBaseline_m = 0.05;  ///< shortest baseline of two antennas with a yaw
/// Spacing of ground observations along the path, for independent errors.
constexpr double kGroundEvery_m = 0.5;

double RoundingSigma(double step) { return step / std::sqrt(12.0); }

/// True for evenly stamped samples. Samples that come in bursts are left to the replay blocks.
template <typename Sample>
bool AreUsable(const std::vector<Sample>& samples) {
  std::vector<TimeNs> t_ns;
  for (const Sample& sample : samples) t_ns.push_back(sample.t_ns);
  return t_ns.size() >= 2 && ComeEvenly(t_ns);
}

double SwingOf(const EncoderRecording& recording, std::size_t axis) {
  double mean = 0, square = 0;
  const auto n = static_cast<double>(std::max<std::size_t>(1, recording.samples.size()));
  for (const EncoderSample& sample : recording.samples) mean += sample.q_rad[axis] / n;
  for (const EncoderSample& sample : recording.samples) {
    square += std::pow(sample.q_rad[axis] - mean, 2) / n;
  }
  return std::sqrt(square);
}

/// Extent of a link along its axes: the larger of the box with the link's mass and inertia, and the
/// box around its frame, joints and centre of mass.
Vec3 ExtentOf_m(const MachineModel& model, int index) {
  const Link& link = model.links[static_cast<std::size_t>(index)];
  Vec3 least_m = link.com_B_m.cwiseMin(0), most_m = link.com_B_m.cwiseMax(0);
  for (const Joint& joint : model.joints) {
    if (joint.parent != index) continue;
    least_m = least_m.cwiseMin(joint.X_PJ.translation());
    most_m = most_m.cwiseMax(joint.X_PJ.translation());
  }
  Vec3 extent_m = most_m - least_m;
  if (link.mass_kg <= 0) return extent_m;
  const Vec3 about_kgm2 = link.inertia_B_kgm2.diagonal();
  for (int i = 0; i < 3; ++i) {
    // Length l along an axis from the second moment of the box about its centre, m l^2 / 12.
    const double along_kgm2 = std::max(0.0, about_kgm2.sum() / 2 - about_kgm2[i]);
    extent_m[i] = std::max(extent_m[i], std::sqrt(12 * along_kgm2 / link.mass_kg));
  }
  return extent_m;
}

class Builder {
 public:
  Builder(const DiagnosisInput& input, const Measurements& measured, const KnownPlace& place)
      : input_(input), measured_(measured), place_(place) {
    problem_.table.stated = input.tolerances;
  }

  SensorProblem Build() {
    ChooseJoints();
    CutSegments();
    AddEncoders();
    AddUnits();
    AddAccelerationGains();
    AddReceivers();
    AddPoses();
    AddTravel();
    AddRests();
    SetMotionOfUnits(&problem_.motion);
    SetStart();
    problem_.motion.parameters = static_cast<int>(problem_.table.parameters.size());
    problem_.motion.wander = problem_.table.Wander();
    problem_.motion.delays = problem_.table.Delays();
    return std::move(problem_);
  }

 private:
  void ChooseJoints();
  void CutSegments();
  void AddEncoders();
  void AddAxis(const NamedEncoders& named, const SensorDescription* sensor, std::size_t axis,
               std::size_t joint, int late);
  void AddUnits();
  /// Tolerated error of a specific force, by gravity under the tolerances of mount and scale.
  double ToleratedOfGravity(const UnitChannel& unit) const;
  void AddAccelerationGains();
  void AddReceivers();
  void AddReceiver(std::size_t sensor, const KinematicChain& chain);
  void AddReflection(const SensorDescription& receiver, ReceiverChannel* channel);
  void SharePairYaw();
  void AddPoses();
  void AddTravel();
  void AddRests();
  void SetStart();
  void AddGround(const std::array<TimeSeries, kBaseNumbers>& base);

  const MachineModel& model() const { return *input_.model; }
  MotionProblem& motion() { return problem_.motion; }
  double Seconds(TimeNs t_ns) const { return ToSeconds(t_ns - problem_.start_ns); }
  int SegmentOf(TimeNs t_ns) const {
    const double at = std::floor(Seconds(t_ns) / segment_s_);
    return at < 0 || at >= static_cast<double>(problem_.motion.segments.size())
               ? -1
               : static_cast<int>(at);
  }
  /// Adds an observation to the segment that contains its end. Null where no segment does.
  Observation* Observe(ObservationKind kind, std::size_t channel, TimeNs from_ns, TimeNs to_ns,
                       const Eigen::Matrix<double, 6, 1>& value);
  int AddNoise(const std::string& name, const std::string& unit, double least, double at_first) {
    motion().noise.push_back({name, unit, least, at_first, at_first});
    return static_cast<int>(motion().noise.size()) - 1;
  }
  /// Copies the tolerances of `count` parameters, from index `first` on, to noise channels from
  /// `noise` on.
  void SetTolerances(int noise, int first, int count) {
    for (int i = 0; first >= 0 && i < count; ++i) {
      motion().noise[static_cast<std::size_t>(noise + i)].tolerance =
          problem_.table.parameters[static_cast<std::size_t>(first + i)].tolerance;
    }
  }
  const SensorDescription* SensorOf(const NamedEncoders& named) const;

  const DiagnosisInput& input_;
  const Measurements& measured_;
  const KnownPlace& place_;
  SensorProblem problem_;
  double segment_s_ = kSegment_s;
  /// For each joint of the model: index among the estimated joints, or -1.
  std::vector<int> places_;
  std::vector<std::size_t> joints_;
  RoughSources rough_;
};

Observation* Builder::Observe(ObservationKind kind, std::size_t channel, TimeNs from_ns,
                              TimeNs to_ns, const Eigen::Matrix<double, 6, 1>& value) {
  const int s = SegmentOf(to_ns);
  if (s < 0) return nullptr;
  MotionSegment& segment = motion().segments[static_cast<std::size_t>(s)];
  segment.observations.push_back({kind, static_cast<int>(channel),
                                  ToSeconds(from_ns - segment.start_ns),
                                  ToSeconds(to_ns - segment.start_ns), value});
  return &segment.observations.back();
}

const SensorDescription* Builder::SensorOf(const NamedEncoders& named) const {
  for (const SensorDescription& sensor : input_.sensors) {
    if (named.channel == input_.machine + "/" + sensor.name) return &sensor;
  }
  return nullptr;
}

void Builder::ChooseJoints() {
  joints_ = EstimatedJoints(input_, measured_);
  places_.assign(model().joints.size(), -1);
  for (const std::size_t j : joints_) {
    places_[j] = static_cast<int>(motion().joints.size());
    motion().joints.push_back(model().joints[j].name);
  }
  rough_.joints.resize(joints_.size());
}

void Builder::CutSegments() {
  TimeNs start_ns = std::numeric_limits<TimeNs>::max(), end_ns = 0;
  const auto widen = [&](const auto& samples) {
    if (samples.empty()) return;
    start_ns = std::min(start_ns, samples.front().t_ns);
    end_ns = std::max(end_ns, samples.back().t_ns);
  };
  for (const NamedEncoders& named : measured_.encoders) widen(named.recording.samples);
  for (const auto& samples : measured_.imus) widen(samples);
  if (end_ns == 0) {
    for (const auto& samples : measured_.gnss) widen(samples);
  }
  if (end_ns <= start_ns) return;
  problem_.start_ns = start_ns;
  const double length_s = ToSeconds(end_ns - start_ns) + 1e-6;
  const double wanted_s = std::clamp(length_s / kFewestSegments, kShortestSegment_s, kSegment_s);
  const auto count = std::max(1.0, std::round(length_s / wanted_s));
  segment_s_ = length_s / count;
  const int needed = static_cast<int>(std::ceil((segment_s_ + 2 * kMargin_s) / kSplineStep_s)) + 3;
  for (int s = 0; s < static_cast<int>(count); ++s) {
    MotionSegment segment;
    segment.start_ns = start_ns + FromSeconds(s * segment_s_ - kMargin_s);
    segment.spline = {kSplineStep_s, (needed + 3) / 4 * 4};
    motion().segments.push_back(std::move(segment));
  }
}

void Builder::AddEncoders() {
  for (const NamedEncoders& named : measured_.encoders) {
    const SensorDescription* sensor = SensorOf(named);
    const auto& axes = named.recording.axes;
    int late = kNoParameter;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const int j = model().JointIndex(axes[i].name);
      if (j < 0 || places_[static_cast<std::size_t>(j)] < 0) continue;
      const std::string target = sensor ? sensor->name : named.channel;
      if (late < 0) {
        late = AddEncoderDelay(target, sensor ? sensor->effects : Effects{}, &problem_.table);
      }
      AddAxis(named, sensor, i, static_cast<std::size_t>(j), late);
    }
  }
}

void Builder::AddAxis(const NamedEncoders& named, const SensorDescription* sensor, std::size_t axis,
                      std::size_t joint, int late) {
  const std::string& name = named.recording.axes[axis].name;
  const bool slides = model().joints[joint].type == JointType::kPrismatic;
  AxisChannel channel;
  channel.number = kBaseNumbers + places_[joint];
  channel.late = late;
  Effects effects;
  double least = 1e-5;
  if (sensor) {
    const auto own = sensor->axis_effects.find(name);
    effects =
        EffectsOfAxis(sensor->effects, own == sensor->axis_effects.end() ? Effects{} : own->second);
    const auto& encoder = std::get<EncoderModel>(sensor->model);
    least = slides ? std::hypot(encoder.noise_m, RoundingSigma(encoder.resolution_m))
                   : std::hypot(encoder.noise_rad, RoundingSigma(encoder.resolution_rad));
    least = std::max(least, 1e-5);
  }
  AddAxisParameters((sensor ? sensor->name : named.channel) + "/" + name, effects, slides,
                    SwingOf(named.recording, axis), &problem_.table, &channel);
  channel.noise = AddNoise(named.channel + "/" + name + (slides ? "_m" : "_rad"),
                           slides ? "m" : "rad", least, 0.01);
  SetTolerances(channel.noise, channel.bias, 1);
  motion().axes.push_back(channel);
  TimeSeries& rough = rough_.joints[static_cast<std::size_t>(places_[joint])];
  const bool is_first = rough.empty();
  for (const EncoderSample& sample : named.recording.samples) {
    Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero();
    value[0] = sample.q_rad[axis];
    Observe(ObservationKind::kAxis, motion().axes.size() - 1, sample.t_ns, sample.t_ns, value);
    if (!is_first) continue;
    rough.t_s.push_back(Seconds(sample.t_ns));
    rough.value.push_back(sample.q_rad[axis]);
  }
}

double Builder::ToleratedOfGravity(const UnitChannel& unit) const {
  double most = 0;
  const auto widen = [&](int first, int count) {
    for (int i = first; first >= 0 && i < first + count; ++i) {
      most = std::max(most, problem_.table.parameters[static_cast<std::size_t>(i)].tolerance);
    }
  };
  widen(unit.mount, 3);
  widen(unit.scale < 0 ? -1 : unit.scale + 3, 3);
  return most * kStandardGravity_mps2;
}

void Builder::AddUnits() {
  for (std::size_t s = 0; s < input_.sensors.size(); ++s) {
    const SensorDescription& sensor = input_.sensors[s];
    const std::vector<ImuSample>& samples = measured_.imus[s];
    const int link = model().LinkIndex(sensor.link);
    if (link < 0 || !AreUsable(samples)) continue;
    const auto chain = ChainTo(model(), link, places_);
    if (!chain) {
      problem_.not_compared.push_back(sensor.name + ": too many joints between it and the base");
      continue;
    }
    UnitChannel channel{*chain, sensor.X_BS};
    AddImuParameters(sensor, ExtentOf_m(model(), link), &problem_.table, &channel);
    const auto& imu = std::get<ImuModel>(sensor.model);
    const double root_s = std::sqrt(kImuWindow_s);
    const Eigen::Matrix<double, 6, 1> white = WhiteNoiseOf(samples, kImuWindow_s);
    const std::string name = input_.machine + "/" + sensor.name + "/";
    for (int i = 0; i < 6; ++i) {
      const bool is_rate = i < 3;
      const double density =
          is_rate ? imu.gyro_noise_density_radpsrthz : imu.accel_noise_density_mps2rthz;
      const int noise = AddNoise(name + (is_rate ? "w" : "a") + std::string(1, "xyz"[i % 3]) +
                                     (is_rate ? "_radps" : "_mps2"),
                                 is_rate ? "rad/s" : "m/s^2",
                                 std::max({density / root_s, white[i], is_rate ? 1e-5 : 1e-4}),
                                 is_rate ? 0.05 : 0.5);
      if (i == 0) channel.noise = noise;
    }
    SetTolerances(channel.noise, channel.bias, 6);
    for (int i = 3; i < 6; ++i) {
      double& tolerance = motion().noise[static_cast<std::size_t>(channel.noise + i)].tolerance;
      tolerance = std::max(tolerance, ToleratedOfGravity(channel));
    }
    motion().imus.push_back(channel);
    for (const ImuWindow& window :
         WindowsOf(samples, kImuWindow_s, [&](TimeNs t_ns) { return SegmentOf(t_ns); })) {
      Eigen::Matrix<double, 6, 1> value;
      value << window.w_S_radps, window.f_S_mps2;
      Observation* seen = Observe(ObservationKind::kImu, motion().imus.size() - 1, window.from_ns,
                                  window.to_ns, value);
      if (!seen) continue;
      seen->share = window.share;
      seen->model_error = window.model_error;
    }
  }
}

void Builder::AddAccelerationGains() {
  if (motion().imus.empty()) return;
  motion().acceleration_gains.assign(kBaseNumbers, kNoParameter);
  motion().acceleration_gains[kYaw] = AddAccelerationGain("yaw", &problem_.table);
  for (const std::string& joint : motion().joints) {
    motion().acceleration_gains.push_back(AddAccelerationGain(joint, &problem_.table));
  }
}

void Builder::AddReceivers() {
  for (std::size_t s = 0; s < input_.sensors.size(); ++s) {
    const int link = model().LinkIndex(input_.sensors[s].link);
    if (link < 0 || !AreUsable(measured_.gnss[s])) continue;
    const auto chain = ChainTo(model(), link, places_);
    if (chain) AddReceiver(s, *chain);
  }
  SharePairYaw();
}

void Builder::AddReceiver(std::size_t sensor, const KinematicChain& chain) {
  const SensorDescription& receiver = input_.sensors[sensor];
  const auto& model = std::get<GnssModel>(receiver.model);
  ReceiverChannel channel{chain, receiver.X_BS.translation(), receiver.X_BS.translation()};
  const Vec3 part_m = ExtentOf_m(*input_.model, input_.model->LinkIndex(receiver.link));
  AddReceiverParameters(receiver, part_m, segment_s_, &problem_.table, &channel);
  AddReflection(receiver, &channel);
  const std::string name = input_.machine + "/" + receiver.name + "/";
  channel.noise = AddNoise(name + "east_m", "m", std::max(model.white_horizontal_m, 1e-3), 0.1);
  AddNoise(name + "north_m", "m", std::max(model.white_horizontal_m, 1e-3), 0.1);
  AddNoise(name + "up_m", "m", std::max(model.white_vertical_m, 1e-3), 0.2);
  SetTolerances(channel.noise, channel.datum, 3);
  motion().receivers.push_back(channel);
  AntennaTrack track{chain, receiver.X_BS.translation(), {}, {}};
  for (const GnssSample& sample : measured_.gnss[sensor]) {
    if (!IsAsDocumented(sample.fix, model.fix)) continue;
    Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero();
    value.head<3>() = sample.enu_m;
    Observe(ObservationKind::kReceiver, motion().receivers.size() - 1, sample.t_ns, sample.t_ns,
            value);
    track.t_s.push_back(Seconds(sample.t_ns));
    track.p_W_m.push_back(sample.enu_m);
  }
  if (!track.t_s.empty()) rough_.antennas.push_back(std::move(track));
}

/// Adds the reflection of a raised part next to an antenna. All joints of that part must have
/// encoders. An inertial unit or poses must also show the motion: with antennas alone, their noise
/// would look like a reflection.
void Builder::AddReflection(const SensorDescription& receiver, ReceiverChannel* channel) {
  if (motion().imus.empty() && measured_.poses.empty()) return;
  const auto part = RaisedPartOf(model(), model().LinkIndex(receiver.link), places_);
  const auto is_measured = [&](const KinematicChain::Step& step) {
    return !rough_.joints[static_cast<std::size_t>(step.place)].empty();
  };
  if (!part || !std::all_of(part->chain.steps.begin(), part->chain.steps.end(), is_measured)) {
    return;
  }
  channel->raised = *part;
  AddReflectionParameters(receiver, &problem_.table, channel);
}

void Builder::SharePairYaw() {
  std::vector<const SensorDescription*> pair;
  for (std::size_t s = 0; s < input_.sensors.size(); ++s) {
    if (measured_.gnss[s].size() >= 2) pair.push_back(&input_.sensors[s]);
  }
  if (pair.size() != 2 || motion().receivers.size() != 2 || pair[0]->link != pair[1]->link) return;
  // Shifts of the antennas across their baseline also turn it.
  const Vec2 between_m = (pair[1]->X_BS.translation() - pair[0]->X_BS.translation()).head<2>();
  if (between_m.norm() < kLeastBaseline_m) return;
  const Vec2 across = Vec2(-between_m.y(), between_m.x()).normalized().cwiseAbs();
  double off_m = 0;
  for (const ReceiverChannel& channel : motion().receivers) {
    const auto place = problem_.table.parameters.begin() + channel.place;
    off_m += across.x() * place[0].tolerance + across.y() * place[1].tolerance;
  }
  const int yaw = AddPairYaw(*pair[0], off_m / between_m.norm(), &problem_.table);
  for (ReceiverChannel& channel : motion().receivers) {
    channel.pair_yaw = yaw;
    channel.middle_L_m = (pair[0]->X_BS.translation() + pair[1]->X_BS.translation()) / 2;
  }
}

void Builder::AddPoses() {
  if (measured_.poses.empty()) return;
  MapChannel channel;
  channel.pivot_m = measured_.poses.front().X_WB.translation();
  AddPoseParameters(measured_.poses_were_measured, &problem_.table, &channel);
  const std::string name = input_.machine + "/" + std::string(kPoses) + "/";
  for (int i = 0; i < 6; ++i) {
    const bool is_place = i < 3;
    // `wander` of a map describes differences between segments. They also occur smoothly within a
    // segment, where residuals do not show them. Therefore they bound the noise from below.
    const int off = is_place ? channel.shift : channel.turn;
    const double smooth =
        off < 0 ? 0 : problem_.table.parameters[static_cast<std::size_t>(off + i % 3)].wander;
    const int noise = AddNoise(
        name + (is_place ? std::string(1, "xyz"[i]) : "r" + std::string(1, "xyz"[i % 3])),
        is_place ? "m" : "rad", std::max(is_place ? 1e-3 : 1e-4, smooth), is_place ? 0.1 : 0.05);
    if (i == 0) channel.noise = noise;
  }
  SetTolerances(channel.noise, channel.shift, 3);
  SetTolerances(channel.noise + 3, channel.turn, 3);
  motion().poses.push_back(channel);
  for (const TruthPose& pose : measured_.poses) {
    Eigen::Matrix<double, 6, 1> value;
    value << pose.X_WB.translation(), RpyFromRotation(pose.X_WB.linear());
    Observe(ObservationKind::kPose, 0, pose.t_ns, pose.t_ns, value);
    rough_.poses_t_s.push_back(Seconds(pose.t_ns));
    rough_.poses.push_back(pose.X_WB);
  }
}

void Builder::AddTravel() {
  const auto at_ns = [&](double t_s) { return problem_.start_ns + FromSeconds(t_s); };
  rough_.travel = GearTravel(input_, measured_, problem_.start_ns);
  // Standstill by levers is used only where nothing measures the base. The base would otherwise
  // absorb errors of the units.
  const bool is_measured = !motion().receivers.empty() || !motion().poses.empty();
  if (rough_.travel.empty() && !is_measured) {
    rough_.travel = StandingByLevers(input_, measured_, problem_.start_ns);
  }
  Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero();
  for (const TravelWindow& window : rough_.travel) {
    value[0] = window.forward_mps;
    value[1] = window.turning_radps;
    Observe(window.is_still ? ObservationKind::kStill : ObservationKind::kTravel, 0,
            at_ns(window.from_s), at_ns(window.to_s), value);
  }
  if (!model().fixed_base) return;
  value.setZero();
  for (std::size_t s = 0; s < motion().segments.size(); ++s) {
    for (double t_s = 0; t_s < segment_s_; t_s += kSplineStep_s) {
      const TimeNs t_ns = at_ns(static_cast<double>(s) * segment_s_ + t_s);
      Observe(ObservationKind::kStill, 0, t_ns, t_ns, value);
    }
  }
}

/// Adds standstill of joints without encoder, from their lever. Otherwise such a joint would absorb
/// errors of the units before and behind it.
void Builder::AddRests() {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (!rough_.joints[j].empty()) continue;
    for (const TravelWindow& window :
         RestingByLever(input_, measured_, joints_[j], problem_.start_ns)) {
      Observe(ObservationKind::kRest, kBaseNumbers + j,
              problem_.start_ns + FromSeconds(window.from_s),
              problem_.start_ns + FromSeconds(window.to_s), Eigen::Matrix<double, 6, 1>::Zero());
    }
  }
}

void Builder::SetStart() {
  rough_.start = place_.start;
  rough_.ground = place_.ground;
  const auto base = RoughBase(rough_);
  for (std::size_t s = 0; s < motion().segments.size(); ++s) {
    MotionSegment& segment = motion().segments[s];
    segment.start.resize(segment.spline.coefficients, motion().numbers());
    const double start_s = Seconds(segment.start_ns);
    for (int i = 0; i < segment.spline.coefficients; ++i) {
      const double t_s = start_s + (i - 1) * kSplineStep_s;
      for (std::size_t n = 0; n < base.size(); ++n) {
        segment.start(i, static_cast<Eigen::Index>(n)) = base[n].At(t_s);
      }
      for (std::size_t j = 0; j < joints_.size(); ++j) {
        segment.start(i, kBaseNumbers + static_cast<Eigen::Index>(j)) =
            rough_.joints[j].empty() ? model().joints[joints_[j]].initial_rad
                                     : rough_.joints[j].At(t_s);
      }
    }
  }
  if (place_.ground) AddGround(base);
}

/// Adds ground observations along the path. A standing machine adds only one, because it does not
/// measure the ground again.
void Builder::AddGround(const std::array<TimeSeries, kBaseNumbers>& base) {
  motion().ground_height = AddGroundHeight(&problem_.table);
  std::optional<Vec2> last_m;
  for (MotionSegment& segment : motion().segments) {
    const double start_s = Seconds(segment.start_ns);
    for (double t_s = kMargin_s; t_s < kMargin_s + segment_s_; t_s += kSplineStep_s) {
      const double at_s = start_s + t_s;
      const Vec2 place_m(base[0].At(at_s), base[1].At(at_s));
      if (last_m && (place_m - *last_m).norm() < kGroundEvery_m) continue;
      last_m = place_m;
      Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero();
      value.head<3>() = OnGround(place_.ground, place_m.x(), place_m.y(), base[kYaw].At(at_s));
      segment.observations.push_back({ObservationKind::kGround, 0, t_s, t_s, value});
    }
  }
}

}  // namespace

SensorProblem MakeSensorProblem(const DiagnosisInput& input, const Measurements& measured,
                                const KnownPlace& place) {
  return Builder(input, measured, place).Build();
}

}  // namespace tera
