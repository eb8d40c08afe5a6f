// A unit on a board that is nothing but registers: what a port links, for its size and symbols.
// WITH_LINK adds that service; without it there is the controller alone.
#include <cstdint>

#include "controller_configuration.hpp"
#include "firmware/app/field_parameters.hpp"
#include "firmware/app/link_service.hpp"
#include "firmware/app/supervisor.hpp"
#include "firmware/app/timed_loop.hpp"
#include "firmware/app/unit.hpp"

namespace {

volatile std::uint32_t registers[16];
volatile std::uint32_t flash_words[2][64];

struct Board {
  bool sample(sonoglide::hal::Sample& sample) {
    sample.friction_force = static_cast<std::int32_t>(registers[0]);
    sample.sliding_velocity = static_cast<std::int32_t>(registers[1]);
    sample.fresh = registers[2] != 0;
    return true;
  }
  void drive(const sonoglide::hal::Drive& drive) {
    registers[3] = static_cast<std::uint32_t>(drive.amplitude);
  }
  std::uint32_t period() const { return registers[4]; }
};

struct Watchdog {
  void feed() { registers[5] = 1; }
  bool caused_reset() const { return registers[6] != 0; }
};

struct ByteLink {
  bool receive(std::uint8_t& byte) {
    byte = static_cast<std::uint8_t>(registers[7]);
    return registers[8] != 0;
  }
  bool send(std::uint8_t byte) {
    registers[9] = byte;
    return registers[10] != 0;
  }
};

struct Flash {
  static constexpr std::size_t page_words = 64;
  std::uint32_t read(std::size_t page, std::size_t word) const { return flash_words[page][word]; }
  void erase(std::size_t page) { registers[11] = page; }
  void program(std::size_t page, std::size_t word, std::uint32_t value) {
    flash_words[page][word] = value;
  }
  bool busy() const { return registers[12] != 0; }
};

namespace app = sonoglide::app;
namespace configuration = app::configuration;

Board board;
Watchdog watchdog;

template <class Supervisor, class Service>
[[noreturn]] void run(Supervisor& supervisor, Service& service) {
  app::TimedLoop loop(supervisor, board, watchdog, service);
  while (true) {
    loop.serve();
  }
}

}  // namespace

int main() {
#ifdef WITH_LINK
  static constexpr app::FieldDesign<configuration::Parts> design(
      configuration::parameters, app::first_target(configuration::target_steps),
      configuration::design, configuration::full_scales, configuration::step_period_s,
      app::default_timeout_ms);
  Flash flash;
  ByteLink bytes;
  app::Unit unit(design, flash);
  app::LinkService service(unit, bytes);
  run(unit.supervisor(), service);
#else
  app::Supervisor<sonoglide::control::Controller<configuration::Parts> > supervisor(
      configuration::parameters);
  supervisor.set_target(app::first_target(configuration::target_steps));
  app::NoService service;
  run(supervisor, service);
#endif
}
