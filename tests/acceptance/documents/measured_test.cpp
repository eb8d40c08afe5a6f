/// The figures in firmware/control/measured.md are those of the tables that they are taken from.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "host_sim/process/regular_expression.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::acceptance::measured_test {
namespace {

const std::filesystem::path source = SONOGLIDE_SOURCE;

std::string document() {
  std::ifstream file(source / "firmware/control/measured.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The row of 1000 loops, judged by their friction ratio.
csv::Row loops_of(const csv::Table& table, const std::string& model, const std::string& loops) {
  for (const csv::Row& row : table.rows()) {
    if (row.text("loops") == "1000" && row.text("judged_by") == "ratio" &&
        row.text("model") == model && row.text("class") == loops) {
      return row;
    }
  }
  throw std::out_of_range(model + ", " + loops);
}

double reachable_steps(const csv::Row& row) {
  return row.number("steps") - row.number("out_of_reach");
}

/// "WITHIN 1 ms | NEVER", of the steps that the drive can reach.
std::string shares(const csv::Row& row) {
  const double steps = reachable_steps(row);
  const double never =
      row.number("never_named") + row.number("never_unnamed") - row.number("out_of_reach");
  return fmt::format("{:.1f} % | {:.1f} %", 100.0 * row.number("prompt") / steps,
                     100.0 * never / steps);
}

TEST(MeasuredFigures, OfRandomLoopsAreThoseOfTheirTables) {
  const std::string text = document();
  const csv::Table sensorless = csv::read_file(source / "tests/random_loops/felt.csv");
  const csv::Table notch = csv::read_file(source / "tests/random_loops/unseen.csv");
  for (const auto& [name, loops] :
       {std::pair("without a known cause", "none of these"), std::pair("all", "all")}) {
    for (const char* model : {"exact", "wrong"}) {
      const csv::Row row = loops_of(sensorless, model, loops);
      const std::string line =
          fmt::format("| {} | {} | {:.0f} | {} | {} |", name, model, reachable_steps(row),
                      shares(row), shares(loops_of(notch, model, loops)));
      EXPECT_NE(text.find(line), std::string::npos) << line;
    }
  }
}

TEST(MeasuredFigures, OfARampedDriveAreThoseOfItsTable) {
  const std::string text = document();
  const csv::Table step = csv::read_file(source / "tests/random_loops/unseen.csv");
  const csv::Table ramped = csv::read_file(source / "tests/random_loops/ramped.csv");
  for (const auto& [name, loops] :
       {std::pair("all", "all"), std::pair("mode within 0.0052 of a multiple", "within 0.0052"),
        std::pair("mode within 0.02 of a multiple", "within 0.02"),
        std::pair("mode within 0.064 of a multiple", "within 0.064"),
        std::pair("mode below 0.064", "below 0.064"), std::pair("friction calibrated", "learnt"),
        std::pair("friction trusted", "trusted")}) {
    for (const char* model : {"exact", "wrong"}) {
      const std::string line =
          fmt::format("| {} | {} | {} | {} |", name, model, shares(loops_of(step, model, loops)),
                      shares(loops_of(ramped, model, loops)));
      EXPECT_NE(text.find(line), std::string::npos) << line;
    }
  }
}

TEST(MeasuredFigures, OfTheLawsAreThoseOfTheirTables) {
  const std::string text = document();
  const csv::Table notch = csv::read_file(source / "tests/random_loops/unseen.csv");
  const csv::Table ramped = csv::read_file(source / "tests/random_loops/ramped.csv");
  const csv::Table alone = csv::read_file(source / "tests/random_loops/alone.csv");
  for (const char* law :
       {"dahl", "coulomb", "lugre", "iwan", "stribeck", "transverse_coulomb", "normal_coulomb"}) {
    const std::string line =
        fmt::format("| `{}` | {} | {} | {} |", law, shares(loops_of(notch, "exact", law)),
                    shares(loops_of(ramped, "exact", law)), shares(loops_of(alone, "exact", law)));
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}

TEST(MeasuredFigures, OfABiasAreThoseOfItsTables) {
  const std::string text = document();
  const auto table = [](const char* name) {
    return csv::read_file(source / "tests/random_loops" / (std::string(name) + ".csv"));
  };
  for (const auto& [name, without, with] :
       {std::tuple("sensorless", table("felt"), table("felt_biased")),
        std::tuple("vibration sensor", table("damped"), table("damped_biased"))}) {
    for (const char* model : {"exact", "wrong"}) {
      const std::string line = fmt::format("| {} | {} | {} | {} |", name, model,
                                           shares(loops_of(without, model, "below 0.064")),
                                           shares(loops_of(with, model, "below 0.064")));
      EXPECT_NE(text.find(line), std::string::npos) << line;
    }
  }
}

TEST(MeasuredFigures, OfAllMeansAreThoseOfTheirTable) {
  const std::string text = document();
  const csv::Table table = csv::read_file(source / "tests/random_loops/all_means.csv");
  for (const auto& [name, loops] :
       {std::pair("all", "all"), std::pair("without a known cause", "none of these"),
        std::pair("mode within 0.0052 of a multiple", "within 0.0052"),
        std::pair("mode within 0.064 of a multiple", "within 0.064"),
        std::pair("mode below 0.064", "below 0.064"),
        std::pair("friction trusted by the scene", "trusted")}) {
    for (const char* model : {"exact", "wrong"}) {
      const csv::Row row = loops_of(table, model, loops);
      const std::string line =
          fmt::format("| {} | {} | {:.0f} | {} |", name, model, reachable_steps(row), shares(row));
      EXPECT_NE(text.find(line), std::string::npos) << line;
    }
  }
}

std::string instructions(const csv::Table& budget, const std::string& board,
                         const std::string& arithmetic, const std::string& scene) {
  for (const csv::Row& row : budget.rows()) {
    if (row.text("board") == board && row.text("arithmetic") == arithmetic &&
        row.text("scene") == scene) {
      return fmt::format("{:.0f}", row.number("step_instructions_mean"));
    }
  }
  throw std::out_of_range(scene);
}

TEST(MeasuredFigures, OfAStepAreThoseOfTheBudget) {
  const std::string text = document();
  const csv::Table budget = csv::read_file(source / "tests/boards/budget.csv");
  for (const char* scene :
       {"target_step", "wire_bonder", "haptic_plate", "damped_step", "damped_by_force"}) {
    const std::string float32 = instructions(budget, "mps2-an386", "float32", scene);
    const std::string q31 = instructions(budget, "mps2-an385", "q31", scene);
    const process::RegularExpression line(
        fmt::format("\\| `{}` \\| [^|]+ \\| {} \\| {} \\|", scene, float32, q31));
    EXPECT_FALSE(line.search(text).empty()) << scene << ": " << float32 << ", " << q31;
  }
}

}  // namespace
}  // namespace sonoglide::acceptance::measured_test
