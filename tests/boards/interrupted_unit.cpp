// A unit whose control side is the interrupt of the system timer, and whose service gives orders at random
// from main. Each run is then replayed without an interrupt, from the periods in which its orders came,
// and must give the same commands. A line on each run goes out on the serial line.
#include SONOGLIDE_BOARD_HEADER

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>

#include "controller_configuration.hpp"
#include "firmware/app/commanded_supervisor.hpp"
#include "firmware/app/field_parameters.hpp"
#include "hal/cortex_m/sys_tick.hpp"
#include "hal/timed/board.hpp"
#include "send_number.hpp"

namespace {

using Hardware = SONOGLIDE_BOARD_CLASS;
using sonoglide::image_test::send;
namespace app = sonoglide::app;
namespace configuration = app::configuration;
namespace hal = sonoglide::hal;

constexpr app::FieldDesign<configuration::Parts> design(
    configuration::parameters, app::first_target(configuration::target_steps),
    configuration::design, configuration::full_scales, configuration::step_period_s, 0);
using Design = app::FieldDesign<configuration::Parts>;
using Supervised = app::CommandedSupervisor<Design::Controller, Design::Designed>;

constexpr std::uint32_t periods = 400;
constexpr std::uint32_t shortest_reload = 3000;  // processor clocks; longer than a step
constexpr std::uint32_t reloads = 20;
constexpr std::uint32_t seeds = 3;

/// What came in a carrier period. Orders of parameters are told by their drive limit.
struct Event {
  std::uint32_t period;
  bool stop;
  bool ordered;
  Supervised::Kind kind;
  std::uint32_t faults;
  std::uint32_t number;  ///< target or drive limit, millionths
};

constexpr std::size_t most_events = 150;

Supervised::Parameters parameters_with(std::uint32_t drive_limit) {
  app::ParameterValues values = design.presets();
  values[static_cast<std::size_t>(app::Parameter::drive_limit)] = drive_limit;
  return design.controller_parameters(values);
}

/// A run: the unit, its contact, what came, and a hash of its commands.
class Run {
 public:
  Run()
      : supervisor_(design.controller_parameters(design.presets()), design.designed(), 0,
                    UINT32_MAX) {
    supervisor_.set_target(design.target(400'000));
  }

  Supervised& supervisor() { return supervisor_; }

  /// The next carrier period.
  void serve(const Supervised::Work& work) {
    contact_.live();
    hal::Sample sample = contact_.sample();
    sample.fresh = period_ % 97 != 96;  // a fault now and then
    const std::uint32_t begin = hal::cortex_m::SysTick::ticks();
    const hal::Drive& drive = supervisor_.step(sample, work);
    supervisor_.publish();
    cost_ = (hal::cortex_m::SysTick::ticks() - begin) & hal::cortex_m::SysTick::largest;
    contact_.drive(drive.amplitude);
    for (const auto word : {static_cast<std::uint32_t>(drive.amplitude),
                            static_cast<std::uint32_t>(drive.commanded_ratio),
                            std::uint32_t{drive.state} << 16 | std::uint32_t{drive.fault}}) {
      hash_ = (hash_ ^ word) * 0x01000193U;
    }
    period_ = period_ + 1;
  }

  std::uint32_t period() const { return period_; }
  std::uint32_t hash() const { return hash_; }
  /// Processor clocks that the last carrier period took, where the timer counts.
  std::uint32_t cost() const { return cost_; }

 private:
  Supervised supervisor_;
  hal::timed::StandInContact contact_;
  std::uint32_t hash_ = 0x811c9dc5U;
  std::uint32_t cost_ = 0;
  volatile std::uint32_t period_ = 0;
};

alignas(Run) unsigned char place[sizeof(Run)];
Run* run;
std::array<Event, most_events> events;
std::size_t event_count;
std::array<std::uint32_t, periods>
    costs;  // of the replay, of the periods that drive or have an order
std::size_t cost_count;
volatile std::uint32_t ordered_number;  // of the order that is pending

extern "C" void take_system_tick() {
  if (run->period() >= periods) {
    return;
  }
  const Supervised::Work work = run->supervisor().look();
  if (work.stop || work.order != nullptr) {
    const bool ordered = work.order != nullptr;
    events[event_count < most_events ? event_count++ : most_events - 1] = {
        run->period(),
        work.stop,
        ordered,
        ordered ? work.order->kind : Supervised::Kind::restart,
        ordered ? work.order->faults : 0,
        ordered_number};
  }
  run->serve(work);
}

std::uint32_t random_state;
std::uint32_t random_number() {
  random_state ^= random_state << 13;
  random_state ^= random_state >> 17;
  random_state ^= random_state << 5;
  return random_state >> 8;
}

/// The service: an order, a stop, or a look at what is shown.
/// @return whether what it saw was whole
bool act() {
  Supervised& supervisor = run->supervisor();
  const std::uint32_t chance = random_number() % 32;
  const app::Snapshot shown = supervisor.snapshot();
  const bool whole =
      shown.sliding_velocity == 0 || shown.sliding_velocity == hal::timed::StandInContact::velocity;
  if (chance == 0) {
    supervisor.order_stop();
  }
  if (chance < 16 || supervisor.order_end() == app::OrderEnd::pending) {
    return whole;
  }
  const std::uint32_t faults = supervisor.faults().count();
  if (chance < 24) {
    supervisor.order_restart(faults);
  } else if (chance < 28) {
    ordered_number = 100'000 + random_number() % 800'000;
    supervisor.order_target(design.target(ordered_number), faults);
  } else if (!shown.driving()) {
    ordered_number = 300'000 + random_number() % 700'000;
    supervisor.order_parameters(parameters_with(ordered_number), design.target(400'000), 0);
  }
  return whole;
}

/// @return whether everything that the service saw was whole
bool run_interrupted(std::uint32_t reload, std::uint32_t seed) {
  run = new (place) Run;
  event_count = 0;
  random_state = seed;
  bool whole = true;
  hal::cortex_m::SysTick::interrupt_every(reload);
  while (run->period() < periods) {
    for (std::uint32_t idle = random_number() % (2 * reload); idle > 0; --idle) {
      asm volatile("");
    }
    whole = act() && whole;
  }
  hal::cortex_m::SysTick::stop();
  return whole;
}

std::uint32_t replayed_hash() {
  run = new (place) Run;
  std::size_t next = 0;
  cost_count = 0;
  hal::cortex_m::SysTick::start();
  Supervised::Order order(design.controller_parameters(design.presets()));
  while (run->period() < periods) {
    Supervised::Work work{false, nullptr};
    if (next < event_count && events[next].period == run->period()) {
      const Event& event = events[next++];
      order.kind = event.kind;
      order.faults = event.faults;
      order.target = design.target(event.kind == Supervised::Kind::target ? event.number : 400'000);
      if (event.kind == Supervised::Kind::parameters) {
        order.controller = Supervised::Controller(parameters_with(event.number));
      }
      work = {event.stop, event.ordered ? &order : nullptr};
    }
    run->serve(work);
    if (work.stop || work.order != nullptr || run->supervisor().driving()) {
      costs[cost_count++] = run->cost();
    }
  }
  return run->hash();
}

/// In rising order.
void sort_costs() {
  for (std::size_t i = 1; i < cost_count; ++i) {
    for (std::size_t k = i; k > 0 && costs[k] < costs[k - 1]; --k) {
      const std::uint32_t cost = costs[k];
      costs[k] = costs[k - 1];
      costs[k - 1] = cost;
    }
  }
}

}  // namespace

int main() {
  Hardware::ByteLink bytes;
  for (std::uint32_t i = 0; i < reloads; ++i) {
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
      const std::uint32_t reload = shortest_reload + 997 * i;
      const bool whole = run_interrupted(reload, 7919 * seed + i);
      const std::uint32_t hash = run->hash();
      const auto orders = static_cast<std::uint32_t>(event_count);
      const bool all_kept = event_count < most_events;
      send(bytes, reload, ' ');
      send(bytes, orders, ' ');
      send(bytes, hash, ' ');
      send(bytes, replayed_hash(), ' ');
      sort_costs();
      send(bytes, costs[cost_count / 2], ' ');
      send(bytes, costs[cost_count - 1], ' ');
      send(bytes, whole && all_kept ? 1 : 0, '\n');
    }
  }
  return 0;
}
