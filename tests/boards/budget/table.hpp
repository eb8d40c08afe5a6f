/// The rows of budget.csv and features.csv, as measured here and now.
#pragma once

#include <string>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "tests/boards/budget/image_budget.hpp"

namespace sonoglide::budget {

/// Names of the closed-loop example scenes.
std::vector<std::string> example_scenes();

/// Whether the unit of an example scene is measured as well.
bool has_unit(const std::string& scene);

inline const std::vector<std::string> arithmetics = {"float32", "q31"};

/// Names of the boards whose images are measured, one of each core.
std::vector<std::string> measured_boards();

/// One row for each example scene.
std::vector<Row> measure_scenes(const emulated::EmulatedBoard& board,
                                const std::string& arithmetic);

/// A part of the controller that a scene may do without: two scenes, one of them without it.
struct Feature {
  std::string name;
  std::string with;
  std::string without;
  std::string file;  ///< the part's, in firmware/control
  std::string type;  ///< the part's
};

const std::vector<Feature>& features();

/// Where features are measured: with a floating-point unit in float32, the smallest core in q31.
struct FeatureBoard {
  std::string board;
  std::string arithmetic;
};

inline const std::vector<FeatureBoard> feature_boards = {{"mps2-an386", "float32"},
                                                         {"microbit", "q31"}};

/// An image of one of the features' scenes.
ImageBudget measure_feature_scene(const FeatureBoard& board, const std::string& scene);

/// One row for each feature: what the image with it costs more. State and calls are on the stack.
std::vector<Row> measure_features(const FeatureBoard& board);

/// One row for each service that a unit may have: what it costs more than a unit with the
/// controller alone, in flash and on the stack, where its state is. A service does its work between
/// steps.
std::vector<Row> measure_services();

/// The repository's tables.
std::vector<Row> recorded_budget();
std::vector<Row> recorded_features();

/// Writes them anew.
void record_budget(const std::vector<Row>& rows);
void record_features(const std::vector<Row>& rows);

}  // namespace sonoglide::budget
