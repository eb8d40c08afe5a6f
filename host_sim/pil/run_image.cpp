#include "host_sim/pil/run_image.hpp"

#include <filesystem>

#include "host_sim/image/image_builder.hpp"
#include "host_sim/image/measure_image.hpp"
#include "host_sim/pil/image_control.hpp"

namespace sonoglide::pil {
namespace {

void add_cost(const image::ImageCost& cost, loop::ImageRecord& record) {
  record.flash_bytes = cost.size.flash_bytes;
  record.ram_bytes = cost.size.ram_bytes;
  record.stack_unbounded_by = cost.stack.unbounded_by;
  if (cost.stack.unbounded_by.empty()) {
    record.stack_bytes_bound = cost.stack.bytes;
  }
}

}  // namespace

loop::RunResult run_image(const scene::Scene& scene, const emulator::EmulatedBoard& board,
                          const std::string& header, const loop::Watch& watch,
                          const process::Attention& attention) {
  const std::filesystem::path image = image::build_image(board, header, attention);
  const image::ImageCost cost = image::measure_image(image, board, attention);
  ImageControl controller(board, image, attention);
  loop::RunResult result = loop::run(scene, controller, watch);
  result.image = controller.shut_down();
  add_cost(cost, *result.image);
  return result;
}

}  // namespace sonoglide::pil
