#include "dataset/import/bag/bag_source.h"
#include "untrusted_file.h"

// MCAP, ROS 1 bags and SQLite 3 bags, by their first bytes, damaged and undamaged.

namespace {

/// Takes all messages of all topics, up to a number beyond any real small file.
class TakesAll : public tera::BagVisitor {
 public:
  Wish Wants(const tera::BagTopic&) override { return Wish::kTake; }
  bool Take(std::size_t, const tera::BagMessage&) override { return ++taken_ < 100'000; }

 private:
  int taken_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const bool to_the_damage : {false, true}) {
    tera::ReadAsFile("log.bag", data, size, [&](const std::filesystem::path& file) {
      TakesAll visitor;
      tera::UnpackedFiles unpacked;
      tera::ReadBag(file, &unpacked, &visitor, to_the_damage);
    });
  }
  return 0;
}
