/// What is in an FMU: its description, its shared library, its sources.
///
/// The schema files of the specification are not part of this repository: the rules that they and the
/// text state are checked here one by one, for FMI 3.0 after its sections 2.4.7 and 2.4.8, for FMI 2.0
/// after sections 2.2.7 and 2.2.8.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/property_tree/xml_parser.hpp>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/acceptance/fmu/importer/description.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance::fmu_archive_test {
namespace {

const std::string scene = table_1_closed_loop + R"([run]
duration_s = 2e-3
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4]]
[sensor]
seed = 3
)";

std::vector<std::string> children(const Tree& element) {
  std::vector<std::string> names;
  for (const auto& [name, child] : element) {
    if (name != "<xmlattr>") {
      names.push_back(name);
    }
  }
  return names;
}

using Names = std::vector<std::string>;

class FmuArchive : public testing::Test {
 protected:
  FmuArchive() { folder_.write("scene.toml", scene); }

  ScratchFolder folder_;
};

class FmuDescription : public FmuArchive, public testing::WithParamInterface<std::string> {};

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

/// The references, or the places counted from 1, of the outputs.
Names outputs_of(const Tree& root, bool version_2) {
  Names found;
  std::size_t place = 0;
  for (const auto& [type, variable] : root.get_child("ModelVariables")) {
    ++place;
    if (attribute_of(variable, "causality") == "output") {
      found.push_back(version_2 ? std::to_string(place) : attribute_of(variable, "valueReference"));
    }
  }
  return found;
}

TEST_P(FmuDescription, TheDescriptionOfVersion3KeepsTheRules) {
  make_fmu(folder_, "scene.toml", "--kind " + GetParam(), "fmu");
  const Description description(folder_, "fmu");
  const Tree& root = description.root();
  EXPECT_EQ(children(root), (Names{"CoSimulation", "UnitDefinitions", "LogCategories",
                                   "DefaultExperiment", "ModelVariables", "ModelStructure"}));
  EXPECT_EQ(description.attribute("fmiVersion"), "3.0");
  EXPECT_EQ(description.attribute("modelName"), "scene");
  EXPECT_EQ(description.stepping("fixedInternalStepSize"), "1.6666666666666667e-05");
  EXPECT_EQ(description.stepping("canSerializeFMUState"), "true");
  check_variables(root, false);
  Names outputs;
  Names initial_unknowns;
  for (const auto& [name, element] : root.get_child("ModelStructure")) {
    ASSERT_TRUE(name == "Output" || (name == "InitialUnknown" && !outputs.empty()));
    (name == "Output" ? outputs : initial_unknowns)
        .push_back(attribute_of(element, "valueReference"));
  }
  EXPECT_EQ(outputs, outputs_of(root, false));
  EXPECT_EQ(initial_unknowns, outputs_of(root, false));
}

TEST_P(FmuDescription, TheDescriptionOfVersion2KeepsTheRules) {
  make_fmu(folder_, "scene.toml", "--fmi 2 --kind " + GetParam(), "fmu");
  const Description description(folder_, "fmu");
  const Tree& root = description.root();
  EXPECT_EQ(children(root), (Names{"CoSimulation", "UnitDefinitions", "LogCategories",
                                   "DefaultExperiment", "ModelVariables", "ModelStructure"}));
  EXPECT_EQ(description.attribute("fmiVersion"), "2.0");
  EXPECT_EQ(description.stepping("canSerializeFMUstate"), "true");
  EXPECT_EQ(description.stepping("fixedInternalStepSize"), "") << "of version 3 alone";
  check_variables(root, true);
  const Tree& structure = root.get_child("ModelStructure");
  EXPECT_EQ(children(structure), (Names{"Outputs", "InitialUnknowns"}));
  for (const char* part : {"Outputs", "InitialUnknowns"}) {
    Names places;
    for (const auto& [name, element] : structure.get_child(part)) {
      places.push_back(attribute_of(element, "index"));
    }
    EXPECT_EQ(places, outputs_of(root, true)) << part;
  }
}

