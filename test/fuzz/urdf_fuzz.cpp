#include "core/config/config.h"
#include "physics/description/machine.h"
#include "untrusted_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return tera::ReadAsFile("a.urdf", data, size, [](const std::filesystem::path& file) {
    const tera::Config config =
        tera::Config::FromText("{kind: a, urdf: \"" + file.string() + "\"}", "a.yaml");
    tera::ReadMachine(config.root());
    config.Finish();
  });
}
