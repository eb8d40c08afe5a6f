/// A scene's controller in every arithmetic, as images on emulated boards.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "firmware/control/drive_command.hpp"
#include "host_sim/emulated/board_list.hpp"
#include "host_sim/loop/image_record.hpp"
#include "host_sim/process/wait_for_input.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/arithmetic/precision.hpp"

namespace sonoglide::arithmetic {

/// From the fewest bits to the most.
inline constexpr std::array<scene::Arithmetic, 4> all_arithmetics = {
    scene::Arithmetic::q15, scene::Arithmetic::q31, scene::Arithmetic::float32,
    scene::Arithmetic::float64};

/// What an image did and cost.
struct ImageRow {
  const emulated::EmulatedBoard* board = nullptr;
  scene::Arithmetic arithmetic = scene::Arithmetic::float64;
  Precision precision;
  control::Fault fault = control::Fault::none;  ///< the first one
  loop::ImageRecord image;
};

/// The scene with one target from beginning to end, on the workstation, whose bits are the boards'.
struct TargetRow {
  double target = 0.0;
  scene::Arithmetic arithmetic = scene::Arithmetic::float64;
  Precision precision;
  control::Limit limit = control::Limit::none;  ///< of the steady part
  control::Fault fault = control::Fault::none;
};

struct Comparison {
  std::vector<ImageRow> images;    ///< board by board
  std::vector<TargetRow> targets;  ///< target by target
};

/// @param scene      in closed loop; its own arithmetic plays no part
/// @param boards     float64 is left out on those that compute it in software
/// @param attention  called now and then; what it throws ends the comparison
/// @param progress   called with the fraction done
/// @throws what emulated::run_image() and emulated::controller_header() throw
Comparison compare(const scene::Scene& scene,
                   const std::vector<const emulated::EmulatedBoard*>& boards,
                   const process::Attention& attention,
                   const std::function<void(double)>& progress);

}  // namespace sonoglide::arithmetic
