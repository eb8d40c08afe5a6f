/// The variables of an FMU: the one place that names them, for its description and for its binary.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "host_sim/loop/stepped.hpp"

namespace sonoglide::fmi {

using loop::Inputs;
using loop::PlantOutputs;
using loop::SteppedScene;

/// Alternatives in the order of Type.
using Value = std::variant<double, float, std::int32_t, std::string>;
enum class Type { float64, float32, int32, string };

enum class Role { time, parameter, input, output };

/// Its value reference is its place among variables().
struct Variable {
  std::string name;  ///< of a parameter the scene's key, `table.key`
  Role role;
  std::string unit;  ///< empty where it has none
  std::string description;
  Value start;                                     ///< of an output only its type counts
  double Inputs::*input = nullptr;                 ///< of an input, unless it is seen
  double highest = 0.0;                            ///< of a target
  double PlantOutputs::*seen = nullptr;            ///< of an input of a controller
  Value (*output)(const SteppedScene&) = nullptr;  ///< of an output

  Type type() const { return static_cast<Type>(start.index()); }
};

/// @param experiment  as the FMU holds it: of a scene that was read from its own echo
std::vector<Variable> variables(const configure::Experiment& experiment, loop::Kind kind);

}  // namespace sonoglide::fmi
