/// Power is cut in every operation of many saves, and cut again in the next.
#include "firmware/store/record_log.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "tests/firmware/app/flash/simulated_flash.hpp"

namespace sonoglide::store::record_log_test {
namespace {

constexpr std::size_t count = 12;
using Log = RecordLog<app::SimulatedFlash, count>;
using Record = Log::Record;
static_assert(Log::slots == 4);

constexpr int operations_of_a_save = count + 2;
constexpr Record none{};

Record record(std::uint32_t number) {
  Record result{};
  for (std::uint32_t i = 0; i < count; ++i) {
    result[i] = i % 2 == 0 ? number * (i + 1) : ~number << i;
  }
  return result;
}

/// After a reset.
Record loaded(app::SimulatedFlash& flash) {
  flash.restore_power();
  Record result = none;
  Log(flash, 0).load(result);
  return result;
}

Origin origin(app::SimulatedFlash& flash) {
  Record found{};
  return Log(flash, 0).load(found);
}

Saving save(app::SimulatedFlash& flash, const Record& wanted) {
  Log log(flash, 0);
  Record old{};
  log.load(old);
  log.save(wanted);
  Saving saving = Saving::busy;
  while (saving == Saving::busy && flash.powered()) {
    saving = log.proceed();
  }
  EXPECT_FALSE(flash.misused());
  return saving;
}

/// With some saves behind it, from record(1) on.
app::SimulatedFlash used(std::uint32_t saves) {
  app::SimulatedFlash flash;
  for (std::uint32_t i = 1; i <= saves; ++i) {
    EXPECT_EQ(save(flash, record(i)), Saving::saved);
  }
  return flash;
}

TEST(RecordLogTest, BlankFlashAndWhatIsNoneHoldNoRecord) {
  app::SimulatedFlash flash;
  EXPECT_EQ(loaded(flash), none);
  EXPECT_EQ(origin(flash), Origin::blank);
  for (const std::uint32_t word : {0U, 0x534E4800U, 0x12345678U}) {
    flash.page(0).fill(word);
    flash.page(1).fill(word);
    EXPECT_EQ(loaded(flash), none);
    EXPECT_EQ(origin(flash), Origin::damaged);
  }
  EXPECT_EQ(save(flash, record(5)), Saving::saved);  // erases first
  EXPECT_EQ(loaded(flash), record(5));
}

TEST(RecordLogTest, TheLastOfManyRecordsIsKept) {
  app::SimulatedFlash flash;
  for (std::uint32_t i = 1; i < 100; ++i) {
    ASSERT_EQ(save(flash, record(i)), Saving::saved);
    ASSERT_EQ(loaded(flash), record(i));
  }
}

TEST(RecordLogTest, SavesOneAfterTheOtherWithoutAReset) {
  app::SimulatedFlash flash;
  Log log(flash, 0);
  Record found{};
  EXPECT_EQ(log.load(found), Origin::blank);
  for (std::uint32_t i = 1; i < 100; ++i) {
    log.save(record(i));
    const int begin = flash.operations();
    int before = begin;
    while (log.proceed() == Saving::busy) {
      EXPECT_LE(flash.operations(), before + 1);
      before = flash.operations();
    }
    EXPECT_FALSE(log.saving());
    // A page is erased only where it is full: the last record stands until the next one is whole.
    EXPECT_EQ(before - begin, operations_of_a_save + ((i - 1) % Log::slots == 0 ? 1 : 0)) << i;
    ASSERT_EQ(loaded(flash), record(i));
  }
  EXPECT_FALSE(flash.misused());
}

TEST(RecordLogTest, APageIsErasedOnceInAsManySavesAsItHasSlots) {
  app::SimulatedFlash flash;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const int before = flash.operations();
    save(flash, record(i));
    EXPECT_EQ(flash.operations() - before, operations_of_a_save + (i % Log::slots == 0 ? 1 : 0));
  }
}

TEST(RecordLogTest, SequenceNumbersWrap) {
  app::SimulatedFlash flash;
  // As if 2^32 - 3 had gone before.
  auto& words = flash.page(0);
  words[0] = 0xFFFFFFFDU;
  encoding::Crc32 checksum;
  checksum.add_word(0x534E4800U | count);
  checksum.add_word(words[0]);
  for (std::size_t i = 0; i < count; ++i) {
    words[1 + i] = record(1)[i];
    checksum.add_word(words[1 + i]);
  }
  words[1 + count] = checksum.value();
  for (std::uint32_t i = 2; i < 20; ++i) {
    ASSERT_EQ(loaded(flash), record(i - 1));
    ASSERT_EQ(save(flash, record(i)), Saving::saved);
  }
}

TEST(RecordLogTest, ACutLeavesTheOldRecordOrTheNewAndSoDoesTheNextCut) {
  for (std::uint32_t saves = 0; saves <= 2 * Log::slots + 1; ++saves) {
    const app::SimulatedFlash before = used(saves);
    const Record old = saves == 0 ? none : record(saves);
    for (int first = 0; first <= operations_of_a_save; ++first) {
      for (const app::Torn first_tear : app::every_tear) {
        app::SimulatedFlash once = before;
        once.cut_after(first, first_tear);
        save(once, record(20));
        const Record after_first = loaded(once);
        ASSERT_TRUE(after_first == old || after_first == record(20)) << saves << ", " << first;
        for (int second = 0; second <= operations_of_a_save; ++second) {
          for (const app::Torn second_tear : app::every_tear) {
            app::SimulatedFlash twice = once;
            twice.cut_after(second, second_tear);
            save(twice, record(30));
            const Record after_second = loaded(twice);
            ASSERT_TRUE(after_second == after_first || after_second == record(30))
                << saves << ", " << first << ", " << second;
            ASSERT_EQ(save(twice, record(40)), Saving::saved);
            ASSERT_EQ(loaded(twice), record(40));
          }
        }
      }
    }
  }
}

TEST(RecordLogTest, EverySingleBitThatFallsCostsItsRecordAlone) {
  const app::SimulatedFlash intact = used(3);
  for (std::size_t word = 0; word < 3 * (count + 2); ++word) {
    for (int bit = 0; bit < 32; ++bit) {
      app::SimulatedFlash flash = intact;
      flash.page(0)[word] ^= 1U << bit;
      const bool of_the_last = word / (count + 2) == 2;
      ASSERT_EQ(loaded(flash), record(of_the_last ? 2 : 3)) << word << ", " << bit;
      ASSERT_EQ(save(flash, record(9)), Saving::saved);
      ASSERT_EQ(loaded(flash), record(9)) << word << ", " << bit;
    }
  }
}

TEST(RecordLogTest, OneBitThatHasFallenIsNoBlankFlash) {
  for (std::size_t word = 0; word < 2 * Log::slots * (count + 2); ++word) {
    app::SimulatedFlash flash;
    constexpr std::size_t of_a_page = Log::slots * (count + 2);
    flash.page(word / of_a_page)[word % of_a_page] ^= 1U << word % 32;
    EXPECT_EQ(origin(flash), Origin::damaged) << word;
  }
}

TEST(RecordLogTest, WornFlashIsReportedAndTheOldRecordStands) {
  for (std::uint32_t saves = 1; saves <= 2 * Log::slots; ++saves) {
    app::SimulatedFlash flash = used(saves);
    flash.wear_out();
    Log log(flash, 0);
    Record found{};
    EXPECT_EQ(log.load(found), Origin::stored);
    for (int i = 0; i < 20; ++i) {
      log.save(record(9));
      Saving saving = Saving::busy;
      while ((saving = log.proceed()) == Saving::busy) {
      }
      EXPECT_EQ(saving, Saving::failed);
      ASSERT_EQ(loaded(flash), record(saves)) << saves;
    }
  }
}

TEST(RecordLogTest, ASaveIsNotDisturbedByTheNextNorByServicesAfterIt) {
  app::SimulatedFlash flash;
  Log log(flash, 0);
  Record found{};
  log.load(found);
  EXPECT_EQ(log.proceed(), Saving::idle);
  log.save(record(1));
  EXPECT_EQ(log.proceed(), Saving::busy);
  log.save(record(2));
  while (log.saving()) {
    log.proceed();
  }
  EXPECT_EQ(log.proceed(), Saving::idle);
  EXPECT_EQ(loaded(flash), record(1));
}

}  // namespace
}  // namespace sonoglide::store::record_log_test
