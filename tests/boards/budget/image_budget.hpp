/// What the image of a controller costs on its board, as rows of a table.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/image.hpp"
#include "host_sim/loop/run_result.hpp"
#include "tests/boards/budget/image_parts.hpp"

namespace sonoglide::budget {

/// Where images and the scenes that they were configured from are.
struct Folders {
  std::filesystem::path images;       ///< <board>/bin/<image>.elf
  std::filesystem::path controllers;  ///< <image>/scene.toml
};

struct ImageBudget {
  emulated::ImageCost cost;
  ImageParts parts;
  loop::ImageInstructions instructions;  ///< over the whole scene
};

/// Of a unit: its control side over the whole scene, and the image that is its product.
struct UnitBudget {
  loop::InstructionRange control;
  emulated::ImageCost cost;
};

/// Runs its scene with a unit in lockstep.
/// Throws what measure() does.
UnitBudget measure_unit(const Folders& folders, const emulated::EmulatedBoard& board,
                        const std::string& image);

/// Takes an image apart and runs its scene with it, in closed loop.
/// @throws process::ProcessError, emulated::ImageError
/// @throws loop::ComputationError  a command differs from the workstation's: the cost of something else
ImageBudget measure(const Folders& folders, const emulated::EmulatedBoard& board,
                    const std::string& image);

/// A column of a table and what stands in it.
struct Figure {
  std::string column;
  std::string value;
};
using Row = std::vector<Figure>;

/// The row of a board's image of an example scene.
/// @param compiler  its version
/// @param unit      of the same scene, where it is measured
Row budget_row(const emulated::EmulatedBoard& board, const std::string& arithmetic,
               const std::string& scene, const std::string& compiler, const ImageBudget& budget,
               const std::optional<UnitBudget>& unit);

/// The version of a board's compiler. Figures of two versions cannot be compared.
std::string compiler_version(const emulated::EmulatedBoard& board);

/// The image of an example scene in an arithmetic.
std::string image_name(const std::string& scene, const std::string& arithmetic);

/// The table as CSV, with its header.
std::string csv(const std::vector<Row>& rows);

/// The rows of a CSV file.
/// @throws csv::CsvError
std::vector<Row> read_csv(const std::filesystem::path& path);

}  // namespace sonoglide::budget
