#include "sim/machine_doubts.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "own_folder.h"
#include "sim/scene_assembly.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A link by its mass, its three equal moments and its drawn geometry.
std::string LinkText(const std::string& name, double mass_kg, double moment_kgm2,
                     const std::string& geometry) {
  const std::string i = fmt::format("{}", moment_kgm2);
  return "<link name=\"" + name + "\"><inertial><mass value=\"" + std::to_string(mass_kg) +
         "\"/><inertia ixx=\"" + i + "\" iyy=\"" + i + "\" izz=\"" + i +
         "\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial><visual><origin xyz=\"1 0 0\" rpy=\"0 0 "
         "1.5707963267948966\"/><geometry>" +
         geometry + "</geometry></visual></link>";
}

std::string Base() { return LinkText("base", 900, 900, R"(<box size="4 2.5 1"/>)"); }

std::string JointText(const std::string& type, const std::string& child,
                      const std::string& parent = "base") {
  return "<joint name=\"to_" + child + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child +
         "\"/><origin xyz=\"0 0 0.8\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" "
         "effort=\"500\" velocity=\"1\"/></joint>";
}

Scenario ReadMachineOf(const std::string& links, const std::string& keys = "fixed_base: true\n") {
  const std::filesystem::path folder = OwnFolder();
  std::ofstream(folder / "m.urdf") << "<robot name=\"m\">" << links << "</robot>";
  std::ofstream(folder / "m.yaml") << "kind: m\nurdf: m.urdf\n" << keys;
  const Config config = Config::FromText(
      "name: t\nduration_s: 1\nterrain: {size_m: [10, 10], cell_m: 0.2, soil: asphalt}\nmachines:\n"
      "  - {name: m1, machine: " +
          (folder / "m.yaml").string() + ", start: {yaw_deg: 30}, operator: {type: idle}}\n",
      "s.yaml");
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

std::vector<std::string> DoubtsWith(const std::string& links,
                                    const std::string& keys = "fixed_base: true\n") {
  const Scenario scenario = ReadMachineOf(links, keys);
  const SceneAssembly assembly(scenario);
  return DoubtsOf(scenario.machines[0], assembly.model());
}

/// An axis-aligned box as OBJ, from the origin.
void WriteBox(const std::string& file, const Vec3& size) {
  std::ofstream obj(OwnFolder() / file);
  for (int k = 0; k < 8; ++k) {
    obj << "v " << (k & 4 ? size.x() : 0) << ' ' << (k & 2 ? size.y() : 0) << ' '
        << (k & 1 ? size.z() : 0) << '\n';
  }
  obj << "f 1 2 4\nf 1 4 3\nf 5 7 8\nf 5 8 6\nf 1 5 6\nf 1 6 2\nf 3 4 8\nf 3 8 7\n";
}

TEST(MachineDoubts, MassAndSizeOfALinkAreThoseOfWhatItShows) {
  const Scenario scenario = ReadMachineOf(Base());
  const SceneAssembly assembly(scenario);
  const std::vector<LinkSize> sizes = SizesOf(scenario.machines[0], assembly.model());
  ASSERT_EQ(sizes.size(), 1u);
  EXPECT_EQ(sizes[0].name, "base");
  EXPECT_DOUBLE_EQ(sizes[0].mass_kg, 900);
  // The box is rotated by a right angle.
  EXPECT_TRUE(sizes[0].size_m.isApprox(Vec3(2.5, 4, 1), 1e-6)) << sizes[0].size_m.transpose();
}

TEST(MachineDoubts, AGyrationBeyondWhatIsDrawnCannotBeMeant) {
  // The diagonal of 4 x 2.5 x 1.5 m is 4.95 m: no axis through a body in it has a radius of
  // gyration above 2.47 m, which 30 kg reach with 184 kg m2.
  const auto upper = [](double moment_kgm2) {
    return Base() + LinkText("upper", 30, moment_kgm2, R"(<box size="4 2.5 1.5"/>)") +
           JointText("revolute", "upper");
  };
  EXPECT_THAT(DoubtsWith(upper(183)), IsEmpty());
  EXPECT_THAT(DoubtsWith(upper(185)),
              ElementsAre("m1, link upper: 30 kg, and its inertia (radius of gyration 2.48 m) is "
                          "that of a body larger than its meshes (2.5 x 4 x 1.5 m): "
                          "placeholders?"));
}

TEST(MachineDoubts, LinksThatAreFixedTogetherAreOneBody) {
  // Neither fits its own box: a link fixed to the massive one carries the drawing of a long arm.
  const std::string arm = LinkText("arm", 180, 300, R"(<box size="0.2 0.2 0.2"/>)") +
                          LinkText("shell", 1, 0.001, R"(<box size="5 0.5 0.5"/>)") +
                          JointText("revolute", "arm") + JointText("fixed", "shell", "arm");
  EXPECT_THAT(DoubtsWith(Base() + arm), IsEmpty());
}

TEST(MachineDoubts, MillimetresAreTakenForMetresAndToldWithTheMesh) {
  WriteBox("box.obj", Vec3(4000, 2500, 1500));
  const auto upper = [](const std::string& scale) {
    return Base() +
           LinkText("upper", 900, 900, "<mesh filename=\"box.obj\" scale=\"" + scale + "\"/>") +
           JointText("continuous", "upper");
  };
  EXPECT_THAT(
      DoubtsWith(upper("1 1 1")),
      ElementsAre("m1, link upper is 4000 m long: is box.obj in mm? scale: 0.001 (in a URDF "
                  "scale=\"0.001 0.001 0.001\")"));
  EXPECT_THAT(DoubtsWith(upper("0.001 0.001 0.001")), IsEmpty());
  EXPECT_THAT(DoubtsWith(upper("0.000001 0.000001 0.000001")),
              testing::Contains(AllOf(HasSubstr("m1, link upper: 900 kg"), HasSubstr("gyration"))));
  const std::string small = Base() +
                            LinkText("upper", 900, 1e-9, R"(<box size="0.004 0.002 0.001"/>)") +
                            JointText("continuous", "upper");
  EXPECT_THAT(DoubtsWith(small), ElementsAre(HasSubstr("denser than any metal")));
}

TEST(MachineDoubts, AMachineLighterThanAirIsMadeOfPlaceholders) {
  // 0.06 kg in 10 m3.
  EXPECT_THAT(DoubtsWith(LinkText("base", 0.06, 0.06, R"(<box size="4 2.5 1"/>)")),
              ElementsAre("m1: 0.06 kg in all, less than the air in 2.5 x 4 x 1 m: placeholders?"));
  // Twice the mass of 10 m3 of air.
  EXPECT_THAT(DoubtsWith(LinkText("base", 24, 24, R"(<box size="4 2.5 1"/>)")), IsEmpty());
}

TEST(MachineDoubts, ALinkDenserThanAnyMetalIsToldWhereverItIs) {
  // 12 m3 of osmium weigh 271 t.
  const auto upper = [](double mass_kg) {
    return Base() + LinkText("upper", mass_kg, mass_kg, R"(<box size="4 2 1.5"/>)") +
           JointText("revolute", "upper");
  };
  EXPECT_THAT(DoubtsWith(upper(299e3)), IsEmpty());
  EXPECT_THAT(DoubtsWith(upper(800e3)),
              ElementsAre("m1, link upper: 8e+05 kg in 2 x 4 x 1.5 m, denser than any metal: are "
                          "its meshes too small?"));
  const std::string block = LinkText("block", 300, 9, R"(<box size="0.2 0.2 0.2"/>)");
  EXPECT_THAT(DoubtsWith(Base() + block + JointText("fixed", "block")),
              ElementsAre(AllOf(HasSubstr("m1, link block: 300 kg"), HasSubstr("denser"))));
}

TEST(MachineDoubts, TheInertiaOfAPointIsAPlaceholder) {
  // Half the diagonal is 2.47 m, a hundredth of it squared and times 500 kg 0.306 kg m2.
  const auto upper = [](double moment_kgm2) {
    return Base() + LinkText("upper", 500, moment_kgm2, R"(<box size="4 2.5 1.5"/>)") +
           JointText("revolute", "upper");
  };
  EXPECT_THAT(DoubtsWith(upper(0.31)), IsEmpty());
  EXPECT_THAT(DoubtsWith(upper(0.001)),
              ElementsAre("m1, link upper: 500 kg, and its inertia (radius of gyration 0.00141 m) "
                          "is that of a point inside its meshes (2.5 x 4 x 1.5 m): "
                          "placeholder?"));
}

TEST(MachineDoubts, LimitsInDegreesAndLimitsThatHoldAJointAreTold) {
  const auto with = [](const std::string& type, const std::string& limit) {
    return DoubtsWith(
        Base() + LinkText("arm", 90, 90, R"(<box size="4 2.5 1"/>)") +
        "<joint name=\"to_arm\" type=\"" + type +
        "\"><parent link=\"base\"/><child link=\"arm\"/><axis xyz=\"0 0 1\"/><limit " + limit +
        "/></joint>");
  };
  EXPECT_THAT(with("revolute", R"(lower="-45" upper="60" effort="500" velocity="1")"),
              ElementsAre("m1, joint to_arm has limits of -45 to 60 rad (17 turns): in degrees? "
                          "URDF takes radians"));
  EXPECT_THAT(with("revolute", R"(lower="-6.28" upper="6.28" effort="500" velocity="1")"),
              IsEmpty());
  EXPECT_THAT(with("revolute", R"(lower="0" upper="0" effort="500" velocity="1")"), IsEmpty());
  EXPECT_THAT(with("revolute", R"(lower="0" upper="0" effort="500" velocity="0")"),
              ElementsAre(HasSubstr("m1, joint to_arm cannot move: its limits are both 0 rad")));
  EXPECT_THAT(with("prismatic", R"(lower="0" upper="8" effort="5000" velocity="1")"), IsEmpty());
}

TEST(MachineDoubts, ACentreOfMassFarBesideTheLinkIsTold) {
  const auto at = [](const std::string& xyz) {
    std::string base = Base();
    return DoubtsWith(base.insert(base.find("<mass"), "<origin xyz=\"" + xyz + "\"/>"));
  };
  EXPECT_THAT(at("85 0 10"), ElementsAre(HasSubstr("its centre of mass lies 8")));
  EXPECT_THAT(at("1.5 0 -0.6"), IsEmpty());  // a counterweight below the drawn parts
}

TEST(MachineDoubts, WhatBearsOnNothingFalls) {
  EXPECT_THAT(DoubtsWith(Base(), ""),
              ElementsAre("m1 touches nothing and will fall: no tracks, wheels or hull_points; "
                          "give it these, or fixed_base: true"));
  EXPECT_THAT(DoubtsWith(Base(), "hull_points: [{link: base, points_m: [[1, 0, -0.5]]}]\n"),
              IsEmpty());
  std::string wheels;
  for (const char* name : {"left", "right"}) {
    wheels += LinkText(name, 20, 1, R"(<cylinder radius="0.4" length="0.2"/>)") +
              JointText("continuous", name);
  }
  EXPECT_THAT(DoubtsWith(Base() + wheels, ""),
              ElementsAre(HasSubstr("are to_left, to_right wheels?")));
}

TEST(MachineDoubts, NoMachineThatIsShippedHasAny) {
  for (const char* name : {"tb235", "excavator20t", "dozer", "warthog", "fixed_arm", "mast"}) {
    const Config config = Config::FromText(
        std::string("name: t\nduration_s: 1\nterrain: {size_m: [10, 10], cell_m: 0.2, soil: dirt}\n"
                    "machines:\n  - {name: m1, machine: tera:config/machines/") +
            name + ".yaml, operator: {type: idle}}\n",
        "s.yaml");
    const Scenario scenario = ReadScenario(config.root());
    config.Finish();
    const SceneAssembly assembly(scenario);
    EXPECT_THAT(DoubtsOf(scenario.machines[0], assembly.model()), IsEmpty()) << name;
  }
}

}  // namespace
}  // namespace tera
