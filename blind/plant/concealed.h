#pragma once

#include <map>
#include <string>
#include <vector>

#include "blind/plant/excavator.h"
#include "blind/plant/plant.h"
#include "core/random.h"

namespace tera::blind {

/// How much an effect changes.
enum class Strength { kStrong, kMedium, kFaint };
std::string_view NameOf(Strength strength);

/// One thing that the scenario does not know of.
struct Concealed {
  std::string target;                   ///< joint, or base
  std::string name;                     ///< the answer wanted; empty: nothing that the tool knows
  std::vector<std::string> alike;       ///< names that say the same of this form
  std::vector<std::string> besides;     ///< names of what this form has in it besides
  std::string form;                     ///< what it is here, in words
  std::map<std::string, double> truth;  ///< parameters of the answer that this form comes to
  std::vector<std::string> variables;   ///< that the error depends on, any of them
  std::vector<std::string> channels;    ///< that show it, behind the machine's name
};

/// A form and what should be said of it.
struct Hidden {
  std::size_t axis = 0;
  AxisForm form;
  Concealed concealed;
};

/// Names of the effects that the tool is asked to name.
const std::vector<std::string>& NameableEffects();

/// Adds an effect of that name to a joint's form. `axis` must be one that CanHave names.
Hidden Hide(const std::string& name, Strength strength, std::size_t axis, const AxisForm& onto,
            const Excavator& excavator, const AxisValues& start_rad, const Stream& stream);
bool CanHave(std::size_t axis, const std::string& name);
/// Whether both may be on one joint: they are different parts of it.
bool GoTogether(const std::string& a, const std::string& b);

/// Adds one of the effects that the tool has no name for.
Hidden HideOutside(std::size_t axis, std::size_t other_axis, const Stream& stream);

}  // namespace tera::blind
