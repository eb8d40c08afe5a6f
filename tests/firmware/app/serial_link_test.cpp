/// A unit behind a UART without flow control: its queue is short, and its service comes round now and then.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "firmware/app/link_service.hpp"
#include "firmware/app/timed_loop.hpp"
#include "hal/serial_line.hpp"
#include "tests/firmware/app/unit/simulated_line.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::app::serial_link_test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// @tparam MostBytes  at least Line::most_bytes()
template <std::size_t MostBytes>
class SerialUnit {
 public:
  explicit SerialUnit(const Line& line) : line_(line), uart_(line.byte_s(), line.queue_bytes) {}

  void put(const std::vector<std::uint8_t>& bytes) { uart_.put(bytes); }
  bool line_idle() const { return uart_.idle(); }
  double now() const { return uart_.now; }
  int lost() const { return uart_.lost; }
  bool driving() const { return unit_.supervisor().driving(); }

  /// Goes on to the next event.
  void proceed() {
    uart_.now = std::min({uart_.next(), serves_at_, interrupts_at_});
    uart_.advance();
    if (interrupts_at_ <= uart_.now) {
      interrupts_at_ = never;
      bytes_.transfer();
    }
    if (serves_at_ <= uart_.now) {
      serves_at_ += line_.service_s();
      board_.pass(line_.carriers - 1);
      loop_.serve();
      ++services;
    }
    const bool wanted = uart_.has_received() || (bytes_.sending() && uart_.has_room());
    if (wanted && interrupts_at_ == never) {
      interrupts_at_ = uart_.now + line_.latency_s();
    }
  }

  /// The next whole frame that comes until a time, but for the samples of a stream, which are counted.
  bool frame(link::Frame& frame, double until) {
    while (uart_.now < until) {
      for (; taken_ < uart_.from_unit.size();) {
        if (decoder_.take(uart_.from_unit[taken_++]) != link::Reception::frame) {
          continue;
        }
        if (decoder_.frame().kind != link::Streamed::kind) {
          frame = decoder_.frame();
          return true;
        }
        ++samples;
      }
      proceed();
    }
    return false;
  }

  int services = 0;
  int samples = 0;

  /// That go out before whatever the unit sends next.
  static constexpr std::size_t sent_ahead_bytes = 64;

 private:
  using Bytes = hal::BufferedLink<Uart, 2 * MostBytes, sent_ahead_bytes>;
  using Service = LinkService<TestedUnit, Bytes, MostBytes>;

  /// Its periods are those of the service.
  class SlowBoard : public TimedBoard {
   public:
    std::uint32_t period() const { return periods_; }
    bool sample(hal::Sample& sample) {
      ++periods_;
      return TimedBoard::sample(sample);
    }

   private:
    std::uint32_t periods_ = 0;
  };

  Line line_;
  Uart uart_;
  double serves_at_ = 0.0;
  double interrupts_at_ = never;
  std::size_t taken_ = 0;
  link::FrameDecoder decoder_;
  SimulatedFlash flash_;
  TestedUnit unit_{field_design, flash_};
  Bytes bytes_{uart_};
  Service service_{unit_, bytes_};
  SlowBoard board_;
  CountingWatchdog watchdog_;
  TimedLoop<TestedUnit::Supervisor, SlowBoard, CountingWatchdog, Service> loop_{
      unit_.supervisor(), board_, watchdog_, service_};
};

link::Frame request(std::uint16_t number) {
  switch (number % 5) {
    case 0:
      return link::frame_of(link::Restart{}, number);
    case 1:
      return link::frame_of(link::SetTarget{300000U + number}, number);
    case 2:
      return link::frame_of(link::ReadParameter{1}, number);
    case 3:
      return link::frame_of(link::ReadFault{0}, number);
    default:
      return link::frame_of(link::ReadTelemetry{}, number);
  }
}

/// More than any line carries.
link::Frame stream(std::uint16_t number) {
  return link::frame_of(link::Stream{link::all_channels, 1}, number);
}

/// @param streams  beside the answers
template <std::size_t MostBytes>
void expect_every_request_is_answered(const Line& line, bool streams) {
  SerialUnit<MostBytes> unit(line);
  // What waits below the link is not cut short: in the ring, beside it, in the UART and on the line.
  const double ahead_s =
      streams ? static_cast<double>(unit.sent_ahead_bytes + line.queue_bytes + 2) * line.byte_s()
              : 0.0;
  if (streams) {
    unit.put(wire_bytes(stream(0xFFFF)));
    link::Frame answer;
    ASSERT_TRUE(unit.frame(answer, 1.0)) << line;
    ASSERT_FALSE(unit.frame(answer, unit.now() + 200 * line.byte_s() + 20 * line.service_s()))
        << line;
    ASSERT_GT(unit.samples, 2) << line;
  }
  for (std::uint16_t number = 0; number < 50; ++number) {
    const std::vector<std::uint8_t> sent = wire_bytes(request(number));
    const double begin = unit.now();
    unit.put(sent);
    link::Frame answer;
    ASSERT_TRUE(unit.frame(answer, begin + 1.0)) << line << ": " << number;
    ASSERT_EQ(answer.sequence, number) << line;
    const double line_s =
        static_cast<double>(sent.size() + wire_bytes(answer).size()) * line.byte_s();
    ASSERT_LE(unit.now() - begin, line_s + ahead_s + 4 * line.service_s())
        << line << ": " << number;
  }
  EXPECT_EQ(unit.lost(), 0) << line;
}

