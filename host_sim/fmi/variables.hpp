/// The variables of an FMU: the one place that names them, for its description and for its binary.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "host_sim/fmi/content.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/stepped/engine.hpp"

namespace sonoglide::fmi {

using stepped::Engine;
using stepped::Inputs;
using stepped::PlantOutputs;

/// Alternatives in the order of Type.
using Value = std::variant<double, float, std::int32_t, std::string, bool>;
enum class Type { float64, float32, int32, string, clock };

enum class Role { time, parameter, input, output, clock };

/// What an output has to do with the clock, where the FMU has one. Every input belongs to it.
enum class Clocked {
  no,
  measured,  ///< it belongs to the clock, whatever the inputs are
  answer     ///< it belongs to the clock, and depends on the inputs of the same tick
};

/// Its value reference is its place among variables().
struct Variable {
  std::string name;  ///< of a parameter the scene's key, `table.key`
  Role role;
  std::string unit;  ///< empty where it has none
  std::string description;
  Value start;                               ///< of an output only its type counts
  double Inputs::*input = nullptr;           ///< of an input, unless it is seen
  double PlantOutputs::*seen = nullptr;      ///< of an input of a controller
  Value (*output)(const Engine&) = nullptr;  ///< of an output
  Clocked clocked = Clocked::no;             ///< of an output

  Type type() const { return static_cast<Type>(start.index()); }
};

/// @param scene  as the FMU holds it: a scene that was read from its own echo
/// @return  with a clock it is the last one
std::vector<Variable> variables(const scene::Scene& scene, Content content);

}  // namespace sonoglide::fmi
