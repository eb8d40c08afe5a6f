#include "tests/boards/budget/image_parts.hpp"

#include <fmt/format.h>

#include <array>
#include <set>
#include <sstream>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/process/child_process.hpp"

namespace sonoglide::budget {
namespace {

/// Of every instruction, on either processor.
constexpr std::uint64_t granule_bytes = 2;

/// One line of GNU nm --print-size: address, size where known, kind, name.
struct Symbol {
  std::uint64_t address = 0;
  std::uint64_t bytes = 0;
  char kind = '\0';
  std::string name;
};

Symbol symbol_of(const std::string& line) {
  std::istringstream columns(line);
  std::string address;
  std::string next;
  Symbol symbol;
  columns >> address >> next;
  symbol.address = std::stoull(address, nullptr, 16);
  if (next.size() > 1) {
    symbol.bytes = std::stoull(next, nullptr, 16);
    columns >> next;
  }
  symbol.kind = next[0];
  std::getline(columns >> std::ws, symbol.name);
  return symbol;
}

std::vector<Symbol> symbols_in(const std::string& text) {
  std::vector<Symbol> symbols;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    symbols.push_back(symbol_of(line));
  }
  return symbols;
}

struct Text {
  std::uint64_t begin = 0;
  std::uint64_t bytes = 0;
};

/// The section of the code, from GNU size -A.
Text text_of(const std::string& sections) {
  std::istringstream lines(sections);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream columns(line);
    std::string name;
    Text text;
    if (columns >> name >> text.bytes >> text.begin && name == ".text") {
      return text;
    }
  }
  return {};
}

/// From the repository's root, "" where the file is not ours.
std::string file_of(const std::string& place) {
  for (const char* root : {"firmware/", "hal/"}) {
    const std::size_t begin = place.rfind(root);
    if (begin != std::string::npos && (begin == 0 || place[begin - 1] == '/')) {
      return place.substr(begin, place.find(':') - begin);
    }
  }
  return "";
}

void add_code(const std::string& prefix, const std::string& image, ImageParts& parts) {
  const Text text =
      text_of(process::run_tool({prefix + "size", "--format=sysv", "--radix=10", image}, {}));
  std::vector<std::string> command{prefix + "addr2line", "--functions", "--demangle",
                                   "--exe=" + image};
  for (std::uint64_t at = 0; at < text.bytes; at += granule_bytes) {
    command.push_back(fmt::format("{:#x}", text.begin + at));
  }
  std::istringstream places(process::run_tool(command, {}));
  std::set<std::string> functions;
  std::string place;
  for (std::string function; std::getline(places, function) && std::getline(places, place);) {
    functions.insert(function);
    parts.files[file_of(place)] += granule_bytes;
  }
  for (const std::string& function : functions) {
    parts.names += function + "\n";
  }
}

bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

/// The namespaces of ours are their rooms.
std::string room_of(const std::string& symbol) {
  for (const char* room : {"control", "friction", "numeric", "app", "link", "store"}) {
    if (has(symbol, fmt::format("sonoglide::{}::", room).c_str())) {
      return fmt::format("firmware/{}/", room);
    }
  }
  return has(symbol, "sonoglide::hal::") ? "hal/" : "";
}

void add_constants(const std::vector<Symbol>& symbols, FileBytes& files) {
  for (const Symbol& symbol : symbols) {
    const bool constant = std::string("rRVD").find(symbol.kind) != std::string::npos;
    files[room_of(symbol.name)] += constant ? symbol.bytes : 0;
  }
}

bool is_of_application(const std::string& file) {
  return has(file, "firmware/app/") || has(file, "firmware/link/") ||
         has(file, "firmware/store/") || has(file, "firmware/image/");
}

Parts parts_of(const FileBytes& files) {
  Parts parts;
  for (const auto& [file, bytes] : files) {
    if (is_of_application(file)) {
      parts.application += bytes;
    } else if (has(file, "firmware/")) {
      parts.controller += bytes;
    } else if (has(file, "hal/")) {
      parts.board += bytes;
    } else {
      parts.library += bytes;
    }
  }
  return parts;
}

StateBytes state_of(const std::vector<Symbol>& symbols) {
  StateBytes state;
  for (const Symbol& symbol : symbols) {
    if (symbol.name == "controller_state") {
      state.controller = symbol.bytes;
    } else if (symbol.name == "application_state") {
      state.application = symbol.bytes;
    } else if (symbol.name == "board_state") {
      state.board = symbol.bytes;
    }
  }
  return state;
}

}  // namespace

ImageParts image_parts(const emulated::EmulatedBoard& board, const std::filesystem::path& image,
                       std::uint64_t flash_bytes) {
  const std::string prefix = emulated::cross_tools(board).prefix;
  ImageParts parts;
  parts.names = process::run_tool(
      {prefix + "nm", "--print-size", "--demangle", "--defined-only", image.string()}, {});
  const std::vector<Symbol> symbols = symbols_in(parts.names);
  add_code(prefix, image.string(), parts);
  add_constants(symbols, parts.files);
  std::uint64_t known = 0;
  for (const auto& [file, bytes] : parts.files) {
    known += bytes;
  }
  parts.files[""] += flash_bytes - known;
  parts.flash = parts_of(parts.files);
  parts.state = state_of(symbols);
  return parts;
}

}  // namespace sonoglide::budget
