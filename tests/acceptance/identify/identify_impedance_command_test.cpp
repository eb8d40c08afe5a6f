/// `sonoglide identify impedance` from outside.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/acceptance/program/page_words.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::identify_impedance_command_test {
namespace {

using Entries = std::vector<std::string>;
using Complex = std::complex<double>;

constexpr double pi = 3.14159265358979323846;
constexpr double capacitance_F = 1.2e-9;
constexpr double resistance_ohm = 50.0;
constexpr double inductance_H = 40e-3;
constexpr double resonance_Hz = 60e3;

/// C0 beside R1, L1 and C1 in series.
Complex impedance_ohm(double frequency_Hz) {
  const double omega = 2.0 * pi * frequency_Hz;
  const double detuning = frequency_Hz / resonance_Hz - resonance_Hz / frequency_Hz;
  const Complex branch{resistance_ohm, 2.0 * pi * resonance_Hz * inductance_H * detuning};
  return 1.0 / (Complex{0.0, omega * capacitance_F} + 1.0 / branch);
}

/// From below the resonance to above the antiresonance, each value off by up to a thousandth.
std::vector<std::pair<double, Complex>> readings() {
  std::vector<std::pair<double, Complex>> result;
  for (int i = 0; i <= 400; ++i) {
    const double frequency_Hz = 58e3 + 20.0 * i;
    const Complex error{std::fmod(0.618034 * i, 1.0) - 0.5, std::fmod(0.754878 * i, 1.0) - 0.5};
    result.emplace_back(frequency_Hz, impedance_ohm(frequency_Hz) * (1.0 + 2e-3 * error));
  }
  return result;
}

std::string text(double number) {
  std::ostringstream stream;
  stream.precision(9);
  stream << number;
  return stream.str();
}

std::string as_table() {
  std::string result = "frequency_Hz,impedance_ohm,phase_deg\n";
  for (const auto& [frequency_Hz, value] : readings()) {
    result += text(frequency_Hz) + "," + text(std::abs(value)) + "," +
              text(std::arg(value) * 180.0 / pi) + "\n";
  }
  return result;
}

std::string as_touchstone() {
  std::string result = "! one port\n# kHz S RI R 50\n";
  for (const auto& [frequency_Hz, value] : readings()) {
    const Complex reflection = (value - 50.0) / (value + 50.0);
    result += text(frequency_Hz / 1e3) + " " + text(reflection.real()) + " " +
              text(reflection.imag()) + "\n";
  }
  return result;
}

void expect_covers(const nlohmann::json& identified, const std::string& name, double truth) {
  const auto& parameter = identified["parameters"][name];
  EXPECT_LT(parameter["low_95"].get<double>(), truth) << name;
  EXPECT_GT(parameter["high_95"].get<double>(), truth) << name;
  EXPECT_NEAR(parameter["value"].get<double>(), truth, 2e-3 * truth) << name;
}

void expect_circuit(const nlohmann::json& identified) {
  expect_covers(identified, "clamped_capacitance_F", capacitance_F);
  expect_covers(identified, "motional_resistance_ohm", resistance_ohm);
  expect_covers(identified, "motional_inductance_H", inductance_H);
  expect_covers(identified, "resonance_frequency_Hz", resonance_Hz);
}

TEST(IdentifyImpedanceCommand, WithAMassWritesASceneThatRuns) {
  ScratchFolder folder;
  folder.write("z.csv", as_table());
  const Outcome outcome = folder.run("identify impedance z.csv --mass-kg 0.01");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\nscene: out/z_impedance/scene.toml\nreport: "), std::string::npos);
  const auto identified = nlohmann::json::parse(folder.read("out/z_impedance/identify.json"));
  expect_circuit(identified);
  // m = N_f^2 L1.
  expect_covers(identified, "force_factor_N_per_V", std::sqrt(0.01 / inductance_H));

  const Outcome run = folder.run("run out/z_impedance/scene.toml --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto control = nlohmann::json::parse(run.out)["control"];
  EXPECT_TRUE(control["faults"].empty());
  for (const auto& step : control["steps"]) {
    EXPECT_TRUE(step["settling_time_s"].is_number()) << step;
    EXPECT_NEAR(step["steady_error"].get<double>(), 0.0, 1e-3);
  }
}

/// The stiffness as wide as the resonance allows, the mass fixed, whichever fact is given.
TEST(IdentifyImpedanceCommand, ItsSceneHasTheIntervalsAsTolerances) {
  for (const char* fact : {"--mass-kg 0.01", "--force-factor-N-per-V 0.5"}) {
    ScratchFolder folder;
    folder.write("z.csv", as_table());
    ASSERT_EQ(folder.run(std::string("identify impedance z.csv --quiet --out o ") + fact).exit_code,
              0);
    const Outcome study = folder.run("robust o/scene.toml --samples 8 --search 0 --quiet --out r");
    ASSERT_EQ(study.exit_code, 0) << study.err;
    const auto parameters = nlohmann::json::parse(folder.read("o/identify.json"))["parameters"];
    const auto figures = nlohmann::json::parse(folder.read("r/robust.json"));
    EXPECT_EQ(figures["failures"], 0);
    const auto& tolerance = figures["scene"]["tolerance"];
    EXPECT_FALSE(tolerance.contains("plant.mass_kg"));
    const auto expect_interval = [&](const char* key, const char* name, double power) {
      const auto& found = parameters[name];
      const double value = figures["scene"][nlohmann::json::json_pointer(key)];
      std::string path = std::string(key).substr(1);
      path.replace(path.find('/'), 1, ".");
      const auto& range = tolerance[path]["range"];
      for (const auto& [end, index] :
           {std::pair{"low_95", std::size_t{0}}, {"high_95", std::size_t{1}}}) {
        const double relative = found[end].get<double>() / found["value"].get<double>();
        EXPECT_NEAR(range[index].get<double>() / value, std::pow(relative, power), 1e-12) << key;
      }
    };
    expect_interval("/plant/stiffness_N_per_m", "resonance_frequency_Hz", 2.0);
    expect_interval("/plant/damping_N_s_per_m", "damping_N_s_per_m", 1.0);
    expect_interval("/transducer/clamped_capacitance_F", "clamped_capacitance_F", 1.0);
    EXPECT_EQ(tolerance.contains("transducer.force_factor_N_per_V"),
              parameters["force_factor_N_per_V"]["low_95"] !=
                  parameters["force_factor_N_per_V"]["high_95"]);
  }
}

TEST(IdentifyImpedanceCommand, WithoutAMechanicalFactSaysWhatIsMissing) {
  ScratchFolder folder;
  folder.write("z.s1p", as_touchstone());
  const Outcome outcome = folder.run("identify impedance z.s1p");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE((outcome.out + outcome.err).find("--mass-kg"), std::string::npos);
  expect_circuit(nlohmann::json::parse(folder.read("out/z_impedance/identify.json")));
  for (const std::string& entry : folder.entries()) {
    EXPECT_EQ(entry.find("scene.toml"), std::string::npos);
  }
}

/// Phases that are 2 degrees off: on the terminal, on the page and in the file.
TEST(IdentifyImpedanceCommand, WarnsOfPhasesThatAreOff) {
  ScratchFolder folder;
  std::string table = "frequency_Hz,impedance_ohm,phase_deg\n";
  for (const auto& [frequency_Hz, value] : readings()) {
    table += text(frequency_Hz) + "," + text(std::abs(value)) + "," +
             text(std::arg(value) * 180.0 / pi + 2.0) + "\n";
  }
  folder.write("z.csv", table);
  const Outcome outcome = folder.run("identify impedance z.csv");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string warning = "The phases are off by";
  EXPECT_NE((outcome.out + outcome.err).find("WARNING: " + warning), std::string::npos)
      << outcome.out;
  EXPECT_NE(folder.read("out/z_impedance/report.html").find(warning), std::string::npos);
  EXPECT_EQ(unexplained_symbols(folder.read("out/z_impedance/report.html")), Entries{});
  const auto identified = nlohmann::json::parse(folder.read("out/z_impedance/identify.json"));
  EXPECT_EQ(identified["warnings"][0].get<std::string>().rfind(warning, 0), 0U);
}

TEST(IdentifyImpedanceCommand, ASweepThatNoCircuitFitsEndsWithThree) {
  ScratchFolder folder;
  std::string table = "frequency_Hz,impedance_ohm,phase_deg\n";
  for (const auto& [frequency_Hz, value] : readings()) {
    table += text(frequency_Hz) + "," + text(std::abs(value)) + "," +
             text(-std::arg(value) * 180.0 / pi) + "\n";
  }
  folder.write("z.csv", table);
  const Outcome outcome = folder.run("identify impedance z.csv");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("is the sign of the phase"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.entries(), (Entries{"z.csv"}));
}

TEST(IdentifyImpedanceCommand, BadInputEndsWithTwoAndWritesNothing) {
  ScratchFolder folder;
  const std::string table = as_table();
  folder.write("cut.csv", table.substr(0, table.find("\n", 4000) + 4));
  folder.write("short.csv", table.substr(0, table.find("\n", 100) + 1));
  folder.write("empty.csv", "");
  const auto refused = [&](const std::string& file, const std::string& message) {
    const Outcome outcome = folder.run("identify impedance " + file);
    EXPECT_EQ(outcome.exit_code, 2) << file;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  };
  refused("cut.csv", "impedance_ohm: cells on this line: 1");
  refused("short.csv", "allowed: at least 8");
  refused("empty.csv", "empty.csv:1:1: file: is empty");
  refused("none.csv", "none.csv:1:1: file: ");
  refused("cut.csv --mass-kg -1", "--mass-kg");
  refused("cut.csv --mass-kg 1e-300", "allowed: 1e-12 to 1e+06");
  refused("cut.csv --mass-kg 1 --force-factor-N-per-V 1", "--force-factor-N-per-V");
  EXPECT_EQ(folder.entries(), (Entries{"cut.csv", "empty.csv", "short.csv"}));
}

}  // namespace
}  // namespace sonoglide::acceptance::identify_impedance_command_test