/// The references in a list such as `clocks` and `dependencies`.
std::set<std::string> references_in(const Tree& element, const std::string& attribute) {
  std::istringstream list(attribute_of(element, attribute));
  return {std::istream_iterator<std::string>(list), {}};
}

/// Sections 2.2.8 and 2.4.7 of FMI 3.0.
TEST_P(FmuDescription, AClockKeepsTheRules) {
  make_fmu(folder_, "scene.toml", "--clock --kind " + GetParam(), "fmu");
  const Description description(folder_, "fmu");
  const Tree& root = description.root();
  check_variables(root, false);
  EXPECT_EQ(description.stepping("hasEventMode"), "true");
  EXPECT_EQ(description.stepping("canHandleVariableCommunicationStepSize"), "false");
  const Tree& clock = description.variable("carrier_clock");
  for (const auto& [name, value] :
       std::map<std::string, std::string>{{"causality", "input"},
                                          {"variability", "discrete"},
                                          {"intervalVariability", "constant"},
                                          {"intervalDecimal", "1.6666666666666667e-05"},
                                          {"shiftDecimal", "0"},
                                          {"supportsFraction", "true"},
                                          {"resolution", "60000"},
                                          {"intervalCounter", "1"},
                                          {"shiftCounter", "0"},
                                          {"clocks", ""},
                                          {"unit", ""}}) {
    EXPECT_EQ(attribute_of(clock, name), value) << name;
  }
  const std::string reference = attribute_of(clock, "valueReference");
  std::set<std::string> inputs = {reference};
  std::map<std::string, bool> outputs;  // whether they are clocked
  int clocks = 0;
  for (const auto& [type, variable] : root.get_child("ModelVariables")) {
    clocks += type == "Clock" ? 1 : 0;
    const std::string each = attribute_of(variable, "valueReference");
    const std::string causality = attribute_of(variable, "causality");
    const std::set<std::string> named = references_in(variable, "clocks");
    EXPECT_TRUE(named.empty() || named == std::set<std::string>{reference}) << each;
    if (causality == "input") {
      inputs.insert(each);
      EXPECT_EQ(named.empty(), type == "Clock") << each;
    } else if (causality == "output") {
      outputs[each] = !named.empty();
    } else {
      EXPECT_TRUE(named.empty()) << "clocked variables are discrete";
    }
  }
  EXPECT_EQ(clocks, 1);
  std::set<std::string> listed;
  std::set<std::string> initial;
  for (const auto& [name, element] : root.get_child("ModelStructure")) {
    const std::string each = attribute_of(element, "valueReference");
    ASSERT_EQ(outputs.count(each), 1U) << "every output is there";
    EXPECT_TRUE((name == "Output" ? listed : initial).insert(each).second) << "once";
    if (name == "Output") {
      const std::set<std::string> dependencies = references_in(element, "dependencies");
      EXPECT_EQ(dependencies.count(reference) == 1, outputs[each]) << each;
      EXPECT_TRUE(
          std::includes(inputs.begin(), inputs.end(), dependencies.begin(), dependencies.end()))
          << each;
    } else {
      EXPECT_FALSE(outputs[each]) << "clocked variables have their first value at a tick";
    }
  }
  EXPECT_EQ(listed.size(), outputs.size());
  EXPECT_EQ(initial.size() + static_cast<std::size_t>(
                                 std::count_if(outputs.begin(), outputs.end(),
                                               [](const auto& output) { return output.second; })),
            outputs.size());
}

