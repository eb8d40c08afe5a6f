/// A scene's controller in every arithmetic, as images on emulated boards.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/output/study_report.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::arithmetic {

/// The course of one closed-loop run; to be watched with.
class Course final : public loop::PeriodSink {
 public:
  /// @param experiment  in closed loop
  explicit Course(const configure::Experiment& experiment)
      : meter_(experiment.plant, *experiment.design) {}

  void take(const loop::Period& period) override {
    friction_ratios_.push_back(period.friction_ratio);
    meter_.take(period);
  }

  /// One for each carrier period.
  const std::vector<double>& friction_ratios() const { return friction_ratios_; }
  std::vector<report::StepMetrics> steps() const { return meter_.steps(); }

 private:
  std::vector<double> friction_ratios_;
  report::StepMeter meter_;
};

/// A figure for which there is no target step is NaN.
struct Precision {
  double rms_difference = 0.0;  ///< of the friction ratio from that with float64, all periods
  double largest_difference = 0.0;
  double steady_error = 0.0;  ///< largest magnitude over the target steps that no limit disturbed
  double ripple = 0.0;        ///< largest over the same
};

/// @param exact  the same scene with a controller in float64
Precision precision(const Course& course, const Course& exact);

/// Throws configure::ConfigurationError for a scene whose controller is not built in every arithmetic.
void require_every_arithmetic(const scene::Scene& scene);

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

struct ArithmeticComparison {
  std::vector<ImageRow> images;    ///< board by board
  std::vector<TargetRow> targets;  ///< target by target
};

/// @param experiment  in closed loop; its own arithmetic plays no part
/// @param boards      float64 is left out on those that compute it in software
/// @param progress    called with the fraction done
/// @throws what emulated::run_image() and emulated::controller_header() throw
ArithmeticComparison compare(const configure::Experiment& experiment,
                             const std::vector<const emulated::EmulatedBoard*>& boards,
                             const std::function<void(double)>& progress);

// What a comparison leaves behind.

/// One line for each image under a heading line; what is not defined is nan.
std::string images_csv(const ArithmeticComparison& comparison);

/// One line for each target and arithmetic.
std::string targets_csv(const ArithmeticComparison& comparison);

/// Difference from float64 against instructions per step, a point for each image; difference and
/// ripple against the target.
output::Sheet diagrams(const scene::Scene& scene, const ArithmeticComparison& comparison);

output::Page page(const scene::Scene& scene, const ArithmeticComparison& comparison);

/// arithmetic.csv, targets.csv, arithmetic.svg and report.html. @throws process::ProcessError
output::StudyReport report(const scene::Scene& scene, const ArithmeticComparison& comparison);

}  // namespace sonoglide::arithmetic
