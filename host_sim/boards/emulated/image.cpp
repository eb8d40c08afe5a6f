#include "host_sim/boards/emulated/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/process/checksum.hpp"
#include "host_sim/process/child_process.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/process/scratch_folder.hpp"

namespace sonoglide::emulated {
namespace {

namespace fs = std::filesystem;

/// The folder of the configured controller, which CMake names the image after.
constexpr const char* controller_name = "controller";

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw process::ProcessError(process::printable(path.string()) + ": " + reason);
}

/// To CMake a semicolon is the end of a path, and it, Ninja or the shell stumble over a few others.
void require_for_cmake(const fs::path& path) {
  const std::string name = path.string();
  if (name.find_first_of(";\"\\<>|$") != std::string::npos || process::printable(name) != name) {
    fail(path,
         "cannot be used by CMake; allowed: a path in UTF-8 without ; \" \\ < > | $ and control "
         "characters");
  }
}

const char* environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

bool has_sources(const fs::path& tree) {
  return fs::exists(tree / "firmware/image/main.cpp");
}

/// Beside the program where it is installed; else what it was built from.
fs::path own_source_tree() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path installed = program.parent_path().parent_path() / "share/sonoglide/source";
  return has_sources(installed) ? installed : fs::path(SONOGLIDE_SOURCE);
}

}  // namespace

fs::path source_tree() {
  const char* named = environment("SONOGLIDE_SOURCE");
  fs::path tree = named != nullptr ? fs::absolute(named) : own_source_tree();
  if (!has_sources(tree)) {
    fail(tree,
         "has no Sonoglide sources to build an image from; allowed: SONOGLIDE_SOURCE=FOLDER in "
         "the environment, with the source tree");
  }
  return tree;
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

namespace {

fs::path cache_folder() {
  if (const char* cache = environment("XDG_CACHE_HOME")) {
    return fs::absolute(cache) / "sonoglide";
  }
  if (const char* home = environment("HOME")) {
    return fs::absolute(home) / ".cache/sonoglide";
  }
  fail("the image cache", "has no place; allowed: XDG_CACHE_HOME or HOME in the environment");
}

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  errno = 0;
  file << text;
  file.close();
  if (!file) {
    fail(path, "could not be written in full: " + std::generic_category().message(errno));
  }
}

std::vector<fs::path> image_sources(const fs::path& tree) {
  std::vector<fs::path> sources{"CMakeLists.txt"};
  for (const char* folder : {"firmware", "hal", "tools/cmake", "tools/toolchains"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(tree / folder)) {
      if (entry.is_regular_file()) {
        sources.push_back(fs::relative(entry.path(), tree));
      }
    }
  }
  std::sort(sources.begin(), sources.end());
  return sources;
}

/// What an image is made of, as a name for it.
std::string key_of(const ImageBoard& board, std::string_view suffix, const std::string& header,
                   const std::string& encoder, const fs::path& tree, const fs::path& compiler) {
  process::ContentHash hash;
  hash.add(board.name);
  hash.add(board.toolchain);
  hash.add(suffix);
  hash.add(header);
  hash.add(encoder);
  for (const fs::path& source : image_sources(tree)) {
    hash.add(source.string());
    hash.add(content(tree / source));
  }
  const fs::path program = fs::canonical(compiler);
  hash.add(program.string());
  hash.add(fmt::format("{} {}", fs::file_size(program),
                       fs::last_write_time(program).time_since_epoch().count()));
  return fmt::format("{}-{:016x}", board.name, hash.value());
}

/// Says of an image which one it is and that it is whole.
std::string name_of(const std::string& key, const fs::path& image) {
  process::ContentHash hash;
  hash.add(key);
  hash.add(content(image));
  return fmt::format("{}-{:016x}.elf", key, hash.value());
}

/// Empty where there is none that is whole; others under its key are removed.
fs::path find_image(const fs::path& cache, const std::string& key) {
  fs::path found;
  std::error_code unknown;
  for (const fs::directory_entry& entry : fs::directory_iterator(cache)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(key + '-', 0) != 0 || !entry.is_regular_file(unknown)) {
      continue;
    }
    if (name == name_of(key, entry.path())) {
      found = entry.path();
    } else {
      fs::remove(entry.path(), unknown);
    }
  }
  return found;
}

