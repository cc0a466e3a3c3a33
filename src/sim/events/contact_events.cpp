#include "sim/events/contact_events.h"

#include <algorithm>

namespace tera {
namespace {

constexpr TimeNs kContactPause_ns = 200'000'000;
constexpr double kStrikeSpeed_mps = 0.2;
constexpr TimeNs kStrike_ns = 20'000'000;
/// Name of the walls of a site's mesh.
constexpr char kSite[] = "site";

/// Velocity of a side's body at a point of W.
Vec3 VelocityAt_mps(const BodyContact::Side& side, const Instant& now, const Vec3& p_W_m) {
  if (side.kind == BodyContact::Kind::kWall) return Vec3::Zero();
  const BodyState& body = side.kind == BodyContact::Kind::kMachine
                              ? now.machines[side.index].links[static_cast<std::size_t>(side.link)]
                              : now.obstacles[side.index];
  return PointVelocity(body, body.X_WB.inverse() * p_W_m);
}

double ClosingSpeed_mps(const BodyContact& contact, const Instant& before) {
  const Vec3 v_W_mps = VelocityAt_mps(contact.a, before, contact.p_W_m) -
                       VelocityAt_mps(contact.b, before, contact.p_W_m);
  return -v_W_mps.dot(contact.force_W_n.normalized());
}

bool BearsShovel(const MachineModel& model, int link) {
  return std::ranges::count(model.ground_tools.shovels, link, &Shovel::link) > 0;
}

}  // namespace

ContactEvents::ContactEvents(const Scenario& scenario)
    : scenario_(scenario), contacts_({.kind = EventKind::kContact, .pause_ns = kContactPause_ns}) {}

const std::string& ContactEvents::WholeOf(const BodyContact::Side& side) const {
  return side.kind == BodyContact::Kind::kMachine ? scenario_.machines[side.index].placement.name
                                                  : scenario_.obstacles[side.index].name;
}

EventSubject ContactEvents::SubjectOf(const BodyContact& contact) const {
  const auto link_of = [&](const BodyContact::Side& side) {
    return scenario_.machines[side.index]
        .placement.model.links[static_cast<std::size_t>(side.link)]
        .name;
  };
  EventSubject subject{WholeOf(contact.a), link_of(contact.a), kSite};
  if (contact.b.kind != BodyContact::Kind::kWall) subject.other = WholeOf(contact.b);
  if (contact.b.kind == BodyContact::Kind::kMachine) subject.other += "/" + link_of(contact.b);
  return subject;
}

void ContactEvents::Observe(const BodyContact& contact, const Instant& before,
                            const Instant& after) {
  const EventSubject subject = SubjectOf(contact);
  const double force_n = contact.force_W_n.norm();
  if (contact.b.kind != BodyContact::Kind::kWall) {
    touched_ns_[{contact.a.index, WholeOf(contact.b)}] = after.t_ns;
  }
  const bool begins = contacts_.Hold(subject, before.t_ns, after.t_ns, force_n);
  if (begins && BearsShovel(scenario_.machines[contact.a.index].placement.model, contact.a.link) &&
      ClosingSpeed_mps(contact, before) >= kStrikeSpeed_mps) {
    strikes_[subject] = {before.t_ns,     before.t_ns,  EventKind::kStrike,
                         subject.machine, subject.part, subject.other};
  }
  if (const auto strike = strikes_.find(subject); strike != strikes_.end()) {
    RecordedEvent& event = strike->second;
    event.end_ns = std::min(after.t_ns, event.begin_ns + kStrike_ns);
    event.value += force_n * ToSeconds(event.end_ns - before.t_ns);
  }
}

void ContactEvents::Observe(const Instant& before, const Instant& after) {
  for (const BodyContact& contact : after.contacts) Observe(contact, before, after);
  contacts_.Close(after.t_ns);
  std::erase_if(touched_ns_, [&](const auto& touched) {
    return after.t_ns - touched.second > kContactPause_ns;
  });
  std::erase_if(strikes_, [&](const auto& strike) {
    if (after.t_ns - strike.second.begin_ns < kStrike_ns) return false;
    struck_.push_back(strike.second);
    return true;
  });
}

std::vector<RecordedEvent> ContactEvents::All() const {
  std::vector<RecordedEvent> all = contacts_.All();
  all.insert(all.end(), struck_.begin(), struck_.end());
  for (const auto& [subject, strike] : strikes_) all.push_back(strike);
  return all;
}

std::vector<std::string> ContactEvents::Touched(std::size_t machine) const {
  std::vector<std::string> names;
  for (const auto& [touched, last_ns] : touched_ns_) {
    if (touched.first == machine) names.push_back(touched.second);
  }
  return names;
}

}  // namespace tera
