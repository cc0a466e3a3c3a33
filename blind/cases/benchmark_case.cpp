#include "blind/cases/benchmark_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tera::blind {
namespace {

constexpr double kOff = 0.03;
constexpr double kTrackShare = 0.25;
constexpr double kInjected_s = 120;

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

CaseKind KindAt(double place, bool has_real) {
  constexpr std::pair<CaseKind, double> kShares[] = {
      {CaseKind::kNothing, 40}, {CaseKind::kOne, 26},       {CaseKind::kTwo, 12},
      {CaseKind::kOutside, 8},  {CaseKind::kConfounded, 6}, {CaseKind::kUntestable, 4},
      {CaseKind::kInjected, 4}};
  double left = place * (has_real ? 100 : 96);
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
    // The other is on another pump: what shares a pump, the library can name.
    const std::size_t axis = 1 + draws_->Below(3), other = axis == 2 ? 3 : 2;
    Add(HideOutside(axis, other, streams_[0]));
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
  void ChooseAxes() {
    std::array<bool, kAxes>& uses = joints_.habit.uses;
    for (const std::size_t axis : axes_) uses[axis] = true;
    while (std::count(uses.begin(), uses.end(), true) < 2) uses[draws_->Below(kAxes)] = true;
    for (std::size_t i = 0; i < kAxes; ++i) {
      if (uses[i]) joints_.measured.push_back(i);
    }
  }

  /// Sets the joints without each of the hidden effects, with the others in place.
  void TakeAway() {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      HiddenInJoint& hidden = joints_.hidden.emplace_back();
      hidden.axis = axes_[i];
      for (std::size_t k = 0; k < axes_.size(); ++k) {
        if (k == i) continue;
        AxisForm& form = hidden.without[axes_[k]];
        form = FormOf(out_->hidden[k].name, axes_[k], form, k).form;
      }
    }
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
  Hidden FormOf(const std::string& name, std::size_t axis, const AxisForm& onto,
                std::size_t number) const {
    return Hide(name, out_->strength, axis, onto, joints_.excavator, joints_.start_rad,
                streams_[number]);
  }
  void Named(const std::string& name, std::size_t axis) {
    Add(FormOf(name, axis, joints_.forms[axis], axes_.size()));
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
    case CaseKind::kInjected:
      break;
  }
  joints.ChooseAxes();
  joints.TakeAway();
}

void DrawTracks(Draws* draws, std::uint64_t seed, const std::string& name,
                const PlainTracks& nominal, BenchmarkCase* out) {
  TracksCase& tracks = out->tracks.emplace();
  tracks.tracks = nominal.Off(kOff, Stream(seed, name + "/off"));
  tracks.noise = DrawNoise(Stream(seed, name + "/noise"));
  const std::size_t count = NameableTrackEffects().size();
  const std::size_t first = draws->Below(count), step = 1 + draws->Below(count - 1);
  std::vector<std::size_t> indices;
  if (out->kind != CaseKind::kNothing) indices = {first % count};
  if (out->kind == CaseKind::kTwo) indices.push_back((first + step) % count);
  const auto hide = [&](std::size_t i, TrackForm* form) {
    return HideInTracks(NameableTrackEffects()[indices[i]], out->strength,
                        Stream(seed, name + (i == 0 ? "/first" : "/second")), form);
  };
  for (std::size_t i = 0; i < indices.size(); ++i) {
    out->hidden.push_back(hide(i, &tracks.form));
    TrackForm& without = tracks.without.emplace_back();
    for (std::size_t k = 0; k < indices.size(); ++k) {
      if (k != i) hide(k, &without);
    }
  }
}

/// Into two minutes of a drive that lasts from 125 s to 290 s.
void DrawInjected(Draws* draws, std::uint64_t seed, const std::string& name, const RealDrive& real,
                  BenchmarkCase* out) {
  const std::vector<std::string>& names = NameableInRealDrives();
  InjectedCase& injected = out->injected.emplace();
  injected.drive = real.Part(125 + 45 * draws->Uniform(), kInjected_s);
  out->duration_s = kInjected_s;
  out->hidden.push_back(HideInRealDrive(names[draws->Below(names.size())], out->strength,
                                        Stream(seed, name + "/first"), &injected));
}

Strength StrengthOf(CaseKind kind, Draws* draws) {
  const auto any = static_cast<Strength>(draws->Below(3));
  if (kind == CaseKind::kOne) return any;
  if (kind == CaseKind::kTwo || kind == CaseKind::kInjected) {
    return any == Strength::kFaint ? Strength::kStrong : any;
  }
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
    case CaseKind::kInjected:
      return "injected into a real drive";
  }
  return "";
}

/// Golden-section places: any run of numbers has each kind in nearly its share.
CaseKind KindOfCase(std::uint64_t seed, int number, bool has_real) {
  const double start = Stream(seed, "blind/kinds").Uniform(0);
  return KindAt(Fraction(start + 0.6180339887498949 * number), has_real);
}

BenchmarkCase DrawCase(std::uint64_t seed, int number, const PlainMachine& nominal,
                       double duration_s) {
  const std::string name = fmt::format("blind/{}", number);
  Draws draws(Stream(seed, name + "/case"));
  BenchmarkCase out;
  out.number = number;
  out.duration_s = duration_s;
  out.kind = KindOfCase(seed, number, nominal.real.has_value());
  out.strength = StrengthOf(out.kind, &draws);
  if (out.kind == CaseKind::kInjected) {
    DrawInjected(&draws, seed, name, *nominal.real, &out);
    return out;
  }
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
  if (c->injected) return RecordInjected(*c->injected);
  if (c->tracks) return RecordTracks(*c->tracks, c->duration_s, seed, name, &c->hidden);
  return RecordJoints(*c->joints, c->duration_s, seed, name);
}

}  // namespace tera::blind
