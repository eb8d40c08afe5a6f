/// A record of numbers in flash that a power cut leaves whole.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/encoding/crc32.hpp"

namespace sonoglide::app::store {

/// Where the record in use comes from.
enum class Origin : std::uint8_t {
  stored,
  blank,         ///< nothing was ever stored; as compiled in
  other_layout,  ///< a record of another layout is stored; as compiled in
  damaged,       ///< what is stored is not whole; as compiled in
};

enum class Saving : std::uint8_t {
  idle,
  busy,
  saved,   ///< what was written is in force from the next load() on
  failed,  ///< the flash did not keep what was programmed; the old record stands
};

/// Keeps a record of `Count` words in two flash pages, written in turn.
///
/// | word      | holds                                    |
/// |-----------|------------------------------------------|
/// | 0         | layout of the record                     |
/// | 1         | sequence number, counts up and wraps     |
/// | 2 …       | the record                               |
/// | 2 + Count | CRC-32 of all before it, words low first |
///
/// The page with the older record is erased and programmed, its checksum last, while the newer one
/// is not touched. Power may fail during any erase or program: load() then finds the old record or
/// the new one, whole. What a torn operation left is told from a record by the checksum, with a
/// chance of 2^-32 to mistake it; a cell left between 0 and 1 may read differently at each reset,
/// and one of the two records comes each time.
///
/// @tparam Flash  see hal/board.hpp; not owned.
template <class Flash, std::size_t Count>
class TwoPageStore {
  static constexpr std::size_t record_begin = 2;
  static constexpr std::size_t checksum_at = record_begin + Count;
  static constexpr std::size_t words_used = checksum_at + 1;
  static_assert(words_used <= Flash::page_words);

 public:
  using Record = std::array<std::uint32_t, Count>;

  /// @param layout  identifies the meaning of the words; not 0xFFFFFFFF, that of an erased page.
  TwoPageStore(Flash& flash, std::uint32_t layout) : flash_(flash), layout_(layout) {}

  /// Finds the newest whole record. Unless it is `stored`, `record` stays as it was.
  Origin load(Record& record) {
    const bool whole[2] = {is_whole(0), is_whole(1)};
    if (!whole[0] && !whole[1]) {
      stale_page_ = 0;
      sequence_ = 0;
      return is_blank(0) && is_blank(1) ? Origin::blank : Origin::damaged;
    }
    const std::size_t newest = whole[0] && whole[1] ? newer_page() : (whole[0] ? 0U : 1U);
    stale_page_ = 1 - newest;
    sequence_ = flash_.read(newest, 1) + 1;
    if (flash_.read(newest, 0) != layout_) {
      return Origin::other_layout;
    }
    for (std::size_t i = 0; i < Count; ++i) {
      record[i] = flash_.read(newest, record_begin + i);
    }
    return Origin::stored;
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

 private:
  // The steps of a save; the words of the record are programmed one in each.
  static constexpr std::size_t idle = 0;
  static constexpr std::size_t erase = 1;
  static constexpr std::size_t first_word = 2;
  static constexpr std::size_t verify = first_word + words_used;

  bool is_whole(std::size_t page) const {
    encoding::Crc32 checksum;
    for (std::size_t i = 0; i < checksum_at; ++i) {
      checksum.add_word(flash_.read(page, i));
    }
    return checksum.value() == flash_.read(page, checksum_at) && !is_blank(page);
  }

  bool is_blank(std::size_t page) const {
    for (std::size_t i = 0; i < words_used; ++i) {
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
    if (at < record_begin) {
      return at == 0 ? layout_ : sequence_;
    }
    return at < checksum_at ? record_[at - record_begin] : checksum_.value();
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
    return Saving::saved;
  }

  Flash& flash_;
  std::uint32_t layout_;
  std::size_t stale_page_ = 0;
  std::uint32_t sequence_ = 0;  ///< of the next record
  std::size_t step_ = idle;
  Record record_{};  ///< being saved
  encoding::Crc32 checksum_;
};

}  // namespace sonoglide::app::store