std::string image_name(std::string_view suffix) {
  return fmt::format("{}{}", controller_name, suffix);
}

/// As CMake takes it; empty: there is none.
std::string encoder_text(double counts_per_m) {
  return counts_per_m > 0.0 ? fmt::format("{:.17g}", counts_per_m) : "";
}

void compile(const ImageBoard& board, std::string_view suffix, const std::string& header,
             const std::string& encoder, const fs::path& tree, const fs::path& folder) {
  const fs::path controller = folder / controller_name;
  fs::create_directory(controller);
  write_file(controller / controller_header_name, header);
  const fs::path toolchain = tree / fmt::format("tools/toolchains/{}.cmake", board.toolchain);
  const std::string build = (folder / "build").string();
  process::run_tool({"cmake", "-G", "Ninja", "-S", tree.string(), "-B", build,
                     "-DCMAKE_TOOLCHAIN_FILE=" + toolchain.string(),
                     fmt::format("-DSONOGLIDE_BOARD={}", board.name),
                     "-DSONOGLIDE_CONTROLLERS=" + controller.string(),
                     "-DSONOGLIDE_ENCODER_COUNTS_PER_M=" + encoder});
  process::run_tool({"cmake", "--build", build, "--target", image_name(suffix)});
}

/// Where node finds rp2040js: in NODE_PATH, or where tools/setup puts it.
fs::path npm_folder() {
  std::vector<fs::path> folders{source_tree() / "build/npm/node_modules"};
  const char* named = environment("NODE_PATH");
  std::istringstream list(named != nullptr ? named : "");
  for (std::string folder; std::getline(list, folder, ':');) {
    folders.emplace_back(fs::absolute(folder));
  }
  const auto found = std::find_if(folders.begin(), folders.end(), [](const fs::path& folder) {
    return fs::exists(folder / "rp2040js");
  });
  if (found == folders.end()) {
    throw process::ProcessError(
        "rp2040js: the npm package that emulates a Pico is not installed; allowed: "
        "npm install rp2040js@1.4.1, and NODE_PATH=FOLDER/node_modules in the environment");
  }
  return *found;
}

}  // namespace

fs::path build_image(const ImageBoard& board, std::string_view suffix, const std::string& header,
                     double encoder_counts_per_m) try {
  const fs::path tree = source_tree();
  const CrossTools tools = cross_tools(board);
  process::require_program("cmake", "cmake");
  process::require_program("ninja", "ninja-build");
  const fs::path compiler = process::require_program(tools.prefix + "g++", tools.package);
  const fs::path cache = cache_folder();
  require_for_cmake(tree);
  require_for_cmake(cache);
  const std::string encoder = encoder_text(encoder_counts_per_m);
  const std::string key = key_of(board, suffix, header, encoder, tree, compiler);
  fs::create_directories(cache);
  fs::path image = find_image(cache, key);
  if (image.empty()) {
    const process::ScratchFolder folder(cache);  // beside its target: the move there is a renaming
    compile(board, suffix, header, encoder, tree, folder.path());
    const fs::path built = folder.path() / "build/bin" / (image_name(suffix) + ".elf");
    // Somebody else may have done the same meanwhile, and may do so now: either image serves.
    image = find_image(cache, key);
    if (image.empty()) {
      image = cache / name_of(key, built);
      fs::rename(built, image);
    }
  }
  return image;
} catch (const fs::filesystem_error& error) {
  fail(error.path2().empty() ? error.path1() : error.path2(),
       error.code().message() +
           "; allowed: XDG_CACHE_HOME or HOME in the environment, a folder that can be written to, "
           "where no other files have the names of images");
}

std::vector<std::string> node_command(const emulated::EmulatedBoard& board,
                                      std::string_view program) {
  const fs::path file = source_tree() / fmt::format("hal/{}/emulated/{}", board.name, program);
  return {"env", "NODE_PATH=" + npm_folder().string(), "node", file.string()};
}

std::vector<std::string> run_command(const emulated::EmulatedBoard& board, const fs::path& image) {
  if (board.emulator != "node") {
    return emulator_command(board, image.string());
  }
  std::vector<std::string> command = node_command(board, "lockstep.cjs");
  command.push_back(image.string());
  return command;
}

}  // namespace sonoglide::emulated
