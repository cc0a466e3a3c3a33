#include "blind/benchmark_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tera::blind {
namespace {

constexpr double kOff = 0.03;
constexpr double kTrackShare = 0.25;

/// Draws in order, by name.
class Draws {
 public:
  explicit Draws(Stream stream) : stream_(stream) {}
  double Uniform() { return stream_.Uniform(next_++); }
  std::size_t Below(std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(Uniform() * static_cast<double>(n)));
  }

 private:
  Stream stream_;
  std::uint64_t next_ = 0;
};

double Fraction(double x) { return x - std::floor(x); }

CaseKind KindAt(double place) {
  constexpr std::pair<CaseKind, double> kShares[] = {
      {CaseKind::kNothing, 40}, {CaseKind::kOne, 26},       {CaseKind::kTwo, 12},
      {CaseKind::kOutside, 8},  {CaseKind::kConfounded, 6}, {CaseKind::kUntestable, 4}};
  double left = place * 96;
  for (const auto& [kind, share] : kShares) {
    if (left < share) return kind;
    left -= share;
  }
  return CaseKind::kUntestable;
}

/// Draws what is hidden in the joints.
class JointsDraw {
 public:
  JointsDraw(Draws* draws, std::uint64_t seed, const std::string& name, const Excavator& nominal,
             BenchmarkCase* out)
      : draws_(draws),
        out_(out),
        joints_(out->joints.emplace()),
        streams_{Stream(seed, name + "/first"), Stream(seed, name + "/second")} {
    joints_.excavator = nominal.Off(kOff, Stream(seed, name + "/off"));
    joints_.noise = DrawNoise(Stream(seed, name + "/noise"));
    // Joints that are not measured stay where the machine's file has them.
    for (std::size_t i = 0; i < kAxes; ++i) joints_.start_rad[i] = nominal.axis(i).initial_rad;
  }

  void One() {
    const std::string name = AnyName();
    Named(name, AxisFor(name));
  }

  /// On one joint in two of three cases.
  void Two() {
    One();
    const std::string first = out_->hidden.front().name;
    const bool same = draws_->Uniform() < 0.66;
    while (true) {
      const std::string name = AnyName();
      if (!GoTogether(first, name)) continue;
      const std::size_t axis = AxisFor(name);
      if ((axis == axes_.front()) == same) return Named(name, axis);
    }
  }

  void Outside() {
    const std::size_t axis = 1 + draws_->Below(3), other = 1 + axis % 3;
    Add(HideOutside(axis, other, joints_.excavator, joints_.start_rad, streams_[0]));
    if (joints_.forms[axis].other_share > 0) joints_.habit.uses[other] = true;
  }

  /// With full lever alone, what does the valve do in between?
  void Confounded() {
    joints_.habit.full_steps_only = true;
    const char* names[] = {"dead_band", "lever_saturation", "rate_gain"};
    const std::string name = names[draws_->Below(3)];
    Named(name, 1 + draws_->Below(3));
  }

  /// A valve that ends where no lever goes.
  void Unseen() {
    joints_.habit.largest = 0.45;
    Named("lever_saturation", draws_->Below(kAxes));
  }

  /// The joints concerned and one more, which nothing is wrong with.
  std::vector<std::size_t> ChooseAxes() {
    std::array<bool, kAxes>& uses = joints_.habit.uses;
    for (const std::size_t axis : axes_) uses[axis] = true;
    while (std::count(uses.begin(), uses.end(), true) < 2) uses[draws_->Below(kAxes)] = true;
    for (std::size_t i = 0; i < kAxes; ++i) {
      if (uses[i]) joints_.measured.push_back(i);
    }
    return axes_;
  }

 private:
  std::string AnyName() { return NameableEffects()[draws_->Below(NameableEffects().size())]; }
  std::size_t AxisFor(const std::string& name) {
    while (true) {
      const std::size_t axis = draws_->Below(kAxes);
      if (CanHave(axis, name)) return axis;
    }
  }
  void Add(const Hidden& hidden) {
    joints_.forms[hidden.axis] = hidden.form;
    out_->hidden.push_back(hidden.concealed);
    axes_.push_back(hidden.axis);
  }
  void Named(const std::string& name, std::size_t axis) {
    Add(Hide(name, out_->strength, axis, joints_.forms[axis], joints_.excavator, joints_.start_rad,
             streams_[std::min<std::size_t>(axes_.size(), 1)]));
  }

