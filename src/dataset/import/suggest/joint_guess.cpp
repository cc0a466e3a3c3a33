#include "dataset/import/suggest/joint_guess.h"

#include <map>
#include <optional>

#include "dataset/import/suggest/doubted_numbers.h"
#include "dataset/import/suggest/rate_guess.h"

namespace tera {

JointGuesses GuessJoints(const std::vector<const NumbersOfColumn*>& columns,
                         const std::vector<TimeNs>& t_ns) {
  std::map<std::string, const NumbersOfColumn*> angle_of, rate_of;
  std::vector<const NumbersOfColumn*> angles;
  for (const NumbersOfColumn* column : columns) {
    if (const std::string joint = JointOfAngle(*column);
        !joint.empty() && angle_of.emplace(joint, column).second) {
      angles.push_back(column);
    }
    if (const std::string joint = JointOfRate(*column); !joint.empty()) {
      rate_of.emplace(joint, column);
    }
  }
  JointGuesses guesses;
  for (const NumbersOfColumn* column : columns) {
    const std::string turning = JointOfAngle(*column), turned = JointOfRate(*column);
    if (!turning.empty() && angle_of[turning] == column) {
      const auto found = rate_of.find(turning);
      const AngleGuess angle = GuessAngle(*column, angles);
      std::optional<RateColumn> rate;
      guesses.columns.push_back(column);
      if (found != rate_of.end() && found->second->gaps == column->gaps) {
        guesses.columns.push_back(found->second);
        // The rate is compared with the angle in the angle's guessed unit.
        NumbersOfColumn witness = *column;
        if (angle.unit.is_known() && angle.unit.scale == 1) witness.unit = angle.unit.unit;
        rate = {found->second->name, GuessRateUnit({found->second}, {t_ns, {}, {&witness}})};
      }
      guesses.joints.emplace_back(column, JointYaml(turning, column->name, angle, rate));
    } else if (!turned.empty() && rate_of[turned] == column && !angle_of.contains(turned)) {
      guesses.columns.push_back(column);
      guesses.joints.emplace_back(column,
                                  JointYaml(turned, {column->name, GuessRateUnit({column})}));
    }
  }
  return guesses;
}

}  // namespace tera
