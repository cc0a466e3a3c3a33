#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "blind/mujoco/cases/whole_case.h"

namespace tera::blind::mujoco {
namespace {

constexpr double kOfJoints = 0.5, kOfSensors = 0.35;  ///< the rest is of tracks

std::string AnyOf(const std::vector<std::string>& names, Draws* draws) {
  return draws->OneOf(names);
}

/// A draw in which the form is one by lot.
Draw AnyForm(Draw draw, bool reserve) {
  draw.variant = DrawVariant(reserve, draw.draws);
  return draw;
}

Effect AnyOfJoints(const Draw& draw) {
  while (true) {
    const std::string name = AnyOf(EffectsOfJoints(), draw.draws);
    const std::size_t axis = kSlew + draw.draws->Below(4);
    if (CanHold(axis, name, draw.variant)) return DrawOfJoint(name, axis, draw);
  }
}

Effect AnyEffect(const Draw& draw) {
  const double place = draw.draws->Between(0, 1);
  if (place < kOfJoints) return AnyOfJoints(draw);
  if (place < kOfJoints + kOfSensors) {
    return DrawOfSensor(AnyOf(EffectsOfSensors(), draw.draws), draw);
  }
  return DrawOfTracks(AnyOf(EffectsOfTracks(), draw.draws), draw);
}

/// Both may be there: of different things, or of one joint by different parts of its drive.
bool GoTogether(const Effect& a, const Effect& b) {
  if (a.concealed.target != b.concealed.target) return true;
  const auto has = [&](const char* name) {
    return a.concealed.name == name || b.concealed.name == name;
  };
  if (a.concealed.name == b.concealed.name || a.concealed.target == "base") return false;
  if (a.concealed.target.find('/') != std::string::npos) return false;  // of one encoder
  return !(has("drive_friction") && (has("backlash") || has("actuator_lag")));
}

std::vector<Effect> EffectsFor(CaseKind kind, const Draw& base, bool reserve) {
  const Draw draw = AnyForm(base, reserve);
  switch (kind) {
    case CaseKind::kOne:
      return {AnyEffect(draw)};
    case CaseKind::kTwo: {
      std::vector<Effect> effects = {AnyEffect(draw)};
      while (effects.size() < 2) {
        Effect second = AnyEffect(AnyForm(base, reserve));
        if (GoTogether(effects.front(), second)) effects.push_back(std::move(second));
      }
      return effects;
    }
    case CaseKind::kOutside:
      return {DrawOutside(draw)};
    case CaseKind::kConfounded:
      return {DrawConfounded(draw)};
    case CaseKind::kUntestable:
      return {DrawUntestable(draw)};
    default:
      return {};
  }
}

Ground DrawGround(bool level, Draws* draws) {
  Ground ground;
  const double kind = draws->Between(0, 1), steepest = level ? 0.012 : 0.07;
  if (kind < 0.3) return ground;
  const double towards_rad = draws->Within(std::numbers::pi);
  ground.slope =
      draws->Between(0, steepest) * Eigen::Vector2d(std::cos(towards_rad), std::sin(towards_rad));
  if (kind < 0.7 || level) return ground;
  ground.has_waves = true;
  ground.slope *= 0.5;
  for (Ground::Wave& wave : ground.waves) {
    const double length_m = draws->Between(9, 18), way_rad = draws->Within(std::numbers::pi);
    const double k_radpm = 2 * std::numbers::pi / length_m;
    wave = {draws->Between(0.02, 0.07), k_radpm * std::cos(way_rad), k_radpm * std::sin(way_rad),
            draws->Within(std::numbers::pi)};
  }
  return ground;
}

Start DrawStart(const MachineNumbers& numbers, bool level, Draws* draws) {
  Start start;
  start.ground = DrawGround(level, draws);
  start.yaw_rad = draws->Within(std::numbers::pi);
  for (std::size_t axis = kBoom; axis < kAxisCount; ++axis) {
    const JointNumbers& joint = numbers.joints[axis];
    start.joints_rad[axis - kSlew] =
        joint.lower_rad + draws->Between(0.45, 0.65) * (joint.upper_rad - joint.lower_rad);
  }
  return start;
}

/// Four levers, or those that are needed and one more.
std::vector<std::size_t> JointsFor(const std::vector<Effect>& effects, Draws* draws) {
  std::vector<std::size_t> joints;
  for (const Effect& effect : effects) {
    joints.insert(joints.end(), effect.needs.joints.begin(), effect.needs.joints.end());
  }
  std::vector<std::size_t> others = {kSlew, kBoom, kArm, kBucket};
  draws->Shuffle(&others);
  const std::size_t more = joints.empty() ? 2 + draws->Below(3) : 1;
  for (std::size_t k = 0; k < more; ++k) joints.push_back(others[k]);
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  return joints;
}

/// Turns taken by joints and tracks, or one of both alone.
std::vector<Manoeuvre> KindsFor(bool joints, bool tracks, bool reserve, Draws* draws) {
  std::vector<Manoeuvre> of_joints = ManoeuvresOf(false, reserve);
  std::vector<Manoeuvre> of_tracks = ManoeuvresOf(true, reserve);
  draws->Shuffle(&of_joints);
  draws->Shuffle(&of_tracks);
  std::vector<Manoeuvre> kinds;
  for (std::size_t k = 0; k < 12; ++k) {
    if (joints) kinds.push_back(of_joints[k % of_joints.size()]);
    if (tracks) kinds.push_back(of_tracks[k % of_tracks.size()]);
  }
  return kinds;
}

/// Recordings that owners have without a diagnosis in mind: standstill, one turn, one straight line
/// or slow waves.
void MakePoor(Draws* draws, WholeCase* out) {
  const Manoeuvre only[] = {Manoeuvre::kRest, Manoeuvre::kSpot, Manoeuvre::kStraight,
                            Manoeuvre::kSines};
  const std::size_t kind = draws->Below(4);
  out->habit.kinds = {only[kind]};
  for (int k = 0; k < 40; ++k) out->habit.kinds.push_back(kind == 3 ? only[3] : Manoeuvre::kRest);
  out->habit.largest = draws->Between(0.2, 0.5);
  out->drives = kind == 1 || kind == 2;
}

void DrawWork(bool reserve, Draws* draws, WholeCase* out) {
  bool needs_joints = false, needs_drive = false;
  for (const Effect& effect : out->effects) {
    needs_joints |= !effect.needs.joints.empty();
    needs_drive |= effect.needs.drives;
  }
  const CaseKind kind = out->about.kind;
  out->habit.joints = JointsFor(out->effects, draws);
  bool joints = needs_joints || !needs_drive, tracks = needs_drive;
  if (kind == CaseKind::kNothing) {
    const double place = draws->Between(0, 1);
    joints = place < 0.7, tracks = place >= 0.4;
  } else if (kind != CaseKind::kConfounded && kind != CaseKind::kUntestable) {
    joints = joints || draws->Chance(0.4);
    tracks = tracks || draws->Chance(0.35);
  }
  out->drives = tracks;
  out->habit.kinds = KindsFor(joints, tracks, reserve, draws);
  out->habit.full_steps_only = kind == CaseKind::kConfounded;
  if (kind == CaseKind::kUntestable) out->habit.largest = 0.5;
  if (kind == CaseKind::kNothing && draws->Chance(0.2)) MakePoor(draws, out);
}

}  // namespace

Variant DrawVariant(bool reserve, Draws* draws) {
  if (reserve) return Variant::kReserved;
  return draws->Chance(0.5) ? Variant::kFirst : Variant::kSecond;
}

std::size_t MachineOfCase(std::uint64_t seed, int number, std::size_t machines) {
  return Draws(Stream(seed, fmt::format("mujoco/{}/machine", number))).Below(machines);
}

Forms WholeCase::With(std::size_t without) const {
  Forms forms = within;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (i != without) effects[i].put(&forms);
  }
  return forms;
}