/// A plant's measured values do not depend on its drive in the same tick, or who connects it to a
/// controller would see an algebraic loop.
TEST_F(FmuArchive, OnlyTheControllersAnswersDependOnInputsOfTheSameTick) {
  for (const std::string& kind : Names{"plant", "controller"}) {
    make_fmu(folder_, "scene.toml", "--clock --kind " + kind, kind);
    const Description description(folder_, kind);
    const std::string output =
        kind == "plant" ? "mean_friction_force_N" : "drive_force_amplitude_N";
    for (const auto& [name, element] : description.root().get_child("ModelStructure")) {
      if (name == "Output" && attribute_of(element, "valueReference") ==
                                  std::to_string(description.reference(output))) {
        EXPECT_EQ(references_in(element, "dependencies").size(), kind == "plant" ? 1U : 4U);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FmuDescription, testing::Values("plant", "controller", "loop"),
                         [](const auto& kind) { return kind.param; });

TEST_F(FmuArchive, TheLibraryNeedsLibcAndLibmAndShowsTheInterfaceAlone) {
  make_fmu(folder_, "scene.toml", "--kind loop", "fmu");
  const std::string library = "fmu/binaries/" SONOGLIDE_PROCESSOR "-linux/sonoglide_loop.so";
  std::istringstream needed(folder_.run_program("readelf", "-d " + library).out);
  std::set<std::string> libraries;
  const std::regex entry(".*\\(NEEDED\\).*\\[(.*)\\]");
  std::smatch found;
  for (std::string line; std::getline(needed, line);) {
    if (std::regex_match(line, found, entry)) {
      libraries.insert(found[1]);
    }
  }
  std::set<std::string> allowed = {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2",
                                   "ld-linux-aarch64.so.1"};
  if (SONOGLIDE_SANITIZED) {
    allowed.insert({"libstdc++.so.6", "libgcc_s.so.1"});
  }
  EXPECT_TRUE(std::includes(allowed.begin(), allowed.end(), libraries.begin(), libraries.end()))
      << testing::PrintToString(libraries);
  std::istringstream symbols(folder_.run_program("nm", "-D --defined-only " + library).out);
  std::size_t functions = 0;
  for (std::string line; std::getline(symbols, line);) {
    EXPECT_TRUE(std::regex_match(line, std::regex("[0-9a-f]+ T fmi[23][A-Z].*"))) << line;
    ++functions;
  }
  EXPECT_EQ(functions, 64U + 34U);
}

TEST_F(FmuArchive, EverySourceThatTheBuildNamesIsThere) {
  make_fmu(folder_, "scene.toml", "--kind loop", "fmu");
  std::istringstream text(folder_.read("fmu/sources/buildDescription.xml"));
  Tree build;
  boost::property_tree::read_xml(text, build);
  const Tree& set = build.get_child("fmiBuildDescription.BuildConfiguration.SourceFileSet");
  const std::vector<std::string> entries = folder_.entries();
  std::size_t units = 0;
  for (const auto& [name, element] : set) {
    if (name == "SourceFile") {
      ++units;
      EXPECT_EQ(std::count(entries.begin(), entries.end(),
                           "fmu/sources/" + attribute_of(element, "name")),
                1)
          << attribute_of(element, "name");
    }
  }
  EXPECT_GT(units, 40U);
}

/// What the build description says of how a source is compiled, for g++.
std::string compiler_words(const Tree& build) {
  const Tree& set = build.get_child("fmiBuildDescription.BuildConfiguration.SourceFileSet");
  EXPECT_EQ(attribute_of(set, "language"), "C++17");
  EXPECT_EQ(attribute_of(set, "compiler"), "gcc");
  std::string words = "-std=c++17 " + attribute_of(set, "compilerOptions");
  for (const auto& [name, element] : set) {
    if (name == "PreprocessorDefinition") {
      words += " -D" + attribute_of(element, "name") + "=" + attribute_of(element, "value");
    } else if (name == "IncludeDirectory") {
      words += " -I" + attribute_of(element, "name");
    }
  }
  return words;
}

/// All sources take minutes: the one with the functions of the interface stands for them here.
TEST_F(FmuArchive, TheInterfaceCompilesAsTheBuildDescriptionSays) {
  if (SONOGLIDE_SANITIZED) {
    GTEST_SKIP() << "the compiler is no part of what sanitizers watch";
  }
  make_fmu(folder_, "scene.toml", "--kind loop", "fmu");
  std::istringstream text(folder_.read("fmu/sources/buildDescription.xml"));
  Tree build;
  boost::property_tree::read_xml(text, build);
  const Outcome compiled = folder_.run_program(
      "g++", compiler_words(build) + " -c host_sim/fmi/binary/fmi3.cpp -o fmi3.o", "fmu/sources");
  ASSERT_EQ(compiled.exit_code, 0) << compiled.err;
  std::istringstream symbols(folder_.run_program("nm", "-g --defined-only fmu/sources/fmi3.o").out);
  std::size_t functions = 0;
  for (std::string line; std::getline(symbols, line);) {
    functions += std::regex_match(line, std::regex("[0-9a-f]+ T fmi3[A-Z].*")) ? 1U : 0U;
  }
  EXPECT_EQ(functions, 64U);
}

TEST_F(FmuArchive, EveryHeaderThatASourceIncludesIsThere) {
  make_fmu(folder_, "scene.toml", "--kind loop", "fmu");
  const std::vector<std::string> entries = folder_.entries();
  const std::set<std::string> there(entries.begin(), entries.end());
  const std::regex include("#include \"(.*)\"");
  std::size_t includes = 0;
  for (const std::string& entry : entries) {
    const std::string ending = std::filesystem::path(entry).extension().string();
    if (entry.rfind("fmu/sources/", 0) != 0 || (ending != ".hpp" && ending != ".cpp")) {
      continue;
    }
    std::istringstream text(folder_.read(entry));
    std::smatch found;
    for (std::string line; std::getline(text, line);) {
      if (std::regex_match(line, found, include)) {
        ++includes;
        EXPECT_EQ(there.count("fmu/sources/" + found[1].str()), 1U) << entry << ": " << line;
      }
    }
  }
  EXPECT_GT(includes, 500U);
}

TEST_F(FmuArchive, OneSceneGivesTheSameBytesTwice) {
  ASSERT_EQ(folder_.run("fmu scene.toml --kind plant --out a.fmu").exit_code, 0);
  ASSERT_EQ(folder_.run("fmu scene.toml --kind plant --out deep/b.fmu --quiet").out, "");
  EXPECT_EQ(folder_.read("a.fmu"), folder_.read("deep/b.fmu"));
}

TEST_F(FmuArchive, WhatAnFmuCannotHoldIsRefusedAtItsPlace) {
  const auto refused = [&](const std::string& options, const std::string& message) {
    const Outcome outcome = folder_.run("fmu scene.toml --out a.fmu " + options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_EQ(folder_.entries(), Names{"scene.toml"});
  };
  refused("", "--kind is required");
  refused("--kind wheel", "--kind");
  refused("--kind loop --fmi 1", "--fmi");
  refused("--kind plant --out a.zip", "--out");
  folder_.write("scene.toml", table_1_open_loop + "[run]\nduration_s = 1e-3\n");
  refused("--kind loop",
          "controller: missing; allowed: a scene in closed loop, or the plant alone");
  refused("--kind plant --set 'drive.frequency_profile=[[0.0, 60e3], [1e-3, 61e3]]'",
          "drive.frequency_profile: changes the carrier period, which is the step; allowed: one "
          "frequency");
}

TEST_F(FmuArchive, AFileOfSomebodyElseStays) {
  folder_.write("mine.fmu", "mine");
  const Outcome outcome = folder_.run("fmu scene.toml --kind loop --out mine.fmu");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(folder_.read("mine.fmu"), "mine");
}

}  // namespace
}  // namespace sonoglide::acceptance::fmu_archive_test
