#include "physics/physics_world.h"
#include <chrono>
#include <cstdio>
#include "core/units.h"
namespace tera {
TEST(Smoke, Runs) {
  Config c = Config::FromFile(DataRoot() / "config/machines/tb235.yaml");
  MachineModel m = ReadMachine(c.root());
  c.Finish();
  std::printf("mass %.3f\n", m.TotalMass_kg());
  MachinePlacement p{"a", m, MakePose(Vec3(1, 2, 3), 0.1, 0.2, 0.3), {}};
  for (auto& j : m.joints) p.q_rad.push_back(j.initial_rad);
  PhysicsWorld w({p}, {}, 9.81);
  MachineInput in;
  in.levers = {0, 0, 0.3, 0, 0.6, 0, 0, 0};
  in.soil.link_wrench.resize(m.links.size());
  auto t0 = std::chrono::steady_clock::now();
  for (int i = 0; i < 500; ++i) {
    const auto& s = w.machines()[0];
    if (i % 50 == 0) {
      std::printf("%d z %.4f vz %.4f az %.4f", i, s.links[0].X_WB.translation().z(), s.links[0].v_WB_mps.z(), s.links[0].a_WB_mps2.z());
      for (size_t k = 0; k < m.joints.size(); ++k) std::printf(" | %.4f %.3f %.0f", s.q_rad[k], s.qd_radps[k], s.effort_nm[k]);
      std::printf("\n");
    }
    w.Step({in}, {}, 0.002);
  }
  for (int i = 0; i < 5000; ++i) w.Step({in}, {}, 0.002);
  double us = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count() * 1e6 / 5500;
  std::printf("%.2f us/step = %.0f x\n", us, 2000 / us);
}
}
