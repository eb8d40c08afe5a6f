#include "host_sim/fmi/archive/make_fmu.hpp"
#include "host_sim/configure/read/experiment.hpp"

#include <fmt/format.h>
#include <minizip/zip.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "host_sim/fmi/resources.hpp"
#include "host_sim/process/file_error.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::fmi {
namespace {

namespace fs = std::filesystem;

/// As the versions of the interface name this machine.
std::string linux_platform(Version version) {
  return version == Version::fmi3 ? SONOGLIDE_PROCESSOR "-linux" : "linux64";
}

const char* windows_platform(Version version) {
  return version == Version::fmi3 ? "x86_64-windows" : "win64";
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string content((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) {
    process::fail(path, "cannot be read");
  }
  return content;
}

/// The newest version of glibc whose symbols a shared library asks for, such as 2.34; as the library
/// names it, `GLIBC_2.34`.
std::string needed_glibc(std::string_view library) {
  constexpr std::string_view prefix = "GLIBC_";
  std::vector<int> newest;
  for (std::size_t at = library.find(prefix); at != std::string_view::npos;
       at = library.find(prefix, at)) {
    std::vector<int> version;
    do {
      at += version.empty() ? prefix.size() : 1;
      version.push_back(0);
      for (; at < library.size() && std::isdigit(static_cast<unsigned char>(library[at])) != 0;
           ++at) {
        version.back() = 10 * version.back() + (library[at] - '0');
      }
    } while (at < library.size() && library[at] == '.');
    newest = std::max(newest, version);
  }
  return fmt::format("{}", fmt::join(newest, "."));
}

std::string external_dependencies(Version version, const std::string& engine, bool has_windows) {
  std::string text = fmt::format("binaries/{}: glibc {} or newer (libc and libm).\n",
                                 linux_platform(version), needed_glibc(engine));
  if (has_windows) {
    text += fmt::format("binaries/{}: Windows 7 or newer; nothing that Windows does not bring.\n",
                        windows_platform(version));
  }
  return text;
}

/// A ZIP archive in memory, file by file. Two archives of the same files are the same bytes: no file
/// has a time.
class Archive {
 public:
  Archive()
      : zip_(zipOpen64(fmt::format("/proc/self/fd/{}", bytes_.number()).c_str(),
                       APPEND_STATUS_CREATE)) {
    require(zip_ != nullptr);
  }
  ~Archive() {
    if (zip_ != nullptr) {
      zipClose(zip_, nullptr);
    }
  }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  /// @param name  with / between folders
  void add(const std::string& name, std::string_view content) {
    zip_fileinfo facts{};
    facts.tmz_date.tm_mday = 1;  // 1980, the first year that the format knows
    facts.tmz_date.tm_year = 1980;
    require(zipOpenNewFileInZip(zip_, name.c_str(), &facts, nullptr, 0, nullptr, 0, nullptr,
                                Z_DEFLATED, Z_BEST_SPEED) == ZIP_OK);
    require(zipWriteInFileInZip(zip_, content.data(), static_cast<unsigned>(content.size())) ==
            ZIP_OK);
    require(zipCloseFileInZip(zip_) == ZIP_OK);
  }

  /// The bytes; to be called once, last.
  std::string close() {
    require(zipClose(std::exchange(zip_, nullptr), nullptr) == ZIP_OK);
    return process::memory_file_text(bytes_, std::string().max_size());
  }

 private:
  static void require(bool good) {
    if (!good) {
      throw std::runtime_error("an FMU cannot be packed");
    }
  }

  process::Descriptor bytes_ = process::make_memory_file();
  zipFile zip_;
};

}  // namespace

fs::path folder_of_program() {
  return fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "lib/sonoglide";
}

Parts find_parts(const fs::path& folder) {
  Parts parts{folder / "fmu.so", folder / "fmu.dll"};
  if (!fs::exists(parts.engine)) {
    process::fail(parts.engine, "is missing; every FMU holds it, and it is built with the program");
  }
  if (!fs::exists(*parts.windows_engine)) {
    parts.windows_engine.reset();
  }
  return parts;
}

std::string make_fmu(const scene::Scene& given, loop::Kind kind, Version version,
                     const Parts& parts, const std::string& tool) {
  const std::string engine = content_of(parts.engine);
  const std::string windows_engine =
      parts.windows_engine ? content_of(*parts.windows_engine) : std::string();
  const Resources resources = make_resources(given, kind, engine + windows_engine);
  const experiment::Experiment held = experiment::read_text(resources.scene, Resources::scene_name);
  const std::string identifier = fmt::format("sonoglide_{}", scene::name_of(loop::kinds, kind));
  Archive archive;
  archive.add(
      "modelDescription.xml",
      model_description(held, kind, version, {given.name, identifier, resources.token, tool}));
  archive.add(fmt::format("binaries/{}/{}.so", linux_platform(version), identifier), engine);
  if (parts.windows_engine) {
    archive.add(fmt::format("binaries/{}/{}.dll", windows_platform(version), identifier),
                windows_engine);
  }
  archive.add("documentation/externalDependencies.txt",
              external_dependencies(version, engine, parts.windows_engine.has_value()));
  archive.add("documentation/licenses/license.txt", our_licence());
  archive.add("documentation/licenses/compiled_in.txt", compiled_in_licences());
  archive.add(std::string("resources/") + Resources::scene_name, resources.scene);
  archive.add(std::string("resources/") + Resources::kind_name, scene::name_of(loop::kinds, kind));
  archive.add(std::string("resources/") + Resources::token_name, resources.token);
  return archive.close();
}

}  // namespace sonoglide::fmi
