/// What is in an FMU: its description, its binaries, its licences.
///
/// The schema files of the specification are not part of this repository: the rules that they and the
/// text state are checked here one by one, for FMI 3.0 after its sections 2.4.7 and 2.4.8, for FMI 2.0
/// after sections 2.2.7 and 2.2.8.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/property_tree/xml_parser.hpp>
#include <cstddef>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/acceptance/fmu/importer/description.hpp"
#include "tests/acceptance/fmu/importer/description_rules.hpp"
#include "tests/acceptance/fmu/importer/header_functions.hpp"
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

/// The references, or the places counted from 1, of the variables of a causality.
Names places_of(const Tree& root, bool version_2, const std::string& causality) {
  Names found;
  std::size_t place = 0;
  for (const auto& [type, variable] : root.get_child("ModelVariables")) {
    ++place;
    if (attribute_of(variable, "causality") == causality) {
      found.push_back(version_2 ? std::to_string(place) : attribute_of(variable, "valueReference"));
    }
  }
  return found;
}

Names outputs_of(const Tree& root, bool version_2) {
  return places_of(root, version_2, "output");
}

/// As a list of dependencies.
std::string parameters_of(const Tree& root, bool version_2) {
  std::string list;
  for (const std::string& place : places_of(root, version_2, "parameter")) {
    list += (list.empty() ? "" : " ") + place;
  }
  return list;
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
  EXPECT_EQ(description.stepping("hasEventMode"), "") << "no clocks";
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
  for (const auto& [name, element] : root.get_child("ModelStructure")) {
    EXPECT_EQ(attribute_of(element, "dependencies"),
              name == "Output" ? "" : parameters_of(root, false));
  }
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
      EXPECT_EQ(attribute_of(element, "dependencies"),
                part == std::string("Outputs") ? "" : parameters_of(root, true));
    }
    EXPECT_EQ(places, outputs_of(root, true)) << part;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FmuDescription, testing::Values("plant", "controller", "loop"),
                         [](const auto& kind) { return kind.param; });

TEST_F(FmuArchive, TheLibraryNeedsLibcAndLibm) {
  make_fmu(folder_, "scene.toml", "--kind loop", "fmu");
  const std::string library = "fmu/binaries/" SONOGLIDE_PROCESSOR "-linux/sonoglide_loop.so";
  const std::string sections = folder_.run_program("readelf", "-d " + library).out;
  const std::set<std::string> libraries = matches_of_lines(sections, ".*\\(NEEDED\\).*\\[(.*)\\]");
  std::set<std::string> allowed = {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2",
                                   "ld-linux-aarch64.so.1"};
  if (SONOGLIDE_SANITIZED) {
    allowed.insert({"libstdc++.so.6", "libgcc_s.so.1"});
  }
  EXPECT_TRUE(std::includes(allowed.begin(), allowed.end(), libraries.begin(), libraries.end()))
      << testing::PrintToString(libraries);
}

TEST_F(FmuArchive, TheLibraryShowsAllFunctionsOfTheHeadersAndNothingElse) {
  EXPECT_EQ(header_functions().size(), 44U + 75U);
  make_fmu(folder_, "scene.toml", "--kind loop", "fmu");
  const Outcome symbols = folder_.run_program(
      "nm", "-D --defined-only fmu/binaries/" SONOGLIDE_PROCESSOR "-linux/sonoglide_loop.so");
  EXPECT_EQ(matches_of_lines(symbols.out, "[0-9a-f]+ . (.*)"), header_functions());
}

TEST_F(FmuArchive, LicencesAndWhatTheBinariesNeedAreInside) {
  for (const char* version : {"2", "3"}) {
    const std::string fmu = std::string("fmu") + version;
    make_fmu(folder_, "scene.toml", std::string("--kind plant --fmi ") + version, fmu);
    EXPECT_EQ(folder_.read(fmu + "/documentation/licenses/license.txt").rfind("MIT License", 0),
              0U);
    const std::string compiled_in = folder_.read(fmu + "/documentation/licenses/compiled_in.txt");
    for (const char* library :
         {"fmt", "toml++", "JSON for Modern C++", "Eigen", "libstdc++", "mingw-w64"}) {
      EXPECT_NE(compiled_in.find(library), std::string::npos) << library;
    }
    const std::string needed = folder_.read(fmu + "/documentation/externalDependencies.txt");
    const std::string symbols =
        folder_
            .run_program("sh", "-c 'nm -D " + fmu +
                                   "/binaries/*/*.so | grep -o GLIBC_.* | sort -Vu"
                                   " | tail -n 1'")
            .out;
    const std::string glibc = symbols.substr(6, symbols.find('\n') - 6);
    EXPECT_NE(needed.find(": glibc " + glibc + " or newer"), std::string::npos)
        << needed << symbols;
    const std::vector<std::string> entries = folder_.entries();
    EXPECT_EQ(std::count(entries.begin(), entries.end(), fmu + "/sources"), 0);
  }
}

/// U+FFFF, which XML has no character for, a control character and a quote.
TEST_F(FmuArchive, ANameThatXmlCannotHoldIsEscaped) {
  folder_.write("a\uffff\x01\"<.toml", scene);
  make_fmu(folder_, shell_word("a\uffff\x01\"<.toml"), "--kind plant", "fmu");
  EXPECT_EQ(Description(folder_, "fmu").attribute("modelName"), "a\\xef\\xbf\\xbf\\x01\"<");
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
}

TEST_F(FmuArchive, AFileOfSomebodyElseStays) {
  folder_.write("mine.fmu", "mine");
  const Outcome outcome = folder_.run("fmu scene.toml --kind loop --out mine.fmu");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(folder_.read("mine.fmu"), "mine");
}

}  // namespace
}  // namespace sonoglide::acceptance::fmu_archive_test
