#pragma once

#include <string>

namespace tera {

/// An arm of 20 kg on a fixed post, with its centre of mass 0.8 m from the pin, raised by a
/// cylinder above it. Pins 0.5 m and 1.3 m from the joint, at angles of 126.870 deg and, on the
/// arm, 22.620 deg (triangles 3-4-5 and 5-12-13). The joint's frame is off the post's by (0.2, 0.1,
/// 1.1) m and 30 deg about z.
inline const std::string kCylinderArm = R"(
kind: cylinder_arm
fixed_base: true
links:
  post: {mass_kg: 50, inertia_kgm2: [1, 1, 1]}
  arm: {mass_kg: 20, com_m: [0.8, 0, 0], inertia_kgm2: [0.2, 3.0, 3.1]}
  hook: {mass_kg: 1, inertia_kgm2: [0.01, 0.01, 0.01]}
joints:
  lift:
    type: revolute
    parent: post
    child: arm
    xyz_m: [0.2, 0.1, 1.1]
    rpy_deg: [0, 0, 30]
    axis: [0, -1, 0]
    limits_deg: [-40, 70]
    max_rate_degps: [30, 20]
    initial_deg: 14.2500327
  swivel: {type: revolute, parent: arm, child: hook, axis: [1, 0, 0], limits_deg: [-5, 5], max_effort_nm: 10}
levers: [lift]
hydraulics: {relief_pa: 20.0e6, return_pressure_pa: 0.2e6}
cylinders:
  ram:
    bore_m: 0.100
    rod_diameter_m: 0.060
    barrel: {link: post, pin_m: [-0.0598076, -0.05, 1.5]}
    rod: {link: arm, pin_m: [1.2, 0, 0.5]}
)";

}  // namespace tera
