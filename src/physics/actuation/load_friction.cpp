#include "physics/actuation/load_friction.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kZeroCelsius_k = 273.15;
/// Oil ISO VG 46: the midpoint of the grade at 40 C by ISO 3448. The value at 100 C is from data
/// sheets for a viscosity index of about 100 (6.7 to 6.9).
constexpr double kWarm_degc = 40, kWarm_cst = 46;
constexpr double kHot_degc = 100, kHot_cst = 6.8;
/// Constant of ASTM D341, valid for all but the thinnest oils.
constexpr double kChartShift_cst = 0.7;
/// Temperature to which the parameters of leak and viscous friction refer.
constexpr double kReference_degc = kWarm_degc;

/// Viscosity of the oil over that at the reference temperature.
double ViscosityRatio(double oil_degc) {
  return OilViscosity_cst(oil_degc) / OilViscosity_cst(kReference_degc);
}

/// Least effort near a dead centre, as a share of the rated effort of a cylinder.
constexpr double kWeakest = 0.1;

OverTravel NotBelow(double least, OverTravel table) {
  for (double& value : table.values) value = std::max(value, least);
  return table;
}

}  // namespace

double OilViscosity_cst(double oil_degc) {
  const auto ordinate = [](double nu_cst) {
    return std::log10(std::log10(nu_cst + kChartShift_cst));
  };
  const auto abscissa = [](double degc) { return std::log10(degc + kZeroCelsius_k); };
  const double slope =
      (ordinate(kWarm_cst) - ordinate(kHot_cst)) / (abscissa(kWarm_degc) - abscissa(kHot_degc));
  const double log_log = ordinate(kWarm_cst) + slope * (abscissa(oil_degc) - abscissa(kWarm_degc));
  return std::pow(10, std::pow(10, log_log)) - kChartShift_cst;
}

ActuatorEffort ActuatorEffort::Constant(double effort_nm) {
  return {{.values = {effort_nm}}, {.values = {effort_nm}}, effort_nm};
}

LoadFrictionParameters LoadFrictionOf(const Effects& effects, const ActuatorEffort& effort) {
  LoadFrictionParameters parameters;
  if (const Effect* droop = FindEffect(effects, "pressure_droop")) {
    const double stall_nm = (*droop)["stall_nm"];
    if (stall_nm > 0) {
      parameters.stall_positive_nm.values = parameters.stall_negative_nm.values = {stall_nm};
    } else if (effort.rated_nm > 0) {
      parameters.stall_positive_nm = NotBelow(kWeakest * effort.rated_nm, effort.positive_nm);
      parameters.stall_negative_nm = NotBelow(kWeakest * effort.rated_nm, effort.negative_nm);
    }
    parameters.droop_response_s = (*droop)["response_s"];
  }
  if (const Effect* friction = FindEffect(effects, "coulomb_friction")) {
    parameters.coulomb_nm = (*friction)["effort_nm"];
  }
  if (const Effect* friction = FindEffect(effects, "viscous_friction")) {
    parameters.viscous_nmsprad =
        (*friction)["coefficient_nmsprad"] * ViscosityRatio((*friction)["oil_degc"]);
  }
  if (const Effect* friction = FindEffect(effects, "stribeck_friction")) {
    parameters.stribeck_nm = (*friction)["excess_nm"];
    parameters.stribeck_radps = (*friction)["rate_radps"];
  }
  if (const Effect* friction = FindEffect(effects, "asymmetric_friction")) {
    parameters.more_positive_nm = (*friction)["positive_nm"];
    parameters.more_negative_nm = (*friction)["negative_nm"];
    parameters.more_positive_nmsprad = (*friction)["positive_nmsprad"];
    parameters.more_negative_nmsprad = (*friction)["negative_nmsprad"];
  }
  if (const Effect* offset = FindEffect(effects, "effort_offset")) {
    parameters.offset_nm = (*offset)["effort_nm"];
  }
  if (const Effect* sag = FindEffect(effects, "sag")) {
    const double drift_radps = (*sag)["drift_radps"] / ViscosityRatio((*sag)["oil_degc"]);
    if (effort.rated_nm > 0 && drift_radps > 0) {
      const auto drift = [&](const OverTravel& against_nm) {
        OverTravel table = NotBelow(kWeakest * effort.rated_nm, against_nm);
        for (double& e_nm : table.values) e_nm = drift_radps * effort.rated_nm / (e_nm * e_nm);
        return table;
      };
      parameters.drift_negative_radpspnm = drift(effort.positive_nm);
      parameters.drift_positive_radpspnm = drift(effort.negative_nm);
    }
  }
  if (const Effect* slide = FindEffect(effects, "drive_friction")) {
    parameters.lost_radps = (*slide)["lost_radps"];
    parameters.slide_s = (*slide)["time_s"];
    parameters.breakaway = (*slide)["breakaway"];
    parameters.slide_stribeck_radps = (*slide)["stribeck_radps"];
  }
  if (const Effect* flex = FindEffect(effects, "structural_flex")) {
    parameters.flex_radps = (*flex)["natural_radps"];
    parameters.flex_damping = (*flex)["damping"];
    parameters.compliance_radpnm = (*flex)["compliance_radpnm"];
  }
  return parameters;
}

LoadFriction::LoadFriction(const LoadFrictionParameters& parameters)
    : parameters_(parameters),
      acts_(ReadsLoad() || parameters.lost_radps > 0 || parameters.flex_radps > 0) {}

