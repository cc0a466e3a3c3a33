#include "sim/scenario/read_wear.h"

namespace tera {

Wear ReadWear(const ConfigMap& config, const Wear& of_all) {
  Wear wear = of_all;
  const auto given = config.OptionalMap("wear");
  if (!given) return wear;
  const auto read = [&](const char* key, double* amount) {
    *amount = given->OptionalNumber(key, Between(0, 1, "")).value_or(*amount);
  };
  read("dust", &wear.dust);
  read("mud", &wear.mud);
  read("scratches", &wear.scratches);
  read("rust", &wear.rust);
  return wear;
}

}  // namespace tera
