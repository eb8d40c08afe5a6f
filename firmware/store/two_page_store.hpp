/// Numbers in flash that survive a power cut, and that other firmware finds by name.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/encoding/crc32.hpp"

namespace sonoglide::store {

/// Result of the search of the store.
enum class Origin : std::uint8_t {
  stored,
  blank,         ///< nothing was ever stored
  other_design,  ///< a whole record of another design
  damaged,       ///< a page holds neither a record nor nothing; the other's record may be whole
};

enum class Saving : std::uint8_t {
  idle,
  busy,
  saved,   ///< what was written is in force from the next load() on
  failed,  ///< the flash did not keep what was programmed, or stayed busy; the old record stands
};

/// A value under its name.
struct Entry {
  std::uint32_t identity;  ///< of what the value is one of, the same in every design
  std::uint32_t value;
};

/// Keeps a record of `Count` entries in two flash pages, written in turn.
///
/// | word          | holds                                              |
/// |---------------|----------------------------------------------------|
/// | 0             | `format`, and in its low byte the number of entries |
/// | 1             | sequence number, counts up and wraps               |
/// | 2             | design that the record was written under           |
/// | 3, 4 …        | identity and value of each entry                   |
/// | after them    | CRC-32 of all before it, words low first           |
///
/// The page with the older record is erased and programmed, its checksum last; the page with the
/// newer record is not touched. If power fails during any erase or program, load() finds the old
/// record or the new one, whole. The checksum takes a torn record for a whole one with a
/// probability of 2^-32. A cell left between 0 and 1 may read differently at each reset; each reset
/// then finds one of the two records. A torn page and a page that has decayed look alike. Both are
/// `damaged`, because the record that is left may have the looser limits.
///
/// @tparam Flash  see hal/board.hpp; not owned.
template <class Flash, std::size_t Count>
class TwoPageStore {
  static constexpr std::uint32_t format = 0x534E4700;
  static constexpr std::uint32_t count_bits = 0xFF;
  static constexpr std::size_t entries_begin = 3;
  static constexpr std::size_t checksum_at = entries_begin + 2 * Count;
  static constexpr std::size_t words_used = checksum_at + 1;
  static constexpr std::size_t most_entries = (Flash::page_words - entries_begin - 1) / 2;
  static_assert(words_used <= Flash::page_words && Count <= count_bits);

 public:
  using Record = std::array<Entry, Count>;

  /// @param flash   has the two pages; outlives the store.
  /// @param design  number of the design.
  TwoPageStore(Flash& flash, std::uint32_t design) : flash_(flash), design_(design) {}

  /// Finds the newest whole record, for find().
  Origin load() {
    const bool whole[2] = {is_whole(0), is_whole(1)};
    if (!whole[0] && !whole[1]) {
      stale_page_ = 0;
      sequence_ = 0;
      entries_ = 0;
      return is_blank(0) && is_blank(1) ? Origin::blank : Origin::damaged;
    }
    const std::size_t newest = whole[0] && whole[1] ? newer_page() : (whole[0] ? 0U : 1U);
    stale_page_ = 1 - newest;
    sequence_ = flash_.read(newest, 1) + 1;
    entries_ = entries(newest);
    if (!whole[stale_page_] && !is_blank(stale_page_)) {
      return Origin::damaged;
    }
    return flash_.read(newest, 2) == design_ ? Origin::stored : Origin::other_design;
  }

  /// @return false, and `value` as it was, where the record has no such entry.
  bool find(std::uint32_t identity, std::uint32_t& value) const {
    for (std::size_t i = 0; i < entries_; ++i) {
      const std::size_t at = entries_begin + 2 * i;
      if (flash_.read(1 - stale_page_, at) == identity) {
        value = flash_.read(1 - stale_page_, at + 1);
        return true;
      }
    }
    return false;
  }

  /// Begins to save a record; load() must have been called. Does nothing while one is being saved.
  void save(const Record& record) {
    if (step_ != idle) {
      return;
    }
    record_ = record;
    checksum_ = {};
    step_ = erase;
  }

  /// Takes the next step of a save: at most one operation of the flash.
  /// @return saved or failed once, at the end.
  Saving proceed() {
    if (step_ == idle) {
      return Saving::idle;
    }
    if (flash_.busy()) {
      return Saving::busy;
    }
    if (step_ == verify) {
      return conclude();
    }
    if (step_ == erase) {
      flash_.erase(stale_page_);
    } else {
      const std::size_t at = step_ - first_word;
      const std::uint32_t value = word(at);
      flash_.program(stale_page_, at, value);
      if (at < checksum_at) {
        checksum_.add_word(value);
      }
    }
    ++step_;
    return Saving::busy;
  }

  /// Gives up the save at hand. The flash may still end the operation that keeps it busy, so that a
  /// reset finds the old record or, if that was the last one, the new.
  /// @return failed
  Saving abandon() {
    step_ = idle;
    return Saving::failed;
  }

 private:
  // The steps of a save; the words of the record are programmed one in each.
  static constexpr std::size_t idle = 0;
  static constexpr std::size_t erase = 1;
  static constexpr std::size_t first_word = 2;
  static constexpr std::size_t verify = first_word + words_used;

  /// Number of entries, as far as the page's first word can be trusted.
  std::size_t entries(std::size_t page) const { return flash_.read(page, 0) & count_bits; }

  bool is_whole(std::size_t page) const {
    if ((flash_.read(page, 0) & ~count_bits) != format || entries(page) > most_entries) {
      return false;
    }
    const std::size_t end = entries_begin + 2 * entries(page);
    encoding::Crc32 checksum;
    for (std::size_t i = 0; i < end; ++i) {
      checksum.add_word(flash_.read(page, i));
    }
    return checksum.value() == flash_.read(page, end);
  }

  bool is_blank(std::size_t page) const {
    for (std::size_t i = 0; i < Flash::page_words; ++i) {
      if (flash_.read(page, i) != 0xFFFFFFFFU) {
        return false;
      }
    }
    return true;
  }

  std::size_t newer_page() const {
    const std::uint32_t ahead = flash_.read(1, 1) - flash_.read(0, 1);
    return ahead - 1 < 0x7FFFFFFFU ? 1 : 0;
  }

  /// What the save at hand writes; the checksum once all before it is.
  std::uint32_t word(std::size_t at) const {
    if (at == checksum_at) {
      return checksum_.value();
    }
    if (at < entries_begin) {
      return at == 0 ? format | Count : at == 1 ? sequence_ : design_;
    }
    const Entry& entry = record_[(at - entries_begin) / 2];
    return (at - entries_begin) % 2 == 0 ? entry.identity : entry.value;
  }

  Saving conclude() {
    step_ = idle;
    for (std::size_t i = 0; i < words_used; ++i) {
      if (flash_.read(stale_page_, i) != word(i)) {
        return Saving::failed;
      }
    }
    stale_page_ = 1 - stale_page_;
    ++sequence_;
    entries_ = Count;
    return Saving::saved;
  }

  Flash& flash_;
  std::uint32_t design_;
  std::size_t stale_page_ = 0;
  std::uint32_t sequence_ = 0;  ///< of the next record
  std::size_t entries_ = 0;     ///< of the newest whole record, which is not on the stale page
  std::size_t step_ = idle;
  Record record_{};  ///< being saved
  encoding::Crc32 checksum_;
};

}  // namespace sonoglide::store