bool LoadFriction::ReadsLoad() const {
  return !parameters_.stall_positive_nm.values.empty() ||
         !parameters_.drift_negative_radpspnm.values.empty() || parameters_.compliance_radpnm > 0;
}

double LoadFriction::Act(double rate_radps, double load_nm, double position_rad, double dt_s) {
  if (dt_s != dt_s_) Prepare(dt_s);
  double rate = rate_radps;
  if (!parameters_.stall_positive_nm.values.empty()) rate = Droop(rate, load_nm, position_rad);
  if (!parameters_.drift_negative_radpspnm.values.empty()) rate -= Leak(load_nm, position_rad);
  if (parameters_.lost_radps > 0) rate = DriveFriction(rate);
  if (parameters_.flex_radps > 0) rate = Flex(rate, load_nm);
  return rate;
}

void LoadFriction::Prepare(double dt_s) {
  dt_s_ = dt_s;
  response_step_ =
      parameters_.droop_response_s > 0 ? -std::expm1(-dt_s / parameters_.droop_response_s) : 1.0;
  slide_keeps_ = parameters_.slide_s > 0 ? std::exp(-dt_s / parameters_.slide_s) : 0.0;
  const double z = parameters_.flex_damping;
  const double decay = std::exp(-z * parameters_.flex_radps * dt_s);
  const double turn_rad = parameters_.flex_radps * std::sqrt(1 - z * z) * dt_s;
  flex_cos_ = decay * std::cos(turn_rad);
  flex_sin_ = decay * std::sin(turn_rad);
}

double LoadFriction::Leak(double load_nm, double position_rad) const {
  // The oil does not carry the part of a load that friction holds.
  const AxisFriction held = Friction(0);
  const double on_oil_nm =
      load_nm - std::clamp(load_nm, -held.against_positive_nm, held.against_negative_nm);
  if (on_oil_nm == 0) return 0;
  return on_oil_nm *
         (on_oil_nm > 0 ? parameters_.drift_negative_radpspnm : parameters_.drift_positive_radpspnm)
             .At(position_rad);
}

double LoadFriction::Droop(double rate_radps, double load_nm, double position_rad) {
  pressed_nm_ += response_step_ * (load_nm - pressed_nm_);
  if (rate_radps == 0) return 0;
  const AxisFriction friction = Friction(rate_radps);
  const double dry_nm = rate_radps > 0 ? pressed_nm_ + friction.against_positive_nm
                                       : -pressed_nm_ + friction.against_negative_nm;
  const double against_nm = dry_nm + friction.viscous_nmsprad * std::abs(rate_radps);
  const double stall_nm =
      (rate_radps > 0 ? parameters_.stall_positive_nm : parameters_.stall_negative_nm)
          .At(position_rad);
  return rate_radps * std::sqrt(std::max(0.0, 1 - against_nm / stall_nm));
}

double LoadFriction::DriveFriction(double rate_radps) {
  // Friction at the rate of the start of the step, limited to what brings the joint to rest.
  const double x = slid_radps_ / parameters_.slide_stribeck_radps;
  const double lost = parameters_.lost_radps * (1 + (parameters_.breakaway - 1) * std::exp(-x * x));
  const double without = rate_radps + slide_keeps_ * (slid_radps_ - rate_radps);
  const double left = std::abs(without) - (1 - slide_keeps_) * lost;
  slid_radps_ = left > 0 ? std::copysign(left, without) : 0.0;
  return slid_radps_;
}

void LoadFriction::Swing(double towards, double* value, double* change) const {
  // With constant input over the step, e = x - u obeys e'' + 2 z w e' + w^2 e = 0.
  const double w = parameters_.flex_radps, z = parameters_.flex_damping;
  const double damped = w * std::sqrt(1 - z * z);
  const double e = *value - towards, de = *change;
  *value = towards + flex_cos_ * e + flex_sin_ * (de + z * w * e) / damped;
  *change = flex_cos_ * de - flex_sin_ * (w * w * e + z * w * de) / damped;
}

double LoadFriction::Flex(double rate_radps, double load_nm) {
  Swing(rate_radps, &flexed_radps_, &flexed_change_radps2_);
  if (parameters_.compliance_radpnm == 0) return flexed_radps_;
  const double bent_rad = -parameters_.compliance_radpnm * load_nm;
  if (!bent_rad_) bent_rad_ = bent_rad;
  const double before_rad = *bent_rad_;
  Swing(bent_rad, &*bent_rad_, &bending_radps_);
  return flexed_radps_ + (*bent_rad_ - before_rad) / dt_s_;
}

AxisFriction LoadFriction::Friction(double rate_radps) const {
  double both = parameters_.coulomb_nm;
  if (parameters_.stribeck_nm > 0) {
    const double x = rate_radps / parameters_.stribeck_radps;
    both += parameters_.stribeck_nm * std::exp(-x * x);
  }
  double viscous_nmsprad = parameters_.viscous_nmsprad;
  if (rate_radps > 0) viscous_nmsprad += parameters_.more_positive_nmsprad;
  if (rate_radps < 0) viscous_nmsprad += parameters_.more_negative_nmsprad;
  return {both + parameters_.more_positive_nm, both + parameters_.more_negative_nm,
          viscous_nmsprad};
}

}  // namespace tera
