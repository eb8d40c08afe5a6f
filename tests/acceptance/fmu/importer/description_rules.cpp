#include "tests/acceptance/fmu/importer/description_rules.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>

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
    EXPECT_TRUE(std::regex_match(name, std::regex("[A-Za-z_][A-Za-z0-9_]*(\\.[A-Za-z_]\\w*)*")));
    const Tree& typed = version_2 ? variable.get_child(children(variable).at(0)) : variable;
    const std::string real_type = version_2 ? children(variable).at(0) : type;
    EXPECT_TRUE(
        version_2 ? (std::set<std::string>{"Real", "Integer", "String"}.count(real_type) == 1)
                  : (std::set<std::string>{"Float64", "Float32", "Int32", "String", "Clock"}.count(
                         real_type) == 1));
    const std::string causality = attribute_of(variable, "causality");
    const std::string variability = attribute_of(variable, "variability");
    const std::string start = attribute_of(typed, "start");
    if (causality == "independent") {
      ++independents;
      EXPECT_EQ(variability, "continuous");
      EXPECT_EQ(start, "");
    } else if (causality == "parameter") {
      EXPECT_EQ(variability, "fixed");
      EXPECT_NE(start, "");
    } else if (causality == "input") {
      EXPECT_EQ(variability, "discrete");
      EXPECT_EQ(start.empty(), real_type == "Clock");
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

}  // namespace sonoglide::acceptance
