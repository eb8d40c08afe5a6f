/// Records in flash that are written often: appended, so that a page is erased once in many of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/encoding/crc32.hpp"
#include "firmware/store/two_page_store.hpp"

namespace sonoglide::store {

/// Keeps the last of many records of `Count` words in two flash pages.
///
/// A record takes a slot of Count + 2 words: sequence number, the words, CRC-32 of a format word and of these. The
/// next record is programmed into the next slot. When a page is full, the other one is erased; it holds only older
/// records. If power fails during any erase or program, load() finds the old record or the new one, whole,
/// but for a probability of 2^-32. The number of erases of each page is that of the records over twice the slots.
///
/// @tparam Flash  see hal/board.hpp; not owned. At most 256 words of a page are used.
template <class Flash, std::size_t Count>
class RecordLog {
  static constexpr std::uint32_t format = 0x534E4800 | Count;
  static constexpr std::size_t slot_words = Count + 2;
  static constexpr std::size_t words_used = Flash::page_words < 256 ? Flash::page_words : 256;

 public:
  static constexpr std::size_t slots = words_used / slot_words;
  static_assert(slots > 0 && Count < 256);

  using Record = std::array<std::uint32_t, Count>;

  /// @param flash       outlives the log.
  /// @param first_page  of the two
  RecordLog(Flash& flash, std::size_t first_page) : flash_(flash), first_page_(first_page) {}

  // Cold and out of line, as all that is not control: for fewer bytes, not for speed.
  /// Finds the newest whole record.
  /// @param record  as it was where there is none
  /// @return stored; blank; or damaged: something stands there, and no whole record
  [[gnu::cold, gnu::noinline]] Origin load(Record& record) {
    bool found = false;
    std::size_t newest = 0;
    for (std::size_t i = 0; i < 2 * slots; ++i) {
      const std::uint32_t sequence = read(i, 0);
      if (is_whole(i) && (!found || sequence - sequence_ < 0x80000000U)) {
        found = true;
        newest = i;
        sequence_ = sequence;
      }
    }
    if (found) {
      for (std::size_t i = 0; i < Count; ++i) {
        record[i] = read(newest, 1 + i);
      }
    }
    next_ = found ? first_blank_after(newest) : 0;
    erases_ = next_ % slots == 0;
    ++sequence_;
    return found ? Origin::stored : all_blank() ? Origin::blank : Origin::damaged;
  }

  /// Begins to save a record; load() must have been called. Does nothing while one is being saved.
  void save(const Record& record) {
    if (step_ == idle) {
      record_ = record;
      checksum_ = begun();
      step_ = erases_ ? erase : first_word;
    }
  }

  bool saving() const { return step_ != idle; }

  /// Takes the next step of a save: at most one operation of the flash.
  /// @return saved or failed once, at the end
  [[gnu::cold, gnu::noinline]] Saving proceed() {
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
      flash_.erase(page(next_));
    } else {
      const std::size_t at = step_ - first_word;
      const std::uint32_t value = word(at);
      flash_.program(page(next_), place(next_, at), value);
      if (at <= Count) {
        checksum_.add_word(value);
      }
    }
    ++step_;
    return Saving::busy;
  }

 private:
  // The steps of a save; the words are programmed one in each.
  static constexpr std::size_t idle = 0;
  static constexpr std::size_t erase = 1;
  static constexpr std::size_t first_word = 2;
  static constexpr std::size_t verify = first_word + slot_words;

  static encoding::Crc32 begun() {
    encoding::Crc32 checksum;
    checksum.add_word(format);
    return checksum;
  }

  std::size_t page(std::size_t slot) const { return first_page_ + slot / slots; }
  static std::size_t place(std::size_t slot, std::size_t word) {
    return slot % slots * slot_words + word;
  }
  [[gnu::cold, gnu::noinline]] std::uint32_t read(std::size_t slot, std::size_t word) const {
    return flash_.read(page(slot), place(slot, word));
  }

  [[gnu::cold, gnu::noinline]] bool is_whole(std::size_t slot) const {
    encoding::Crc32 checksum = begun();
    for (std::size_t i = 0; i <= Count; ++i) {
      checksum.add_word(read(slot, i));
    }
    return checksum.value() == read(slot, Count + 1);
  }

  bool is_blank(std::size_t slot) const {
    for (std::size_t i = 0; i < slot_words; ++i) {
      if (read(slot, i) != 0xFFFFFFFFU) {
        return false;
      }
    }
    return true;
  }

  bool all_blank() const {
    std::size_t i = 0;
    while (i < 2 * slots && is_blank(i)) {
      ++i;
    }
    return i == 2 * slots;
  }

  /// Behind every slot of its page in which something stands; the first of the other page where that is full.
  std::size_t first_blank_after(std::size_t slot) const {
    const std::size_t end = (slot / slots + 1) * slots;
    std::size_t blank = end;
    while (blank > slot + 1 && is_blank(blank - 1)) {
      --blank;
    }
    return blank % (2 * slots);
  }

  /// What the save at hand writes; the checksum once all before it is.
  std::uint32_t word(std::size_t at) const {
    return at == 0 ? sequence_ : at <= Count ? record_[at - 1] : checksum_.value();
  }

  Saving conclude() {
    step_ = idle;
    Saving result = Saving::saved;
    for (std::size_t i = 0; i < slot_words; ++i) {
      if (read(next_, i) != word(i)) {
        result = Saving::failed;
      }
    }
    if (result == Saving::saved || !erases_) {
      next_ = (next_ + 1) % (2 * slots);
      erases_ = next_ % slots == 0;
    }
    ++sequence_;
    return result;
  }

  Flash& flash_;
  std::size_t first_page_;
  std::uint32_t sequence_ = 0;  ///< of the next record
  std::size_t next_ = 0;        ///< slot of the next record, over both pages
  bool erases_ = true;          ///< its page first
  std::size_t step_ = idle;
  Record record_{};  ///< being saved
  encoding::Crc32 checksum_;
};

}  // namespace sonoglide::store
