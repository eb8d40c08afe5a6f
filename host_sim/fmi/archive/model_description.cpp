#include "host_sim/fmi/archive/make_fmu.hpp"

#include <fmt/format.h>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "host_sim/fmi/variables.hpp"

namespace sonoglide::fmi {
namespace {

using Tree = boost::property_tree::ptree;

template <class Value>
void attribute(Tree& element, const std::string& name, const Value& value) {
  element.put(Tree::path_type("<xmlattr>/" + name, '/'), value);
}

std::string exact(double value) {
  return fmt::format("{}", value);
}

struct UnitPowers {
  std::string_view unit;
  int kg;
  int m;
  int s;
  int A;
};

/// Powers of the base units of the SI.
constexpr std::array<UnitPowers, 15> units = {{{"1", 0, 0, 0, 0},
                                               {"N.s/m", 1, 0, -1, 0},
                                               {"N/m", 1, 0, -2, 0},
                                               {"N/V", 0, -1, 1, 1},
                                               {"N/s", 1, 1, -3, 0},
                                               {"m/s", 0, 1, -1, 0},
                                               {"s/m", 0, -1, 1, 0},
                                               {"1/m", 0, -1, 0, 0},
                                               {"kg", 1, 0, 0, 0},
                                               {"Hz", 0, 0, -1, 0},
                                               {"N", 1, 1, -2, 0},
                                               {"V", 1, 2, -3, -1},
                                               {"A", 0, 0, 0, 1},
                                               {"F", -1, -2, 4, 2},
                                               {"m", 0, 1, 0, 0}}};
constexpr UnitPowers second = {"s", 0, 0, 1, 0};

Tree unit_element(const UnitPowers& unit) {
  Tree powers;
  attribute(powers, "kg", unit.kg);
  attribute(powers, "m", unit.m);
  attribute(powers, "s", unit.s);
  attribute(powers, "A", unit.A);
  Tree element;
  attribute(element, "name", std::string(unit.unit));
  element.add_child("BaseUnit", powers);
  return element;
}

/// Those that a variable has.
Tree unit_definitions(const std::vector<Variable>& variables) {
  std::set<std::string> used;
  for (const Variable& variable : variables) {
    used.insert(variable.unit);
  }
  Tree definitions;
  for (const UnitPowers& unit : units) {
    if (used.count(std::string(unit.unit)) > 0) {
      definitions.add_child("Unit", unit_element(unit));
    }
  }
  definitions.add_child("Unit", unit_element(second));
  return definitions;
}

Tree log_categories() {
  Tree categories;
  Tree category;
  attribute(category, "name", "logStatusError");
  attribute(category, "description", "A call that failed, and why");
  categories.add_child("Category", category);
  return categories;
}

/// No carrier period of the scene is shorter: at most one ends in each step. What a controller
/// follows stays within 6 % of the start, and a frequency is rounded by 1/128 of itself at most.
double shortest_period_s(const scene::Scene& scene) {
  constexpr double margin = 1.07;
  double highest_Hz = scene.drive->frequency_Hz;
  for (const scene::TimedValue& row : scene.drive->frequency_profile) {
    highest_Hz = std::max(highest_Hz, row.value);
  }
  return 1.0 / (scene.carrier_changes() ? margin * highest_Hz : highest_Hz);
}

Tree default_experiment(const scene::Scene& scene) {
  Tree experiment;
  attribute(experiment, "startTime", "0");
  attribute(experiment, "stopTime", exact(scene.run.duration_s));
  attribute(experiment, "stepSize", exact(shortest_period_s(scene)));
  return experiment;
}

const char* causality(Role role) {
  switch (role) {
    case Role::time:
      return "independent";
    case Role::parameter:
      return "parameter";
    case Role::input:
      return "input";
    case Role::output:
      break;
  }
  return "output";
}

/// A wave has no value between two carrier periods: inputs and outputs hold for one.
const char* variability(Role role) {
  return role == Role::time ? "continuous" : role == Role::parameter ? "fixed" : "discrete";
}

bool has_start(Role role) {
  return role == Role::parameter || role == Role::input;
}

std::string start_of(const Variable& variable) {
  return variable.type() == Type::int32 ? fmt::format("{}", std::get<std::int32_t>(variable.start))
                                        : exact(std::get<double>(variable.start));
}

void describe(Tree& element, const Variable& variable, std::size_t reference) {
  attribute(element, "name", variable.name);
  attribute(element, "valueReference", reference);
  attribute(element, "description", variable.description);
  attribute(element, "causality", causality(variable.role));
  attribute(element, "variability", variability(variable.role));
}

/// A number's type has the unit and the start value.
void add_unit_and_start(Tree& element, const Variable& variable) {
  const bool is_real = variable.type() == Type::float64 || variable.type() == Type::float32;
  if (is_real && !variable.unit.empty()) {
    attribute(element, "unit", variable.unit);
  }
  if (has_start(variable.role)) {
    attribute(element, "start", start_of(variable));
  }
}

/// Outputs hold from one carrier period to the next: they depend on nothing at the same time. Their
/// first values depend on the parameters.
/// @param place  name of the attribute that tells a variable, counted from `first` on
std::vector<Tree> unknowns(const std::vector<Variable>& variables, std::string_view structure,
                           const char* place, std::size_t first) {
  std::string parameters;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (variables[i].role == Role::parameter) {
      parameters += fmt::format("{}{}", parameters.empty() ? "" : " ", first + i);
    }
  }
  std::vector<Tree> elements;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (variables[i].role == Role::output) {
      Tree element;
      attribute(element, place, first + i);
      attribute(element, "dependencies", structure == "Output" ? std::string() : parameters);
      elements.push_back(element);
    }
  }
  return elements;
}

