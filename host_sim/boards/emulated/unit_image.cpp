#include "host_sim/boards/emulated/unit_image.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "host_sim/boards/emulated/board_limits.hpp"
#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/boards/emulated/image.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/process/child_process.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/regular_expression.hpp"
#include "host_sim/process/scratch_folder.hpp"

namespace sonoglide::emulated {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view elf = ".elf";
constexpr std::string_view bin = ".bin";
constexpr std::string_view uf2 = ".uf2";

std::vector<UnitBoard> boards_of_products() {
  constexpr std::string_view unit = "_unit";
  constexpr std::string_view copy = "cp ";
  constexpr std::string_view nucleo = "openocd -f board/st_nucleo_g4.cfg -c ";
  constexpr std::string_view verify = " verify reset exit";
  return {
      {{"pico", "Cortex-M0+", "arm-cortex-m0plus", false, false},
       unit,
       false,
       {{uf2, copy, " /media/$USER/RPI-RP2/"},
        {elf, "openocd -f interface/cmsis-dap.cfg -f target/rp2040.cfg -c ", verify, true},
        {bin, "picotool load -x ", ""}},
       "rp2040",
       "6 MHz / n, n from 97 on"},
      {{"pico2", "Cortex-M33", "arm-cortex-m33"},
       unit,
       false,
       {{uf2, copy, " /media/$USER/RP2350/"},
        {elf, "picotool load -x ", ""},
        {bin, "picotool load -x ", ""}},
       "rp2350",
       "3 MHz / n, n from 49 on"},
      {{"nucleo-g474re", "Cortex-M4F", "arm-cortex-m4f"},
       unit,
       false,
       {{elf, nucleo, verify, true}, {bin, nucleo, " 0x08000000 verify reset exit", true}},
       "",
       "84 MHz / n, n from 960 on",
       true},
  };
}

/// What comes before the image.
std::string emulator_begin(const EmulatedBoard& board) {
  return fmt::format("{}", fmt::join(unit_emulator_command(board, ""), " "));
}

std::vector<UnitBoard> all_boards() {
  static const std::vector<std::string> begins = [] {
    std::vector<std::string> texts;
    for (const EmulatedBoard& board : emulated_boards()) {
      texts.push_back(emulator_begin(board));
    }
    return texts;
  }();
  std::vector<UnitBoard> boards = boards_of_products();
  for (std::size_t i = 0; i < begins.size(); ++i) {
    boards.push_back({emulated_boards()[i], "_timed", true, {{elf, begins[i], ""}}});
  }
  return boards;
}

/// What an image says of the scene where it does not compile or link, and of which key.
std::optional<configure::ConfigurationError> refusal(const std::string& words,
                                                     const UnitBoard& board) {
  static const process::RegularExpression asserted("static assertion failed: ([^\n]*)");
  static const process::RegularExpression key("[a-z]+\\.[a-z][A-Za-z_]*");
  static const process::RegularExpression memory(
      "region `[^']*' overflowed by [0-9]+ bytes|less than [^\n]* for the stack");
  if (const process::Match told = asserted.search(words); !told.empty()) {
    const std::string& message = told[1];
    if (const process::Match found = key.search(message); !found.empty()) {
      const std::string named = found[0] + ": ";
      const std::string reason =
          message.rfind(named, 0) == 0 ? message.substr(named.size()) : message;
      const bool of_carrier = found[0] == "drive.frequency_Hz" && !board.carriers.empty();
      return configure::ConfigurationError(
          found[0], fmt::format("{} ({}){}{}", reason, board.name, of_carrier ? "; allowed: " : "",
                                of_carrier ? board.carriers : ""));
    }
  } else if (const process::Match found = memory.search(words); !found.empty()) {
    return configure::ConfigurationError(
        "controller",
        fmt::format(
            "the unit is too large for the {}: {}; allowed: another controller.arithmetic, a "
            "scene with fewer parts, or another board",
            board.name, found[0]));
  }
  return std::nullopt;
}

}  // namespace

const UnitFile* UnitBoard::file(std::string_view ending) const {
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const UnitFile& each) { return each.ending == ending; });
  return found == files.end() ? nullptr : &*found;
}

const std::vector<UnitBoard>& unit_boards() {
  static const std::vector<UnitBoard> boards = all_boards();
  return boards;
}

const UnitBoard* find_unit_board(std::string_view name) {
  const std::vector<UnitBoard>& boards = unit_boards();
  const auto found = std::find_if(boards.begin(), boards.end(),
                                  [&](const UnitBoard& board) { return board.name == name; });
  return found == boards.end() ? nullptr : &*found;
}

void require_unit(const scene::Scene& scene, const UnitBoard& board) {
  require_arithmetic(scene, board);
}

fs::path build_unit(const UnitBoard& board, const std::string& header,
                    double encoder_counts_per_m) {
  try {
    return build_image(board, board.image_suffix, header, encoder_counts_per_m);
  } catch (const process::ProcessError& error) {
    if (const auto refused = refusal(error.what(), board)) {
      throw *refused;
    }
    throw;
  }
}

std::string unit_file(const UnitBoard& board, const fs::path& image, std::string_view ending) {
  if (ending == elf) {
    return content(image);
  }
  const process::ScratchFolder folder(fs::temp_directory_path());
  const fs::path file = folder.path() / fmt::format("unit{}", ending);
  if (ending == bin) {
    process::run_tool(
        {cross_tools(board).prefix + "objcopy", "-O", "binary", image.string(), file.string()});
  } else {
    // It writes its file beside the image.
    const fs::path copy = folder.path() / "unit.elf";
    fs::copy_file(image, copy);
    process::require_program("python3", "python3");
    process::run_tool({"python3", (source_tree() / "hal/pico/write_uf2").string(), copy.string(),
                       std::string(board.uf2_chip)});
  }
  return content(file);
}

}  // namespace sonoglide::emulated
