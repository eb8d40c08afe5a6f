/// Power is cut in every operation of a save, and cut again in the next.
#include "firmware/store/two_page_store.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "tests/firmware/app/flash/simulated_flash.hpp"

namespace sonoglide::store::two_page_store_test {
namespace {

constexpr std::uint32_t design = 7;
constexpr std::size_t count = 6;
using Store = TwoPageStore<app::SimulatedFlash, count>;
using Values = std::array<std::uint32_t, count>;

constexpr Values compiled_in{1, 2, 3, 4, 5, 6};

constexpr std::uint32_t identity(std::size_t entry) {
  return 0x10000001U * static_cast<std::uint32_t>(entry + 1);
}

Values values(std::uint32_t number) {
  return {number, 0xFFFFFFFFU, 0, number << 24, ~number, 0x5A5A5A5AU};
}

Store::Record record(const Values& wanted) {
  Store::Record result{};
  for (std::size_t i = 0; i < count; ++i) {
    result[i] = {identity(i), wanted[i]};
  }
  return result;
}

struct Loaded {
  Values values = compiled_in;
  Origin origin = Origin::blank;
};

/// What a store of a design finds after a reset.
template <class FoundBy = Store>
Loaded loaded(app::SimulatedFlash& flash, std::uint32_t wanted_design = design) {
  flash.restore_power();
  FoundBy store(flash, wanted_design);
  Loaded result;
  result.origin = store.load();
  for (std::size_t i = 0; i < count; ++i) {
    store.find(identity(i), result.values[i]);
  }
  return result;
}

/// Of a store whose last save was cut: the old values or the new.
bool is_found(Origin origin) {
  return origin == Origin::stored || origin == Origin::blank || origin == Origin::damaged;
}

Saving save(app::SimulatedFlash& flash, const Values& wanted) {
  Store store(flash, design);
  store.load();
  store.save(record(wanted));
  Saving saving = Saving::busy;
  while (saving == Saving::busy && flash.powered()) {
    saving = store.proceed();
  }
  EXPECT_FALSE(flash.misused());
  return saving;
}

int operations_of_a_save() {
  app::SimulatedFlash flash;
  save(flash, values(1));
  return flash.operations();
}

/// Saves with a cut, or whole where the save has fewer operations; what a reset then finds.
Loaded save_cut(app::SimulatedFlash& flash, const Values& wanted, int operations, app::Torn torn) {
  flash.cut_after(operations, torn);
  save(flash, wanted);
  const Loaded found = loaded(flash);
  EXPECT_TRUE(is_found(found.origin));
  return found;
}

TEST(TwoPageStoreTest, BlankFlashLeavesWhatIsCompiledIn) {
  app::SimulatedFlash flash;
  const Loaded found = loaded(flash);
  EXPECT_EQ(found.origin, Origin::blank);
  EXPECT_EQ(found.values, compiled_in);
}

TEST(TwoPageStoreTest, TheLastOfManyRecordsIsKept) {
  app::SimulatedFlash flash;
  for (std::uint32_t i = 0; i < 100; ++i) {
    ASSERT_EQ(save(flash, values(i)), Saving::saved);
    const Loaded found = loaded(flash);
    ASSERT_EQ(found.origin, Origin::stored);
    ASSERT_EQ(found.values, values(i));
  }
}

TEST(TwoPageStoreTest, ASaveIsOneEraseAndAWordAtATime) {
  // Format, sequence, design, identities and values, checksum.
  EXPECT_EQ(operations_of_a_save(), 1 + 3 + 2 * 6 + 1);
  app::SimulatedFlash flash;
  Store store(flash, design);
  store.load();
  store.save(record(values(1)));
  int before = 0;
  while (store.proceed() == Saving::busy) {
    EXPECT_LE(flash.operations(), before + 1);
    before = flash.operations();
  }
}

constexpr std::size_t words_used = 3 + 2 * count + 1;

/// Flash with `saves` whole saves behind it.
app::SimulatedFlash used(std::uint32_t saves) {
  app::SimulatedFlash flash;
  for (std::uint32_t i = 0; i < saves; ++i) {
    save(flash, values(i));
  }
  return flash;
}

// What firmware that is in use has written, the checksum by zlib.
TEST(TwoPageStoreTest, APageIsLaidOutAsDocumented) {
  using Words = std::array<std::uint32_t, words_used>;
  app::SimulatedFlash flash;
  save(flash, values(3));
  save(flash, values(4));
  const Words expected[2] = {
      {0x534E4706, 0x00000000, 0x00000007, 0x10000001, 0x00000003, 0x20000002, 0xFFFFFFFF,
       0x30000003, 0x00000000, 0x40000004, 0x03000000, 0x50000005, 0xFFFFFFFC, 0x60000006,
       0x5A5A5A5A, 0xC9B28B61},
      {0x534E4706, 0x00000001, 0x00000007, 0x10000001, 0x00000004, 0x20000002, 0xFFFFFFFF,
       0x30000003, 0x00000000, 0x40000004, 0x04000000, 0x50000005, 0xFFFFFFFB, 0x60000006,
       0x5A5A5A5A, 0x56F5A45C}};
  for (const std::size_t page : {0U, 1U}) {
    for (std::size_t i = 0; i < app::SimulatedFlash::page_words; ++i) {
      EXPECT_EQ(flash.read(page, i), i < words_used ? expected[page][i] : 0xFFFFFFFFU)
          << page << ", " << i;
    }
  }
  app::SimulatedFlash written;
  for (std::size_t i = 0; i < words_used; ++i) {
    written.page(1)[i] = expected[1][i];
  }
  EXPECT_EQ(loaded(written).origin, Origin::stored);
  EXPECT_EQ(loaded(written).values, values(4));
}

TEST(TwoPageStoreTest, ASaveThatIsGivenUpLeavesTheOldRecordAndTheNextSaveIsWhole) {
  for (int steps = 0; steps < 100; ++steps) {
    app::SimulatedFlash flash = used(2);
    Store store(flash, design);
    store.load();
    store.save(record(values(20)));
    Saving saving = Saving::busy;
    for (int i = 0; i < steps && saving == Saving::busy; ++i) {
      saving = store.proceed();
    }
    if (saving == Saving::busy) {
      EXPECT_EQ(store.abandon(), Saving::failed);
      EXPECT_EQ(store.proceed(), Saving::idle);
    }
    const Values found = loaded(flash).values;
    EXPECT_TRUE(found == values(1) || found == values(20)) << steps;
    store.save(record(values(30)));
    while ((saving = store.proceed()) == Saving::busy) {
    }
    EXPECT_EQ(saving, Saving::saved) << steps;
    EXPECT_EQ(loaded(flash).values, values(30)) << steps;
    EXPECT_FALSE(flash.misused());
  }
}

TEST(TwoPageStoreTest, WhileARecordIsBeingSavedAnotherIsNotTaken) {
  app::SimulatedFlash flash;
  Store store(flash, design);
  store.load();
  store.save(record(values(20)));
  while (store.proceed() == Saving::busy) {
    store.save(record(values(30)));
  }
  EXPECT_EQ(store.proceed(), Saving::idle);
  EXPECT_EQ(loaded(flash).values, values(20));
}

TEST(TwoPageStoreTest, SequenceNumbersWrap) {
  app::SimulatedFlash flash;
  save(flash, values(0));
  save(flash, values(1));
  for (std::size_t page = 0; page < 2; ++page) {
    // The same records as if 2^32 - 2 had gone before.
    auto& words = flash.page(page);
    words[1] += 0xFFFFFFFEU;
    encoding::Crc32 checksum;
    for (std::size_t i = 0; i < words_used - 1; ++i) {
      checksum.add_word(words[i]);
    }
    words[words_used - 1] = checksum.value();
  }
  for (std::uint32_t i = 2; i < 8; ++i) {
    ASSERT_EQ(loaded(flash).values, values(i - 1));
    save(flash, values(i));
  }
}

TEST(TwoPageStoreTest, ACutLeavesTheOldRecordOrTheNewAndSoDoesTheNextCut) {
  const int operations = operations_of_a_save();
  for (const std::uint32_t saves : {0U, 1U, 2U, 3U}) {
    for (int first = 0; first <= operations; ++first) {
      for (const app::Torn first_tear : app::every_tear) {
        app::SimulatedFlash once = used(saves);
        const Values old = loaded(once).values;
        const Values after_first = save_cut(once, values(20), first, first_tear).values;
        ASSERT_TRUE(after_first == old || after_first == values(20)) << first;
        for (int second = 0; second <= operations; ++second) {
          for (const app::Torn second_tear : app::every_tear) {
            app::SimulatedFlash twice = once;
            const Values after_second = save_cut(twice, values(30), second, second_tear).values;
            ASSERT_TRUE(after_second == after_first || after_second == values(30))
                << first << ", " << second;
            ASSERT_EQ(save(twice, values(40)), Saving::saved);
            ASSERT_EQ(loaded(twice).values, values(40));
          }
        }
      }
    }
  }
}

// Every subset of a word's bits would be too many: a thousand random ones for each word.
TEST(TwoPageStoreTest, AnyBitsOfATornWordLeaveARecordWhole) {
  app::SimulatedFlash flash = used(3);
  const Values old = loaded(flash).values;
  for (int operation = 0; operation < operations_of_a_save(); ++operation) {
    for (int i = 0; i < 1000; ++i) {
      const Values found = save_cut(flash, values(20), operation, app::Torn::arbitrary).values;
      ASSERT_EQ(found, old) << operation;
    }
  }
}

TEST(TwoPageStoreTest, ASaveThatWasReportedIsThere) {
  for (const std::uint32_t saves : {0U, 1U, 2U}) {
    app::SimulatedFlash flash = used(saves);
    EXPECT_EQ(save(flash, values(9)), Saving::saved);
    EXPECT_EQ(loaded(flash).values, values(9));
  }
}

TEST(TwoPageStoreTest, WornFlashIsReportedAndTheOldRecordStands) {
  app::SimulatedFlash flash = used(2);
  flash.wear_out();
  EXPECT_EQ(save(flash, values(9)), Saving::failed);
  EXPECT_EQ(loaded(flash).values, values(1));
}

TEST(TwoPageStoreTest, AnotherDesignFindsWhatItKnowsAndSaysSo) {
  app::SimulatedFlash flash = used(2);
  const Loaded found = loaded(flash, design + 1);
  EXPECT_EQ(found.origin, Origin::other_design);
  EXPECT_EQ(found.values, values(1));
}

// Entries are found by their identity, wherever they stand and whatever others there are.
TEST(TwoPageStoreTest, OtherListsOfEntriesFindTheirOwn) {
  app::SimulatedFlash flash = used(2);
  using Shorter = TwoPageStore<app::SimulatedFlash, 2>;
  using Longer = TwoPageStore<app::SimulatedFlash, 30>;
  EXPECT_EQ(loaded<Shorter>(flash, design + 1).values, values(1));
  EXPECT_EQ(loaded<Longer>(flash, design + 1).values, values(1));
  Shorter shorter(flash, design + 1);
  shorter.load();
  shorter.save({Entry{identity(4), 44}, Entry{identity(9), 99}});
  while (shorter.proceed() == Saving::busy) {
  }
  const Loaded found = loaded(flash);
  EXPECT_EQ(found.origin, Origin::other_design);
  EXPECT_EQ(found.values, (Values{1, 2, 3, 4, 44, 6}));
  Store store(flash, design);
  store.load();
  std::uint32_t value = 7;
  EXPECT_FALSE(store.find(identity(3), value));
  EXPECT_EQ(value, 7U);
  EXPECT_TRUE(store.find(identity(9), value));
  EXPECT_EQ(value, 99U);
}

TEST(TwoPageStoreTest, WhatIsNotWholeIsReported) {
  app::SimulatedFlash flash = used(1);
  flash.page(0)[4] ^= 1U;
  const Loaded found = loaded(flash);
  EXPECT_EQ(found.origin, Origin::damaged);
  EXPECT_EQ(found.values, compiled_in);
}

TEST(TwoPageStoreTest, OfTwoPagesWithoutARecordEitherMayBeTheDamagedOne) {
  for (const std::size_t page : {0U, 1U}) {
    app::SimulatedFlash flash;
    flash.page(page)[app::SimulatedFlash::page_words - 1] ^= 1U;
    EXPECT_EQ(loaded(flash).origin, Origin::damaged) << page;
  }
}

// The older record may be the looser one: it is not `stored`.
TEST(TwoPageStoreTest, EverySingleBitThatFallsIsReported) {
  const app::SimulatedFlash intact = used(2);
  for (const std::size_t page : {0U, 1U}) {
    for (std::size_t word = 0; word < words_used; ++word) {
      for (int bit = 0; bit < 32; ++bit) {
        app::SimulatedFlash flash = intact;
        flash.page(page)[word] ^= 1U << bit;
        const Loaded found = loaded(flash);
        ASSERT_EQ(found.origin, Origin::damaged) << page << ", " << word << ", " << bit;
        ASSERT_EQ(found.values, values(page == 1 ? 0 : 1)) << word << ", " << bit;
      }
    }
  }
}

TEST(TwoPageStoreTest, AnyFirstWordIsNoRecordUnlessItIs) {
  app::SimulatedFlash flash = used(1);
  const std::uint32_t first = flash.page(0)[0];
  for (std::uint32_t entries = 0; entries < 256; ++entries) {
    flash.page(0)[0] = (first & 0xFFFFFF00U) | entries;
    ASSERT_EQ(loaded(flash).origin, entries == count ? Origin::stored : Origin::damaged) << entries;
  }
}

}  // namespace
}  // namespace sonoglide::store::two_page_store_test