  Draws* draws_;
  BenchmarkCase* out_;
  JointsCase& joints_;
  Stream streams_[2];
  std::vector<std::size_t> axes_;
};

void DrawJoints(Draws* draws, std::uint64_t seed, const std::string& name, const Excavator& nominal,
                BenchmarkCase* out) {
  JointsDraw joints(draws, seed, name, nominal, out);
  switch (out->kind) {
    case CaseKind::kNothing:
      break;
    case CaseKind::kOne:
      joints.One();
      break;
    case CaseKind::kTwo:
      joints.Two();
      break;
    case CaseKind::kOutside:
      joints.Outside();
      break;
    case CaseKind::kConfounded:
      joints.Confounded();
      break;
    case CaseKind::kUntestable:
      joints.Unseen();
      break;
  }
  out->joints->hidden_axes = joints.ChooseAxes();
}

void DrawTracks(Draws* draws, std::uint64_t seed, const std::string& name,
                const PlainTracks& nominal, BenchmarkCase* out) {
  TracksCase& tracks = out->tracks.emplace();
  tracks.tracks = nominal.Off(kOff, Stream(seed, name + "/off"));
  tracks.noise = DrawNoise(Stream(seed, name + "/noise"));
  const std::size_t count = NameableTrackEffects().size();
  const std::size_t first = draws->Below(count), step = 1 + draws->Below(count - 1);
  const auto hide = [&](std::size_t index, const char* stream) {
    out->hidden.push_back(HideInTracks(NameableTrackEffects()[index % count], out->strength,
                                       Stream(seed, name + stream), &tracks.form));
  };
  if (out->kind != CaseKind::kNothing) hide(first, "/first");
  if (out->kind == CaseKind::kTwo) hide(first + step, "/second");
}

Strength StrengthOf(CaseKind kind, Draws* draws) {
  const auto any = static_cast<Strength>(draws->Below(3));
  if (kind == CaseKind::kOne) return any;
  if (kind == CaseKind::kTwo) return any == Strength::kFaint ? Strength::kStrong : any;
  return kind == CaseKind::kConfounded ? Strength::kStrong : Strength::kMedium;
}

}  // namespace

std::string_view NameOf(CaseKind kind) {
  switch (kind) {
    case CaseKind::kNothing:
      return "nothing wrong";
    case CaseKind::kOne:
      return "one effect";
    case CaseKind::kTwo:
      return "two effects";
    case CaseKind::kOutside:
      return "outside the library";
    case CaseKind::kConfounded:
      return "confounded";
    case CaseKind::kUntestable:
      return "untestable";
  }
  return "";
}

BenchmarkCase DrawCase(std::uint64_t seed, int number, const PlainMachine& nominal,
                       double duration_s) {
  const std::string name = fmt::format("blind/{}", number);
  Draws draws(Stream(seed, name + "/case"));
  BenchmarkCase out;
  out.number = number;
  out.duration_s = duration_s;
  // Golden-section places: any run of numbers has each kind in nearly its share.
  const double start = Stream(seed, "blind/kinds").Uniform(0);
  out.kind = KindAt(Fraction(start + 0.6180339887498949 * number));
  out.strength = StrengthOf(out.kind, &draws);
  const bool has_track_cases =
      out.kind == CaseKind::kNothing || out.kind == CaseKind::kOne || out.kind == CaseKind::kTwo;
  if (has_track_cases && draws.Uniform() < kTrackShare) {
    DrawTracks(&draws, seed, name, nominal.tracks, &out);
  } else {
    DrawJoints(&draws, seed, name, nominal.excavator, &out);
  }
  return out;
}

CaseRecording Record(BenchmarkCase* c, std::uint64_t seed) {
  const std::string name = fmt::format("blind/{}", c->number);
  if (c->tracks) return RecordTracks(*c->tracks, c->duration_s, seed, name, &c->hidden);
  return RecordJoints(*c->joints, c->duration_s, seed, name);
}

}  // namespace tera::blind
