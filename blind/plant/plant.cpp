#include "blind/plant/plant.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

#include "blind/plant/axis_equations.h"
#include "blind/plant/integrator.h"
#include "blind/plant/messages.h"

namespace tera::blind {
namespace {

/// The four joints as one system.
class Plant {
 public:
  Plant(const Excavator& excavator, const Forms& forms, const AxisValues& start_rad,
        const Stream& stream)
      : excavator_(excavator), forms_(forms) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < kAxes; ++i) {
      axes_.emplace_back(excavator, i, forms[i]);
      messages_.emplace_back(forms[i], Stream(StreamSeed(stream, i), "queue"));
      first_[i] = size;
      size += axes_[i].size();
    }
    std::vector<double> x(size);
    const auto at = Around(0, start_rad);
    for (std::size_t i = 0; i < kAxes; ++i)
      axes_[i].Start(at[i], start_rad[i], Own(i, std::span<double>(x)));
    integrator_.emplace(
        x, [this](double t, auto x, auto dx) { Derive(t, x, dx); }, kAxes * AxisEquations::kEdges,
        [this](double t, auto x, auto edges) { Edges(t, x, edges); });
    state_ = x;
  }
  Plant(const Plant&) = delete;

  void Send(double t_s, const AxisValues& lever) {
    for (std::size_t i = 0; i < kAxes; ++i) messages_[i].Send(t_s, lever[i]);
  }

  void To(double t_s) {
    while (true) {
      // A message may change a lever; from there on it is another equation.
      bool changed = false;
      double next_s = t_s;
      for (std::size_t i = 0; i < kAxes; ++i) {
        const double lever = messages_[i].At(now_s_);
        changed = changed || lever != lever_[i];
        lever_[i] = lever;
        next_s = std::min(next_s, messages_[i].Next(now_s_));
      }
      if (changed) integrator_->Restart();
      if (next_s > now_s_) {
        const auto x = integrator_->To(next_s);
        state_.assign(x.begin(), x.end());
        now_s_ = next_s;
      }
      if (now_s_ >= t_s) return;
    }
  }

  AxisValues q_rad() const {
    AxisValues q;
    for (std::size_t i = 0; i < kAxes; ++i)
      q[i] = axes_[i].angle(Own(i, std::span<const double>(state_)));
    return q;
  }
  AxisValues w_radps() const {
    AxisValues w;
    for (std::size_t i = 0; i < kAxes; ++i)
      w[i] = axes_[i].rate(Own(i, std::span<const double>(state_)));
    return w;
  }

 private:
  static std::uint64_t StreamSeed(const Stream& stream, std::size_t axis) {
    return static_cast<std::uint64_t>(stream.Uniform(axis) * 1e15);
  }
  std::span<double> Own(std::size_t i, std::span<double> x) const {
    return x.subspan(first_[i], axes_[i].size());
  }
  std::span<const double> Own(std::size_t i, std::span<const double> x) const {
    return x.subspan(first_[i], axes_[i].size());
  }

  std::array<Surroundings, kAxes> Around(double t_s, const AxisValues& q_rad) const {
    const AxisValues load_nm = excavator_.Loads_nm(q_rad);
    const AxisValues inertia_kgm2 = excavator_.Inertias_kgm2(q_rad);
    std::array<Surroundings, kAxes> at;
    for (std::size_t i = 0; i < kAxes; ++i) {
      at[i] = {t_s, lever_[i], lever_[forms_[i].other_axis], load_nm[i], inertia_kgm2[i]};
    }
    return at;
  }
  std::array<Surroundings, kAxes> Around(double t_s, std::span<const double> x) const {
    AxisValues q;
    for (std::size_t i = 0; i < kAxes; ++i) q[i] = axes_[i].angle(Own(i, x));
    return Around(t_s, q);
  }
  void Derive(double t_s, std::span<const double> x, std::span<double> dx) const {
    const auto at = Around(t_s, x);
    for (std::size_t i = 0; i < kAxes; ++i) axes_[i].Derive(at[i], Own(i, x), Own(i, dx));
  }
  void Edges(double t_s, std::span<const double> x, std::span<double> edges) const {
    const auto at = Around(t_s, x);
    constexpr std::size_t n = AxisEquations::kEdges;
    for (std::size_t i = 0; i < kAxes; ++i) {
      axes_[i].Edges(at[i], Own(i, x), edges.subspan(i * n, n));
    }
  }

  const Excavator& excavator_;
  Forms forms_;
  std::vector<AxisEquations> axes_;
  std::vector<Messages> messages_;
  std::array<std::size_t, kAxes> first_{};
  std::optional<Integrator> integrator_;
  std::vector<double> state_;
  AxisValues lever_{};
  double now_s_ = 0;
};

}  // namespace

Motion Move(const Excavator& excavator, const Forms& forms, const Course& course,
            const Driver& driver, const Stream& stream) {
  Plant plant(excavator, forms, course.start_rad, stream);
  Motion motion;
  std::size_t sample = 0;
  const auto commands = static_cast<std::size_t>(course.duration_s / motion.command_s + 0.5);
  for (std::size_t k = 0; k < commands; ++k) {
    const double t_s = static_cast<double>(k) * motion.command_s;
    const double end_s = static_cast<double>(k + 1) * motion.command_s;
    motion.lever.push_back(driver(t_s, plant.q_rad()));
    plant.Send(t_s, motion.lever.back());
    for (; sample < course.sample_s.size() && course.sample_s[sample] < end_s; ++sample) {
      plant.To(std::max(t_s, course.sample_s[sample]));
      motion.t_s.push_back(course.sample_s[sample]);
      motion.q_rad.push_back(plant.q_rad());
      motion.w_radps.push_back(plant.w_radps());
    }
    plant.To(end_s);
  }
  return motion;
}

Driver Replayed(const Motion& motion) {
  return [levers = motion.lever, command_s = motion.command_s](double t_s, const AxisValues&) {
    const auto k = static_cast<std::size_t>(t_s / command_s + 0.5);
    return levers[std::min(k, levers.size() - 1)];
  };
}

}  // namespace tera::blind