WholeCase DrawWholeCase(std::uint64_t seed, int number, const MachineNumbers& numbers, bool reserve,
                        std::optional<double> duration_s) {
  const std::string name = fmt::format("mujoco{}/{}", reserve ? "/reserve" : "", number);
  Draws draws(Stream(seed, name + "/case"));
  WholeCase out;
  out.about.number = number;
  out.about.kind = KindOfCase(seed, number, false);
  out.about.strength = static_cast<Strength>(draws.Below(3));
  if (out.about.kind == CaseKind::kConfounded) out.about.strength = Strength::kStrong;
  out.about.duration_s = std::round(duration_s.value_or(draws.Between(60, 120)));
  const Draw draw{numbers, out.about.strength, Variant::kFirst, &draws};
  out.effects = EffectsFor(out.about.kind, draw, reserve);
  bool level = false, of_receivers = false;
  for (const Effect& effect : out.effects) {
    out.about.hidden.push_back(effect.concealed);
    level |= effect.needs.level;
    of_receivers |= effect.needs.is_of_receivers;
  }
  DrawWork(reserve, &draws, &out);
  out.within = DrawWithinTolerances(numbers, &draws);
  out.start = DrawStart(numbers, level, &draws);
  out.has_poses = !of_receivers && draws.Chance(0.5);
  return out;
}

}  // namespace tera::blind::mujoco
