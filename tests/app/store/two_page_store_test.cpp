/// Power is cut in every operation of a save, and cut again in the next.
#include "firmware/app/store/two_page_store.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/app/flash/simulated_flash.hpp"

namespace sonoglide::app::store {
namespace {

constexpr std::uint32_t layout = 7;
using Store = TwoPageStore<SimulatedFlash, 6>;
using Record = Store::Record;

constexpr Record compiled_in{1, 2, 3, 4, 5, 6};

Record record(std::uint32_t number) {
  return {number, 0xFFFFFFFFU, 0, number << 24, ~number, 0x5A5A5A5AU};
}

struct Loaded {
  Record record = compiled_in;
  Origin origin = Origin::blank;
};

/// What is found after a reset.
Loaded loaded(SimulatedFlash& flash, std::uint32_t wanted_layout = layout) {
  flash.restore_power();
  Store store(flash, wanted_layout);
  Loaded result;
  result.origin = store.load(result.record);
  return result;
}

Saving save(SimulatedFlash& flash, const Record& wanted) {
  Store store(flash, layout);
  Record old{};
  store.load(old);
  store.save(wanted);
  Saving saving = Saving::busy;
  while (saving == Saving::busy && flash.powered()) {
    saving = store.proceed();
  }
  EXPECT_FALSE(flash.misused());
  return saving;
}

int operations_of_a_save() {
  SimulatedFlash flash;
  save(flash, record(1));
  return flash.operations();
}

/// Saves with a cut, or whole where the save has fewer operations; what a reset then finds.
Loaded save_cut(SimulatedFlash& flash, const Record& wanted, int operations, Torn torn) {
  flash.cut_after(operations, torn);
  save(flash, wanted);
  return loaded(flash);
}

TEST(TwoPageStoreTest, BlankFlashLeavesWhatIsCompiledIn) {
  SimulatedFlash flash;
  const Loaded found = loaded(flash);
  EXPECT_EQ(found.origin, Origin::blank);
  EXPECT_EQ(found.record, compiled_in);
}

TEST(TwoPageStoreTest, TheLastOfManyRecordsIsKept) {
  SimulatedFlash flash;
  for (std::uint32_t i = 0; i < 100; ++i) {
    ASSERT_EQ(save(flash, record(i)), Saving::saved);
    const Loaded found = loaded(flash);
    ASSERT_EQ(found.origin, Origin::stored);
    ASSERT_EQ(found.record, record(i));
  }
}

TEST(TwoPageStoreTest, ASaveIsOneEraseAndAWordAtATime) {
  // Layout, sequence, record, checksum.
  EXPECT_EQ(operations_of_a_save(), 1 + 2 + 6 + 1);
  SimulatedFlash flash;
  Store store(flash, layout);
  Record old{};
  store.load(old);
  store.save(record(1));
  int before = 0;
  while (store.proceed() == Saving::busy) {
    EXPECT_LE(flash.operations(), before + 1);
    before = flash.operations();
  }
}

TEST(TwoPageStoreTest, SequenceNumbersWrap) {
  SimulatedFlash flash;
  save(flash, record(0));
  save(flash, record(1));
  for (std::size_t page = 0; page < 2; ++page) {
    // The same records as if 2^32 - 2 had gone before.
    auto& words = flash.page(page);
    words[1] += 0xFFFFFFFEU;
    encoding::Crc32 checksum;
    for (std::size_t i = 0; i < 8; ++i) {
      checksum.add_word(words[i]);
    }
    words[8] = checksum.value();
  }
  for (std::uint32_t i = 2; i < 8; ++i) {
    ASSERT_EQ(loaded(flash).record, record(i - 1));
    save(flash, record(i));
  }
}

/// Flash with `saves` whole saves behind it.
SimulatedFlash used(std::uint32_t saves) {
  SimulatedFlash flash;
  for (std::uint32_t i = 0; i < saves; ++i) {
    save(flash, record(i));
  }
  return flash;
}

TEST(TwoPageStoreTest, ACutLeavesTheOldRecordOrTheNewAndSoDoesTheNextCut) {
  const int operations = operations_of_a_save();
  for (const std::uint32_t saves : {0U, 1U, 2U, 3U}) {
    for (int first = 0; first <= operations; ++first) {
      for (const Torn first_tear : every_tear) {
        SimulatedFlash once = used(saves);
        const Record old = loaded(once).record;
        const Record after_first = save_cut(once, record(20), first, first_tear).record;
        ASSERT_TRUE(after_first == old || after_first == record(20)) << first;
        for (int second = 0; second <= operations; ++second) {
          for (const Torn second_tear : every_tear) {
            SimulatedFlash twice = once;
            const Record after_second = save_cut(twice, record(30), second, second_tear).record;
            ASSERT_TRUE(after_second == after_first || after_second == record(30))
                << first << ", " << second;
            ASSERT_EQ(save(twice, record(40)), Saving::saved);
            ASSERT_EQ(loaded(twice).record, record(40));
          }
        }
      }
    }
  }
}

// Every subset of a word's bits would be too many: a thousand random ones for each word.
TEST(TwoPageStoreTest, AnyBitsOfATornWordLeaveARecordWhole) {
  SimulatedFlash flash = used(3);
  const Record old = loaded(flash).record;
  for (int operation = 0; operation < operations_of_a_save(); ++operation) {
    for (int i = 0; i < 1000; ++i) {
      const Record found = save_cut(flash, record(20), operation, Torn::arbitrary).record;
      ASSERT_EQ(found, old) << operation;
    }
  }
}

TEST(TwoPageStoreTest, ASaveThatWasReportedIsThere) {
  for (const std::uint32_t saves : {0U, 1U, 2U}) {
    SimulatedFlash flash = used(saves);
    EXPECT_EQ(save(flash, record(9)), Saving::saved);
    EXPECT_EQ(loaded(flash).record, record(9));
  }
}

TEST(TwoPageStoreTest, WornFlashIsReportedAndTheOldRecordStands) {
  SimulatedFlash flash = used(2);
  flash.wear_out();
  EXPECT_EQ(save(flash, record(9)), Saving::failed);
  EXPECT_EQ(loaded(flash).record, record(1));
}

TEST(TwoPageStoreTest, AnotherLayoutLeavesWhatIsCompiledInAndIsReported) {
  SimulatedFlash flash = used(2);
  const Loaded found = loaded(flash, layout + 1);
  EXPECT_EQ(found.origin, Origin::other_layout);
  EXPECT_EQ(found.record, compiled_in);
}

TEST(TwoPageStoreTest, WhatIsNotWholeIsReported) {
  SimulatedFlash flash = used(1);
  flash.page(0)[4] ^= 1U;
  const Loaded found = loaded(flash);
  EXPECT_EQ(found.origin, Origin::damaged);
  EXPECT_EQ(found.record, compiled_in);
}

TEST(TwoPageStoreTest, EverySingleBitThatFallsIsNoticed) {
  const SimulatedFlash intact = used(2);
  for (std::size_t word = 0; word < 9; ++word) {
    for (int bit = 0; bit < 32; ++bit) {
      SimulatedFlash flash = intact;
      flash.page(1)[word] ^= 1U << bit;
      ASSERT_EQ(loaded(flash).record, record(0)) << word << ", " << bit;
    }
  }
}

}  // namespace
}  // namespace sonoglide::app::store
