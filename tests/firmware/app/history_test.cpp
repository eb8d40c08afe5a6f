/// What a unit has been through is counted over resets, whatever the flash does.
#include "firmware/app/history.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "firmware/app/link_service.hpp"
#include "firmware/app/timed_loop.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::app::history_test {
namespace {

using hal::ResetCause;

using History = UnitHistory<HistoryPages>;
static_assert(std::is_same_v<HistoryOn<HistoryPages>, History>);
static_assert(std::is_same_v<HistoryOn<SimulatedFlash>, NoHistory>);

constexpr std::uint32_t periods_per_second = 1000;
constexpr hal::KeptException kept{3, 0x1234, 0x5679, 0x61000003, 1U << 16, 1U << 30, 0xe000ed00};

/// From a reset to the next; the flash outlives it.
struct Boot {
  explicit Boot(SimulatedFlash& flash, ResetCause cause = ResetCause::power_on,
                const hal::KeptException* exception = nullptr)
      : pages(powered(flash)), history(pages, watchdog, cause, exception, periods_per_second) {}

  /// In operation, at rest or not.
  void pass(std::uint32_t seconds, bool resting) {
    for (const std::uint32_t end = periods + seconds * periods_per_second; periods != end;) {
      history.serve(++periods, resting);
    }
  }

  static SimulatedFlash& powered(SimulatedFlash& flash) {
    flash.restore_power();
    return flash;
  }

  HistoryPages pages;
  CountingWatchdog watchdog;
  History history;
  std::uint32_t periods = 0;
};

TEST(UnitHistoryTest, CountsResetsByTheirCause) {
  SimulatedFlash flash;
  for (std::uint32_t i = 1; i <= 50; ++i) {
    const Boot boot(flash, i % 5 == 0 ? ResetCause::watchdog : ResetCause::reset);
    EXPECT_EQ(boot.history[History::boots], i);
    EXPECT_EQ(boot.history[History::watchdog_resets], i / 5);
    EXPECT_EQ(boot.history[History::exceptions], 0U);
    EXPECT_EQ(boot.history.cause(), i % 5 == 0 ? ResetCause::watchdog : ResetCause::reset);
    EXPECT_TRUE(boot.history.saved());
    EXPECT_GT(boot.watchdog.feeds, 0);
  }
  EXPECT_FALSE(flash.misused());
}

TEST(UnitHistoryTest, KeepsTheLastException) {
  SimulatedFlash flash;
  const Boot first(flash);
  const Boot second(flash, ResetCause::exception, &kept);
  for (int i = 3; i < 20; ++i) {
    const Boot boot(flash);
    EXPECT_EQ(boot.history[History::exceptions], 1U);
    EXPECT_EQ(boot.history[History::exception_boot], 2U);
    EXPECT_EQ(boot.history.exception(), hal::words_of(kept));
  }
  const Boot last(flash, ResetCause::exception, &kept);
  EXPECT_EQ(last.history[History::exceptions], 2U);
  EXPECT_EQ(last.history[History::exception_boot], 20U);
}

TEST(UnitHistoryTest, PowerThatIsCutWhileABootIsWrittenCostsThisBootAtMost) {
  constexpr int operations_of_a_boot = 1 + 12 + 2;
  for (std::uint32_t before = 0; before < 10; ++before) {
    SimulatedFlash used;
    for (std::uint32_t i = 0; i < before; ++i) {
      const Boot boot(used);
    }
    for (int cut = 0; cut < operations_of_a_boot; ++cut) {
      for (const Torn torn : every_tear) {
        SimulatedFlash flash = used;
        flash.cut_after(cut, torn);
        HistoryPages pages(flash);
        CountingWatchdog watchdog;
        History(pages, watchdog, ResetCause::power_on, nullptr, periods_per_second);
        const Boot next(flash);
        EXPECT_TRUE(next.history[History::boots] == before + 1 ||
                    next.history[History::boots] == before + 2)
            << before << ", " << cut;
        EXPECT_TRUE(before == 0 || !next.history.began_anew()) << before << ", " << cut;
        const Boot last(flash);
        EXPECT_EQ(last.history[History::boots], next.history[History::boots] + 1);
        EXPECT_FALSE(flash.misused());
      }
    }
  }
}

TEST(UnitHistoryTest, ItsTimeIsWrittenDownAfterAStopOnceAMinute) {
  SimulatedFlash flash;
  {
    Boot boot(flash);
    const int operations = flash.operations();
    boot.pass(100, false);
    boot.history.note_stop();
    boot.pass(1, false);
    EXPECT_EQ(flash.operations(), operations) << "while it drives";
    boot.pass(1, true);
    EXPECT_EQ(flash.operations(), operations + 12 + 2);
    boot.pass(58, true);
    boot.history.note_stop();
    boot.pass(1, true);
    EXPECT_EQ(flash.operations(), operations + 12 + 2) << "too soon";
    EXPECT_EQ(boot.history[History::seconds], 161U);
  }
  {
    Boot boot(flash);
    EXPECT_EQ(boot.history[History::seconds], 101U);
    boot.pass(60, false);
    boot.history.note_stop();
    boot.pass(1, true);
    EXPECT_TRUE(boot.history.saved());
  }
  const Boot boot(flash);
  EXPECT_EQ(boot.history[History::seconds], 161U);
  EXPECT_EQ(boot.history[History::boots], 3U);
}

// A drive that begins meanwhile holds the save up; nothing is lost.
TEST(UnitHistoryTest, ASaveWaitsForTheDriveToEnd) {
  SimulatedFlash flash;
  {
    Boot boot(flash);
    boot.pass(70, false);
    boot.history.note_stop();
    for (int i = 0; i < 10; ++i) {
      boot.history.serve(++boot.periods, true);
    }
    const int operations = flash.operations();
    boot.pass(5, false);
    EXPECT_EQ(flash.operations(), operations);
    EXPECT_EQ(Boot(flash).history[History::seconds], 0U);
  }
  SimulatedFlash other;
  Boot boot(other);
  boot.pass(70, false);
  boot.history.note_stop();
  for (int i = 0; i < 10; ++i) {
    boot.history.serve(++boot.periods, true);
  }
  boot.pass(5, false);
  boot.pass(1, true);
  EXPECT_EQ(Boot(other).history[History::seconds], 70U);
  EXPECT_FALSE(other.misused());
}

TEST(UnitHistoryTest, TheCounterOfPeriodsWraps) {
  SimulatedFlash flash;
  HistoryPages pages(flash);
  CountingWatchdog watchdog;
  constexpr std::uint32_t second = 1U << 31;
  History history(pages, watchdog, ResetCause::power_on, nullptr, second);
  std::uint32_t periods = 0;
  for (int i = 0; i < 100; ++i) {
    history.serve(periods += second / 2, true);
  }
  EXPECT_EQ(history[History::seconds], 50U);
}

TEST(UnitHistoryTest, AFlashThatTakesNothingIsToldAndKeepsNobodyWaiting) {
  SimulatedFlash worn;
  const Boot first(worn);
  worn.wear_out();
  const Boot second(worn);
  EXPECT_EQ(second.history[History::boots], 2U);
  EXPECT_FALSE(second.history.saved());
  const Boot third(worn);
  EXPECT_EQ(third.history[History::boots], 2U);

  SimulatedFlash hung;
  hung.hang();
  const Boot boot(hung);
  EXPECT_FALSE(boot.history.saved());
}

TEST(UnitHistoryTest, ThatItBeganAnewIsToldFromThenOn) {
  SimulatedFlash flash;
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(Boot(flash).history.began_anew());
  }
  for (std::size_t page = 0; page < 2; ++page) {
    for (std::uint32_t& word : flash.page(page)) {
      word &= ~1U;
    }
  }
  for (std::uint32_t i = 1; i < 20; ++i) {
    const Boot boot(flash, i == 5 ? ResetCause::exception : ResetCause::reset,
                    i == 5 ? &kept : nullptr);
    EXPECT_TRUE(boot.history.began_anew());
    EXPECT_EQ(boot.history[History::boots], i);
    EXPECT_EQ(boot.history[History::exception_boot], i < 5 ? 0U : 5U);
  }
}

