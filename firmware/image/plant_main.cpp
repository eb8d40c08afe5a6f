// The image of one scene's plant and controller together: the closed loop without a host.
#include "controller_configuration.hpp"
#include "firmware/app/control_loop.hpp"
#include "firmware/app/target_schedule.hpp"
#include "firmware/control/controller.hpp"
#include "firmware/image/plant/watched_board.hpp"
#include "hal/semihosting/report.hpp"
#include "plant_configuration.hpp"

namespace {

namespace configuration = sonoglide::app::configuration;
namespace hal = sonoglide::hal;

using WatchedBoard = sonoglide::image::WatchedBoard<configuration::PlantBoard>;

void run(WatchedBoard& board) {
  sonoglide::control::Controller<configuration::Parts> controller(configuration::parameters);
  controller.start();
  sonoglide::app::ControlLoop loop(controller, board);
  sonoglide::app::TargetSchedule targets(configuration::target_steps);
  do {
    targets.advance(controller);
  } while (board.periods() < configuration::plant_periods && loop.serve());
}

bool report(const WatchedBoard& board) {
  hal::semihosting::Report report;
  report.number("periods", board.periods());
  report.hash("trace_hash", board.trace_hash());
  report.hash("sample_hash", board.sample_hash());
  report.number("plant_counts_min", board.sampling().least());
  report.number("plant_counts_sum", board.sampling().sum());
  report.number("plant_counts_max", board.sampling().most());
  report.number("controller_counts_min", board.answering().least());
  report.number("controller_counts_sum", board.answering().sum());
  report.number("controller_counts_max", board.answering().most());
  return report.complete();
}

}  // namespace

// 0, or 1 where the plant could not go on or a line was not taken.
int main() {
  configuration::PlantBoard plant(configuration::plant_parameters);
  WatchedBoard board(plant);
  run(board);
  return report(board) && board.periods() == configuration::plant_periods ? 0 : 1;
}
