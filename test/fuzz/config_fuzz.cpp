#include "core/config/config.h"
#include "untrusted_file.h"

// YAML as read for every configuration: anchors, merges, nesting, overrides, and messages on
// unknown keys.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return tera::ReadAsFile("a.yaml", data, size, [](const std::filesystem::path& file) {
    const tera::Config config = tera::Config::FromFile(file, {"seed=3", "machines[0].name=a"});
    config.ResolvedYaml();
    config.root().Text("name");
    for (const tera::ConfigMap& item : config.root().List("machines")) {
      item.PoseXyzRpy();
      item.OptionalMap("rig");
    }
    config.Finish();
  });
}
