#include "host_sim/emulated/run_image.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>

#include "host_sim/emulated/image_builder.hpp"
#include "host_sim/emulated/image_control.hpp"
#include "host_sim/emulated/image_cost.hpp"

namespace sonoglide::emulated {
namespace {

void add_cost(const emulated::ImageCost& cost, loop::ImageRecord& record) {
  record.flash_bytes = cost.size.flash_bytes;
  record.ram_bytes = cost.size.ram_bytes;
  record.stack_unbounded_by = cost.stack.unbounded_by;
  if (cost.stack.unbounded_by.empty()) {
    record.stack_bytes_bound = cost.stack.bytes;
  }
}

/// The image takes most of the time.
constexpr double image_share = 0.9;

loop::Watch of_the_image(loop::Watch watch) {
  if (watch.progress) {
    watch.progress = [progress = watch.progress](double part) { progress(image_share * part); };
  }
  return watch;
}

loop::WorkstationRun run_on_workstation(const scene::Scene& scene,
                                        const configure::ControlDesign& design,
                                        std::uint64_t image_hash, const loop::Progress& progress) {
  loop::Watch watch;
  if (progress) {
    watch.progress = [&](double part) { progress(image_share + (1.0 - image_share) * part); };
  }
  const std::uint64_t hash = loop::run(scene, design, watch).control->trace_hash;
  return {hash, hash == image_hash};
}

}  // namespace

loop::RunResult run_image(const scene::Scene& scene, const configure::ControlDesign& design,
                          const emulated::EmulatedBoard& board, const std::string& header,
                          const loop::Watch& watch) {
  const std::filesystem::path image = emulated::build_image(board, header);
  const emulated::ImageCost cost = emulated::measure_image(image, board);
  ImageControl controller(board, image);
  loop::RunResult result = loop::run(scene, design, controller, of_the_image(watch));
  result.image = controller.shut_down();
  add_cost(cost, *result.image);
  result.image->workstation =
      run_on_workstation(scene, design, result.control->trace_hash, watch.progress);
  return result;
}

void require_same(const loop::RunResult& result) {
  const loop::WorkstationRun& workstation = result.image->workstation.value();
  if (!workstation.same) {
    throw loop::ComputationError(fmt::format(
        "over {:g} s the image on {} gave other drive commands than the same controller on the "
        "workstation: trace hash {:016x}, not {:016x}",
        result.final_time_s, result.image->board, result.control->trace_hash,
        workstation.trace_hash));
  }
}

}  // namespace sonoglide::emulated
