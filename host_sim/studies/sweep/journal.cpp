#include "host_sim/studies/sweep/journal.hpp"

#include <optional>
#include <string_view>
#include <utility>

namespace sonoglide::sweep {
namespace {

constexpr long_work::JournalKind kind = {"sweep", "--vary"};

}  // namespace

Journal::Journal(const std::filesystem::path& folder, const Identity& identity, std::size_t points)
    : journal_(folder / "sweep.journal", kind, identity, [&](std::string_view text) {
        std::optional<Record> record = parse_record(text);
        if (!record || record->point >= points) {
          return false;
        }
        finished_.push_back(std::move(*record));
        return true;
      }) {}

std::string Journal::text_of(const std::vector<Record>& records) {
  std::string text;
  for (const Record& record : records) {
    text += long_work::Journal::line_of(record_text(record));
  }
  return text;
}

}  // namespace sonoglide::sweep