/// @param sends_requests  whole ones, or noise
template <std::size_t MostBytes>
void expect_a_stop_acts_behind_a_burst(const Line& line, bool sends_requests, bool streams) {
  SerialUnit<MostBytes> unit(line);
  unit.put(wire_bytes(link::frame_of(link::Restart{}, 0xFFFF)));
  link::Frame answer;
  ASSERT_TRUE(unit.frame(answer, 1.0)) << line;
  ASSERT_TRUE(unit.driving()) << line;
  if (streams) {
    unit.put(wire_bytes(stream(0)));
    ASSERT_TRUE(unit.frame(answer, unit.now() + 1.0)) << line;
  }
  std::minstd_rand random(7);
  std::vector<std::uint8_t> burst;
  for (std::uint16_t number = 1; burst.size() < 600; ++number) {
    const std::vector<std::uint8_t> bytes =
        sends_requests ? wire_bytes(link::frame_of(link::ReadTelemetry{}, number))
                       : std::vector<std::uint8_t>{static_cast<std::uint8_t>(random())};
    burst.insert(burst.end(), bytes.begin(), bytes.end());
  }
  const std::vector<std::uint8_t> stop = wire_bytes(link::frame_of(link::Stop{}, 1000));
  burst.insert(burst.end(), stop.begin(), stop.end());
  unit.put(burst);
  while (!unit.line_idle()) {
    unit.proceed();
  }
  const int before = unit.services;
  while (unit.driving() && unit.services < before + 10) {
    unit.proceed();
  }
  // The service that takes the last byte, and the control before the next.
  EXPECT_LE(unit.services - before, 2) << line;
  EXPECT_EQ(unit.lost(), 0) << line;
}

/// Calls for a line, with the least power of two of bytes that a service must take.
template <std::size_t MostBytes = 1, class Call>
void with_bound(const Line& line, const Call& call) {
  if (line.most_bytes() <= MostBytes) {
    call(std::integral_constant<std::size_t, MostBytes>{});
  } else if constexpr (MostBytes < 1024) {
    with_bound<2 * MostBytes>(line, call);
  }
}

template <class Call>
void on_every_line(const Call& call) {
  for (const std::uint32_t baud : {9600U, 19200U, 115200U, 460800U, 1000000U, 3000000U}) {
    for (const int carriers : {1, 2, 6, 16, 48, 128}) {
      for (const std::size_t queue_bytes : {1U, 2U, 8U, 32U}) {
        const Line line{baud, carriers, queue_bytes};
        with_bound(line, [&](auto bound) { call(line, bound); });
      }
    }
  }
}

TEST(SerialLine, BringsNoMoreThanItsBound) {
  EXPECT_EQ(hal::bytes_in(115200, 16 / 60e3), 4U);
  EXPECT_EQ(hal::bytes_in(9600, 1 / 60e3), 1U);
  EXPECT_EQ(hal::bytes_in(3000000, 128 / 60e3), 641U);
}

TEST(SerialLink, AnswersEveryRequestOnEveryLineInTime) {
  for (const bool streams : {false, true}) {
    on_every_line([&](const Line& line, auto bound) {
      expect_every_request_is_answered<decltype(bound)::value>(line, streams);
    });
  }
}

TEST(SerialLink, AStopActsBehindABurstOnEveryLine) {
  for (const bool sends_requests : {true, false}) {
    for (const bool streams : {false, true}) {
      on_every_line([&](const Line& line, auto bound) {
        expect_a_stop_acts_behind_a_burst<decltype(bound)::value>(line, sends_requests, streams);
      });
    }
  }
}

// Whatever byte it is.
TEST(SerialLink, ALostByteCostsItsFrameAlone) {
  std::vector<std::uint8_t> wire;
  for (std::uint16_t number = 0; number < 5; ++number) {
    const std::vector<std::uint8_t> bytes = wire_bytes(request(number));
    wire.insert(wire.end(), bytes.begin(), bytes.end());
  }
  for (std::size_t lost = 0; lost < wire.size(); ++lost) {
    link::FrameDecoder decoder;
    int frames = 0;
    for (std::size_t i = 0; i < wire.size(); ++i) {
      if (i != lost && decoder.take(wire[i]) == link::Reception::frame) {
        ++frames;
      }
    }
    EXPECT_GE(frames, 4) << lost;
  }
}

TEST(ByteRing, KeepsTheirOrderAndDropsWhatFindsNoRoom) {
  hal::ByteRing<3> ring;
  std::uint8_t byte = 0;
  EXPECT_FALSE(ring.take(byte));
  for (int turn = 0; turn < 5; ++turn) {
    for (std::uint8_t i = 0; i < 3; ++i) {
      EXPECT_TRUE(ring.put(i));
    }
    EXPECT_FALSE(ring.put(9));
    for (std::uint8_t i = 0; i < 3; ++i) {
      ASSERT_TRUE(ring.take(byte));
      EXPECT_EQ(byte, i);
    }
    EXPECT_TRUE(ring.empty());
  }
}

}  // namespace
}  // namespace sonoglide::app::serial_link_test
