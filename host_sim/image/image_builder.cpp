#include "host_sim/image/image_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "host_sim/image/content_hash.hpp"
#include "host_sim/image/controller_header.hpp"
#include "host_sim/image/cross_tools.hpp"
#include "host_sim/process/find_program.hpp"
#include "host_sim/process/process_error.hpp"
#include "host_sim/process/run_tool.hpp"
#include "host_sim/process/scratch_folder.hpp"

namespace sonoglide::image {
namespace {

namespace fs = std::filesystem;

/// The folder of the configured controller, which CMake names the image after.
constexpr const char* controller_name = "controller";

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw process::ProcessError(path.string() + ": " + reason);
}

const char* environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

fs::path source_tree() {
  const char* named = environment("SONOGLIDE_SOURCE");
  fs::path tree = fs::absolute(named != nullptr ? named : SONOGLIDE_SOURCE);
  if (!fs::exists(tree / "firmware/app/image/main.cpp")) {
    fail(tree,
         "has no Sonoglide sources to build an image from; allowed: SONOGLIDE_SOURCE=FOLDER in "
         "the environment, with the source tree");
  }
  return tree;
}

fs::path cache_folder() {
  if (const char* cache = environment("XDG_CACHE_HOME")) {
    return fs::absolute(cache) / "sonoglide";
  }
  if (const char* home = environment("HOME")) {
    return fs::absolute(home) / ".cache/sonoglide";
  }
  fail("the image cache", "has no place; allowed: XDG_CACHE_HOME or HOME in the environment");
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
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
std::string key_of(const emulator::EmulatedBoard& board, const std::string& header,
                   const fs::path& tree, const fs::path& compiler) {
  ContentHash hash;
  hash.add(board.name);
  hash.add(board.toolchain);
  hash.add(header);
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

void compile(const emulator::EmulatedBoard& board, const std::string& header, const fs::path& tree,
             const fs::path& folder, const process::Attention& attention) {
  const fs::path controller = folder / controller_name;
  fs::create_directory(controller);
  std::ofstream(controller / controller_header_name, std::ios::binary) << header;
  const fs::path toolchain = tree / fmt::format("tools/toolchains/{}.cmake", board.toolchain);
  const std::string build = (folder / "build").string();
  process::run_tool({"cmake", "-G", "Ninja", "-S", tree.string(), "-B", build,
                     "-DCMAKE_TOOLCHAIN_FILE=" + toolchain.string(),
                     fmt::format("-DSONOGLIDE_BOARD={}", board.name),
                     "-DSONOGLIDE_CONTROLLERS=" + controller.string()},
                    attention);
  process::run_tool({"cmake", "--build", build, "--target", controller_name}, attention);
}

}  // namespace

fs::path build_image(const emulator::EmulatedBoard& board, const std::string& header,
                     const process::Attention& attention) try {
  const fs::path tree = source_tree();
  const CrossTools tools = cross_tools(board);
  process::require_program("cmake", "cmake");
  process::require_program("ninja", "ninja-build");
  const fs::path compiler = process::require_program(tools.prefix + "g++", tools.package);
  const fs::path cache = cache_folder();
  fs::path image = cache / (key_of(board, header, tree, compiler) + ".elf");
  if (!fs::exists(image)) {
    fs::create_directories(cache);
    const process::ScratchFolder folder(cache);  // beside its target: the move there is a renaming
    compile(board, header, tree, folder.path(), attention);
    // Somebody else may have put the same image there meanwhile: that one serves as well.
    fs::rename(folder.path() / "build/bin" / fmt::format("{}.elf", controller_name), image);
  }
  return image;
} catch (const fs::filesystem_error& error) {
  throw process::ProcessError(error.what());
}

}  // namespace sonoglide::image
