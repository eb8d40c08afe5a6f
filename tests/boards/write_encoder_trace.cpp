// Runs a scene with a texture on the workstation, its controller on a board with an encoder, and writes what both
// meet, a line for each step: the count, and what board_trace writes. The count begins below 0 and so it wraps.
//
// Usage: encoder_trace SCENE.toml [TABLE.KEY=VALUE ...] > trace
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/run.hpp"
#include "tests/scene_units/agreement/encoder.hpp"
#include "trace_line.hpp"

#include "controller_configuration.hpp"

namespace sonoglide {
namespace {

namespace configuration = app::configuration;
using app::scene_units_test::PortOf;
using Encoder = app::scene_units_test::Encoder<SONOGLIDE_COUNTS_PER_M>;
using Image =
    app::scene_units_test::ImagePort<configuration::Parts,
                                     std::decay_t<decltype(configuration::target_steps)>, Encoder>;
constexpr std::int64_t first_count = -3000;

class WritingPort final : public PortOf<hal::Sample, hal::Drive> {
 public:
  explicit WritingPort(Image& image) : image_(image) {}

  void set_target(double /*target*/) override {}

 private:
  hal::Drive answer(const hal::Sample& sample) override {
    std::cout << image_.board.travel() << ' ';
    const hal::Drive drive = ask(image_, sample);
    boards_test::write_line(sample, drive);
    return drive;
  }

  Image& image_;
};

void write(const std::vector<std::string>& words) {
  const configure::Experiment experiment =
      experiment::read_file(words.at(0), {words.begin() + 1, words.end()});
  Image image(configuration::parameters, configuration::target_steps, Encoder(first_count));
  WritingPort port(image);
  loop::Watch watch;
  watch.periods.push_back(&image.board);
  loop::run(experiment.plant, *experiment.design, port, watch);
}

}  // namespace
}  // namespace sonoglide

int main(int count, char** words) {
  try {
    sonoglide::write({words + 1, words + count});
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