struct ProductWithHistory : TestedProduct {
  static inline History* history = nullptr;
};

TEST(UnitHistoryTest, IsToldToTheHostAndSavedAfterItsStop) {
  SimulatedFlash history_flash;
  Boot boot(history_flash, ResetCause::exception, &kept);
  boot.pass(90, false);
  ProductWithHistory::history = &boot.history;
  SimulatedFlash flash;
  TestedUnit unit(field_design, flash);
  Wire wire;
  LinkService<TestedUnit, Wire, 1, ProductWithHistory> service(unit, wire);
  TimedBoard board(boot.periods);
  CountingWatchdog watchdog;
  TimedLoop loop(unit.supervisor(), board, watchdog, service);
  std::uint16_t sequence = 0;
  const auto ask = [&](const auto& request) {
    const link::WireFrame encoded = link::encode(link::frame_of(request, sequence++));
    wire.to_unit.insert(wire.to_unit.end(), encoded.bytes.begin(),
                        encoded.bytes.begin() + static_cast<std::ptrdiff_t>(encoded.size));
    wire.from_unit.clear();
    link::FrameDecoder decoder;
    for (int i = 0; i < 300; ++i) {
      loop.serve();
    }
    link::Frame answer{};
    for (const std::uint8_t byte : wire.from_unit) {
      if (decoder.take(byte) == link::Reception::frame) {
        answer = decoder.frame();
      }
    }
    return answer;
  };
  link::History told{};
  ASSERT_TRUE(link::read(ask(link::ReadHistory{}), told));
  EXPECT_EQ(told.boots, 1U);
  EXPECT_GE(told.seconds, 90U);
  EXPECT_EQ(told.exceptions, 1U);
  EXPECT_EQ(told.exception_boot, 1U);
  EXPECT_EQ(told.cause, static_cast<std::uint8_t>(ResetCause::exception));
  EXPECT_EQ(told.saved, 1);
  EXPECT_EQ(told.began_anew, 0);
  link::KeptException exception{};
  ASSERT_TRUE(link::read(ask(link::ReadException{}), exception));
  EXPECT_EQ(exception.words, hal::words_of(kept));
  const int operations = history_flash.operations();
  ask(link::Restart{});
  EXPECT_TRUE(unit.supervisor().driving());
  EXPECT_EQ(history_flash.operations(), operations);
  ask(link::Stop{});
  EXPECT_EQ(history_flash.operations(), operations + 12 + 2);
  EXPECT_GE(Boot(history_flash).history[History::seconds], 90U);
}

}  // namespace
}  // namespace sonoglide::app::history_test
