// The board to start from, its registers in memory.
#include <gtest/gtest.h>

#include <cstdint>

#include "hal/template/board.hpp"
#include "hal/template/unit.hpp"

extern "C" {
sonoglide::hal::template_board::CarrierRegisters carrier;
sonoglide::hal::template_board::UartRegisters uart;
}

namespace sonoglide::hal::template_board::template_board_test {
namespace {

class TemplateBoard : public testing::Test {
 protected:
  TemplateBoard() {
    carrier.periods = 7;
    carrier.stop = 0;
    carrier.amplitude = 0;
  }

  /// The timer reaches another drive phase 0 with both conversions done.
  static void finish_period(std::uint32_t force, std::uint32_t velocity) {
    carrier.periods = carrier.periods + 1;
    carrier.force = force;
    carrier.velocity = velocity;
    carrier.force_ready = carrier.periods;
  }
};

TEST_F(TemplateBoard, SpreadsAConverterOverTheWholeCode) {
  Board board;
  Sample sample{};
  for (std::uint32_t code = 0; code < 4096; ++code) {
    finish_period(code, 4095 - code);
    ASSERT_TRUE(board.sample(sample));
    EXPECT_EQ(sample.friction_force, (static_cast<std::int64_t>(code) - 2048) * (1 << 20));
    EXPECT_EQ(sample.sliding_velocity, (2047 - static_cast<std::int64_t>(code)) * (1 << 20));
    EXPECT_EQ(sample.force_at_rail, code == 0 || code == 4095);
    EXPECT_EQ(sample.velocity_at_rail, code == 0 || code == 4095);
    EXPECT_TRUE(sample.fresh);
  }
}

TEST_F(TemplateBoard, SaysThatAPeriodWentByWithoutAnAnswer) {
  Board board;
  Sample sample{};
  finish_period(2048, 2048);
  finish_period(2048, 2048);
  ASSERT_TRUE(board.sample(sample));
  EXPECT_FALSE(sample.fresh);
  finish_period(2048, 2048);
  ASSERT_TRUE(board.sample(sample));
  EXPECT_TRUE(sample.fresh);
}

TEST_F(TemplateBoard, SaysThatAConversionIsNotThere) {
  Board board;
  Sample sample{};
  finish_period(2048, 2048);
  carrier.force_ready = carrier.periods - 1;
  ASSERT_TRUE(board.sample(sample));
  EXPECT_FALSE(sample.fresh);
}

TEST_F(TemplateBoard, CountsPeriodsAcrossTheirOverflow) {
  carrier.periods = 0xffffffffU;
  Board board;
  Sample sample{};
  finish_period(2048, 2048);
  ASSERT_TRUE(board.sample(sample));
  EXPECT_TRUE(sample.fresh);
}

TEST_F(TemplateBoard, DrivesWithTheUpperBitsOfTheAmplitude) {
  Board board;
  board.drive({INT32_MAX, 0, 0, 0, 0, 0});
  EXPECT_EQ(carrier.amplitude, 1023U);
  board.drive({1 << 30, 0, 0, 0, 0, 0});
  EXPECT_EQ(carrier.amplitude, 512U);
  board.drive({0, 0, 0, 0, 0, 0});
  EXPECT_EQ(carrier.amplitude, 0U);
}

TEST_F(TemplateBoard, StopsWithTheDriveOff) {
  Board board;
  board.drive({INT32_MAX, 0, 0, 0, 0, 0});
  carrier.stop = 1;
  Sample sample{};
  EXPECT_FALSE(board.sample(sample));
  EXPECT_EQ(carrier.amplitude, 0U);
}

TEST_F(TemplateBoard, MakesTheCarrierPeriodOfItsUnit) {
  UnitBoard board(1667);
  EXPECT_EQ(carrier.period_ticks, 1667U);
  Sample sample{};
  finish_period(2048, 2048);
  ASSERT_TRUE(board.sample(sample));
  EXPECT_TRUE(sample.fresh);
  EXPECT_EQ(board.period(), 8U);
}

TEST_F(TemplateBoard, ReceivesAndSendsWithoutWaiting) {
  Uart line;
  std::uint8_t byte = 7;
  uart.received_count = 0;
  uart.room = 0;
  uart.sent = 0;
  EXPECT_FALSE(line.receive(byte));
  EXPECT_FALSE(line.send(0x5a));
  EXPECT_EQ(byte, 7);
  EXPECT_EQ(uart.sent, 0U);
  uart.received = 0xa5;
  uart.received_count = 1;
  uart.room = 1;
  EXPECT_TRUE(line.receive(byte));
  EXPECT_TRUE(line.send(0x5a));
  EXPECT_EQ(byte, 0xa5);
  EXPECT_EQ(uart.sent, 0x5aU);
}

}  // namespace
}  // namespace sonoglide::hal::template_board::template_board_test
