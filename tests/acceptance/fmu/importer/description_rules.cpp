#include "tests/acceptance/fmu/importer/description_rules.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "host_sim/process/regular_expression.hpp"

namespace sonoglide::acceptance {

std::vector<std::string> children(const Tree& element) {
  std::vector<std::string> names;
  for (const auto& [name, child] : element) {
    if (name != "<xmlattr>") {
      names.push_back(name);
    }
  }
  return names;
}

namespace {

using Names = std::set<std::string>;

/// What an element must have, and what it may have besides.
struct Attributes {
  Names required;
  Names optional;
};
using Elements = std::map<std::string, Attributes>;

Names operator+(Names a, const Names& b) {
  a.insert(b.begin(), b.end());
  return a;
}

const Names about_the_model = {"description",
                               "author",
                               "version",
                               "copyright",
                               "license",
                               "generationTool",
                               "generationDateAndTime",
                               "variableNamingConvention"};
const Names of_a_number = {"declaredType", "quantity", "min", "max", "start"};
const Names of_a_real = {"unit",       "displayUnit", "relativeQuantity", "unbounded", "nominal",
                         "derivative", "reinit"};

Elements common_elements() {
  return {{"UnitDefinitions", {}},
          {"Unit", {{"name"}, {}}},
          {"BaseUnit", {{}, {"kg", "m", "s", "A", "K", "mol", "cd", "rad", "factor", "offset"}}},
          {"LogCategories", {}},
          {"Category", {{"name"}, {"description"}}},
          {"DefaultExperiment", {{}, {"startTime", "stopTime", "tolerance", "stepSize"}}},
          {"ModelVariables", {}},
          {"ModelStructure", {}}};
}

/// FMI 3.0, sections 2.4.1 to 2.4.8 and 4.3.
Elements elements_of_version_3() {
  const Names required = {"name", "valueReference"};
  const Names any = {
      "description",        "causality", "variability", "canHandleMultipleSetPerTimeInstant",
      "intermediateUpdate", "previous",  "clocks"};
  const Names real = any + of_a_number + of_a_real + Names{"initial"};
  const Attributes unknown = {{"valueReference"}, {"dependencies", "dependenciesKind"}};
  Elements elements = common_elements();
  elements.merge(Elements{
      {"fmiModelDescription", {{"fmiVersion", "modelName", "instantiationToken"}, about_the_model}},
      {"CoSimulation",
       {{"modelIdentifier"},
        {"needsExecutionTool", "canBeInstantiatedOnlyOncePerProcess", "canGetAndSetFMUState",
         "canSerializeFMUState", "providesDirectionalDerivatives", "providesAdjointDerivatives",
         "providesPerElementDependencies", "canHandleVariableCommunicationStepSize",
         "fixedInternalStepSize", "maxOutputDerivativeOrder",
         "recommendedIntermediateInputSmoothness", "providesIntermediateUpdate",
         "mightReturnEarlyFromDoStep", "canReturnEarlyAfterIntermediateUpdate", "hasEventMode",
         "providesEvaluateDiscreteStates"}}},
      {"Float64", {required, real}},
      {"Float32", {required, real}},
      {"Int32", {required, any + of_a_number + Names{"initial"}}},
      {"String", {required, any + Names{"declaredType", "initial"}}},
      {"Output", unknown},
      {"InitialUnknown", unknown}});
  return elements;
}

/// FMI 2.0.4, sections 2.2.1 to 2.2.8 and 4.3.1.
Elements elements_of_version_2() {
  Elements elements = common_elements();
  elements.merge(Elements{
      {"fmiModelDescription",
       {{"fmiVersion", "modelName", "guid"}, about_the_model + Names{"numberOfEventIndicators"}}},
      {"CoSimulation",
       {{"modelIdentifier"},
        {"needsExecutionTool", "canHandleVariableCommunicationStepSize", "canInterpolateInputs",
         "maxOutputDerivativeOrder", "canRunAsynchronuously", "canBeInstantiatedOnlyOncePerProcess",
         "canNotUseMemoryManagementFunctions", "canGetAndSetFMUstate", "canSerializeFMUstate",
         "providesDirectionalDerivative"}}},
      {"ScalarVariable",
       {{"name", "valueReference"},
        {"description", "causality", "variability", "initial",
         "canHandleMultipleSetPerTimeInstant"}}},
      {"Real", {{}, of_a_number + of_a_real}},
      {"Integer", {{}, of_a_number}},
      {"String", {{}, {"declaredType", "start"}}},
      {"Outputs", {}},
      {"InitialUnknowns", {}},
      {"Unknown", {{"index"}, {"dependencies", "dependenciesKind"}}}});
  return elements;
}

void check_elements(const std::string& name, const Tree& element, const Elements& known) {
  const auto found = known.find(name);
  ASSERT_NE(found, known.end()) << "no element " << name;
  const auto& [required, optional] = found->second;
  for (const std::string& each : required) {
    EXPECT_NE(attribute_of(element, each), "") << name << " has no " << each;
  }
  for (const auto& [part, inside] : element) {
    if (part != "<xmlattr>") {
      check_elements(part, inside, known);
      continue;
    }
    for (const auto& [attribute, value] : inside) {
      EXPECT_EQ(required.count(attribute) + optional.count(attribute), 1U)
          << name << " cannot have " << attribute;
    }
  }
}

bool matches(const std::string& text, const std::string& expression) {
  return !process::RegularExpression(expression).match(text).empty();
}

/// A reference fits 32 bits, and a start value is of its type.
void check_numbers(const std::string& type, const std::string& reference,
                   const std::string& start) {
  EXPECT_TRUE(matches(reference, "[0-9]{1,9}")) << reference;
  const bool whole = type == "Int32" || type == "Integer";
  const char* const number = whole ? "-?[0-9]+" : "-?[0-9]+(\\.[0-9]+)?(e[-+]?[0-9]+)?";
  EXPECT_TRUE(start.empty() || matches(start, number)) << start;
}

void check_log_categories(const Tree& categories) {
  Names names;
  for (const auto& [name, category] : categories) {
    EXPECT_TRUE(names.insert(attribute_of(category, "name")).second) << "once";
  }
}

/// Names, references, causality, variability, start values and units of the variables.
void check_variables(const Tree& root, bool version_2) {
  std::set<std::string> names;
  std::set<std::string> references;
  std::set<std::string> units;
  for (const auto& [name, unit] : root.get_child("UnitDefinitions")) {
    EXPECT_TRUE(units.insert(attribute_of(unit, "name")).second);
  }
  int independents = 0;
  for (const auto& [type, variable] : root.get_child("ModelVariables")) {
    const std::string name = attribute_of(variable, "name");
    SCOPED_TRACE(name);
    EXPECT_TRUE(names.insert(name).second);
    EXPECT_TRUE(references.insert(attribute_of(variable, "valueReference")).second);
    EXPECT_TRUE(matches(name, "[A-Za-z_][A-Za-z0-9_]*(\\.[A-Za-z_]\\w*)*"));
    const Tree& typed = version_2 ? variable.get_child(children(variable).at(0)) : variable;
    const std::string real_type = version_2 ? children(variable).at(0) : type;
    EXPECT_TRUE(version_2
                    ? (std::set<std::string>{"Real", "Integer", "String"}.count(real_type) == 1)
                    : (std::set<std::string>{"Float64", "Float32", "Int32", "String"}.count(
                           real_type) == 1));
    const std::string causality = attribute_of(variable, "causality");
    const std::string variability = attribute_of(variable, "variability");
    const std::string start = attribute_of(typed, "start");
    check_numbers(real_type, attribute_of(variable, "valueReference"), start);
    if (causality == "independent") {
      ++independents;
      EXPECT_EQ(variability, "continuous");
      EXPECT_EQ(start, "");
    } else if (causality == "parameter") {
      EXPECT_EQ(variability, "fixed");
      EXPECT_NE(start, "");
    } else if (causality == "input") {
      EXPECT_EQ(variability, "discrete");
      EXPECT_NE(start, "");
    } else {
      EXPECT_EQ(causality, "output");
      EXPECT_EQ(variability, "discrete");
      EXPECT_EQ(start, "") << "it is calculated";
    }
    EXPECT_EQ(attribute_of(variable, "initial"), "") << "the default is right";
    if (!attribute_of(typed, "unit").empty()) {
      EXPECT_EQ(units.count(attribute_of(typed, "unit")), 1U);
      EXPECT_TRUE(real_type != "Int32" && real_type != "Integer" && real_type != "String");
    }
  }
  EXPECT_EQ(independents, 1);
}

}  // namespace

void check_description(const Tree& root, bool version_2) {
  check_elements("fmiModelDescription", root,
                 version_2 ? elements_of_version_2() : elements_of_version_3());
  check_log_categories(root.get_child("LogCategories"));
  EXPECT_TRUE(matches(attribute_of(root.get_child("CoSimulation"), "modelIdentifier"),
                      "[A-Za-z_][A-Za-z0-9_]*"));
  check_variables(root, version_2);
}

}  // namespace sonoglide::acceptance
