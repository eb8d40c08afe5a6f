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
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/acceptance/fmu/importer/description.hpp"
#include "tests/acceptance/fmu/importer/description_rules.hpp"
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

using Names = std::vector<std::string>;

class FmuArchive : public testing::Test {
 protected:
  FmuArchive() { folder_.write("scene.toml", scene); }

  ScratchFolder folder_;
};

class FmuDescription : public FmuArchive, public testing::WithParamInterface<std::string> {};

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
  check_description(root, false);
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
  check_description(root, true);
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