class Fmi3 {
 public:
  static constexpr const char* version = "3.0";
  static constexpr const char* token_name = "instantiationToken";
  static constexpr const char* state_name = "FMUState";

  static void describe_stepping(Tree& element, const scene::Scene& scene, loop::Kind kind) {
    if (!scene.carrier_changes()) {
      attribute(element, "fixedInternalStepSize", exact(1.0 / scene.drive->frequency_Hz));
    }
    attribute(element, "mightReturnEarlyFromDoStep", loop::has_controller(kind) ? "true" : "false");
  }

  static void add(Tree& list, const Variable& variable, std::size_t reference) {
    constexpr std::array names = {"Float64", "Float32", "Int32", "String"};
    Tree element;
    describe(element, variable, reference);
    add_unit_and_start(element, variable);
    list.add_child(names[static_cast<std::size_t>(variable.type())], element);
  }

  static Tree structure(const std::vector<Variable>& variables) {
    Tree structure;
    for (const char* name : {"Output", "InitialUnknown"}) {
      for (const Tree& unknown : unknowns(variables, name, "valueReference", 0)) {
        structure.add_child(name, unknown);
      }
    }
    return structure;
  }
};

class Fmi2 {
 public:
  static constexpr const char* version = "2.0";
  static constexpr const char* token_name = "guid";
  static constexpr const char* state_name = "FMUstate";

  static void describe_stepping(Tree& /*element*/, const scene::Scene& /*scene*/,
                                loop::Kind /*kind*/) {}

  static void add(Tree& list, const Variable& variable, std::size_t reference) {
    constexpr std::array names = {"Real", "Real", "Integer", "String"};
    Tree element;
    describe(element, variable, reference);
    Tree type;
    add_unit_and_start(type, variable);
    element.add_child(names[static_cast<std::size_t>(variable.type())], type);
    list.add_child("ScalarVariable", element);
  }

  static Tree structure(const std::vector<Variable>& variables) {
    Tree structure;
    for (const auto& [list, name] :
         {std::pair("Outputs", "Output"), std::pair("InitialUnknowns", "InitialUnknown")}) {
      Tree elements;
      for (const Tree& unknown : unknowns(variables, name, "index", 1)) {
        elements.add_child("Unknown", unknown);
      }
      structure.add_child(list, elements);
    }
    return structure;
  }
};

template <class Interface>
Tree describe(const configure::Experiment& experiment, loop::Kind kind, const ModelFacts& facts) {
  const scene::Scene& scene = experiment.plant;
  const std::vector<Variable> list = variables(experiment, kind);
  Tree model;
  attribute(model, "fmiVersion", Interface::version);
  attribute(model, "modelName", facts.name);
  attribute(model, Interface::token_name, facts.token);
  attribute(model, "generationTool", facts.tool);
  attribute(model, "variableNamingConvention", "structured");
  Tree stepping;
  attribute(stepping, "modelIdentifier", facts.identifier);
  attribute(stepping, "canHandleVariableCommunicationStepSize", "true");
  attribute(stepping, std::string("canGetAndSet") + Interface::state_name, "true");
  attribute(stepping, std::string("canSerialize") + Interface::state_name, "true");
  Interface::describe_stepping(stepping, scene, kind);
  model.add_child("CoSimulation", stepping);
  model.add_child("UnitDefinitions", unit_definitions(list));
  model.add_child("LogCategories", log_categories());
  model.add_child("DefaultExperiment", default_experiment(scene));
  Tree elements;
  for (std::size_t i = 0; i < list.size(); ++i) {
    Interface::add(elements, list[i], i);
  }
  model.add_child("ModelVariables", elements);
  model.add_child("ModelStructure", Interface::structure(list));
  Tree root;
  root.add_child("fmiModelDescription", model);
  return root;
}

}  // namespace

std::string model_description(const configure::Experiment& experiment, loop::Kind kind,
                              Version version, const ModelFacts& facts) {
  const Tree root = version == Version::fmi3 ? describe<Fmi3>(experiment, kind, facts)
                                             : describe<Fmi2>(experiment, kind, facts);
  std::ostringstream text;
  boost::property_tree::write_xml(
      text, root, boost::property_tree::xml_writer_make_settings<std::string>(' ', 2));
  return text.str();
}

}  // namespace sonoglide::fmi
